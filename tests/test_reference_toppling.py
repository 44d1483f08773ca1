"""Claims about a body that topples about a line: two routes, and what a small lean tends to."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions import toppling as closed
from reference_solutions.checks import toppling as integrated
from tests.turned_signs import caught, signs, turned

T = np.linspace(0.0, 0.9, 31)


def agree(one: ModuleType, other: ModuleType, **law: float) -> bool:
    """Whether the routes agree on the angle."""
    return bool(np.abs(one.angle(T, **law) - other.angle(T, **law)).max() < 1e-11)


@given(st.floats(0.02, 1.5), st.floats(0.5, 1.5))
@settings(max_examples=10, deadline=None)
def test_the_two_routes_agree(theta0: float, lam: float) -> None:
    assert agree(closed, integrated, theta0=theta0, lam=lam)


@pytest.mark.parametrize("sign", signs(closed))
def test_any_wrong_sign_in_the_formula_is_caught(sign: int) -> None:
    assert caught(lambda: agree(turned(closed, sign), integrated, theta0=0.3, lam=3.0))


def test_a_small_lean_grows_as_cosh() -> None:
    found = closed.angle(T, theta0=1e-6, lam=3.0)
    assert found == pytest.approx(1e-6 * np.cosh(3.0 * T), rel=1e-9)


def test_times_after_it_hangs_are_refused() -> None:
    with pytest.raises(ValueError, match=r"t = 0.9 s; from 0.6\d+ s on the body hangs"):
        closed.angle(T, theta0=1.0, lam=3.0)
