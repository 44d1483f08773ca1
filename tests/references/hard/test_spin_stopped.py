"""Claims about an impact that stops two spins: two routes agree, and no other spins are stopped."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.checks.hard import spin_stopped as integrated
from reference_solutions.hard import spin_stopped as closed
from tests.support.turned_signs import caught, signs, turned

LAW = {"m1": 3.0, "m2": 2.0, "V": 1.5}
N = np.array([2.0, -1.0, 2.0]) / 3
ARMS = np.array([[0.3, -0.2, 0.5], [-0.4, 0.1, -0.6]])
INERTIAS = np.array([
    [[0.9, 0.1, -0.2], [0.1, 0.7, 0.05], [-0.2, 0.05, 1.1]],
    [[0.5, -0.1, 0.0], [-0.1, 0.8, 0.2], [0.0, 0.2, 0.6]],
])  # fmt: skip


def agree(one: ModuleType, other: ModuleType, arms: np.ndarray, **law: float) -> bool:
    """Whether the second route leaves no spin, and both bodies have the velocity of the first."""
    spins = one.spins(arms, INERTIAS, N, **law)
    found = other.after(arms, INERTIAS, N, spins, **law).reshape(4, 3)
    due = np.array([one.together(**law) * N] * 2 + [np.zeros(3)] * 2)
    return bool(np.abs(found - due).max() < 1e-12 * law["V"])


@given(st.floats(0.1, 10.0), st.floats(0.1, 10.0), st.floats(-1.0, 1.0))
@settings(max_examples=20)
def test_the_two_routes_agree(m1: float, m2: float, more: float) -> None:
    assert agree(closed, integrated, ARMS + more, m1=m1, m2=m2, V=1.5)


@pytest.mark.parametrize("sign", signs(closed))
def test_any_wrong_sign_in_the_formula_is_caught(sign: int) -> None:
    assert caught(lambda: agree(turned(closed, sign), integrated, ARMS, **LAW))


def test_an_arm_that_is_a_little_off_leaves_a_spin() -> None:
    spins = closed.spins(ARMS, INERTIAS, N, **LAW)
    found = integrated.after(1.01 * ARMS, INERTIAS, N, spins, **LAW)
    assert np.abs(found[6:]).max() > 1e-3
