"""Claims about a column of grains in layers, and about the measured laws of its collapse."""

import math

import numpy as np
import pytest

from reference_solutions.bulk import column


def test_spheres_in_the_hollows_of_a_layer_touch_it() -> None:
    hollow = np.array([0.5, math.sqrt(1.0 / 12.0), column.RISE])
    for corner in ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, math.sqrt(0.75), 0.0]):
        assert np.linalg.norm(hollow - corner) == pytest.approx(1.0, rel=1e-12)
    assert pytest.approx(column.RISE - 0.5) == column.GROUND


def test_a_column_of_close_packed_spheres_fills_what_its_radius_and_height_say() -> None:
    spheres, layers = 91, 6
    room = math.pi * column.radius(spheres) ** 2 * layers * column.RISE
    assert spheres * layers * math.pi / 6.0 / room == pytest.approx(math.pi / math.sqrt(18.0))
    assert column.layers(4.9) == 6


def test_the_laws_of_low_and_tall_columns_meet_where_they_should() -> None:
    a = column.TALL
    assert column.run_out(a) == pytest.approx(column.run_out(a * (1 - 1e-12)), rel=0.02)
    assert column.run_out(0.5) == pytest.approx(0.62)
    assert column.run_out(4.0) == pytest.approx(3.2)
    assert [column.height(a) for a in (1.0, 64.0)] == pytest.approx([0.88, 1.76])
