"""Claims about margins of rounding in slip along a line: they scale with what is compared."""

from __future__ import annotations

import numpy as np
import pytest

from reference_solutions.blocks.harmonic_slip import Drive, Law, Phase, displacement, phases

UNITS = [(size, rate) for size in (1e-9, 1.0, 1e9) for rate in (1e-6, 1.0, 1e6)]


@pytest.mark.parametrize(("size", "rate"), UNITS)
def test_a_slip_that_all_but_stops_goes_on_in_any_units(size: float, rate: float) -> None:
    """w = (size/rate)(1.001 + cos x): a thousandth of its mean is left at half a turn."""
    law, turns = Law(0.0, -size), 2.6
    drive = Drive(rate, 0.0, law, law)
    (slip,) = phases(drive, 2.001 * size / rate, 2.0 * np.pi * turns / rate)
    assert slip.direction == 1
    x = np.array([0.3, 3.1, 16.0])
    due = size / rate**2 * (1.001 * x + np.sin(x))
    assert displacement(x / rate, drive, (slip,)) == pytest.approx(due, rel=1e-13, abs=0.0)


@pytest.mark.parametrize(("size", "rate"), UNITS)
def test_a_point_at_rest_begins_to_slip_at_once_in_any_units(size: float, rate: float) -> None:
    """It is pushed with a tenth of the amplitude of the drive."""
    drive = Drive(rate, np.arcsin(0.6), Law(-0.5 * size, size), Law(0.5 * size, size))
    first: Phase = phases(drive, 0.0, 1.0 / rate)[0]
    assert (first.begin, first.direction) == (0.0, 1)
    assert first.a == pytest.approx(0.1 * size, rel=1e-14)
