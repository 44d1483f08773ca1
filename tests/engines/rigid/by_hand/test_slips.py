"""Claims about kernels of `rigid` that tell slip from none, with truths by hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest

from tests.engines.rigid.test_momentum import pile
from tests.scenes.blocks.block_scenes import HELD, incline
from vv.engines.rigid.general import events
from vv.engines.rigid.general.events import may_slip, mean_forces, past_after, slowest_slip
from vv.engines.rigid.limits import BEGINS, CLOSE, GLIMPSE, GRIP, VEERED
from vv.engines.rigid.point.model import point
from vv.engines.rigid.point.trial import Ground, slip_turns
from vv.engines.rigid.solver.assembly import Joints
from vv.scene import Vector

MU, PUSH = 0.5, 10.0  # N s
RIGHT = (1.0, 0.0, 0.0)


class Sines(NamedTuple):
    """Of prescribed motions only how many there are."""

    omega: Vector


class Moved(NamedTuple):
    """Of a scene only friction and what moves."""

    mu: float
    drives: Sines
    shaking: Sines


class Sliding(NamedTuple):
    """Of friction only the directions of slip at the start."""

    d: Vector


class Tried(NamedTuple):
    """Of a trial only its impulses and velocities."""

    key: Any
    joints: Joints
    friction: Sliding
    p: Vector
    v: Vector
    w: Vector


def tried(rub: float, push: float = PUSH) -> Tried:
    """A cube on a floor, pressed at one of its four contacts, where friction acts to the right."""
    joints, *_ = pile(1, MU)
    p = np.zeros((4, 3))
    p[2] = rub, 0.0, push
    none = np.zeros((4, 3))
    return Tried(np.zeros((4, 4), int), joints, Sliding(none), p, none[:2].copy(), none[:2].copy())


def _may(setting: Any, trial: Any) -> bool:
    return may_slip(setting, trial)


may: Any = numba.njit(_may)


@pytest.mark.parametrize(("base", "shaken"), [(0, 1), (2, 0), (1, 1)])
@pytest.mark.parametrize("rub", [0.98, 1.02, -0.98, -1.02])
def test_what_sticks_may_slip_beyond_a_part_of_the_limit_where_something_moves(
    rub: float, base: int, shaken: int
) -> None:
    setting = Moved(MU, Sines(np.ones(base)), Sines(np.ones(shaken)))
    assert may(setting, tried(rub * GRIP * MU * PUSH)) is (abs(rub) > 1.0)
    still = Moved(MU, Sines(np.ones(0)), Sines(np.ones(0)))
    assert not may(still, tried(rub * GRIP * MU * PUSH))


def test_what_slips_or_is_open_cannot_begin_to_slip() -> None:
    setting = Moved(MU, Sines(np.ones(1)), Sines(np.ones(0)))
    slips = tried(MU * PUSH)
    slips.friction.d[2] = RIGHT
    assert not may(setting, slips)
    assert not may(setting, tried(1.0, push=-1e-9))


def _slowest(trial: Any, v: Vector, w: Vector) -> float:
    return slowest_slip(trial, v, w)


def test_the_slowest_slip_is_that_of_contacts_which_slip_and_press() -> None:
    trial = tried(0.0)
    trial.p[:3, 2] = PUSH
    trial.friction.d[1:] = [RIGHT, (0.6, 0.8, 0.0), (-1.0, 0.0, 0.0)]
    v, w = np.array([[3.0, 4.0, 0.0], [1.0, 0.0, 0.0]]), np.zeros((2, 3))
    kernel: Any = numba.njit(_slowest)
    assert kernel(trial, v, w) == pytest.approx(2.0)
    w[0] = 0.0, 0.0, 1.0
    arms = trial.joints.arm_second
    turned = [float(np.dot(d, [2.0 - arm[1], 4.0 + arm[0], 0.0]))
              for d, arm in zip(trial.friction.d[1:3], arms[1:3], strict=True)]  # fmt: skip
    assert kernel(trial, v, w) == pytest.approx(min(turned))


def _forces(p: Vector) -> Vector:
    return mean_forces(p, 0.25)


def _after(trial: Any, least: float) -> tuple[Vector, Any]:
    past = past_after(trial, 0.25, least)
    return past.force, past.still


def test_after_a_trial_contacts_are_still_that_press_and_do_not_slip() -> None:
    """Of four, the third alone presses; a velocity along the normal is no slip."""
    trial, least = tried(2.0), 1e-3
    after: Any = numba.njit(_after)
    trial.v[0] = 0.6e-3, -0.8e-3, 7.0
    for times, still in ((1.02, True), (0.98, False)):
        force, found = after(trial, times * least)
        assert found.tolist() == [False, False, still, False]
        assert force == pytest.approx(4.0 * trial.p)
    kernel: Any = numba.njit(_forces)
    assert kernel(trial.p) == pytest.approx(4.0 * trial.p)


@pytest.mark.parametrize(
    ("starts", "lasts"),
    [(0.3, None), (0.71, None), (0.99, None), (0.0, 1.0), (1.05, 1.0), (0.5 * CLOSE, 1.0)],
)
@pytest.mark.parametrize("dt", [1e-4, 1e-2])
def test_a_slip_begins_within_a_part_of_a_step_of_where_it_is_said_to(
    monkeypatch: pytest.MonkeyPatch, dt: float, starts: float, lasts: float | None
) -> None:
    """A short trial sees it at once, a long one a tenth of a step later; time is the state here.

    A step in which slip begins at once, or not at all, is taken whole.
    """

    def attempt(setting: Any, state: list[float], now: float, span: float, *_: Any) -> Any:
        assert state[0] == pytest.approx(now / dt)
        brief = span == pytest.approx(GLIMPSE * dt)
        late = now / dt >= starts if brief else (now + span) / dt > starts + 0.1
        return SimpleNamespace(begun=late, gaps=SimpleNamespace(slack=0.0))

    replaced = {
        "attempt": attempt,
        "marked": bool,
        "copy_of": list,
        "move": lambda setting, state, trial, span: state.__setitem__(0, state[0] + span / dt),
        "past_after": lambda *_: None,
    }
    for name, one in replaced.items():
        monkeypatch.setattr(events, name, one)
    setting = SimpleNamespace(pull=0.0, braking=0.0, tolerance=0.0, slack=0.0)
    search: Any = events.time_to_slip_start
    found = search.py_func(setting, [0.0], None, 0.0, dt, dt, None, attempt(0, [0.0], 0.0, dt)) / dt
    if lasts is None:
        assert 0.0 <= starts - found <= 0.5**BEGINS
    else:
        assert found == lasts


def _turns(ground: Ground, angle: float) -> bool:
    after = (2.0 * np.cos(angle), 2.0 * np.sin(angle), 0.0)
    return slip_turns(ground, 0.0, 1e-3, (3.0, 0.0, 0.0), after)


@pytest.mark.parametrize(
    ("angle", "turns"),
    [
        (0.98 * np.arcsin(VEERED**0.5), False),
        (1.02 * np.arcsin(VEERED**0.5), True),
        (np.pi, False),
        (np.pi - 1e-3, True),
    ],
)
def test_slip_turns_by_more_than_an_angle_unless_it_reverses_along_its_line(
    angle: float, turns: bool
) -> None:
    model = point(incline(20, 30, free_spin=HELD))
    assert model is not None
    kernel: Any = numba.njit(_turns)
    assert kernel(model.arguments(1e-3)[1], angle) is turns
