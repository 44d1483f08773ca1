"""Exact histories are evaluated once for the times of a run, whichever quantity asks for them."""

from __future__ import annotations

import numpy as np
import pytest

from vv.ask import Displacement
from vv.case import Exact, Motion, remembered
from vv.case.remembered import LATEST
from vv.scene import Vector

TIMES = np.linspace(0.0, 1.0, 5)


class Path:
    """A motion in a plane that counts how often it is asked for."""

    def __init__(self) -> None:
        self.asked = 0

    def __call__(self, t: Vector) -> Vector:
        self.asked += 1
        return np.stack([t, t**2], axis=1)


def test_all_components_of_a_motion_share_one_evaluation() -> None:
    path = Path()
    motion = Motion(Displacement(0), np.eye(3)[:2], path, TIMES, "m")
    parts = [motion.component(i, name, name, Exact({})).reference for i, name in enumerate("xy")]
    for _ in range(3):
        found = [list(one(TIMES)) for one in parts if one is not None]
        assert found == [list(TIMES), list(TIMES**2)]
        assert motion.size == pytest.approx(np.sqrt(2.0))
    assert path.asked == 1


def test_other_times_are_evaluated_for_themselves_and_old_ones_forgotten() -> None:
    path = Path()
    history = remembered(path)
    for count in range(LATEST + 1):
        assert np.array_equal(history(TIMES + count)[:, 0], TIMES + count)
    assert path.asked == LATEST + 1
    history(TIMES + LATEST)
    assert path.asked == LATEST + 1
    history(TIMES)
    assert path.asked == LATEST + 2


@pytest.mark.parametrize("as_pair", [False, True])
def test_what_is_handed_out_again_cannot_be_changed(as_pair: bool) -> None:
    made = remembered(lambda t: (2 * t, 3 * t) if as_pair else 2 * t)(TIMES)
    for part in made if isinstance(made, tuple) else (made,):
        with pytest.raises(ValueError, match="read-only"):
            part[0] = 1.0
