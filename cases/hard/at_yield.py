"""A shaken block on a slope a trillionth steeper or less steep than its friction angle."""

from __future__ import annotations

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks.incline import CASE as INCLINE
from vv.case import Case, Parameters, Source, Trial, Variant

YIELD = INCLINE.variant("at-yield")
OWN = ("alpha", "phi", "A", "f", "g", "duration")
BESIDE = 1e-12  # relative to the slope: a few thousand rounding errors


def _declare(variant: str, p: Parameters) -> Trial:
    return INCLINE.declare("at-yield", {**INCLINE.defaults("at-yield"), **p})


ALPHA = 20.0
CASE = Case(
    name="at-yield",
    title="At the limit of rest",
    source=Source(
        *YAGODA_BIRAN_2016,
        "The paper does not treat phi = alpha. The velocity (A/(w cos alpha))(1 - cos wt) then "
        "touches zero once a cycle, as the case incline shows. With a trillionth more of friction "
        "the block stops for a moment, and with a trillionth less it never stops.",
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
