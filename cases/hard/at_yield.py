"""A shaken block on a slope a trillionth steeper or less steep than its friction angle."""

from __future__ import annotations

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks.incline import CASE as INCLINE
from vv.case import Case, Parameters, Source, Trial, Variant

YIELD = INCLINE.variant("at-yield")
OWN = ("alpha", "phi", "A", "f", "g", "duration")
BESIDE = 1e-12  # of the slope: within a few thousand roundings of it


def _declare(variant: str, p: Parameters) -> Trial:
    return INCLINE.declare("at-yield", {**INCLINE.defaults("at-yield"), **p})


ALPHA = 20.0
CASE = Case(
    name="at-yield",
    title="At the limit of rest",
    source=Source(
        *YAGODA_BIRAN_2016,
        "phi = alpha is not in the paper. The velocity (A/(w cos alpha))(1 - cos wt) touches zero "
        "once a cycle there, which the incline shows; a trillionth more of friction stops the "
        "block for a moment, and a trillionth less never does.",
    ),
    parameters=tuple(one for one in INCLINE.parameters if one.name in OWN),
    variants=tuple(
        Variant(name, summary, YIELD.formula, {**YIELD.defaults, "phi": phi}, YIELD.inert - {"fy"})
        for name, summary, phi in (
            ("above", "phi = alpha (1 + 1e-12)", ALPHA * (1 + BESIDE)),
            ("below", "phi = alpha (1 - 1e-12)", ALPHA * (1 - BESIDE)),
        )
    ),
    declare=_declare,
)
