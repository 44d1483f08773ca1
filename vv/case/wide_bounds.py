"""Bounds that may exceed the largest tolerance: they are cut there, or hold as they are."""

from __future__ import annotations

from typing import Any

from vv.ask import Knobs, Method
from vv.case.judges import LARGEST_TOLERANCE, Exact, Judge, Shown, Tolerance

NOTHING = 1.0  # relative error of an answer of zero, which a bound as large as that would accept
TINY = 1e-100  # a step [s] or a compliance [m/N] that is still positive


def capped(value: float, reason: str, **scaling: Any) -> Tolerance:
    """The tolerance of this value at its dt and kn, which may exceed LARGEST_TOLERANCE.

    It is then stated at the step, or the stiffness, at which it is that large, so that at others it
    is what it would be. Where nothing scales it, `Tolerance.over` says how much larger it is.
    scaling: other fields of `Tolerance`.
    """
    over = value / LARGEST_TOLERANCE
    if over > 1.0 and scaling.get("order"):
        scaling["dt"] = max(scaling["dt"] * over ** (-1 / scaling["order"]), TINY)
    elif over > 1.0 and scaling.get("softness"):
        scaling["kn"] = min(scaling["kn"] * over ** (1 / scaling["softness"]), 1 / TINY)
    elif over > 1.0:
        scaling["over"] = over
    return Tolerance(min(value, LARGEST_TOLERANCE), reason, **scaling)


def _too_wide(bound: float, reason: str) -> str:
    return f"an error of {bound:.2g} is allowed, so that nothing would be told: {reason}"


def shown_if_wide(judge: Judge, method: Method, knobs: Knobs) -> Judge:
    """The judge, or Shown where its uncut bound at a setting accepts an answer of zero.

    At the case's own parameters and settings a bound is cut at LARGEST_TOLERANCE, since no error
    may be larger there; at others a code that is right may have the error that the uncut bound
    allows.
    """
    if isinstance(judge, Exact):
        tolerance = judge.tolerance(method)
        if (bound := tolerance.uncut(knobs)) >= NOTHING:
            return Shown(_too_wide(bound, tolerance.reason))
    return judge
