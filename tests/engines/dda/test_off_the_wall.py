"""Claims about a block without rotations far above its wall: it falls as if there were no wall."""

from pathlib import Path

import numpy as np
import pytest

from adapters.dda import ADAPTER
from tests.scenes.blocks.block_scenes import DOWN, FLOOR, HELD, G, box
from vv.ask import Ask, Displacement, History, Knobs
from vv.scene import Contact, Scene


@pytest.mark.parametrize("walls", [(), (FLOOR,)], ids=["no wall", "a wall 0.1 m below"])
@pytest.mark.parametrize("speed", [0.0, 3.0])
def test_a_block_off_its_wall_falls(walls: tuple[object, ...], speed: float) -> None:
    up = np.array([0.0, 0.0, speed])
    block = box("one", [0.0, 0.0, 0.6], [0.5] * 3, free_spin=HELD, velocity=up)
    scene = Scene((*walls, block), Contact(np.inf), gravity=DOWN)  # type: ignore[arg-type]
    seen = Displacement(len(walls))
    ask = Ask(scene, History(0.12, 0.03), (seen,), Knobs(1e-3, 1e9))
    (run,) = ADAPTER.run([ask], "default", Path(), 0.0)
    way = speed * run.times - G * run.times**2 / 2
    assert run.values[seen][:, 2] == pytest.approx(way, abs=1e-9)
