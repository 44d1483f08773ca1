"""Claims of docs/findings.md about programs, run where they are installed: errors that they have.

Those of our own codes are in tests/test_findings.py. Bands are about what was measured, by a few
per cent, or by a factor of two where rounding has a part.
"""

import pytest

from tests.support.findings import PROJECT, asked, found
from tests.support.installed import require
from vv.ask import Knobs, Status
from vv.case import Level

QUICK, DEFAULT, PAPER = Level.QUICK, Level.DEFAULT, Level.PAPER
CLOSING = "bounce:floor rho=1760 r1=0.0843 mu=0.782 g=9.89 gap=1.36e-4 v_t=0.0147"
STICKING = "oblique-impact:pair-alloy-linear e=0.98"
SOFT = Knobs(2.5e-4, 1e8)
Row = tuple[str, str, Knobs | Level | None, str, float, float]


def of_both(name: str, at: Knobs | Level | None, quantity: str, low: float, high: float,
            schemes: str = "default") -> list[Row]:  # fmt: skip
    """A row for YADE and the same for LIGGGHTS."""
    return [(name, f"{code}/{schemes}", at, quantity, low, high) for code in ("yade", "liggghts")]


FOUND: list[Row] = [
    *of_both("single-contact:T2", Knobs(1e-3), "y", 7.7e-3, 7.9e-3),  # drag half a step late
    *of_both("single-contact:T2", Knobs(5e-4), "y", 3.85e-3, 3.95e-3),
    *of_both("single-contact:T4", Knobs(1e-3), "y", 1.05e-2, 1.08e-2),
    *of_both("single-contact:T4", Knobs(1e-3), "y", 3e-5, 5.2e-5, "half-step-mass"),
    *of_both("stable-step:viscous", None, "limit", 0.344, 0.346),
    ("stable-step:viscous", "yade/half-step-mass", None, "limit", 0.0, 3e-4),
    *of_both("bounce:floor", None, "x", 3.0e-5, 3.3e-5),  # begins stuck
    *of_both(CLOSING, Knobs(1e-5), "x", 0.14, 0.16),
    *of_both(CLOSING, Knobs(5e-7), "x", 2.0e-3, 2.1e-3),
    *of_both(CLOSING, Knobs(1.25e-7), "x", 4.1e-4, 4.2e-4),
    *of_both("responding-block:3d", None, "distance", 7.4e-3, 7.8e-3),  # slip one step late
    *of_both("responding-block:3d", DEFAULT, "distance", 8.8e-4, 9.5e-4),
    *of_both("shaken-fast:20hz", SOFT, "d2x", 9.1, 9.4),
    *of_both("dashpot:z-0.6", None, "restitution", 6.0e-3, 6.8e-3),
    *of_both("dashpot:z-0.6", DEFAULT, "restitution", 7.5e-4, 8.3e-4),
    ("oblique-impact:angle-alloy", "liggghts/default", None, "worst", 5.1e-3, 5.3e-3),
    ("oblique-impact:angle-alloy", "liggghts/default", None, "nearest", 0.0, 2e-5),
    ("oblique-impact:pair-alloy", "liggghts/default", PAPER, "worst", 1.9e-2, 2.0e-2),
    ("oblique-impact:pair-alloy", "liggghts/default", PAPER, "nearest", 0.0, 2e-7),
    ("oblique-impact:angle-alloy", "yade/default", None, "nearest", 4.8e-4, 5.2e-4),
    ("oblique-impact:angle-alloy", "yade/default", PAPER, "nearest", 3.9e-5, 4.3e-5),
    ("oblique-impact:angle-alloy-linear", "yade/default", DEFAULT, "nearest", 6e-6, 7e-6),
    ("hertz-impact:aluminium", "yade/default", DEFAULT, "deepest", 0.0, 4e-6),
    *of_both("restitution:hertz-0.6", None, "deepest", 1.2e-3, 1.4e-3),  # first order
    *of_both("restitution:hertz-0.6", PAPER, "deepest", 3.2e-5, 3.7e-5),
    (STICKING, "yade/default", None, "worst", 1.1e-4, 1.3e-4),
    (STICKING, "liggghts/default", None, "worst", 3.2e-4, 3.6e-4),
    ("mfix:dem05-hertz", "liggghts/default", None, "nearest", 0.0, 1.5e-5),
    ("incline:gravity-5", "lmgc90/default", None, "d", 0.0, 1e-12),
    ("incline:gravity-5", "pybullet/default", None, "d", 0.0, 1e-12),
    ("incline:newmark-30", "lmgc90/default", None, "d", 0.0, 1.1e-5),
    ("incline:newmark-30", "pybullet/default", None, "d", 0.0, 1e-5),
    ("incline:two-directions", "lmgc90/default", None, "distance", 9e-5, 1.1e-4),
    ("incline:two-directions", "pybullet/default", None, "distance", 8e-5, 1e-4),
    ("failure-modes:2d-20", "lmgc90/default", DEFAULT, "agree", 0.0, 1e-12),
    ("failure-modes:2d-20", "lmgc90/default", DEFAULT, "worst", 0.0, 8e-4),
    ("failure-modes:3d-6", "pybullet/default", DEFAULT, "worst", 3.3e-2, 3.6e-2),
    ("failure-modes:3d-6", "pybullet/default", DEFAULT, "agree", 1.9 / 22, 2.1 / 22),
    ("standing:stack-10", "lmgc90/default", Knobs(2e-2), "moved", 0.9e-4, 1.3e-4),
    ("standing:stack-10", "pybullet/default", Knobs(2e-2), "moved", 1.4e-3, 1.8e-3),
    ("standing:stack-20", "lmgc90/default", Knobs(2e-2), "moved", 0.12, 0.2),
    ("standing:stack-20", "pybullet/default", Knobs(2e-2), "moved", 0.3, 0.42),
    ("standing:arch", "lmgc90/default", None, "moved", 1.8e-4, 2.1e-4),
    ("standing:arch", "pybullet/default", None, "moved", 0.8, 1.1),
    ("wedge:xi-0.01", "lmgc90/default", None, "s", 0.06, 0.065),
    ("wedge:xi-0.01", "pybullet/default", None, "s", 0.36, 0.38),
    ("wedge:xi-1e-06", "lmgc90/default", None, "s", 0.99, 1.01),
    ("wedge:xi-1e-06", "pybullet/default", None, "s", 0.99, 1.01),
    ("painleve:mu-1.34", "pybullet/default", Knobs(1e-3), "distance", 5e-5, 6e-5),
    ("painleve:mu-1.34", "pybullet/default", Knobs(5e-4), "distance", 1.2e-3, 1.3e-3),
    ("painleve:mu-1.34", "pybullet/default", Knobs(2.5e-4), "distance", 2.7e-3, 2.8e-3),
    ("painleve:mu-2", "pybullet/default", Knobs(1e-3), "distance", 5e-5, 6e-5),
    ("spin-stopped:crossed", "pybullet/default", None, "middle", 0.0, 1e-13),
    ("laden-block:level", "pybullet/default", None, "slip", 0.0, 5e-6),
    ("laden-block:turning", "pybullet/default", None, "slipping", 0.020, 0.022),
    ("laden-block:turning", "pybullet/default", Knobs(1e-4), "slipping", 0.020, 0.022),
    ("shaken-fast:5hz", "lmgc90/default", Knobs(1e-3), "mean", 2.4, 2.5),
    ("shaken-fast:5hz", "pybullet/default", Knobs(1e-3), "mean", 0.042, 0.046),
    ("shaken-fast:20hz", "lmgc90/default", Knobs(1e-3), "mean", 8.2, 8.5),
    ("shaken-fast:20hz", "pybullet/default", Knobs(1e-3), "mean", 8.6, 8.9),
    ("rocking:stands", "lmgc90/default", None, "distance", 3e-4, 4e-4),
    ("rocking:stands", "pybullet/default", None, "distance", 5e-4, 5.6e-4),
    ("long-swing:pressed", "kratos/default", None, "leapfrog", 0.0, 1e-14),
    ("bounce:again", "kratos/default", None, "y1", 2.8e-4, 3.2e-4),
    ("bounce:again", "kratos/default", DEFAULT, "y1", 4.8e-5, 5.4e-5),
    ("oblique-impact:along-polyethylene-linear", "kratos/default", PAPER, "nearest",
     3.5e-6, 3.7e-6),
    ("hertz-impact:glass", "kratos/default", None, "overlap", 1.03e-4, 1.05e-4),
    ("hertz-impact:glass", "yade/default", None, "overlap", 1.03e-4, 1.05e-4),
    ("oblique-impact:angle-alumina", "kratos/default", None, "worst", 3.2e-3, 3.5e-3),
    ("oblique-impact:spun-alloy", "kratos/default", None, "worst", 0.0185, 0.0195),
]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "scheme", "at", "quantity", "low", "high"),
    FOUND,
    ids=[f"{name} {scheme} {at} {quantity}" for name, scheme, at, quantity, *_ in FOUND],
)
def test_what_is_found_of_a_program_is_as_it_is_told(
    name: str, scheme: str, at: Knobs | Level | None, quantity: str, low: float, high: float
) -> None:
    require(PROJECT.load_adapter(scheme.partition("/")[0]))
    assert low <= found(name, scheme, at, quantity) <= high


def test_lmgc90_refuses_faces_that_leave_where_they_met() -> None:
    require(PROJECT.load_adapter("lmgc90"))
    *_, run = asked("responding-block:3d-turning", "lmgc90/default", None)
    assert run.status is Status.REFUSED
