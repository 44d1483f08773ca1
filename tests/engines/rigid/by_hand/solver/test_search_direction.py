"""Claims about when conjugate directions of sweeps are followed, and when they begin anew."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vv.engines.rigid.solver import cone
from vv.engines.rigid.solver.problem import Problem
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")


def test_a_direction_is_followed_by_the_ratio_of_changes_unless_they_grow(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The first change has no direction before it; one as large as the last still goes on."""
    changes = [4.0, 1.0, 1.0, 1.05, 0.21, 0.42]  # of squared impulses by sweeps
    left, told = iter([*changes, 1.0]), list[Any]()

    def follow(direction: Vector, before: Vector, now: Vector, share: float, on: bool) -> None:
        told.append((share, bool(on)))

    monkeypatch.setattr(cone, "sweep", lambda *_: None)
    monkeypatch.setattr(cone, "residual", lambda *_: 1.0)
    monkeypatch.setattr(cone, "change_of", lambda *_: (next(left), 1.0))
    monkeypatch.setattr(cone, "follow_direction", follow)
    nothing: Any = None
    p, v, w = np.zeros((3, 2, 3))
    cone.solve_contacts(Problem(nothing, nothing, nothing, p, v, w), 1e-6, 0, len(changes) + 1)
    shares = [0.0, 0.25, 1.0, 1.05, 0.2, 2.0]
    assert told == [(pytest.approx(one), one <= 1.0) for one in shares for _ in "pvw"]


@pytest.mark.parametrize(("left", "due"), [([1.0, 2e-6, 2e-6, 0.5e-6], 3), ([1.0, *[2e-6] * 9], 7)])
def test_sweeps_that_change_little_go_on_while_the_residual_is_large(
    monkeypatch: pytest.MonkeyPatch, left: list[float], due: int
) -> None:
    residuals = iter(left)
    monkeypatch.setattr(cone, "sweep", lambda *_: None)
    monkeypatch.setattr(cone, "residual", lambda *_: next(residuals))
    monkeypatch.setattr(cone, "change_of", lambda *_: (1.0, 0.5e-6))
    nothing: Any = None
    p, v, w = np.zeros((3, 2, 3))
    found = cone.solve_contacts(Problem(nothing, nothing, nothing, p, v, w), 1e-6, 0, 7)
    assert found == (due, left[due])
