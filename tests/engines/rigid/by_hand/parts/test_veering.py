"""Claims about slow slip that turns, and about the part of a step in which it does not."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from vv.engines.rigid.general import veering
from vv.engines.rigid.general.veering import time_of_even_slip, veers
from vv.engines.rigid.limits import LOITERS, VEERED
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.problem import Friction

pytestmark = pytest.mark.usefixtures("in_python")
MU, MASS, NORMAL, DT, SLACK = 0.5, 4.0, 3.0, 0.01, 1e-9
PULL = 2 * MU * NORMAL / MASS  # m/s, that friction of both contacts gives the block in a step


def turns(
    first: float, last: float, angle: float, slips: bool = True, presses: bool = True
) -> bool:
    """Whether slip veers that turns by an angle [rad] while its speed goes from first to last.

    Two contacts of a block on a wall at its centre share the load.
    """
    up = np.array([[0.0, 0.0, 1.0]] * 2)
    none, inverse = np.zeros((2, 3)), np.array([np.eye(3) / MASS, np.zeros((3, 3))])
    joints = Joints(np.ones(2, int), np.zeros(2, int), up, none, none, up, np.ones(2), np.ones(2))
    bodies = Bodies(inverse, np.zeros((2, 3, 3)), none)
    friction = Friction(MU, np.zeros(2), np.array([[1.0, 0, 0]] * 2) * slips, none.copy())
    p = np.array([[-0.2, -0.1, NORMAL if presses else -NORMAL]] * 2)
    old = np.array([[first, 0.0, 0.3], [0.0, 0.0, 0.0]])
    new = np.array([[last * np.cos(angle), last * np.sin(angle), -0.2], [0.0, 0.0, 0.0]])
    return veers(joints, bodies, friction, p, old, none, new, none)


@pytest.mark.parametrize(("first", "last"), [(1.0, 9.0), (9.0, 1.0), (1.0, 1.0)])
def test_slip_veers_where_it_turns_and_is_slow_at_either_end(first: float, last: float) -> None:
    slow, angle = LOITERS * PULL, np.arcsin(np.sqrt(VEERED))
    for speed, turn, due in ((0.99, 1.01, True), (1.01, 1.01, False), (0.99, 0.99, False)):
        found = turns(speed * slow * first, speed * slow * last, turn * angle)
        assert found == (due and min(first, last) == 1.0)
    assert turns(0.9 * slow, 0.9 * slow, -0.5)
    assert not turns(0.9 * slow, 0.9 * slow, np.pi)  # it reverses along a line


def test_contacts_that_stick_or_do_not_press_do_not_veer() -> None:
    slow = 0.5 * LOITERS * PULL
    assert turns(slow, slow, 0.5)
    assert not turns(slow, slow, 0.5, slips=False)
    assert not turns(slow, slow, 0.5, presses=False)


@pytest.mark.parametrize(("even", "due"), [(1.0, 1.0), (0.6, 0.5), (0.2, 0.125), (0.0, 0.03125)])
def test_a_step_is_halved_until_slip_keeps_its_direction(
    monkeypatch: pytest.MonkeyPatch, even: float, due: float
) -> None:
    """No part below the least one is halved; trials begin at the state and with the same slack."""
    spans: list[float] = []

    def trial(span: float) -> Any:
        return SimpleNamespace(
            v=np.zeros((3, 3)), w=span, joints=None, bodies=None, friction=None, p=None,
            gaps=SimpleNamespace(slack=SLACK),
        )  # fmt: skip

    def attempt(setting: Any, state: Any, now: float, span: float, *rest: Any) -> Any:
        assert (setting, state, now, *rest) == ("setting", "state", 0.7, "contacts", "past", SLACK)
        spans.append(span)
        return trial(span)

    def rates(setting: Any, state: Any, now: float, v: Any, w: Any) -> None:
        assert (setting, state, now, v.shape, w.shape) == ("setting", "state", 0.7, (3, 3), (3, 3))
        v[:] = 5.0

    def veered(joints: Any, bodies: Any, friction: Any, p: Any, v_old: Any, *rest: Any) -> bool:
        assert (v_old == 5.0).all()
        return bool(rest[-1] > even * DT)

    for name, made in (("attempt", attempt), ("rates", rates), ("veers", veered)):
        monkeypatch.setattr(veering, name, made)
    given: Any = ("setting", "state", "past", 0.7, DT, DT, "contacts", trial(DT))
    assert time_of_even_slip(*given) == pytest.approx(due * DT)
    assert spans == pytest.approx([DT * 0.5**k for k in range(1, 1 + round(np.log2(1 / due)))])
