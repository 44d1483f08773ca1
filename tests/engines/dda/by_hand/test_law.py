"""Claims about the law of a contact in an iteration of `dda`, and about where a slide stops."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vv.engines.dda.law import (
    OPEN,
    SLIDE,
    STICK,
    lagged_friction,
    respond,
    return_mapping,
    share_to_stop,
)
from vv.engines.kernels.triples import NOWHERE

pytestmark = pytest.mark.usefixtures("in_python")
KN, KS, MU, EASE = 1e6, 4e5, 0.5, 3e5
RIGHT, UP = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
CAP = 200.0  # N
STRETCH = CAP / KS


@pytest.mark.parametrize("coulomb", [True, False])
def test_a_gap_bears_nothing_and_without_friction_nothing_rubs(coulomb: bool) -> None:
    rest: Any = (1.0, EASE, coulomb)
    along: Any = ((1e-3, 0.0, 0.0), NOWHERE, RIGHT, KN)
    opened: Any = (STICK, 0.0, *along, KS, MU, *rest)
    assert respond(*opened) == (OPEN, 0.0, NOWHERE)
    for law in ((None, MU), (KS, None)):
        smooth: Any = (STICK, -2e-3, *along, *law, *rest)
        state, push, rubs = respond(*smooth)
        assert (state, rubs) == (SLIDE, NOWHERE)
        assert push == pytest.approx(2000.0)


@pytest.mark.parametrize("coulomb", [True, False])
@pytest.mark.parametrize(("part", "state"), [(0.98, STICK), (1.02, SLIDE)])
def test_a_contact_slides_beyond_mu_times_its_force(part: float, state: int, coulomb: bool) -> None:
    """Its stretch is that of before and the slip; it points along both together."""
    size = part * MU * 2000.0 / KS
    spring, slip = (0.6 * size, 0.3 * size, 0.0), (0.0, 0.5 * size, 0.0)
    for was in (STICK, OPEN):
        now, push, along = respond(was, -2e-3, slip, spring, UP, KN, KS, MU, 1.0, EASE, coulomb)
        assert now == state
        assert push == pytest.approx(2000.0)
        assert along == pytest.approx((0.6, 0.8, 0.0) if state == SLIDE else NOWHERE)


@pytest.mark.parametrize(("slip", "spring", "hold", "due"), [
    ((0.0, 0.0, 0.0), 0.9 * STRETCH, 1.0, STICK),
    ((0.2 * STRETCH, 0.0, 0.0), 0.9 * STRETCH, 1.0, SLIDE),
    ((-1e-9, 0.0, 0.0), 0.0, 0.0, STICK),
    ((1e-9, 0.0, 0.0), 0.0, 0.0, SLIDE),
    ((-1e-9, 0.0, 0.0), 2.0 * STRETCH, 1.0, SLIDE),
])  # fmt: skip
def test_a_lagged_slide_sticks_when_springs_bear_it_or_when_it_goes_back(
    slip: Any, spring: float, hold: float, due: int
) -> None:
    given: Any = (SLIDE, CAP, slip, (spring, 0.0, 0.0), RIGHT, KS, hold, EASE)
    assert lagged_friction(*given)[0] == due


@pytest.mark.parametrize("hold", [0.0, 1.0])
def test_a_lagged_slide_turns_towards_its_slip(hold: float) -> None:
    slip, spring = np.array([1e-3, 2e-3, 0.0]), np.array([3e-3, -1e-3, 0.0])
    toward = CAP * np.array(UP) + EASE * (slip + hold * spring)
    given: Any = (SLIDE, CAP, tuple(slip), tuple(spring), UP, KS, hold, EASE)
    now, along = lagged_friction(*given)
    assert now == SLIDE
    assert along == pytest.approx(toward / np.linalg.norm(toward))
    none: Any = (SLIDE, 0.0, NOWHERE, NOWHERE, UP, KS, 0.0, EASE)
    assert lagged_friction(*none) == (SLIDE, UP)


@pytest.mark.parametrize(("part", "due"), [(0.98, STICK), (1.02, SLIDE), (-1.0, STICK)])
def test_a_slide_by_coulombs_law_goes_on_along_its_direction(part: float, due: int) -> None:
    """Its trial stretch, seen along cap direction + ease trial, exceeds the limit or not."""
    trial = part * STRETCH * np.array([0.6, 0.8, 0.0])
    given: Any = (SLIDE, CAP, tuple(trial), NOWHERE, (0.6, 0.8, 0.0), KS, EASE)
    now, along = return_mapping(*given)
    assert now == due
    assert along == pytest.approx((0.6, 0.8, 0.0) if due == SLIDE else NOWHERE)


def test_a_slide_by_coulombs_law_turns_towards_its_trial() -> None:
    slip, spring = np.array([1e-3, 2e-3, 0.0]), np.array([3e-3, -1e-3, 0.0])
    toward = CAP * np.array(UP) + EASE * (slip + spring)
    now, along = return_mapping(SLIDE, CAP, tuple(slip), tuple(spring), UP, KS, EASE)
    assert now == SLIDE
    assert along == pytest.approx(toward / np.linalg.norm(toward))
    assert return_mapping(SLIDE, 0.0, NOWHERE, NOWHERE, UP, KS, EASE) == (STICK, NOWHERE)


@pytest.mark.parametrize(("stops", "due"), [(0.25, 0.25), (0.8, 0.8), (1.25, 1.0)])
def test_a_slide_that_slows_down_evenly_stops_after_a_part_of_a_step(
    stops: float, due: float
) -> None:
    """It covers start (1 - 1/(2 stops)) in a step."""
    start = 3e-3
    assert share_to_stop(start, start * (1.0 - 0.5 / stops)) == pytest.approx(due)
    assert share_to_stop(-start, -start) == 1.0
    assert share_to_stop(0.0, -start) == 1.0
