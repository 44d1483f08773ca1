"""Functions that read the motion of a body from a run so that a drawing can show it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from vv.ask import Observable, Run
from vv.scene import Vector


@dataclass(frozen=True, eq=False)
class ComponentAlong:
    """The component of an observable along a direction (3,), over time (k,)."""

    observable: Observable
    direction: Vector

    def __call__(self, run: Run) -> Vector:
        """(k,), in the unit of the observable; raises KeyError if the run has it not."""
        return np.asarray(run.values[self.observable] @ self.direction)


@dataclass(frozen=True, eq=False)
class RotationAbout:
    """The angle (k,) by which a body rotates about an axis (3,), in units of `unit` [rad]."""

    body: int
    axis: Vector
    unit: float
    read: Callable[[Run], Vector]

    def __call__(self, run: Run) -> Vector:
        """(k,) [unit]."""
        return self.read(run)
