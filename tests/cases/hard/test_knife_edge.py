"""Claims about the case of a prism on a knife edge: the friction that it requires."""

from __future__ import annotations

import numpy as np
import pytest

from cases.hard.knife_edge import CASE
from vv.scene import volume_and_centroid

P = {**CASE.defaults("topples"), "duration": 1e-4, "theta": 0.6}


def needed() -> float:
    """Friction over pressure at release, (1 - h lam^2/g) tan(theta), where it rotates at lam."""
    scene = CASE.declare("topples", {**P, "mu": 10.0}).study.scene
    upper = scene.blocks[1]
    arm = volume_and_centroid(upper.vertices, upper.faces)[1]
    about = float(scene.axes[0] @ upper.inertia @ scene.axes[0])
    share = upper.mass * (arm @ arm) / (about + upper.mass * (arm @ arm))
    return float((1.0 - share) * np.tan(P["theta"]))


def test_edges_slip_with_less_friction_than_the_turn_leaves_to_bear() -> None:
    CASE.declare("topples", {**P, "mu": 1.001 * needed()})
    with pytest.raises(ValueError, match="the edges slip"):
        CASE.declare("topples", {**P, "mu": 0.999 * needed()})
