"""Runs numba's passes without its timers, events and checks around each pass and statement.

A sixth of the time of compiling went into events without listeners, contexts for warnings that do
not occur, and texts of statements for possible errors. The place of an error is added when it
occurs.
"""

from __future__ import annotations

import contextlib
from collections import defaultdict
from collections.abc import Iterator
from typing import Any

from numba.core import event, ir, typeinfer
from numba.core.compiler_machinery import PassManager
from numba.core.errors import ForceLiteralArg, TypingError

MANAGER: Any = PassManager
EVENTS: Any = event
TYPING: Any = typeinfer
NETWORK: Any = typeinfer.ConstraintNetwork
PLACED: Any = TypingError
VARIABLE: Any = ir.Var
STATEMENT: Any = ir.Inst
LISTED: Any = STATEMENT._rec_list_vars
PLAIN = frozenset({ir.Loc, str, int, bool, float, type(None)})


class Passes(MANAGER):  # type: ignore[misc]
    """Runs all passes of a function in order."""

    def _runPass(self, index: int, one: Any, state: Any) -> None:  # noqa: N802 - numba's name
        one.analysis = self._analysis
        one.run_initialization(state)
        one.run_pass(state)
        one.run_finalizer(state)


class NoListeners(list[Any]):
    """A list of listeners that stays empty while a kernel is compiled, with some 100 000 events."""

    def append(self, listener: object) -> None:
        """Ignore the listener: each function has two timers that hear all events of its callees."""

    def remove(self, listener: object) -> None:
        """Do nothing, since no listener was added."""


class Silent:
    """A context that adds nothing to errors."""

    def __enter__(self) -> None:
        """Do nothing."""

    def __exit__(self, *_: object) -> None:
        """Let exceptions pass."""


SILENT = Silent()


def silent_context(*_: object, **__: object) -> Silent:
    """The replacement for the context that numba makes at each call to explain an error."""
    return SILENT


class Constraints(NETWORK):  # type: ignore[misc]
    """The constraints on the types of variables, without a context for warnings around each."""

    def propagate(self, typeinfer: Any) -> list[Any]:
        """Apply each constraint once; returns the errors, some of which a later call resolves."""
        found: list[Any] = []
        for constraint in self.constraints:
            try:
                constraint(typeinfer)
            except ForceLiteralArg as error:
                found.append(error)
            except TypingError as error:
                placed = PLACED(str(error), loc=constraint.loc, highlighting=False)
                placed.__cause__ = error
                found.append(placed)
        return found


def variables(statement: Any, value: Any) -> list[Any]:
    """All variables in a value of numba's intermediate representation."""
    found: list[Any] = []
    gather(value, found)
    return found


def gather(value: Any, found: list[Any]) -> None:
    """Append the variables in a value to `found`; most values are locations and names."""
    kind = type(value)
    if kind is VARIABLE:
        found.append(value)
    elif kind is dict:
        for one in value.values():
            if type(one) not in PLAIN:
                gather(one, found)
    elif kind is list or kind is tuple:
        for one in value:
            gather(one, found)
    elif isinstance(value, STATEMENT):
        found += value.list_vars()


@contextlib.contextmanager
def without_events() -> Iterator[None]:
    """A context in which numba compiles without event listeners and without texts for errors."""
    heard, explained = EVENTS._registered, TYPING.new_error_context
    EVENTS._registered = defaultdict(NoListeners)
    TYPING.new_error_context, TYPING.ConstraintNetwork = silent_context, Constraints
    STATEMENT._rec_list_vars = variables
    try:
        yield
    finally:
        EVENTS._registered = heard
        TYPING.new_error_context, TYPING.ConstraintNetwork = explained, NETWORK
        STATEMENT._rec_list_vars = LISTED
