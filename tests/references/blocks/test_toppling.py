"""Claims about a body that topples about a line: two routes agree, and small leans have a limit."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.blocks import toppling as closed
from reference_solutions.checks.blocks import toppling as integrated

T = np.linspace(0.0, 0.9, 31)


@given(st.floats(0.02, 1.5), st.floats(0.5, 1.5))
@settings(max_examples=10)
def test_the_two_routes_agree(theta0: float, lam: float) -> None:
    law = {"theta0": theta0, "lam": lam}
    assert np.abs(closed.angle(T, **law) - integrated.angle(T, **law)).max() < 1e-11


def test_a_small_lean_grows_as_cosh() -> None:
    found = closed.angle(T, theta0=1e-6, lam=3.0)
    assert found == pytest.approx(1e-6 * np.cosh(3.0 * T), rel=1e-9)


def test_times_after_it_hangs_are_refused() -> None:
    with pytest.raises(ValueError, match=r"t = 0.9 s; from 0.731\d* s on the body hangs"):
        closed.angle(T, theta0=1.0, lam=3.0)
