"""Claims about momentum of sweeps: when it rises, is lost, and when the residual is looked at."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vv.engines.rigid.solver import momentum
from vv.engines.rigid.solver.momentum import (
    CAP,
    GREW,
    LEAST,
    LOWERED,
    MOST,
    RAISED,
    WINDOW,
    extrapolate,
    joined,
    momentum_sweeps,
    separated,
)
from vv.engines.rigid.solver.problem import Problem

pytestmark = pytest.mark.usefixtures("in_python")


def test_rows_are_joined_parted_and_extrapolated() -> None:
    v, w = np.random.default_rng(6).normal(size=(2, 5, 3))
    both = joined(v, w)
    assert both.tolist() == np.hstack([v, w]).tolist()
    out_v, out_w = np.empty((2, 5, 3))
    separated(both, out_v, out_w)
    assert (out_v.tolist(), out_w.tolist()) == (v.tolist(), w.tolist())
    now, last = v.copy(), w.copy()
    extrapolate(now, last, 0.25)
    assert now == pytest.approx(v + 0.25 * (v - w))
    assert last.tolist() == v.tolist()


class Scripted:
    """Sweeps whose changes are told in advance, and the shares by which they are extrapolated."""

    def __init__(self, patch: pytest.MonkeyPatch, size: Any, left: Any = lambda k: 1.0) -> None:
        self.shares: list[float] = []
        self.looks: list[int] = []
        self.sweeps, self._size, self._left = 0, size, left
        for name in ("packed", "unpacked", "separated"):
            patch.setattr(momentum, name, lambda *_: (None, (), None))
        patch.setattr(momentum, "pairs_room", lambda n: [None])
        patch.setattr(momentum, "joined", lambda v, w: None)
        patch.setattr(momentum, "residual", self._residual)
        patch.setattr(momentum, "sweep_batches", self._sweep)
        patch.setattr(momentum, "extrapolate", lambda now, last, share: self.shares.append(share))

    def _sweep(self, *_: Any) -> tuple[float, float]:
        self.sweeps += 1
        return self._size(self.sweeps), self._left(self.sweeps)

    def _residual(self, *_: Any) -> float:
        self.looks.append(self.sweeps)
        return float(self._left(self.sweeps))

    def run(self, tolerance: float, fewest: int, most: int) -> tuple[int, float]:
        """Iterate."""
        nothing: Any = [None] * 6
        return momentum_sweeps(Problem(*nothing), tolerance, fewest, most)


def nesterov(count: int, caps: Any) -> list[float]:
    """The shares of so many sweeps, with a cap for each window of sweeps."""
    pace, shares = 1.0, []
    for k in range(count):
        faster = 0.5 * (1.0 + np.sqrt(1.0 + 4.0 * pace**2))
        shares.append(min(caps[k // WINDOW], (pace - 1.0) / faster))
        pace = faster
    return shares


def test_momentum_rises_and_its_cap_with_it_while_changes_hardly_decrease(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It is raised after each window from the second on, up to MOST."""
    told, windows = Scripted(monkeypatch, lambda k: 1.0), 30
    caps = [CAP, CAP]
    for _ in range(windows):
        caps.append(min(MOST, 1.0 - RAISED * (1.0 - caps[-1])))
    assert told.run(1e-3, 0, windows * WINDOW) == (windows * WINDOW, 1.0)
    assert told.shares == pytest.approx(nesterov(windows * WINDOW - 1, caps))
    assert told.shares[-1] == MOST


def test_the_cap_stays_while_changes_decrease_fast(monkeypatch: pytest.MonkeyPatch) -> None:
    told = Scripted(monkeypatch, lambda k: 0.9**k)
    told.run(1e-3, 0, 10 * WINDOW)
    assert told.shares[-1] == CAP


def test_momentum_is_lost_and_its_cap_lowered_where_changes_grow(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Sums of windows are W, then 0.99 GREW W, then 1.01 GREW W, and then small again."""
    sizes = [1.0, 0.99 * GREW, 1.01 * GREW, 1e-3, 1e-6, 1e-9, 1e-12]
    told = Scripted(monkeypatch, lambda k: sizes[(k - 1) // WINDOW])
    told.run(1e-3, 0, 7 * WINDOW)
    third = 3 * WINDOW - 1
    assert told.shares[third] == 0.0
    assert told.shares[third + 1] == 0.0
    assert min(told.shares[2:third]) > 0.0
    raised = 1.0 - RAISED * (1.0 - CAP)
    lowered = max(LEAST, 1.0 - LOWERED * (1.0 - raised))
    assert told.shares[third + WINDOW - 1] <= lowered
    assert told.shares[-1] == pytest.approx(min(lowered, nesterov(4 * WINDOW - 1, [1.0] * 5)[-1]))


def test_the_residual_is_looked_at_when_changes_are_small_and_seldom(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Changes are twice the tolerance from sweep 7 on; the residual is met at sweep 16."""
    told = Scripted(
        monkeypatch, lambda k: 1.0, lambda k: 1e-3 if k >= 16 else 2e-3 if k > 6 else 1.0
    )
    assert told.run(1e-3, 0, 99) == (19, 1e-3)
    assert told.looks == [0, 7, 11, 15, 19]
    told = Scripted(monkeypatch, lambda k: 1.0, lambda k: 1e-3 if k else 1.0)
    assert told.run(1e-3, 10, 99) == (10, 1e-3)
    assert told.looks == [0, 10]
    told = Scripted(monkeypatch, lambda k: 1.0, lambda k: 0.0)
    assert told.run(1e-3, 10, 99) == (0, 0.0)
