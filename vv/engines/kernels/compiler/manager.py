"""Runs numba's passes, less what it notes, times and checks around each of them and each statement.

A sixth of the time of compiling went into events that nobody hears, traps for warnings that nobody
raises, and texts of statements in case an error occurs. Where one does, its place is added then.
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
    """All passes of a function, one after the other."""

    def _runPass(self, index: int, one: Any, state: Any) -> None:  # noqa: N802 - numba's name
        one.analysis = self._analysis
        one.run_initialization(state)
        one.run_pass(state)
        one.run_finalizer(state)


class Nobody(list[Any]):
    """Who hears of numba's events while a whole is compiled, of which there are 100 000."""

    def append(self, listener: object) -> None:
        """Do not listen: each part has two clocks, which are told of all that those within do."""

    def remove(self, listener: object) -> None:
        """Stop listening."""


class Silent:
    """A context in which nothing is added to errors."""

    def __enter__(self) -> None:
        """Note nothing."""

    def __exit__(self, *_: object) -> None:
        """Let what was raised pass."""


SILENT = Silent()


def in_silence(*_: object, **__: object) -> Silent:
    """What numba asks for at each call that it types: words for an error."""
    return SILENT


class Constraints(NETWORK):  # type: ignore[misc]
    """What the types of variables must fulfil, without a trap for warnings around each."""

    def propagate(self, typeinfer: Any) -> list[Any]:
        """Look at each once; returns the errors, for some of which it is only too early."""
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
    """All variables in a value that numba's code of a function is made of."""
    found: list[Any] = []
    gather(value, found)
    return found


def gather(value: Any, found: list[Any]) -> None:
    """Add the variables in a value to those found; most values are places and names, with none."""
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
def quietly() -> Iterator[None]:
    """Compile without listeners to events, and types without words for each call."""
    heard, explained = EVENTS._registered, TYPING.new_error_context
    EVENTS._registered = defaultdict(Nobody)
    TYPING.new_error_context, TYPING.ConstraintNetwork = in_silence, Constraints
    STATEMENT._rec_list_vars = variables
    try:
        yield
    finally:
        EVENTS._registered = heard
        TYPING.new_error_context, TYPING.ConstraintNetwork = explained, NETWORK
        STATEMENT._rec_list_vars = LISTED
