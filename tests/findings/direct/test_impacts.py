"""Findings on the contact laws of YADE and LIGGGHTS in impacts, and on how their contacts begin."""

from __future__ import annotations

import math

import numpy as np
import pytest

from cases.impact import oblique_impact
from cases.impact.parts._oblique import ARMS, SPRINGS, Choice
from tests.findings.figures import PROJECT, asked
from tests.support.installed import require
from vv.case import Level

MIDDLE, MINDLIN, LINEAR = ARMS  # arms of slip and of torque: R - U/2; both R - U; slip alone
GROWS, CURRENT = SPRINGS  # the shear force, by increments or as a spring of the current stiffness
STICKING = "oblique-impact:pair-alloy-linear e=0.98"


@pytest.mark.shows(
    "In impacts YADE and LIGGGHTS follow different contact laws",
    "On a wall, YADE computes slip with the lever arm R - U, whereas for pairs, and in LIGGGHTS, "
    "the arm is R - U/2",
    "The arm of its torque is R - U/2 with linear springs and R - U with MindlinPhys",
)
@pytest.mark.parametrize(
    ("code", "variant", "law"),
    [
        ("yade", "along-polyethylene", (MINDLIN, GROWS)),
        ("yade", "along-polyethylene-linear", (LINEAR, GROWS)),
        ("yade", "pair-alloy v=2", (MIDDLE, GROWS)),
        ("liggghts", "along-polyethylene", (MIDDLE, CURRENT)),
        ("liggghts", "pair-alloy v=2", (MIDDLE, CURRENT)),
    ],
)
def test_a_code_follows_its_own_law(code: str, variant: str, law: Choice) -> None:
    """The velocities after each impact are nearest to those of this law, of all in `_oblique`."""
    require(PROJECT.load_adapter(code))
    answer = asked(f"oblique-impact:{variant}", f"{code}/default", Level.PAPER)
    impacts = oblique_impact._impacts(variant.partition(" ")[0], answer.given)
    springs = SPRINGS[:1] if impacts.law.p == 1.0 else SPRINGS  # of a linear spring both are one
    off = {}
    for choice in ((arms, spring) for arms in ARMS for spring in springs):
        due = {name: impacts.after(name, choice) for name in impacts.blows}
        off[choice] = max(
            math.dist(impacts.seen_after(name, answer.run), (one.normal, one.tangential))
            for name, one in due.items()
        )
    assert min(off.values()) == off[law]
    assert sorted(off.values())[1] > 1.5 * off[law]


@pytest.mark.shows(
    "YADE's ViscElMat creates a contact for a sphere that only touches",
    "Two spheres that touch to the last bit are a contact in YADE, and not in LIGGGHTS",
    "LIGGGHTS therefore begins such a contact without the dashpot, and the spheres part faster "
    "by z w dt of the speed, which is 2.0e-4 at a restitution of 0.98 and 100 steps",
)
def test_liggghts_begins_a_contact_that_only_touches_without_its_dashpot() -> None:
    """The dashpot of the first half step, 2 z w m v for dt/2, would take z w dt of the speed."""
    after = []
    for code in ("yade", "liggghts"):
        require(PROJECT.load_adapter(code))
        answer = asked(STICKING, f"{code}/default", None)
        impacts = oblique_impact._impacts("pair-alloy-linear", answer.given)
        after.append([impacts.seen_after(name, answer.run)[0] for name in impacts.blows])
    dt = answer.ask.knobs.dt
    assert dt is not None
    taken = impacts.law.z * math.sqrt(impacts.law.K / impacts.reduced) * dt
    assert taken == pytest.approx(2.0e-4, abs=5e-6)
    assert np.divide(after[1], after[0]) - 1.0 == pytest.approx(taken, rel=0.02)
