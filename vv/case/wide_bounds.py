"""Bounds that may exceed the largest tolerance: they are cut there, or hold as they are."""

from __future__ import annotations

from vv.ask import Knobs, Method
from vv.case.judges import Exact, Judge, Shown

NOTHING = 1.0  # relative error of an answer of zero, which a bound as large as that would accept


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
