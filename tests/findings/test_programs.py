"""Findings on YADE and LIGGGHTS, run where they are installed.

Keys, rows and bands are as in tests/findings/test_dda.py.
"""

import math

import pytest

from tests.findings.figures import PROJECT, Answer, against, ends, passes, value
from tests.findings.table import Row, Table, each, rows
from vv.ask import Knobs, Status
from vv.case import Level

QUICK, DEFAULT, PAPER = Level.QUICK, Level.DEFAULT, Level.PAPER
BOTH = "yade/default,liggghts/default"
CORRECTED = "yade/half-step-mass,liggghts/half-step-mass"
CLOSING = "bounce:floor rho=1760 r1=0.0843 mu=0.782 g=9.89 gap=1.36e-4 v_t=0.0147"
STICKING = "oblique-impact:pair-alloy-linear e=0.98"
YADE, LIGGGHTS, DEM = "yade/default", "liggghts/default", "dem/default"


def printed_beside(answer: Answer) -> float:
    """The number of quantities that have an answer of another code beside them."""
    return sum(answer.of(one.name).printed is not None for one in answer.trial.quantities)


FOUND: Table = {
    "With `limitForce`, and in YADE's ViscElMat, it does not": [
        *each(BOTH, ("dashpot:z-0.6", DEFAULT, value("restitution"), 0.2485, 0.2505)),
    ],
    "7.8e-3 and 1.1e-2 at 1e-3 s": [
        *each(BOTH, ("single-contact:T2", Knobs(1e-3), "y", 7.7e-3, 7.9e-3)),
        *each(BOTH, ("single-contact:T4", Knobs(1e-3), "y", 1.05e-2, 1.08e-2)),
    ],
    "which makes them first order on T2 and T4": [
        *each(BOTH, ("single-contact:T2", Knobs(5e-4), "y", 3.85e-3, 3.95e-3)),
    ],
    "where drag of that size evaluated at the middle of the step would leave the limit at 2/w": [
        Row("stable-step:viscous", DEM, None, "limit", 0.0, 3e-4),
    ],
    "They are stable only up to 0.656 of 2/w": [
        *each(BOTH, ("stable-step:viscous", None, "limit", 0.3435, 0.3455)),
    ],
    "The mass m + eta dt/2 corrects both": [
        *each(CORRECTED, ("single-contact:T4", Knobs(1e-3), "y", 3e-5, 5.2e-5)),
        Row("stable-step:viscous", "yade/half-step-mass", None, "limit", 0.0, 3e-4),
    ],
    "which makes them first order where a contact begins in stick": [
        *each(BOTH, ("bounce:floor", None, "x", 3.0e-5, 3.3e-5)),
        *each(BOTH, ("bounce:floor", DEFAULT, "x", 1.2e-6, 3.0e-6)),
    ],
    "which makes them first order in two and three directions": [
        *each(BOTH, ("responding-block:3d", None, "distance", 7.4e-3, 7.8e-3)),
        *each(BOTH, ("responding-block:3d", DEFAULT, "distance", 1.8e-4, 2.0e-4)),
    ],
    "6e-3 of the restitution at 0.6 of critical and a step of 2e-5 s, 8e-4 at 2.5e-6 s": [
        *each(BOTH, ("dashpot:z-0.6", None, "restitution", 6.0e-3, 6.8e-3)),
        *each(BOTH, ("dashpot:z-0.6", DEFAULT, "restitution", 7.5e-4, 8.3e-4)),
    ],
    "They differ by 0.5 to 2 % of the speed where surfaces stick in part": [
        Row("oblique-impact:angle-alloy", LIGGGHTS, None, "worst", 5.0e-3, 5.5e-3),
        Row("oblique-impact:pair-alloy", LIGGGHTS, PAPER, "worst", 1.9e-2, 2.0e-2),
    ],
    "each code agrees with that of its own law to the error of its step": [
        Row("oblique-impact:angle-alloy", LIGGGHTS, None, "nearest", 0.0, 2e-5),
        Row("oblique-impact:pair-alloy", LIGGGHTS, PAPER, "nearest", 0.0, 2e-7),
        Row("oblique-impact:angle-alloy", YADE, None, "nearest", 4.8e-4, 5.2e-4),
        Row("oblique-impact:angle-alloy", YADE, PAPER, "nearest", 3.9e-5, 4.3e-5),
        Row("mfix:dem05-hertz", LIGGGHTS, None, "nearest", 0.0, 1.5e-5),
    ],
    "This makes a difference of 2e-4 to 7e-3 of the speed": [
        Row("oblique-impact:spun-alloy", YADE, PAPER, "worst", 1.5e-4, 2.5e-4),
        Row("oblique-impact:along-polyethylene", YADE, PAPER, "worst", 6.5e-3, 7.5e-3),
    ],
    "differs by 0.4 to 0.5 % at 5 to 15 degrees": [
        Row("mfix:dem05-hertz", LIGGGHTS, None, against(f"kept-{angle}"), 0.0035, 0.0051)
        for angle in (5, 10, 15)
    ],
    "The printed answers of DEM01, DEM02, DEM05 and DEM06 are shown beside every code": [
        *(
            Row(f"mfix:{one}", DEM, None, printed_beside, 1, 99)
            for one in ("dem01", "dem02-0.9", "dem05-hertz", "dem06")
        ),
        *(Row(f"mfix:{one}", DEM, None, printed_beside, 0, 0) for one in ("dem03", "dem04")),
    ],
    "and `dem` and YADE by up to 6 %": [
        *each(f"{DEM},{YADE}", ("mfix:dem05-hertz", None, against("kept-5"), -0.06, -0.05)),
    ],
    "have linear drag only, and refuse it": [
        *each(BOTH, ("mfix:dem06", None, ends(Status.REFUSED), 1, 1)),
        Row("mfix:dem06", DEM, None, "speed", 0.0, 4e-5),
    ],
    "From 30 degrees on all have its digits": [
        *each(f"{DEM},{BOTH}", ("mfix:dem05-hertz", None, against("kept-30"), -5e-5, 5e-5)),
        *each(f"{DEM},{BOTH}", ("mfix:dem05-hertz", None, against("kept-45"), -5e-5, 5e-5)),
    ],
    "that closes a gap of 1.4e-4 m under gravity": [
        Row(CLOSING, DEM, None, passes("x"), 1, 1),
    ],
    "the depth is right to 4e-6": [
        Row("hertz-impact:aluminium", YADE, DEFAULT, "deepest", 0.0, 4e-6),
    ],
    "2e-4 to 2e-3 of the depth at 1600 steps a contact without losses; `dem` is of second order, "
    "1e-6 to 3e-6": [
        Row("restitution:hertz-0.8", YADE, DEFAULT, "deepest", 1.5e-4, 2.0e-4),
        Row("restitution:hertz-0.8", LIGGGHTS, DEFAULT, "deepest", 1.5e-4, 2.0e-4),
        Row("restitution:hertz-0.2", YADE, DEFAULT, "deepest", 1.9e-3, 2.2e-3),
        Row("restitution:hertz-0.8", DEM, DEFAULT, "deepest", 2.5e-6, 3.5e-6),
        Row("restitution:hertz-0.2", DEM, DEFAULT, "deepest", 0.9e-6, 1.5e-6),
    ],
    "LIGGGHTS accepts no restitution below 0.05 in its formula for contacts that may pull, which "
    "corresponds to 0.2 for contacts that do not": [
        Row("restitution:hertz-0.2", LIGGGHTS, None, ends(Status.REFUSED), 1, 1),
    ],
    "With friction, LIGGGHTS' spring of the current stiffness is 6e-3 of the speed off": [
        Row("oblique-impact:angle-alloy-0.98", LIGGGHTS, PAPER, "worst", 5.5e-3, 6.5e-3),
    ],
    "at the nearest law 6e-6 remains at 400 steps": [
        Row("oblique-impact:angle-alloy-linear", YADE, DEFAULT, "nearest", 5.5e-6, 6.9e-6),
    ],
    "There a sphere that sticks to another is 1.2e-4 of the speed off in YADE and 3.4e-4 in "
    "LIGGGHTS": [
        Row(STICKING, YADE, None, "worst", 1.15e-4, 1.25e-4),
        Row(STICKING, LIGGGHTS, None, "worst", 3.2e-4, 3.6e-4),
    ],
    "it is 15 % off at 1e-5 s, 2.0e-3 at 5e-7 s and 4.1e-4 at 1.25e-7 s in YADE and in LIGGGHTS "
    "alike": [
        *each(BOTH, (CLOSING, Knobs(1e-5), "x", 0.145, 0.155)),
        *each(BOTH, (CLOSING, Knobs(5e-7), "x", 1.95e-3, 2.1e-3)),
        *each(BOTH, (CLOSING, Knobs(1.25e-7), "x", 4.05e-4, 4.2e-4)),
    ],
    "Clumps start with the forces of the motion itself, and are within 6e-4": [
        Row("failure-modes:2d-30", "liggghts/clump", Knobs(2.5e-5, 1e10), "worst", 5.5e-4, 6e-4),
        Row("failure-modes:3d-50", "liggghts/clump", Knobs(2.5e-5, 1e10), "worst", 3.5e-4, 4.5e-4),
        Row("failure-modes:2d-30", "yade/clump", Knobs(2.5e-5, 1e10), "worst", 5.5e-4, 6e-4),
    ],
}


@pytest.mark.parametrize("row", rows(FOUND))
def test_yade_and_liggghts_are_as_they_are_told(row: Row) -> None:
    row.check()


@pytest.mark.shows(
    "at 0.6 of critical damping such a contact has a restitution of 0.095, and 0.249 if it may "
    "not pull"
)
def test_a_contact_that_pulls_returns_less() -> None:
    """At 0.6 of critical damping; a linear contact that may pull ends as its swing does."""
    z = 0.6
    assert math.exp(-math.pi * z / math.sqrt(1 - z**2)) == pytest.approx(0.095, abs=5e-4)
    case = PROJECT.load_case("dashpot")
    trial = case.declare("z-0.6", case.defaults("z-0.6"))
    (kept,) = (one for one in trial.quantities if one.name == "restitution")
    assert kept.reference == pytest.approx(0.249, abs=5e-4)
