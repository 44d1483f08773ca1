"""Claims about blocks that would slide while gravity settles them before t = 0."""

from __future__ import annotations

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import HELD, incline, slope
from vv.engines.dda.refusals import _slides_before_start
from vv.scene import Harmonic


@pytest.mark.parametrize(("push", "slides"), [(1950.0, False), (1990.0, True), (-8700.0, True)])
def test_a_load_pulls_beside_the_weight(push: float, slides: bool) -> None:
    """Of 1000 kg: 3355 N along a slope of 20 degrees, of which friction at 30 holds 5322 N."""
    axes, _ = slope(20.0)
    shaking = Harmonic(np.array([1.0, 0.0, 0.0]), np.array([2.0, 0.0, 0.0]))
    scene = incline(20.0, 30.0, shaking, free_spin=HELD, load=push * axes[0])
    told = _slides_before_start(scene, 2.0)
    pulls = abs(3355.22 + push)
    assert told is None or f"with {pulls:.2f} N, and friction holds 5322.24 N" in told
    assert (told is not None) == slides
