"""Claims about the case of masonry: the bounds of walls whose slip reverses often."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest

from cases.blocks.masonry import CASE
from cases.blocks.parts._sliding_wall import alone
from reference_solutions.blocks import responding_block
from vv.ask import Method
from vv.case import Exact, Scalar, Series, evaluated


def late(given: dict[str, float]) -> tuple[float, float]:
    """The bound of springs per step [1/s], and the bound of schemes that do not divide steps."""
    p = {**CASE.defaults("slides"), **given}
    (lowest, _) = CASE.declare("slides", p).quantities
    assert isinstance(lowest, Series)
    assert isinstance(lowest.judge, Exact)
    penalty, cut = (lowest.judge.tolerance(m) for m in (Method.PENALTY, Method.SECOND_ORDER))
    return penalty.late, cut.value


def test_bounds_grow_with_how_often_slip_turns_about_over_the_way() -> None:
    """They grow as mu g f T^2 over twenty times D, where that is more than one."""
    assert late({}) == pytest.approx((10.0, 2e-2))  # 0.2 9.81 2 0.5^2 over 1 is 0.981
    assert late({"D": 0.05 * 0.981 / 3.0}) == pytest.approx((30.0, 6e-2))


def on_springs(variant: str = "slides", **given: float) -> float | None:
    """The bound of springs at 1e9 N/m but for the steps; None where they are not judged."""
    (lowest, _) = CASE.declare(variant, {**CASE.defaults(variant), **given}).quantities
    assert isinstance(lowest, Series)
    assert isinstance(lowest.judge, Exact)
    bound = lowest.judge.tolerances.get(Method.PENALTY)
    return None if bound is None else bound.value


def walked(courses: int, mu: float, **given: float) -> float:
    """n mu g T/w of blocks of 48 kg, over the farthest that one block slides."""
    p = {**CASE.defaults("slides"), "mu": mu, **given}
    law = {name: p[name] for name in ("D", "f")}
    t = np.linspace(0.0, p["duration"], 11)
    slid = responding_block.one_direction(t, mu=mu, g=p["g"], **law)
    way = np.abs(slid - responding_block.base(t, **law)).max()
    return float(courses * mu * p["g"] * p["duration"] / math.sqrt(1e9 / 48.0) / way)


@pytest.mark.shows(
    "The case judges no springs there",
)
@pytest.mark.parametrize(
    ("columns", "courses", "ends"),
    [(6, 5, 0.6), (6, 12, 0.25225), (6, 9, 0.51685), (16, 14, 0.43514)],
)
def test_springs_are_judged_up_to_a_third_of_the_thrust_at_which_bed_joints_open(
    columns: int, courses: int, ends: float
) -> None:
    """Where friction changes its sign, springs without damping swing three times as far."""
    for part, judged in ((0.999, True), (1.001, False)):
        mu = part * ends / 3
        bound = on_springs(columns=columns, courses=courses, mu=mu, D=0.06)
        assert (bound is not None) is judged
        walk = pytest.approx(walked(courses, mu, D=0.06))
        assert bound == (walk if judged else None)


@pytest.mark.parametrize("variant", ["slides", "slides-200"])
def test_springs_are_judged_at_the_parameters_of_the_case(variant: str) -> None:
    courses = 14 if variant == "slides-200" else 5
    assert on_springs(variant) == pytest.approx(walked(courses, 0.2))


def test_a_large_wall_is_declared_within_seconds() -> None:
    """It takes 1.5 s of CPU. All pairs of 900 stones, most of them far apart, took 14."""
    on_springs()  # imports
    began = time.process_time()
    on_springs(columns=150.0, courses=6.0, mu=0.05, D=0.06)
    assert time.process_time() - began < 4.0


def test_courses_on_springs_walk_at_the_speed_of_blocks_that_vibrate_at_the_limit() -> None:
    assert on_springs() == pytest.approx(0.0162, rel=5e-3)
    assert on_springs(mu=0.19, duration=0.8) == pytest.approx(walked(5, 0.19, duration=0.8))
    assert on_springs(mu=0.19, D=0.03) == pytest.approx(walked(5, 0.19, D=0.03))


def test_the_force_on_a_bedstone_is_told_over_the_weight_or_over_one_newton() -> None:
    def scale(g: float) -> float:
        quantities = CASE.declare("borne", {**CASE.defaults("borne"), "g": g}).quantities
        (sheared,) = (one for one in quantities if one.name == "sheared")
        assert isinstance(sheared, Scalar)
        return evaluated(sheared.scale)

    assert scale(6.0) == pytest.approx(2.0 * scale(3.0))
    assert scale(0.0) == 1.0


def test_a_wall_whose_stones_no_forces_balance_is_refused() -> None:
    """Of 13 courses on piers of one and a half stones it leans; of five, from mu = 0.6 on."""
    with pytest.raises(ValueError, match=r"mu = 0.481; .* need a thrust of 0.481 times their"):
        judge(courses=13.0, mu=0.481, duration=0.462)
    with pytest.raises(ValueError, match=r"mu = 0.61; .* a thrust of 0.61 times"):
        judge(mu=0.61)


def test_a_wall_that_is_shaken_gently_needs_no_more_than_the_base_has() -> None:
    """D w^2 of 0.2 g: friction of 0.7 would let it rock, but the wall never needs it."""
    gentle = 0.2 * 9.81 / (4 * math.pi) ** 2
    assert Method.SECOND_ORDER in judge(mu=0.7, D=gentle).tolerances


def test_a_wall_near_the_end_of_equilibrium_is_shown_and_not_judged() -> None:
    """Five courses end at 0.6, so that those above 0.545 may part, as a tenth more tells."""
    assert Method.SECOND_ORDER in judge(mu=0.54).tolerances
    assert judge(mu=0.55).tolerances == {}
    assert judge(mu=0.55).not_judged.keys() >= {Method.SECOND_ORDER, Method.PENALTY}
    assert judge(columns=8.0, mu=1.6).tolerances == {}  # forces in upright joints alone hold it


@pytest.mark.parametrize("variant", ["slides", "slides-200"])
def test_the_walls_of_the_case_are_far_from_that(variant: str) -> None:
    assert alone(dict(CASE.defaults(variant)))


def judge(**given: float) -> Exact:
    (lowest, _) = CASE.declare("slides", {**CASE.defaults("slides"), **given}).quantities
    assert isinstance(lowest, Series)
    assert isinstance(lowest.judge, Exact)
    return lowest.judge
