"""Claims about slip that prescribed motions bend, and about contacts that bodies share a groove."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.engines.rigid.by_hand.test_free_motion import BASE, OTHER, SHAKEN, begun, rate
from tests.engines.rigid.by_hand.test_midstep import a_trial, at_contact
from vv.engines.rigid.general import bends
from vv.engines.rigid.general.bends import add_friction, along_groove, sag_by_motions, set_turns
from vv.engines.rigid.slip import bend
from vv.engines.rigid.solver.assembly import Bodies, apply
from vv.engines.rigid.solver.problem import Friction, Problem
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
NOW, SPAN = 0.07, 0.013  # s


def gained(begin: float, end: float) -> Vector:
    """The velocity that shaking gives, in closed form."""
    omega = 2 * np.pi * SHAKEN.frequency
    first, last = (np.cos(omega * t + SHAKEN.phase) / omega for t in (begin, end))
    return np.asarray(SHAKEN.amplitude * (first - last))


def sag(setting: Any, block: int, motion: Any) -> Vector:
    """The velocity relative to a wall at mid-step less the mean of those at the ends."""
    shaken = gained(NOW, NOW + SPAN / 2) - 0.5 * gained(NOW, NOW + SPAN)
    base = [rate(motion, NOW + part * SPAN) if motion else np.zeros(3) for part in (0, 0.5, 1)]
    held = setting.inverse[block] @ (setting.mass[block] * shaken)
    return np.asarray(held - base[1] + 0.5 * (base[0] + base[2]))


def test_the_sag_of_a_block_on_a_wall_is_by_shaking_and_by_the_wall() -> None:
    """Contacts are with walls 0, 2 and 1, and between both blocks."""
    setting, _, _ = begun()
    joints = a_trial().joints
    for c, motion in ((0, BASE), (2, OTHER), (3, None)):
        due = sag(setting, joints.second[c], motion)
        found = sag_by_motions(setting, NOW, SPAN, joints, c)
        assert found == pytest.approx(due, abs=1e-12)
    assert sag_by_motions(setting, NOW, SPAN, joints, 1) == (0.0, 0.0, 0.0)


UP, SIDE = np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.6, 0.8])
END = np.array([0.8, 0.0, 0.6])


@pytest.mark.parametrize(("normals", "due"), [
    ((UP, UP), [3.0, 2.0, 0.0]),
    ((UP, SIDE), [3.0, 0.0, 0.0]),
    ((UP, SIDE, SIDE), [3.0, 0.0, 0.0]),
    ((UP, SIDE, END), [0.0, 0.0, 0.0]),
    ((SIDE, END), None),
])  # fmt: skip
@pytest.mark.parametrize("unit", [1.0, 1e3])
def test_a_velocity_is_that_which_all_walls_that_press_a_block_allow(
    normals: Any, due: Any, unit: float
) -> None:
    """In their plane, along their groove, or none; contacts that do not press do not count."""
    n = np.array([*normals, END, [1.0, 0, 0], [0, 1.0, 0]])
    count = len(normals)
    second = np.array([0] * count + [1, 0, 0])  # of another block, with another block, and open
    first = np.array([2] * count + [2, 1, 2])
    joints: Any = SimpleNamespace(normal=n, first=first, second=second)
    p = 5.0 * n
    p[-1] *= -1.0
    found = along_groove(tuple(unit * np.array([3.0, 2.0, 1.0])), joints, 0, p, 2)
    if due is None:
        groove = np.cross(SIDE, END)
        groove /= np.linalg.norm(groove)
        due = groove @ [3.0, 2.0, 1.0] * groove
    assert found == pytest.approx(unit * np.array(due), abs=1e-9 * unit)


class Slipping:
    """Four contacts of which one has no slip at the start and one does not press."""

    def __init__(self) -> None:
        self.setting, _, _ = begun()
        self.joints, random = a_trial().joints, np.random.default_rng(8)
        inverse, spins = random.uniform(0.5, 2.0, size=(2, 5, 3, 1)) * np.eye(3)
        inverse[2:] = spins[2:] = 0.0  # walls
        self.bodies = Bodies(inverse, spins, np.zeros((5, 3)))
        self.motion = 0.1 * random.normal(size=(4, 5, 3))
        self.motion[[0, 2], :2] += [3.0, 0.0, 0.0]
        self.p = 0.01 * self.joints.normal + 0.001
        self.p[2] = -0.01 * self.joints.normal[2]
        d = self.joints.normal[:, [1, 0, 2]] * [1.0, -1.0, 0.0]
        d[1] = 0.0
        self.friction = Friction(0.4, np.zeros(4), d, np.full((4, 3), 7.0))

    def flat(self, c: int, u: Any) -> Vector:
        """The part of a vector in the tangent plane of a contact."""
        n = self.joints.normal[c]
        return np.asarray(np.asarray(u) - np.dot(u, n) * n)

    def pulled(self) -> Vector:
        """What friction gives the bodies (2, 5, 3): all of it where contacts slip."""
        gained = np.zeros((2, 5, 3))
        for c in range(4):
            along = self.flat(c, self.p[c])
            if c in (0, 3):
                along *= 0.4 * (self.p[c] @ self.joints.normal[c]) / np.linalg.norm(along)
            apply(self.joints, c, self.bodies, gained[0], gained[1], tuple(along))
        return gained


def test_friction_of_all_contacts_counts_at_each() -> None:
    of = Slipping()
    found = np.zeros((2, 5, 3))
    add_friction(of.joints, of.bodies, of.friction, of.p, *found)
    assert np.abs(found).max() > 1e-6
    assert found == pytest.approx(of.pulled(), abs=1e-12)


def test_friction_turns_by_the_bend_of_each_slip(monkeypatch: pytest.MonkeyPatch) -> None:
    of = Slipping()
    joints, friction, p = of.joints, of.friction, of.p
    monkeypatch.setattr(bends, "along_groove", lambda sag, *_: tuple(0.5 * np.array(sag)))
    v_old, w_old, v, w = of.motion
    problem = Problem(joints, of.bodies, friction, p, v, w)
    assert set_turns(of.setting, NOW, SPAN, problem, v_old, w_old)
    for c in (0, 3):
        before, after, pulled = (
            tuple(of.flat(c, at_contact(joints, c, *motion)))
            for motion in (of.motion[:2], of.motion[2:], of.pulled())
        )
        aside = tuple(0.5 * sag(of.setting, 0, {0: BASE, 3: None}[c]))
        due = bend(before, aside, after, float(np.linalg.norm(pulled)))
        assert np.linalg.norm(due) > 1e-6
        assert friction.turn[c] == pytest.approx(due)
    assert (friction.turn[1:3] == 7.0).all()
    still = problem._replace(friction=friction._replace(d=0.0 * friction.d))
    assert not set_turns(of.setting, NOW, SPAN, still, v_old, w_old)
