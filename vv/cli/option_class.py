"""Lets a command take its options as one frozen dataclass, a field for each."""

from __future__ import annotations

import dataclasses
import functools
import inspect
from collections.abc import Callable
from typing import Any, TypeVar, get_type_hints

Call = TypeVar("Call")
Command = Callable[..., None]


def takes(fields: type[Call]) -> Callable[[Callable[[Call], None]], Command]:
    """Decorator for a command whose options are the fields of a dataclass.

    The option parser reads the fields as the parameters of a function.
    """
    hints = get_type_hints(fields, include_extras=True)
    parameters = [
        inspect.Parameter(
            field.name,
            inspect.Parameter.KEYWORD_ONLY,
            default=field.default,
            annotation=hints[field.name],
        )
        for field in dataclasses.fields(fields)  # type: ignore[arg-type]  # any dataclass
    ]

    def decorate(command: Callable[[Call], None]) -> Command:
        @functools.wraps(command)
        def called(**given: Any) -> None:
            command(fields(**given))

        called.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        return called

    return decorate
