"""Claims about a rocking block: two routes agree, also with values of the literature."""

from __future__ import annotations

import numpy as np
import pytest

from reference_solutions.blocks import rocking
from reference_solutions.checks.blocks import rocking as stepped

LAW = {"b": 0.2, "h": 0.6, "g": 9.81}
W = 2 * np.pi
ALPHA = rocking.slenderness(**LAW)[0]


@pytest.mark.parametrize("t", [0.3, 0.9, 1.3, 1.9])
def test_a_block_that_is_let_go_rocks_the_same_by_both_routes(t: float) -> None:
    found = rocking.leans([0.0, t], **LAW, theta=0.6 * ALPHA)[-1]
    other = stepped.leans(t, **LAW, A=0.0, w=W, T=0.0, theta=0.6 * ALPHA, steps=2000)
    assert found == pytest.approx(other, abs=1e-10)


@pytest.mark.parametrize(("A", "t"), [(4.5, 0.5), (4.5, 1.5), (5.2, 0.75), (6.0, 0.7)])
def test_a_block_under_half_a_sine_rocks_the_same_by_both_routes(A: float, t: float) -> None:
    """The second route starts the rocking at the end of a step, which causes an error of 1e-6."""
    found = rocking.leans([0.0, t], **LAW, A=A, w=W, T=0.5)[-1]
    other = stepped.leans(t, **LAW, A=A, w=W, T=0.5, theta=0.0, steps=3000)
    assert found == pytest.approx(other, abs=2e-6)


def test_it_overturns_from_the_threshold_on_by_both_routes() -> None:
    least = rocking.threshold(**LAW, w=W)
    assert least == pytest.approx(5.638047, abs=1e-6)
    assert stepped.overturns(least * (1 + 1e-6), **LAW, w=W, steps=2000)
    assert not stepped.overturns(least * (1 - 1e-6), **LAW, w=W, steps=2000)


def test_a_slow_sine_overturns_it_hardly_above_what_lifts_it_by_both_routes() -> None:
    least, lifts = rocking.threshold(**LAW, w=3.0), LAW["g"] * np.tan(ALPHA)
    assert 1.01 < least / lifts < 1.3
    assert stepped.overturns(least * (1 + 1e-6), **LAW, w=3.0, steps=2000)
    assert not stepped.overturns(least * (1 - 1e-6), **LAW, w=3.0, steps=2000)


@pytest.mark.parametrize(("g", "least"), [(9.80, 5.43639), (9.80665, 5.43911), (9.81, 5.44049)])
def test_for_small_angles_the_threshold_is_that_of_makris_and_roussos(
    g: float, least: float
) -> None:
    found = rocking.linear_threshold(b=0.2, h=0.6, g=g, w=W)
    assert found == pytest.approx(least, abs=5e-6)


def test_swings_end_and_turn_where_they_should() -> None:
    t = np.linspace(0.0, 1.9, 19001)
    lean = rocking.leans(t, **LAW, theta=0.6 * ALPHA)
    ends = t[1:][np.diff(np.sign(lean)) != 0][:3]
    assert ends == pytest.approx([0.46043, 1.07570, 1.54661], abs=2e-4)
    spans = zip(ends, [*ends[1:], 1.9], strict=True)
    swings = [np.abs(lean[(t > one) & (t < two)]).max() / ALPHA for one, two in spans]
    assert swings == pytest.approx([0.37400, 0.25168, 0.17431], abs=1e-5)


def test_only_one_amplitude_is_the_threshold_where_stronger_pulses_throw_a_block_round() -> None:
    """Under 10 times that amplitude a block of b/h = 0.57 rotates more than once in free flight."""
    law = {"b": 0.656, "h": 1.16, "g": 14.2, "w": 2 * np.pi * 0.951}
    least = rocking.threshold(**law)
    assert stepped.overturns(least * (1 + 1e-6), **law, steps=2000)
    assert not stepped.overturns(least * (1 - 1e-6), **law, steps=2000)


@pytest.mark.parametrize("part", [1.5, 1.05, 1.01])
def test_it_is_thrown_over_as_soon_by_both_routes(part: float) -> None:
    A = part * rocking.threshold(**LAW, w=W)
    found = rocking.overturns(**LAW, A=A, w=W)
    other = stepped.leans(found, **LAW, A=A, w=W, T=0.5, theta=0.0, steps=6000)
    assert other == pytest.approx(2 * ALPHA, rel=2e-4)


@pytest.mark.parametrize(("b", "part"), [(0.6, 1.1), (0.2, 0.99)])
def test_what_is_not_thrown_over_is_said_so(b: float, part: float) -> None:
    law = {**LAW, "b": b, "w": W}
    with pytest.raises(ValueError, match=r"higher than wide|does not overturn"):
        rocking.overturns(**law, A=part * rocking.threshold(**law))


def test_a_block_that_lies_on_its_side_stays_there() -> None:
    least = rocking.threshold(**LAW, w=W)
    lean = rocking.leans([0.0, 3.0, 4.0], **LAW, A=1.1 * least, w=W, T=0.5)
    assert lean[1:] == pytest.approx([np.pi / 2] * 2, abs=1e-12)


def test_a_squat_block_does_not_rebound() -> None:
    assert rocking.restitution(0.6, 0.4) == 0.0


def test_beyond_the_threshold_the_time_to_overturn_grows_by_a_logarithm() -> None:
    """The time increases by ln(100)/p for each two decades closer to the threshold (Hogan 1989)."""
    least, t = rocking.threshold(**LAW, w=W), np.linspace(0.0, 6.0, 60001)
    falls = [
        t[rocking.leans(t, **LAW, A=least * (1 + near), w=W, T=0.5) > ALPHA + 0.1][0]
        for near in (1e-4, 1e-6)
    ]
    p = rocking.slenderness(**LAW)[1]
    assert falls[1] - falls[0] == pytest.approx(np.log(100) / p, rel=1e-2)


def test_a_sine_too_weak_to_lift_a_block_or_too_slow_to_tell_amplitudes_apart_is_refused() -> None:
    with pytest.raises(ValueError, match=r"leans from g tan\(alpha\) = 3.27\d* on"):
        rocking.excess(3.0, **LAW, w=W)
    with pytest.raises(ValueError, match=r"w = 0.1 1/s; such a slow sine overturns every block"):
        rocking.threshold(**LAW, w=0.1)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_block_that_falls_leans_no_farther_than_flat_and_stays_there(side: float) -> None:
    alpha, p = rocking.slenderness(**LAW)
    t = np.linspace(0.0, 20.0, 201) / p
    lean, rate = rocking.phases(t, **LAW, theta=1.2 * side * alpha).T
    falls = np.abs(lean) < np.pi / 2
    assert np.count_nonzero(falls) > 20
    assert (side * np.diff(lean[falls]) > 0.0).all()
    assert not falls[np.argmin(falls) :].any()
    assert lean[~falls] == pytest.approx(side * np.pi / 2)
    assert (rate[~falls] == 0.0).all()
