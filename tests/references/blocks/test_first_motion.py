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


@pytest.mark.parametrize("sign", signs(first_motion))
def test_any_wrong_sign_is_caught(sign: int) -> None:
    wrong = turned(first_motion, sign)
    joins = first_motion.slip_joins(50.0, 20.0)
    assert caught(
        lambda: (
            max(error(wrong, *point) for point in POINTS) < 1e-9
            and abs(wrong.slip_joins(50.0, 20.0) - joins) < 1e-9
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
