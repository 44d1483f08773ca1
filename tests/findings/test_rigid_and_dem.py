"""Findings on `rigid`, `dem` and Housner's rule, run where they say.

Keys, rows and bands are as in tests/findings/test_dda.py.
"""

import math

import pytest

from tests.findings.figures import PROJECT, Answer, allowed, value
from tests.findings.table import Row, Table, each, rows
from vv.ask import Knobs
from vv.standins.stand_in import SHEAR

RIGID, DEM, PUBLISHED = "rigid/default", "dem/default", "dem/published"
STOUT, SLENDER = "rocking-restitution:aspect-3", "rocking-restitution:aspect-5"
CHARTS = (
    *(f"2d-{phi}" for phi in (10, 20, 30, 40, 60)),
    *(f"3d-{phi}" for phi in (6, 20, 40, 50)),
    *(f"gravity-{alpha}" for alpha in (14, 32, 50)),
)


def residual(answer: Answer) -> float:
    """The largest residual of contact of all steps [m/s]."""
    return answer.ledger.audits["residual of contact [m/s]"][0]


def phase(answer: Answer) -> float:
    """w dt of the block across its springs, which are SHEAR times as stiff there."""
    knobs, (block,) = answer.ask.knobs, answer.ask.scene.blocks
    assert knobs.dt is not None
    assert knobs.kn is not None
    return math.sqrt(SHEAR * knobs.kn / block.mass) * knobs.dt


FOUND: Table = {
    "`rigid` is right in the paradox to 1.1e-6 at a step of 1e-3 s, with second order": [
        Row("painleve:mu-2", RIGID, Knobs(1e-3), "distance", 8e-7, 1.2e-6),
        Row("painleve:mu-2", RIGID, Knobs(5e-4), "distance", 2.2e-7, 2.7e-7),
    ],
    "a stack of 100, which is a chain, by Newton steps: it creeps by 7.1e-7 m in 10 s": [
        Row("standing:stack-100", RIGID, None, value("moved"), 7.0e-7, 7.2e-7),
    ],
    "`rigid` holds a wedge in a groove of 1e-6 rad, with an error below 1e-11": [
        Row("wedge:xi-1e-06", RIGID, Knobs(1e-2), "s", 0.0, 1e-11),
    ],
    "`rigid` has all 249 points of the charts right, half a degree from their borders too": [
        Row(f"failure-modes:{chart}", RIGID, None, "agree", 0.0, 0.0) for chart in CHARTS
    ],
    "`dem` is 2.6e-4 off where a block slides along two directions at 1e-4 s on springs of 1e10 "
    "N/m": [
        Row("incline:two-directions", DEM, Knobs(1e-4, 1e10), "d", 2.55e-4, 2.65e-4),
    ],
    "There w dt is 1": [
        Row("incline:two-directions", DEM, Knobs(1e-4, 1e10), phase, 0.999, 1.001),
    ],
    "The other settings with w dt = 1": [
        Row("incline:two-directions", DEM, at, phase, 0.999, 1.001)
        for at in (Knobs(2e-4, 2.5e9), Knobs(5e-5, 4e10))
    ],
    "With springs 1 % softer or stiffer the error is 3e-5": [
        Row("incline:two-directions", DEM, Knobs(1e-4, 1.01e10), "d", 2.9e-5, 3.2e-5),
        Row("incline:two-directions", DEM, Knobs(1e-4, 0.99e10), "d", 2.8e-5, 3.3e-5),
    ],
    "6.1e-4 at 2e-4 s on 2.5e9 N/m (1.4e-4 on 2.6e9) and 9.8e-5 at 5e-5 s on 4e10 (2.0e-5 on "
    "4.2e10)": [
        Row("incline:two-directions", DEM, Knobs(2e-4, 2.5e9), "d", 6.05e-4, 6.15e-4),
        Row("incline:two-directions", DEM, Knobs(2e-4, 2.6e9), "d", 1.35e-4, 1.45e-4),
        Row("incline:two-directions", DEM, Knobs(5e-5, 4e10), "d", 9.75e-5, 9.85e-5),
        Row("incline:two-directions", DEM, Knobs(5e-5, 4.2e10), "d", 1.95e-5, 2.05e-5),
    ],
    "than its spring stretches, which falls with 1/kn: at 1e11 N/m it is 2.0e-5 off at 2e-5 s and "
    "2.6e-5 at 5e-6 s, at 1e12 N/m 9.6e-6 at 2e-6 s": [
        Row("incline:two-directions", DEM, Knobs(2e-5, 1e11), "d", 1.94e-5, 2.05e-5),
        Row("incline:two-directions", DEM, Knobs(5e-6, 1e11), "d", 2.55e-5, 2.65e-5),
        Row("incline:two-directions", DEM, Knobs(2e-6, 1e12), "d", 9.55e-6, 9.65e-6),
    ],
    "(allowed are 4.8e-5, 4.0e-5 and 1.4e-5)": [
        Row("incline:two-directions", DEM, Knobs(2e-5, 1e11), allowed("d"), 4.7e-5, 4.8e-5),
        Row("incline:two-directions", DEM, Knobs(5e-6, 1e11), allowed("d"), 3.95e-5, 4.05e-5),
        Row("incline:two-directions", DEM, Knobs(2e-6, 1e12), allowed("d"), 1.35e-5, 1.45e-5),
    ],
    "`dem/published` is of first order with drag, as its source is": [
        Row("single-contact:T2", PUBLISHED, Knobs(1e-3), "y", 0.0130, 0.0135),
        Row("single-contact:T2", PUBLISHED, Knobs(5e-4), "y", 0.0065, 0.0068),
    ],
    "which makes 1e-3 of the displacement in one second of sliding at 1e-3 s": [
        Row("incline:gravity-5", PUBLISHED, Knobs(1e-3, 1e8), "d", 0.99e-3, 1.01e-3),
    ],
    "A sphere in a groove agrees with springs to 1.1e-5 in `dem`, YADE and LIGGGHTS": [
        *each(
            "dem/default,yade/default,liggghts/default", ("wedge:sphere", None, "s", 0.0, 1.1e-5)
        ),
    ],
    "On springs of 1e8 N/m and at 2.5e-4 s `dem`, YADE and LIGGGHTS are wrong on the responding "
    "block at 20 Hz, by nine times its displacement": [
        Row("shaken-fast:20hz", DEM, Knobs(2.5e-4, 1e8), "d2x", 8.5, 9.5),
        *each(
            "yade/default,liggghts/default",
            ("shaken-fast:20hz", Knobs(2.5e-4, 1e8), "d2x", 9.1, 9.4),
        ),
    ],
    "`dem` at 1e11 N/m and 5e-6 s is 1.6 % off": [
        Row("shaken-fast:20hz", DEM, Knobs(5e-6, 1e11), "d2x", 0.0155, 0.0165),
    ],
    "`rigid` agrees with Housner to 1.5e-6 at 1e-3 s, `dda` and PyBullet to 5e-3 there and to "
    "1.2e-3 at 2.5e-4 s": [
        *(Row(one, RIGID, Knobs(1e-3), "restitution", 0.0, 1.5e-6) for one in (STOUT, SLENDER)),
        *(
            row
            for one in (STOUT, SLENDER)
            for row in each(
                "dda/default,pybullet/default", (one, Knobs(1e-3, 1e10), "restitution", 2e-3, 5e-3)
            )
        ),
        *(
            row
            for one in (STOUT, SLENDER)
            for row in each(
                "dda/default,pybullet/default",
                (one, Knobs(2.5e-4, 1e10), "restitution", 5e-4, 1.2e-3),
            )
        ),
    ],
    "In a facade of 35 blocks with friction of 0.9, shaken at 1.09 g, Newton rounds that go on "
    "where the residual grows solve what sweeps leave: every step reaches 5e-6 m/s, at 1e-3 and at "
    "5e-4 s": [
        Row("masonry:borne mu=0.9 D=0.03 f=3", RIGID, at, residual, 0.0, 5e-6)
        for at in (Knobs(1e-3, 1e9), Knobs(5e-4, 1e9))
    ],
    "the tolerance would be 2.0e-4": [
        Row("incline:two-directions", DEM, Knobs(1e-4, 1e10), allowed("d"), 2.0e-4, 2.08e-4),
    ],
}


@pytest.mark.parametrize("row", rows(FOUND))
def test_rigid_and_dem_are_as_they_are_told(row: Row) -> None:
    row.check()


@pytest.mark.shows("No level runs that setting")
def test_no_level_runs_a_step_of_six_phases() -> None:
    case = PROJECT.load_case("incline")
    rungs = case.declare("two-directions", case.defaults("two-directions")).study.rungs
    assert not any(Knobs(1e-4, 1e10) in run for run in rungs.values())
