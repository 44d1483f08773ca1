"""Claims about the contacts that are looked for, whatever the size of blocks."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import FLOOR, FREE, HELD, IN_PLANE, box
from vv.engines.dda.formulation import Formulation
from vv.engines.dda.general.model import General
from vv.engines.dda.limits import FLOAT
from vv.engines.dda.point.model import LEVEL, SAME, sliding
from vv.engines.dda.springs import Springs
from vv.engines.dda.stepping import Steps
from vv.scene import Contact, Scene

ANY = Formulation(1e-9, 10, 1)
HALF = np.array([0.4, 0.5, 0.3])  # times the size


def points(size: float, axes: Any, free: Any) -> int:
    """How many corners of a box of this size [m] touch the floor, of which some do."""
    block = box("b", [0.0, 0.0, 0.3 * size], size * HALF, axes, free=free, free_spin=HELD)
    model = sliding(Scene((FLOOR, block), Contact(np.inf)), ANY)
    assert model is not None
    return model.points


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(("part", "touch"), [(0.0, 4), (0.9, 4), (1.1, 2)])
def test_corners_touch_that_are_as_low_as_the_lowest_to_a_part_of_the_size(
    size: float, part: float, touch: int
) -> None:
    tilt = part * LEVEL / 0.8
    assert points(size, [[1.0, 0.0, tilt], [0.0, 1.0, 0.0], [-tilt, 0.0, 1.0]], FREE) == touch


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(("part", "touch"), [(0.0, 2), (0.9, 2), (1.1, 4)])
def test_corners_behind_one_another_in_a_plane_scene_are_one_to_a_part_of_the_size(
    size: float, part: float, touch: int
) -> None:
    """The sides of a prism are askew to the depth, which is its size."""
    askew = part * SAME
    axes = [[1.0, -askew, 0.0], [askew, 1.0, 0.0], [0.0, 0.0, 1.0]]
    assert points(size, axes, IN_PLANE) == touch


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_contacts_are_looked_for_within_a_hundredth_of_the_smallest_block(size: float) -> None:
    """Of its largest extent, which is 0.8 of the size here."""
    large = box("large", [0.0, 0.0, 0.0], size * HALF)
    small = box("small", [9.0 * size, 0.0, 0.0], [0.1 * size, 0.4 * size, 0.2 * size])
    model = General(Scene((small, large), Contact(1e6)), ANY)
    assert model.setting(1.0, Springs(1e6, None, None)).reach == pytest.approx(8e-3 * size)


@pytest.mark.parametrize(("part", "rests"), [(0.9, True), (1.1, False)])
def test_a_block_rests_as_near_as_what_weight_and_load_together_press_a_spring(
    part: float, rests: bool
) -> None:
    """Half of the weight of 240 kg is borne by the load."""
    gravity, kn = np.array([0.0, 0.0, -10.0]), 1e9
    gap = part * FLOAT * 1200.0 / kn
    centre, half, load = [0.0, 0.0, 0.3 + gap], [0.4, 0.25, 0.3], np.array([0.0, 0.0, 1200.0])
    block = box("b", centre, half, free_spin=HELD, load=load)
    assert block.mass == pytest.approx(240.0)
    model = sliding(Scene((FLOOR, block), Contact(np.inf), gravity=gravity), ANY)
    assert model is not None
    told = model.arguments(Steps(1, 1e-3, 0), Springs(kn, None, None))
    assert told[3] is rests
