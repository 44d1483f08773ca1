"""Claims about the direction in which springs resist a block least, by hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.engines.dda.test_augmented_lagrangian import wedge
from vv.ask import Knobs
from vv.engines.dda.general.augmented.firmness import least_share
from vv.scene import Vector, rotated

pytestmark = pytest.mark.usefixtures("in_python")
EPS = float(np.finfo(float).eps)


def share(normals: Vector, line: Vector) -> float:
    """Of a block that touches one wall per normal, and moves along these lines."""
    count = len(normals)
    touch: Any = SimpleNamespace(
        key=range(count), normal=normals, second=np.zeros(count, int), wall=np.zeros(count, int)
    )
    bodies: Any = SimpleNamespace(mass=[1.0], start=[0, len(line)], line=line)
    return least_share(touch, bodies)


@pytest.mark.parametrize("xi", [1.0, 1e-3, 1e-6, 1e-7])
def test_two_sides_share_by_their_angle_alone_in_every_frame(xi: float) -> None:
    """Axes of a scene are unit and square to rounding; what is left of a third one is none."""
    scene, chance = wedge(xi, 30.0, 0.5, Knobs(1e-3, 1e9)).scene, np.random.default_rng(3)
    for _ in range(20):
        frame, _ = np.linalg.qr(chance.normal(size=(3, 3)))
        turned = rotated(scene, frame * np.linalg.det(frame))
        sides = np.array([wall.normal for wall in turned.walls])
        for lines in (turned.axes, np.eye(3)):
            ratio = share(sides, lines) / np.sin(xi / 2) ** 2
            assert ratio == pytest.approx(1.0, abs=EPS * (64 + 16 / xi))
