"""The error for data that does not fit its class."""

from __future__ import annotations

from typing import Any, NoReturn

MISSING = object()


class DamagedError(ValueError):
    """Data that does not fit its class; names the field, the value and the rule."""

    def __init__(self, value: object, rule: str, place: str = "") -> None:
        super().__init__(value, rule, place)
        self.value, self.rule, self.place = value, rule, place

    def __str__(self) -> str:
        shown = "" if self.value is MISSING else f" = {self.value!r:.60}"
        return f"{self.place.removeprefix('.')}{shown}; {self.rule}"

    def within(self, name: str) -> DamagedError:
        """The same error, with the name of the enclosing object in front."""
        return DamagedError(self.value, self.rule, f"{name}{self.place}")


def refuse(data: Any, rule: str) -> NoReturn:
    """Raise DamagedError for a value that breaks a rule."""
    raise DamagedError(data, rule)
