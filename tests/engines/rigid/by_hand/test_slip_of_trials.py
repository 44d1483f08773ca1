"""Claims about what a trial of `rigid` tells of slips, and about forces of locks, by hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.engines.rigid.by_hand.solver.test_joints import jacobian, scattered
from tests.engines.rigid.by_hand.test_free_motion import FREE, GRAVITY, LOAD, hold, scene
from vv.engines.rigid.general.events import may_slip, past_after, slowest_slip
from vv.engines.rigid.general.model import Space
from vv.engines.rigid.limits import GRIP

pytestmark = pytest.mark.usefixtures("in_python")
SPAN, MU = 0.02, 0.4


def a_trial(presses: Any, slides: Any) -> Any:
    """Six contacts of which some press or pull, and some slide at the start of the step."""
    joints, _ = scattered(1)
    random = np.random.default_rng(3)
    d = random.normal(size=(6, 3))
    d = d / np.linalg.norm(d, axis=1, keepdims=True) * np.array(slides)[:, None]
    p = joints.normal * np.array(presses)[:, None]
    v, w = random.normal(size=(2, 4, 3))
    return SimpleNamespace(joints=joints, p=p, friction=SimpleNamespace(d=d), v=v, w=w,
                           key=np.arange(6))  # fmt: skip


def slips(trial: Any) -> Any:
    """The relative velocities (6, 3) at the contacts."""
    both = np.concatenate([trial.v.ravel(), trial.w.ravel()])
    return np.array([jacobian(trial.joints, c) @ both for c in range(6)])


def test_the_slowest_slip_is_that_of_contacts_that_press_and_slide() -> None:
    presses, slides = [2.0, 2.0, -2.0, 2.0, 0.0, 2.0], [1, 1, 1, 0, 1, 1]
    trial = a_trial(presses, slides)
    along = (slips(trial) * trial.friction.d).sum(1)
    count = np.array([True, True, False, False, False, True])
    assert slowest_slip(trial, trial.v, trial.w) == pytest.approx(along[count].min())
    others = a_trial(np.where(count, 0.0, 2.0), slides)
    assert slowest_slip(others, trial.v, trial.w) == pytest.approx(along[[2, 4]].min())
    assert slowest_slip(a_trial([0.0] * 6, slides), trial.v, trial.w) == np.inf


@pytest.mark.parametrize("c", [0, 2, 4])
def test_a_slip_is_none_after_a_trial_if_it_presses_and_is_slow_along_its_surface(c: int) -> None:
    trial = a_trial([2.0, -2.0] * 3, [1] * 6)
    n = trial.joints.normal
    u = slips(trial)
    speeds = np.linalg.norm(u - (u * n).sum(1, keepdims=True) * n, axis=1)
    for part in (0.98, 1.02):
        past = past_after(trial, SPAN, part * speeds[c])
        due = (speeds <= part * speeds[c]) & (np.arange(6) % 2 == 0)
        assert past.still.tolist() == due.tolist()
        assert past.still[c] == (part > 1.0)
        assert past.force == pytest.approx(trial.p / SPAN)
        assert past.key is trial.key
        assert past.joints is trial.joints


@pytest.mark.parametrize(("part", "may"), [(0.98, False), (1.02, True)])
def test_what_sticks_may_slip_where_something_moves_and_friction_is_used(
    part: float, may: bool
) -> None:
    """One contact presses by 3 N s and rubs in proportion to the grip; one pulls and rubs more."""
    setting: Any = SimpleNamespace(
        drives=SimpleNamespace(omega=np.ones(1)), shaking=SimpleNamespace(omega=np.ones(0)), mu=MU
    )
    trial = a_trial([0.0, 3.0, -3.0, 0.0, 0.0, 0.0], [0] * 6)
    for c, size in ((1, part), (2, 9.0)):
        side = np.cross(trial.joints.normal[c], [0.3, -0.5, 0.8])
        trial.p[c] += size * GRIP * MU * 3.0 * side / np.linalg.norm(side)
    assert may_slip(setting, trial) is may
    setting.drives, setting.shaking = setting.shaking, setting.drives
    assert may_slip(setting, trial) is may
    trial.friction.d[1] = trial.joints.normal[0]
    assert not may_slip(setting, trial)
    setting.shaking = setting.drives
    trial.friction.d[1] = 0.0
    assert not may_slip(setting, trial)


def test_locks_bear_what_acts_in_their_directions() -> None:
    """Forces and impulses of contacts, weights and loads, with the sign of a reaction."""
    made = scene()
    system, random, times = Space(made), np.random.default_rng(4), np.array([0.0, 0.5, 2.0])
    reaction = random.normal(size=(3, 5, 6))
    for k, block in enumerate(made.blocks):
        locked = np.eye(3) - hold(FREE, k)
        steady = LOAD[k] + block.mass * GRAVITY
        forces, impulses = system.locked(reaction, k, times)
        assert forces == pytest.approx(-(reaction[:, k, :3] + steady) @ locked)
        due = reaction[:, k, 3:] + times[:, None] * steady
        assert impulses == pytest.approx(-due @ locked)
    assert np.abs(system.locked(reaction, 1, times)[1]).max() > 1.0
