"""Bounds and settings of a case, as numbers worked out by hand."""

import math
from typing import Any

import numpy as np
import pytest

from vv.ask import Bracket, Displacement, History, Knobs, Run, Status
from vv.case import (
    LARGEST_TOLERANCE,
    Grid,
    Ladder,
    Level,
    Search,
    Shown,
    Tolerance,
    at_rest,
    largest_step,
)
from vv.case.common_quantities import Motion
from vv.case.study import knobs_in_scene, why_too_long
from vv.scene import Contact, Scene, Spheres  # fmt: skip

BALL = Displacement(0)
SPHERES = Spheres(
    position=np.array([[0.0, 0.0, 0.0], [9.0, 0.0, 0.0]]),
    velocity=np.zeros((2, 3)),
    radius=np.ones(2),
    mass=np.ones(2),
    free=np.ones((2, 3), bool),
)
SCENE = Scene((SPHERES,), Contact(1e4))
GOAL = History(1.0, 0.5)


@pytest.mark.parametrize(
    ("knobs", "bound"),
    [
        (Knobs(1e-3, 1e8), 1e-3),
        (Knobs(2e-3, 1e8), 4e-3),  # second order
        (Knobs(1e-3, 4e8), 5e-4),  # as kn**-0.5
        (Knobs(2e-3, 4e8), 2e-3),
        (Knobs(1e-4, 1e8), 1e-4),  # its floor
        (Knobs(1e-1, 1e8), LARGEST_TOLERANCE),
        (Knobs(None, 1e8), 1e-3),
        (Knobs(2e-3, None), 4e-3),
    ],
)
def test_a_tolerance_follows_the_step_and_the_stiffness(knobs: Knobs, bound: float) -> None:
    rule = Tolerance(1e-3, "w", dt=1e-3, order=2, floor=1e-4, kn=1e8, softness=0.5)
    assert rule.at(knobs) == pytest.approx(bound)


def test_a_tolerance_that_names_no_step_or_stiffness_stays() -> None:
    for knobs in (Knobs(), Knobs(1e-5, 1e5)):
        assert Tolerance(1e-3, "w").at(knobs) == 1e-3


@pytest.mark.parametrize(
    ("largest", "still", "rests"),
    [
        (0.0, None, True),
        (0.0, 5.0, True),
        (5e-12, 5.0, True),
        (6e-12, 5.0, False),
        (1e-30, None, False),
        (1.0, 5.0, False),
    ],
)
def test_rest_is_a_trillionth_of_the_way_that_stands_for_none(
    largest: float, still: float | None, rests: bool
) -> None:
    assert at_rest(largest, still) is rests


def motion(slope: float, still: float | None = None) -> Motion:
    def path(t: np.ndarray) -> np.ndarray:
        return slope * np.stack([3.0 * t, 4.0 * t], axis=1)

    return Motion(BALL, np.eye(3)[:2], path, np.linspace(0.0, 1.0, 3), "m", still)


def test_the_size_of_a_motion_is_its_largest_norm_or_what_stands_for_it_at_rest() -> None:
    assert motion(1.0).size == pytest.approx(5.0)
    assert motion(1.0, still=7.0).size == pytest.approx(5.0)
    assert motion(0.0, still=7.0).size == 7.0


def test_the_distance_is_the_largest_norm_of_the_error_vector() -> None:
    times = np.array([0.0, 0.5, 1.0])
    exact = np.stack([3.0 * times, 4.0 * times, 0.0 * times], axis=1)
    off = np.array([[0.0, 0.0, 0.0], [0.3, 0.4, 9.0], [0.0, 0.1, 9.0]])  # z is not looked at
    run = Run(Status.RAN, times=times, values={BALL: exact + off})
    assert motion(1.0).distance(Shown("w")).observe(run) == pytest.approx(0.5)


def test_the_largest_step_is_that_below_all_unstable_ones_over_theory() -> None:
    tried = np.array([[1.0, 0.1], [2.0, 0.2], [3.0, 9.0], [4.0, 0.3]])
    found = largest_step("s", 4.0, "2/w", Bracket(8.0, 1.0), Shown("w"))
    run = Run(Status.RAN, times=np.zeros(1), tried=tried)
    assert (found.observe(run), found.reference, found.scale) == (0.5, 1.0, 1.0)


def test_a_search_begins_at_its_step_and_takes_as_many_steps_at_each() -> None:
    study = Search(SCENE, (BALL,), 0.01, 40, Bracket(8.0, 1.0), kn=1e8)
    assert study.goal == History(0.4, 0.02)
    assert study.rungs[Level.QUICK] == study.rungs[Level.PAPER] == (Knobs(0.01, 1e8),)
    for dt, duration in ((0.01, 0.4), (0.02, 0.8)):
        ask = study.ask(Knobs(dt, 1e8))
        assert ask.goal.duration == pytest.approx(duration)
        assert (ask.knobs.kn, ask.search) == (1e8, study.bracket)
    assert study.ask(Knobs(None, 1e8)).goal.duration == pytest.approx(0.4)
    with pytest.raises(ValueError, match="at least 20"):
        Search(SCENE, (BALL,), 0.01, 19, Bracket(8.0, 1.0))


def grid(with_kn: bool = True, **changes: Any) -> Grid:
    given = {"cpu_limit": 1.0, "kn": dict.fromkeys(Level, (1e4, 4e4)), **changes}
    if with_kn:
        given["scene_with_kn"] = lambda kn: Scene((SPHERES,), Contact(kn))
    steps = dict.fromkeys(Level, (0.5, 2.0))
    return Grid(SCENE, GOAL, (BALL,), steps, lambda kn: 10.0 / math.sqrt(kn or 1.0), **given)


def test_a_map_has_every_step_at_every_stiffness_in_units_of_the_critical_one() -> None:
    assert grid().rungs[Level.DEFAULT] == (
        Knobs(0.05, 1e4), Knobs(0.2, 1e4), Knobs(0.025, 4e4), Knobs(0.1, 4e4),
    )  # fmt: skip


def test_the_scene_of_a_point_has_its_stiffness_if_that_is_part_of_the_scene() -> None:
    assert grid().ask(Knobs(0.1, 4e4)).scene.contact.kn == 4e4
    assert grid().ask(Knobs(0.1)).scene is SCENE
    assert grid(with_kn=False).ask(Knobs(0.1, 4e4)).scene is SCENE
    assert knobs_in_scene(grid()) == ("kn",)
    assert knobs_in_scene(grid(with_kn=False)) == ()
    assert knobs_in_scene(Ladder(SCENE, GOAL, (BALL,), dict.fromkeys(Level, (Knobs(0.1),)))) == ()


def test_steps_that_no_number_counts_are_refused() -> None:
    """2^53 steps are counted; of one more no float is left."""
    levels = dict.fromkeys(Level, (Knobs(0.5), Knobs(0.25)))
    Ladder(SCENE, History(2.0**51, 1.0), (BALL,), levels)
    with pytest.raises(ValueError, match=r"takes 1.8e\+16 steps of 0.25 s, of which at most 9.01e"):
        Ladder(SCENE, History(2.0**52, 1.0), (BALL,), levels)


@pytest.mark.parametrize("name", ["kn", "steps"])
def test_a_map_without_steps_or_stiffnesses_is_refused(name: str) -> None:
    values: dict[str, Any] = {
        "steps": dict.fromkeys(Level, (1.0,)),
        "kn": dict.fromkeys(Level, (1e4,)),
    }
    values[name] = {**values[name], Level.PAPER: ()}
    with pytest.raises(ValueError, match="empty at level paper"):
        Grid(SCENE, GOAL, (BALL,), critical=lambda kn: 0.1, **values)


@pytest.mark.parametrize(
    ("dt", "pace", "said"),
    [
        (0.1, (0.1, 0.0), None),  # ten steps of 0.1 s: at the limit of 1 s
        (0.1, (0.11, 0.0), "9.1 steps"),
        (0.1, (0.0, 0.05), None),  # for each of two bodies
        (0.1, (0.02, 0.05), "not run: 10 steps of about 0.12 s each; the limit is 1 s"),
        (None, (9.0, 9.0), None),  # takes no steps
    ],
)
def test_a_setting_that_would_take_too_long_is_told(
    dt: float | None, pace: tuple[float, float], said: str | None
) -> None:
    found = why_too_long(grid(), Knobs(dt), pace)
    assert (found is None) if said is None else (found is not None and said in found)
    search = Search(SCENE, (BALL,), 0.01, 40, Bracket(8.0, 1.0))
    assert why_too_long(search, Knobs(0.01), (1e9, 0.0)) is None


@pytest.mark.parametrize(
    ("value", "given", "coarse", "fine"),
    [
        (0.4, {"dt": 1e-3, "order": 1}, 0.1, 0.04),
        (0.4, {"dt": 1e-3, "order": 2}, 0.1, 0.004),
        (0.04, {"dt": 1e-3, "order": 1}, 0.04, 0.004),
        (0.4, {"kn": 1e8, "softness": 0.5}, 0.1, 0.04),
        (0.4, {"kn": 1e8, "softness": 0.5, "dt": 1e-3, "order": 1}, 0.1, 0.004),
        (0.4, {}, 0.1, 0.1),
        (math.inf, {"dt": 1e-3, "order": 1}, 0.1, 0.1),
        (math.inf, {"kn": 1e8, "softness": 1.0}, 0.1, 0.1),
    ],
)
def test_a_bound_over_the_largest_is_cut_at_each_setting_and_not_before_it_is_scaled(
    value: float, given: dict[str, Any], coarse: float, fine: float
) -> None:
    """Between the settings steps are a tenth as long, and springs a hundred times as stiff."""
    found = Tolerance(value, "why", **given)
    assert found.at(Knobs(1e-3, 1e8)) == pytest.approx(coarse)
    assert found.at(Knobs(1e-4, 1e10)) == pytest.approx(fine)
