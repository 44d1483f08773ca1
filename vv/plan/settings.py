"""Parses parameters and knobs as users type them, and converts units."""

from __future__ import annotations

import functools
import re
import tokenize
from collections.abc import Sequence
from typing import TYPE_CHECKING

from vv.ask import Knobs
from vv.base.errors import UsageError
from vv.base.hints import name_hint
from vv.case import Case, Parameter, Sign

if TYPE_CHECKING:
    import pint

KNOBS = {"dt": "s", "kn": "N/m", "dd": ""}  # their units


def parameters_with_settings(case: Case, variant: str, settings: Sequence[str]) -> dict[str, float]:
    """Parameters of a variant, changed by texts NAME=VALUE[UNIT]; raises UsageError."""
    parameters = case.defaults(variant)
    by_name = {p.name: p for p in case.parameters}
    for text in settings:
        name, equals, value = (word.strip() for word in text.partition("="))
        if not equals:
            raise UsageError(f"--set {text}: expected NAME=VALUE[UNIT]")
        if name not in by_name:
            raise UsageError(f"{case.name} has no parameter '{name}'{name_hint(name, by_name)}")
        parameters[name] = parse_value(value, by_name[name])
    return parameters


NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[+-]?nan|[+-]?inf)\s*(.*?)\s*")


LONGEST = 40  # the most characters of a unit
BESIDE = (TypeError, AttributeError, AssertionError, tokenize.TokenError)  # raised by pint
_FACTOR = r"[^\W\d_]+(?:(?:\*\*|\^)?-?\d(?:\.\d)?)?|1|%|°"
UNIT = re.compile(rf"\(?(?:{_FACTOR})(?:\s*[*/·]\s*\(?(?:{_FACTOR})\)?|\s+(?:{_FACTOR}))*\)?")


def parse_value(text: str, parameter: Parameter) -> float:
    """A typed value, converted to the parameter's unit; raises UsageError naming the parameter."""
    match = NUMBER.fullmatch(text)
    if match is None:
        raise UsageError(f"{parameter.name} = '{text}': not a number with an optional unit")
    value, unit = float(match[1]), match[2]
    plain = unit in ("", parameter.unit)
    try:
        return parameter.checked(value if plain else _converted(value, unit, parameter))
    except ValueError as error:
        raise UsageError(str(error)) from error


def _converted(value: float, unit: str, parameter: Parameter) -> float:
    def readable(text: str) -> str:
        return re.sub(r"([A-Za-z])(\d)", r"\1**\2", text) or "dimensionless"

    shown = unit if len(unit) <= LONGEST else f"{unit[:LONGEST]}..."
    if shown != unit or not UNIT.fullmatch(unit):  # other texts would be evaluated, even 9**9**9
        raise UsageError(
            f"{parameter.name} = {value:g} '{shown}': not a unit, such as kN/m or m/s**2"
        )
    import pint

    units = _units()
    try:
        typed = units.Quantity(value, readable(unit))
        return float(typed.to(readable(parameter.unit)).magnitude)
    except (pint.PintError, ValueError, *BESIDE) as error:
        target = parameter.unit or "a plain number"
        raise UsageError(
            f"{parameter.name} = {value:g} '{unit}': not a unit that converts to {target}"
        ) from error


@functools.cache
def _units() -> pint.UnitRegistry[float]:
    """The registry of all units, which takes a third of a second to load."""
    import pint

    return pint.UnitRegistry()


def parse_knobs(text: str) -> Knobs:
    """Knobs from a text such as dt=1e-4,kn=1e9 or dt=50us; raises UsageError."""
    values: dict[str, float] = {}
    for part in text.split(","):
        name, equals, value = (word.strip() for word in part.partition("="))
        if not equals or name not in KNOBS:
            raise UsageError(f"--rung {text}: expected dt=SECONDS, kn=N/M, or dt=SECONDS,kn=N/M")
        if name in values:
            raise UsageError(f"--rung {text}: {name} is given twice; repeat --rung instead")
        try:
            values[name] = parse_value(value, Parameter(name, 1.0, KNOBS[name], "", Sign.ANY))
        except UsageError as error:
            raise UsageError(f"--rung {text}: {error}") from error
    try:
        return Knobs(**values)
    except ValueError as error:
        raise UsageError(f"--rung {text}: {error}") from error
