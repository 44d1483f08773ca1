"""Claims about a mass on a shaken spring: two routes agree, also for a sphere in a corner."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.checks.contact import shaken_spring as integrated
from reference_solutions.contact import shaken_spring as closed
from tests.support.turned_signs import caught, signs, turned
from vv.case import Series
from vv.plan.project import find

CASE = find().load_case("shaken-corner")
T = np.linspace(0.0, 4.0, 81)
LAW = {"m": 2.0, "k": 60.0, "c": 3.0, "v": 0.7, "force": 5.0}
SHAKING = ((0.3, 2.0, 0.4), (0.2, 7.0, -1.0))
BASE = ((0.05, 3.0, 1.1), (0.03, 9.0, 2.0))


def agree(one: ModuleType, other: ModuleType, **law: float) -> bool:
    """Whether the routes agree on the displacement."""
    drives = {"shaking": SHAKING, "base": BASE}
    told = {"shaking": [one.Sine(*a) for a in SHAKING], "base": [one.Sine(*a) for a in BASE]}
    due = other.displacement(T, **law, **drives)
    apart = np.abs(one.displacement(T, **law, **told) - due).max() / np.abs(due).max()
    return bool(apart < 1e-11)


@given(st.floats(0.0, 0.9), st.floats(0.1, 10.0), st.floats(-3.0, 3.0))
@settings(max_examples=10)
def test_the_two_routes_agree(z: float, m: float, force: float) -> None:
    law = {"m": m, "k": 60.0, "c": 2 * z * (60.0 * m) ** 0.5, "v": 0.7, "force": force}
    assert agree(closed, integrated, **law)


@pytest.mark.parametrize("sign", signs(closed))
def test_any_wrong_sign_in_the_formula_is_caught(sign: int) -> None:
    assert caught(lambda: agree(turned(closed, sign), integrated, **LAW))


def test_what_does_not_swing_is_refused() -> None:
    with pytest.raises(ValueError, match=r"c = 22.0 N s/m; only below .* = 21.9089"):
        closed.displacement(T, m=2.0, k=60.0, c=22.0, v=0.7)


@given(st.floats(0.0, 0.4), st.floats(0.0, 0.4), st.sampled_from(["corner", "wall", "viscous"]))
@settings(max_examples=20)
def test_no_contact_of_the_corner_opens_or_slips(z: float, zn: float, variant: str) -> None:
    p = {**CASE.defaults(variant), "z": z}
    p |= {"zn": zn} if variant == "viscous" else {}
    trial = CASE.declare(variant, p)
    scene, t = trial.study.scene, np.linspace(0.0, 0.04, 801)
    motions = [wall.motion.sines() if wall.motion else () for wall in scene.walls]
    steps = [[(a, 2 * np.pi * f, phi) for a, f, phi in motion] for motion in motions]
    path = np.stack(
        [q.reference(t) for q in trial.quantities if isinstance(q, Series) and q.reference], axis=1
    )
    for wall, sines in zip(scene.walls, steps, strict=True):
        moved = sum(np.outer(np.sin(w * t + phi) - np.sin(phi), a) for a, w, phi in sines)
        apart = path @ scene.axes[: path.shape[1]] - moved
        along = np.linalg.norm(apart - np.outer(apart @ wall.normal, wall.normal), axis=1)
        push = scene.contact.kn * (p["u"] - apart @ wall.normal)
        push -= scene.contact.eta_n * np.gradient(apart @ wall.normal, t)
        assert push.min() > 0
        if scene.contact.mu > 0:
            assert (scene.contact.ks * along < scene.contact.mu * push).all()
