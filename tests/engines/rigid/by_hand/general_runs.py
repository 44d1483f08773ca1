"""Runs of the general model of `rigid` in Python, with their energies checked."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vv.engines.rigid.general.kernel import move_rigid
from vv.engines.rigid.general.model import Space
from vv.scene import Scene

KINETIC, RUBBED, HIT, BASE, SHAKEN, DRIVEN, SHOVED, TURNED = range(8)
SIGNS = np.array([1.0, 1.0, 1.0, -1.0, -1.0, -1.0, 1.0, 1.0])


class Moved:
    """The rows of a run: of each block displacement x, velocity v and spin w, and its energies.

    In a plane scene, and where nothing turns, the energies balance to rounding and residuals.
    """

    def __init__(self, scene: Scene, steps: int, dt: float, stride: int = 1) -> None:
        self.system = Space(scene)
        blocks = tuple(range(len(scene.blocks)))
        path, self.energy, report, self.acted, watched = self.system.outputs(
            steps // stride + 1, blocks
        )
        given = self.system.arguments(dt)
        self.rows = move_rigid(path, self.energy, report, self.acted, watched, stride, dt, *given)
        self.x, self.v, self.w = path[..., :3], path[..., 3:6], path[..., 6:]
        self.force = self.acted[..., :3]
        self.residual, self.sweeps, self.deep, self.cuts = report.T
        self.t = dt * stride * np.arange(len(path))
        balance = self.energy @ SIGNS
        if self.system.closes:
            size = np.abs(self.energy).max()
            assert balance == pytest.approx(np.full(self.rows, balance[0]), abs=1e-9 * size)


def rising(*rows: Any) -> Any:
    """Columns that change in time as one array."""
    return np.transpose(np.broadcast_arrays(*rows))
