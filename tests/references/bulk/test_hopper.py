"""Claims about a hole surrounded by grains, and about the law of the discharge through it."""

import math

import numpy as np
import pytest

from reference_solutions.bulk import hopper


@pytest.mark.parametrize("clear", [4.5, 6.0, 9.0])
def test_the_hole_is_as_large_as_points_that_no_grain_covers(clear: float) -> None:
    ring, many = hopper.edge(clear)
    turn = 2.0 * math.pi * np.arange(many) / many
    grains = ring * np.column_stack([np.cos(turn), np.sin(turn)])
    axis = np.arange(-ring, ring, 0.02)
    x, y = (part.ravel() for part in np.meshgrid(axis, axis))
    middle = 2.0 * math.pi / many
    facing = (np.arctan2(y, x) + 0.5 * middle) % middle - 0.5 * middle  # from the nearest grain
    inside = np.hypot(x, y) * np.cos(0.5 * middle - np.abs(facing)) < ring * np.cos(0.5 * middle)
    near = np.hypot(x[:, None] - grains[:, 0], y[:, None] - grains[:, 1]).min(axis=1)
    free = 0.02**2 * np.count_nonzero(inside & (near > 0.5))
    assert 0.25 * math.pi * hopper.across(clear) ** 2 == pytest.approx(free, rel=4e-3)
    assert clear < hopper.across(clear) < clear + 1.0
    assert ring == pytest.approx(0.5 * clear + 0.5, rel=1e-12), "grains leave the opening clear"
    apart = 2.0 * ring * math.sin(math.pi / many)
    assert apart >= 1.02 > 2.0 * ring * math.sin(math.pi / (many + 1)), "no more grains find room"


def test_a_hole_as_wide_as_its_edge_takes_lets_nothing_through() -> None:
    assert hopper.rate(hopper.EDGE, 0.6) == 0.0
    assert hopper.rate(hopper.EDGE + 1.0, math.pi / 6.0) == pytest.approx(0.58)
    assert hopper.rate(5.4, 0.6) / hopper.rate(2.4, 0.6) == pytest.approx(32.0)


def test_the_uncertainty_is_that_of_both_constants() -> None:
    opening, step = 6.0, 1e-6
    by_edge = (hopper.rate(opening - step, 1.0) / hopper.rate(opening, 1.0) - 1.0) / step
    both = math.hypot(0.03 / 0.58, 0.1 * by_edge)
    assert hopper.uncertainty(opening) == pytest.approx(both, rel=1e-5)
