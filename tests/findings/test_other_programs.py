"""Findings on LMGC90, PyBullet and Kratos, run where they are installed, or as recorded.

Keys, rows and bands are as in tests/findings/test_dda.py.
"""

import math

import numpy as np
import pytest

from reference_solutions.hard import painleve_rod
from tests.findings.figures import ends, error, value
from tests.findings.table import Row, Table, each, rows, shown
from tests.findings.test_rigid_and_dem import CHARTS
from tests.references.impact.test_lagged_rules import ALUMINA, ON_GLASS, UNIT, stepped
from vv.ask import Knobs, Status
from vv.case import Level

DEFAULT, PAPER = Level.DEFAULT, Level.PAPER
LMGC90, PYBULLET, KRATOS = "lmgc90/default", "pybullet/default", "kratos/default"
BOTH = f"{LMGC90},{PYBULLET}"

FOUND: Table = {
    "LMGC90 and PyBullet follow a block under gravity, at rest or thrown at first, to 1e-12": [
        *each(BOTH, ("incline:gravity-5", None, "d", 0.0, 1e-12)),
        *each(BOTH, ("incline:launch-1", None, "d", 0.0, 1e-12)),
    ],
    "and Newmark's block to 1e-5 at 1e-3 s": [
        *each(BOTH, ("incline:newmark-30", None, "d", 0.0, 1.1e-5)),
    ],
    "Both are of first order where the direction of slip turns, 1e-4 at 1e-3 s": [
        Row("incline:two-directions", LMGC90, None, "distance", 9e-5, 1.1e-4),
        Row("incline:two-directions", PYBULLET, None, "distance", 8e-5, 1e-4),
    ],
    "LMGC90 and PyBullet have every point right, to 8e-4 of the displacement at worst": [
        row
        for one in CHARTS
        for row in (
            *each(BOTH, (f"failure-modes:{one}", DEFAULT, "agree", 0.0, 1e-12)),
            *each(BOTH, (f"failure-modes:{one}", DEFAULT, "worst", 0.0, 8e-4)),
        )
    ],
    "ten cubes in 10 s by 1e-4 m in LMGC90 and 2e-3 m in PyBullet at 2e-2 s, and twenty by 0.16 "
    "and 0.36 m": [
        Row("standing:stack-10", LMGC90, Knobs(2e-2), "moved", 0.9e-4, 1.3e-4),
        Row("standing:stack-10", PYBULLET, Knobs(2e-2), "moved", 1.4e-3, 1.8e-3),
        Row("standing:stack-20", LMGC90, Knobs(2e-2), "moved", 0.12, 0.2),
        Row("standing:stack-20", PYBULLET, Knobs(2e-2), "moved", 0.3, 0.42),
    ],
    "LMGC90's arch stands where it should and sinks by 2e-4 m, because contacts are enforced at "
    "the end of a step; PyBullet's falls": [
        Row("standing:arch", LMGC90, None, "moved", 1.8e-4, 2.1e-4),
        Row("standing:arch", PYBULLET, None, "moved", 0.8, 1.1),
    ],
    "In a groove of 1e-2 rad the wedge is 6 % off in LMGC90 and 37 % in PyBullet, and at 1e-6 rad "
    "it falls freely in both": [
        Row("wedge:xi-0.01", LMGC90, None, "s", 0.06, 0.065),
        Row("wedge:xi-0.01", PYBULLET, None, "s", 0.36, 0.38),
        *each(BOTH, ("wedge:xi-1e-06", None, "s", 0.99, 1.01)),
    ],
    "at mu = 1.34, the rod slides on for a while in PyBullet before it jams, for longer with finer "
    "steps: it is 5e-5, 1.3e-3 and 2.8e-3 off at 1e-3, 5e-4 and 2.5e-4 s": [
        Row("painleve:mu-1.34", PYBULLET, Knobs(1e-3), "distance", 5e-5, 6e-5),
        Row("painleve:mu-1.34", PYBULLET, Knobs(5e-4), "distance", 1.2e-3, 1.3e-3),
        Row("painleve:mu-1.34", PYBULLET, Knobs(2.5e-4), "distance", 2.7e-3, 2.8e-3),
    ],
    "which is refused for this reason": [
        Row("responding-block:3d-turning", LMGC90, None, ends(Status.REFUSED), 1, 1),
    ],
    "PyBullet's slip velocity is 2.1 % off, at 1e-3 s and at 1e-4 s alike": [
        Row("laden-block:turning", PYBULLET, None, "slipping", 0.020, 0.022),
        Row("laden-block:turning", PYBULLET, Knobs(1e-4), "slipping", 0.020, 0.022),
    ],
    "For a cube whose rotation is locked it is right to 5e-6": [
        Row("laden-block:level", PYBULLET, None, "slip", 0.0, 5e-6),
    ],
    "PyBullet jams Painleve's rod at mu = 2 as it should, with an error of 5e-5 at 1e-3 s, where "
    "2e-2 is allowed": [
        Row("painleve:mu-2", PYBULLET, Knobs(1e-3), "distance", 5e-5, 6e-5),
    ],
    "stops two spins by one impact to 1e-13": [
        Row("spin-stopped:crossed", PYBULLET, None, "middle", 0.0, 1e-13),
    ],
    "On a base that shakes at 5 Hz for ten time constants, a block is off by 1.1, 0.48 and 0.13 of "
    "its mean displacement in PyBullet at 5e-4, 2.5e-4 and 1e-4 s": [
        Row("shaken-fast:5hz", PYBULLET, Knobs(5e-4), "mean", 1.05, 1.15),
        Row("shaken-fast:5hz", PYBULLET, Knobs(2.5e-4), "mean", 0.475, 0.485),
        Row("shaken-fast:5hz", PYBULLET, Knobs(1e-4), "mean", 0.125, 0.135),
    ],
    "and by 0.5 to 2.4 % in LMGC90": [
        Row("shaken-fast:5hz", LMGC90, Knobs(dt), "mean", 5e-3, 2.45e-2)
        for dt in (5e-4, 2.5e-4, 1e-4)
    ],
    "At 20 Hz and 2.5e-4 s it is off by nine times in both": [
        *each(BOTH, ("shaken-fast:20hz", Knobs(2.5e-4), "mean", 8.5, 9.5)),
    ],
    "Kratos has the phase of a leapfrog to 3e-15 over thousands of oscillations": [
        Row("long-swing:pressed", KRATOS, None, "leapfrog", 0.0, 1e-14),
    ],
    "and its largest stable step to 5e-4": [
        Row("stable-step:undamped", KRATOS, None, "limit", 0.0, 5e-4),
    ],
    "1.4e-5 at 400 steps, 3.6e-6 at 1600 and an overlap of 0.027 R": [
        Row(
            "oblique-impact:along-polyethylene-linear", KRATOS, DEFAULT, "nearest", 1.35e-5, 1.45e-5
        ),
        Row("oblique-impact:along-polyethylene-linear", KRATOS, PAPER, "nearest", 3.5e-6, 3.7e-6),
    ],
    "an error of 5e-5 of their transverse displacement remains at any step from 1e-5 s on": [
        Row("bounce:again", KRATOS, Knobs(dt), "y1", 4.6e-5, 5.4e-5) for dt in (1e-5, 5e-6, 2.5e-6)
    ],
    "Kratos' Hertz law is of second order head on, with YADE's digits": [
        *each(f"{KRATOS},yade/default", ("hertz-impact:glass", None, "overlap", 1.03e-4, 1.05e-4)),
    ],
    "The law makes a difference of 0.3 to 1.9 % of a velocity": [
        Row("oblique-impact:angle-alumina", KRATOS, None, "worst", 3.2e-3, 3.5e-3),
        Row("oblique-impact:spun-alloy", KRATOS, None, "worst", 0.0185, 0.0195),
    ],
    "LMGC90 follows it within 4.4e-4 of its displacement at any step from 1e-3 to 5e-5 s": [
        Row("rocking:stands", LMGC90, Knobs(dt), "distance", 3e-4, 4.4e-4)
        for dt in (1e-3, 5e-4, 2.5e-4, 5e-5)
    ],
    "and PyBullet within 5.4e-4 and 2.7e-5 there, with first order": [
        Row("rocking:stands", PYBULLET, Knobs(1e-3), "distance", 5.3e-4, 5.4e-4),
        Row("rocking:stands", PYBULLET, Knobs(2.5e-4), "distance", 1.3e-4, 1.4e-4),
        Row("rocking:stands", PYBULLET, Knobs(5e-5), "distance", 2.6e-5, 2.7e-5),
    ],
}


@pytest.mark.parametrize("row", rows(FOUND))
def test_lmgc90_pybullet_and_kratos_are_as_they_are_told(row: Row) -> None:
    row.check()


@pytest.mark.shows(
    "A jam has no finite force, and each sweep of its solver passes on mu over the critical mu "
    "of the impulse of the sweep before, 1.005 here",
    "In 200 sweeps the impulse grows to 213 times that of the weight in the first step",
    "The impulse that is missing in the first step times the step is the whole error",
)
@pytest.mark.parametrize("dt", [5e-4, 2.5e-4, 1.25e-4])
def test_pybullet_jams_late_since_its_sweeps_raise_the_impulse_of_a_weight_by_half_a_percent_each(
    dt: float,
) -> None:
    """The first step lacks a part of the impulse that jams the rod, and the second makes up for it.

    A jam takes the impulse at which the end stops. Of the first step's 200 sweeps each but the last
    passes on mu over the critical mu of what the sweep before gave.
    """
    given = {"mu": 1.34, "slope": 2.0, "half": 1.0, "V": 2.0, "g": 9.81}
    growth = given["mu"] / painleve_rod.critical(2.0)
    first = 0.5 * given["g"] * dt / (1 + 3 / 5)  # stops the fall of the end, over the mass
    reached = first * (growth**199 - 1) / (growth - 1)
    wanted = float(painleve_rod.middle([1e-7], **given)[0, 1]) / 1e-7
    assert growth == pytest.approx(1.005)
    weight = 0.5 * given["g"] * dt  # its impulse in the first step, which is half a step of fall
    assert reached / weight == pytest.approx(213, abs=1)
    assert reached < wanted
    lags = math.hypot(given["mu"], 1.0) * (wanted - reached) * dt
    whole = np.linalg.norm(painleve_rod.middle([0.04], **given))
    found = shown("painleve:mu-1.34", PYBULLET, Knobs(dt), error("distance"))
    assert found == pytest.approx(lags / whole, abs=5e-5)  # its error in steps that jam at once


@pytest.mark.shows(
    "With friction it is a fourth law beside those",
    "gives Kratos' velocities to all six digits that are recorded",
)
@pytest.mark.parametrize("degrees", [2.24, 4.22, 9.84, 20.22])
def test_kratos_shear_force_falls_with_the_stiffness_where_a_contact_unloads(
    degrees: float,
) -> None:
    """The rule is integrated by itself, with as many steps; increments alone are 5e-4 off."""
    found = shown("kharaz:hertz", KRATOS, DEFAULT, value(f"kept-{degrees:g}"))
    across = 3.9 * math.sin(math.radians(degrees))
    out = 3.9 * math.cos(math.radians(degrees))
    rule, plain = (
        stepped(ON_GLASS, ALUMINA, out, across, UNIT / 400, softens=softens)[1]
        for softens in (True, False)
    )
    assert rule == pytest.approx(found * across, abs=1e-6 * across)  # six digits are recorded
    assert abs(plain - found * across) > 5e-4 * 3.9
