"""Claims about the gap of a block that moves as a point: a small part of its size is none."""

from __future__ import annotations

import pytest

from tests.scenes.blocks.block_scenes import FLOOR, HELD, box
from vv.engines.rigid.point.model import point
from vv.scene import Contact, Scene


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(("part", "counts"), [(0.9, 0.0), (-0.9, 0.0), (1.1, 1.1), (-1.1, -1.1)])
def test_a_gap_of_a_part_of_the_size_is_none_whatever_the_size(
    size: float, part: float, counts: float
) -> None:
    half = [0.5 * size, 0.1 * size, 0.2 * size]
    centre = [0.0, 0.0, half[2] + part * 1e-11 * size]
    model = point(Scene((FLOOR, box("b", centre, half, free_spin=HELD)), Contact(1.0, mu=0.3)))
    assert model is not None
    ground = model.arguments(1e-3)[1]
    assert ground.gap == pytest.approx(counts * 1e-11 * size, rel=1e-3)
