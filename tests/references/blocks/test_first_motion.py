"""Claims about the onset of motion of a block on a slope: two routes agree, also on the borders."""

from types import ModuleType

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from reference_solutions.blocks import first_motion
from reference_solutions.blocks.first_motion import Mode
from reference_solutions.checks.blocks import first_motion as enumerated
from tests.support.turned_signs import caught, signs, turned

ANGLE = st.floats(2.0, 88.0)
POINTS = [
    (psi, phi, delta) for psi in (8.0, 33.0, 61.0) for phi in (9.0, 34.0, 58.0, 80.0)
    for delta in (7.0, 31.0, 63.0)
]  # fmt: skip


def error(route: ModuleType, psi: float, phi: float, delta: float) -> float:
    at = {"psi": psi, "phi": phi, "delta": delta}
    own = route.acceleration(route.mode(**at), **at)
    return float(np.abs(own - enumerated.acceleration(**at)[:2]).max())


@given(ANGLE, ANGLE, ANGLE)
@settings(max_examples=60)
def test_the_two_routes_agree(psi: float, phi: float, delta: float) -> None:
    assert error(first_motion, psi, phi, delta) < 1e-9


CORNERS = [
    {"psi": psi, "phi": phi, "delta": delta, "half": half} for psi in (50.0, 74.1, 79.0, 81.2, 85.0)
    for phi in (37.4, 44.0, 50.0) for delta in (6.2, 10.0, 15.4, 36.0) for half in (0.2, 0.5, 0.8)
]  # fmt: skip


def turning(route: ModuleType) -> list[bool]:
    return [route.may_turn_aside(**one) for one in CORNERS]


def test_two_routes_agree_on_where_a_block_in_space_may_turn_aside() -> None:
    due = turning(enumerated)
    assert turning(first_motion) == due
    assert 0.1 < np.mean(due) < 0.9
    holds = [first_motion._one_corner_holds(*one.values()) for one in CORNERS]
    slips = [first_motion._slip_is_unstable(*one.values()) for one in CORNERS]
    assert set(zip(holds, slips, strict=True)) >= {(True, False), (False, True), (False, False)}


@given(ANGLE, ANGLE, st.floats(0.0, 1.0), st.floats(0.2, 1.5))
@settings(max_examples=60)
def test_they_agree_at_any_angles(psi: float, phi: float, part: float, half: float) -> None:
    delta = 1.0 + part * (min(psi, phi) - 1.5)
    at = {"psi": psi, "phi": phi, "delta": delta, "half": half}
    assert first_motion.may_turn_aside(**at) == enumerated.may_turn_aside(**at)


@pytest.mark.parametrize("sign", signs(first_motion))
def test_any_wrong_sign_is_caught(sign: int) -> None:
    wrong = turned(first_motion, sign)
    joins = first_motion.slip_joins(50.0, 20.0)
    assert caught(
        lambda: (
            max(error(wrong, *point) for point in POINTS) < 1e-9
            and abs(wrong.slip_joins(50.0, 20.0) - joins) < 1e-9
            and turning(wrong) == turning(first_motion)
        )
    )


@given(st.floats(6.0, 80.0), st.floats(0.05, 0.95))
def test_slip_joins_a_topple_where_the_critical_friction_is_that_of_the_block(
    phi: float, part: float
) -> None:
    delta = part * phi
    psi = first_motion.slip_joins(phi, delta)
    assume(psi < 90.0)
    assert first_motion.critical(psi, delta) == pytest.approx(phi, rel=1e-9)


@pytest.mark.parametrize(
    ("psi", "phi", "delta", "mode"),
    [(19, 20, 30, Mode.STAYS), (21, 20, 30, Mode.SLIDES), (31, 60, 30, Mode.TOPPLES),
     (29, 60, 30, Mode.STAYS), (50, 25, 20, Mode.SLIDES_AND_TOPPLES), (50, 19, 20, Mode.SLIDES)],
)  # fmt: skip
def test_a_block_does_what_the_chart_says(psi: float, phi: float, delta: float, mode: Mode) -> None:
    assert first_motion.mode(psi=psi, phi=phi, delta=delta) is mode


def test_what_the_chart_does_not_cover_is_refused() -> None:
    with pytest.raises(ValueError, match=r"psi = 90.0 degrees; it must lie between 0 and 90"):
        first_motion.mode(psi=90.0, phi=20.0, delta=20.0)
    with pytest.raises(ValueError, match=r"delta = 30.0 degrees; a block topples for delta"):
        first_motion.critical(20.0, 30.0)
    with pytest.raises(ValueError, match=r"delta = 30.0 degrees; it must be below phi"):
        first_motion.slip_joins(20.0, 30.0)
    with pytest.raises(ValueError, match=r"half = 0.0; it must be positive"):
        first_motion.may_turn_aside(psi=50.0, phi=40.0, delta=20.0, half=0.0)
