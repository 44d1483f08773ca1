"""Claims about a body that skids over a spring: two routes agree, its loss is friction work."""

from __future__ import annotations

from math import pi, sqrt
from types import ModuleType

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from reference_solutions.checks.contact import skid as integrated
from reference_solutions.contact import skid as closed
from tests.support.turned_signs import caught, signs, turned

LAW = {"m": 2.0, "kn": 3e5, "ks": 2e5, "mu": 0.5, "vn": 0.3, "vt": 0.4}


def agree(one: ModuleType, other: ModuleType, **law: float) -> bool:
    """Whether the routes agree in contact, to second order in steps, and motion is free later."""
    t, due = other.contact(**law, steps=4000)
    found = np.concatenate(one.motion(t, **law), axis=1)
    size = law["vt"] * np.array([t[-1], t[-1], 1.0, 1.0])
    place, speed = one.motion(t[-1] * np.array([1.0, 2.0]), **law)
    drift = place[1] - place[0] - speed[1] * t[-1]
    return bool((np.abs(found - due) < 2e-6 * size).all() and np.abs(drift).max() < 1e-12)


@given(st.floats(0.05, 1.0), st.floats(0.1, 2.0), st.floats(0.5, 3.0))
@settings(max_examples=20)
def test_the_two_routes_agree(mu: float, ratio: float, vt: float) -> None:
    assume(vt > 1.01 * mu / ratio and vt + mu / ratio > 2.01 * mu)
    assert agree(closed, integrated, m=2.0, kn=3e5, ks=3e5 * ratio, mu=mu, vn=1.0, vt=vt)


@pytest.mark.parametrize("sign", signs(closed))
def test_any_wrong_sign_in_the_formula_is_caught(sign: int) -> None:
    assert caught(lambda: agree(turned(closed, sign), integrated, **LAW))


def test_the_work_of_friction_is_what_it_loses() -> None:
    t = np.linspace(0.0, pi / sqrt(LAW["kn"] / LAW["m"]), 20001)
    place, speed = closed.motion(t, **LAW)
    friction = -LAW["mu"] * LAW["kn"] * place[:, 0]
    lost = 0.5 * LAW["m"] * (speed[0] @ speed[0] - speed[-1] @ speed[-1])
    assert np.trapezoid(friction * speed[:, 1], t) == pytest.approx(lost, rel=1e-6)


@pytest.mark.parametrize(("changed", "value"), [("vt", 0.2), ("ks", 4e4)])
def test_what_would_stick_is_refused(changed: str, value: float) -> None:
    with pytest.raises(ValueError, match=r"beside mu vn = 0.15 m/s the body would stick"):
        closed.motion(np.zeros(1), **{**LAW, changed: value})
