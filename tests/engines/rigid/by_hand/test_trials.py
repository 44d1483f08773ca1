"""Claims about a trial step: which contacts it has, and where their slip begins or ends."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.engines.rigid.by_hand.solver.test_joints import jacobian, scattered
from tests.engines.rigid.by_hand.solver.test_sweeps import rubbing
from tests.scenes.blocks.block_scenes import FLOOR, box
from vv.engines.blocks.contacts import empty_contacts
from vv.engines.rigid.general import step
from vv.engines.rigid.general.model import Space
from vv.engines.rigid.general.setting import State
from vv.engines.rigid.limits import NEARLY
from vv.engines.rigid.slip import least_slip_speed
from vv.engines.rigid.solver.problem import Problem
from vv.scene import Contact, Scene

pytestmark = pytest.mark.usefixtures("in_python")
SPAN = 0.01  # s


@pytest.mark.parametrize(("part", "found"), [(0.98, 4), (1.02, 0)])
@pytest.mark.parametrize("speed", [0.0, 0.3])
@pytest.mark.parametrize("size", [1.0, 1e-3])
def test_a_trial_has_the_contacts_that_twice_its_motion_could_close(
    size: float, speed: float, part: float, found: int
) -> None:
    """And those within a millionth of the extent of the smallest block, at the end of the step."""
    falls = speed * size
    gap = SPAN * falls + part * (2.0 * SPAN * falls + 1e-6 * 0.6 * size)
    half = np.array([0.1, 0.2, 0.3]) * size
    small = box("small", [0, 0, half[2] + gap], half, velocity=[0.0, 0.0, -falls])
    large = box("large", [9.0 * size, 0, 9.0 * size], 7.0 * half)
    made = Scene((FLOOR, large, small), Contact(np.inf, mu=0.3))
    setting, centre, v, w = Space(made).arguments(SPAN)
    state = State(centre, 0.0 * centre, np.array([np.eye(3)] * 2), v, w)
    contacts = empty_contacts(64)
    past = step.no_past(contacts, setting)
    trial = step.attempt(setting, state, 0.0, SPAN, contacts, past, setting.slack)
    assert len(trial.p) == found


def judged(
    patch: pytest.MonkeyPatch,
    pull: float,
    tolerance: float,
    sliding: Any,
    looked: list[int],
    asked: float = 1e-9,
    left: float = 0.5e-9,
    **gaps: Any,
) -> step.Trial:
    """A trial with given velocities at six contacts, of which those of even number press.

    looked: an entry for each time that the direction of friction is followed; asked, left: the
    residual that the trial is to reach, and that which it does.
    """
    for name in ("apply_nonzero", "act_at_midstep"):
        patch.setattr(step, name, lambda *_: 0.0)
    patch.setattr(step, "converged", lambda *_: (3, left))
    patch.setattr(step, "set_turns", lambda *_: looked.append(1))
    joints, bodies = scattered(1)
    p = joints.normal * np.where(np.arange(6) % 2 == 0, 2.0, -2.0)[:, None]
    v, w = np.random.default_rng(2).normal(size=(2, 4, 3))
    known = {"gap": np.zeros(6), "slack": 0.0, "opens": np.zeros(6), "known": np.ones(6, bool)}
    setting: Any = SimpleNamespace(
        slack=1e-9,
        pull=pull,
        braking=0.0,
        tolerance=tolerance,
        fewest=0,
        bends=2,
        mass=np.ones(3),
    )
    friction = rubbing(3, slides=False)._replace(d=sliding)
    nothing: Any = None
    return step.solved(
        setting, 0.0, SPAN, Problem(joints, bodies, friction, p, v, w), joints, np.zeros((6, 3)),
        nothing, step.Gaps(**{**known, **gaps}), v, w, asked,
    )  # fmt: skip


def motions() -> tuple[Any, Any]:
    """The relative velocities (6, 3) at the contacts, and their parts along the surfaces."""
    joints, _ = scattered(1)
    both = np.random.default_rng(2).normal(size=(2, 4, 3)).ravel()
    u = np.array([jacobian(joints, c) @ both for c in range(6)])
    return u, u - (u * joints.normal).sum(1, keepdims=True) * joints.normal


@pytest.mark.parametrize("c", [0, 2, 4])
def test_a_slip_begins_where_a_pressed_contact_moves_along_its_surface(
    monkeypatch: pytest.MonkeyPatch, c: int
) -> None:
    """Whatever moves along the normal: it is faster than a part of the velocity gained."""
    slips = np.linalg.norm(motions()[1], axis=1)
    none, looked = np.zeros((6, 3)), list[int]()
    for part in (0.98, 1.02):
        pull = part * slips[c] / (NEARLY * SPAN)
        found = judged(monkeypatch, pull, 0.0, none, looked)
        due = (slips > part * slips[c]) & (np.arange(6) % 2 == 0)
        assert found.begun.tolist() == due.tolist()
        assert found.begun[c] == (part < 1.0)
        assert not found.ended.any()
        residual = judged(monkeypatch, 0.0, 0.1 * part * slips[c], none, looked)
        assert residual.begun.tolist() == due.tolist()
    fresh = np.arange(6) == c
    assert len(looked) == 4  # once each: nothing turns
    far = judged(monkeypatch, 0.0, 0.0, none, looked, known=~fresh, gap=np.zeros(6))
    assert far.begun.tolist() == [k % 2 == 0 and k != c for k in range(6)]


@pytest.mark.parametrize("c", [0, 2, 4])
def test_a_slip_ends_where_a_pressed_contact_is_slow_along_its_direction(
    monkeypatch: pytest.MonkeyPatch, c: int
) -> None:
    u, along = motions()
    d = along / np.linalg.norm(along, axis=1, keepdims=True)
    d[1::4] *= -1.0
    speeds, looked, goes_on = (u * d).sum(1), list[int](), 0
    for part in (0.98, 1.02):
        limit = part * speeds[c]
        found = judged(monkeypatch, 0.0, 9.0, d, looked, asked=0.1 * limit)
        unmet = judged(monkeypatch, 0.0, 9.0, d, [], left=0.1 * limit)
        due = (speeds <= limit) & (np.arange(6) % 2 == 0)
        assert found.ended.tolist() == unmet.ended.tolist() == due.tolist()
        assert found.ended[c] == (part > 1.0)
        goes_on += not due.any()
        assert not found.begun.any()
    assert len(looked) == goes_on  # where slip ends, the step is divided first
    assert least_slip_speed(SPAN, 0.0, 0.1) == 1.0
    open_now, fresh = np.full(6, 2e-9), np.zeros(6, bool)
    assert not judged(monkeypatch, 0.0, 9.0, d, looked, 9.0, gap=open_now, known=fresh).ended.any()
    closed = judged(monkeypatch, 0.0, 9.0, d, looked, 9.0, gap=0.4 * open_now, known=fresh)
    assert closed.ended.tolist() == (np.arange(6) % 2 == 0).tolist()
