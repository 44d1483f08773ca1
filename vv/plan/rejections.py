"""Says why a case rejects parameters: in its own words, or that a formula of it has no value."""

from __future__ import annotations

import dis
import re
import sys
from collections.abc import Mapping

from vv.case import Case

LIBRARIES = sys.stdlib_module_names | {"numpy", "scipy", "numba"}
RAISE = dis.opmap["RAISE_VARARGS"]


def rejection(case: Case, variant: str, parameters: Mapping[str, float], error: Exception) -> str:
    """The sentence on the error with which a case ended at these parameters."""
    usual = case.defaults(variant)
    units = {one.name: one.unit for one in case.parameters}
    changed = {
        name: f"{name} = {value!r}" for name, value in parameters.items() if value != usual[name]
    }
    given = {f"{text} {units[name]}".strip(): text for name, text in changed.items()}
    defaults = ", ".join(f"{name} = {usual[name]!r} {units[name]}".strip() for name in changed)
    return f"{case.name}:{variant}: {_reason(given, defaults, error)}"


def _reason(given: Mapping[str, str], defaults: str, error: Exception) -> str:
    """Why parameters are rejected, with the changed ones unless the reason has one of them.

    given: NAME = VALUE UNIT of each changed parameter -> the same without the unit.
    """
    why = re.sub(r"np\.float64\((.*?)\)", r"\1", str(error))
    if given and not stated(error):
        fails = "divides by zero" if isinstance(error, ZeroDivisionError) else "has no value"
        why = f"a formula of the case {fails}; the default is {defaults}"
    elif not given or any(
        re.search(rf"\b{re.escape(one)}(?![\d.])", why) for one in given.values()
    ):
        return why
    return f"with {', '.join(given)}: {why}"


def stated(error: Exception) -> bool:
    """Whether a statement outside libraries raised an error, with words for the reader.

    All else comes from a formula, such as a root of a negative number, in the words of Python.
    """
    place = error.__traceback__
    while place is not None and place.tb_next is not None:
        place = place.tb_next
    if place is None or isinstance(error, AssertionError):
        return False
    package = place.tb_frame.f_globals.get("__name__", "").partition(".")[0]
    raised = place.tb_frame.f_code.co_code[place.tb_lasti] == RAISE
    return raised and package not in LIBRARIES
