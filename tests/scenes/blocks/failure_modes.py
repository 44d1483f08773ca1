"""How a block on an incline moves first: the published chart, and what `rigid` does in one step.

Yagoda-Biran and Hatzor (2016), after Hoek and Bray and with their corrected border between
toppling and toppling with slip: slope alpha, friction angle phi, and tan delta = breadth/height.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from tests.scenes.blocks.block_scenes import ACROSS, IN_PLANE, incline, slope
from vv.ask import Ask, Displacement, History, Knobs, Velocity
from vv.engines import rigid
from vv.scene import Vector

MODES = {
    (False, False): "stable",
    (True, False): "slides",
    (False, True): "topples",
    (True, True): "slides and topples",
}
STEP = 1e-3  # s
STARTS = 1e-6  # m/s and rad/s: a velocity after the first step below which nothing moves
NEAR = 1e-3  # rad: closer to a border the first step need not tell the sides apart
LEAST, MOST = [2.0, 2.0, 5.0], [65.0, 65.0, 65.0]  # degrees: alpha, phi, delta


def charted(alpha: float, phi: float, delta: float) -> tuple[str, float]:
    """The mode by the chart, and the distance to its nearest border [rad]; angles in degrees.

    A block topples if alpha > delta unless it slides away first, which it does for phi <= delta;
    it slides too for phi < phi_c, with tan(phi_c - delta) = tan(alpha - delta)/4.
    """
    a, f, d = np.radians([alpha, phi, delta])
    if a <= d:
        return MODES[bool(f < a), False], float(min(d - a, abs(f - a)))
    critical = d + np.arctan(np.tan(a - d) / 4)
    near = min(a - d, abs(f - d), abs(f - critical))
    return MODES[bool(f < critical), bool(f > d)], float(near)


def points(count: int, seed: int) -> Iterator[tuple[float, float, float]]:
    """So many random (alpha, phi, delta) [degrees], none of them near a border."""
    random, found = np.random.default_rng(seed), 0
    while found < count:
        alpha, phi, delta = random.uniform(LEAST, MOST).tolist()
        if charted(alpha, phi, delta)[1] > NEAR:
            found += 1
            yield alpha, phi, delta


def seen(alpha: float, phi: float, delta: float, plane: bool) -> str:
    """The mode read from the block's velocities after one step; plane: it moves in the plane."""
    half = np.array([np.tan(np.radians(delta)), 0.8, 1.0]) * 0.5
    masks: dict[str, Any] = {"free": IN_PLANE, "free_spin": ACROSS} if plane else {}
    scene = incline(alpha, phi, half=half, **masks)
    ask = Ask(scene, History(STEP, STEP), (Displacement(1), Velocity(1)), Knobs(STEP))
    program = rigid.prepare(ask)
    program.solve()
    velocity, spin = np.split(np.asarray(program.arguments[0][-1, 1, 3:]), 2)
    axes = slope(alpha)[0]
    toe: Vector = half[0] * axes[0] - half[2] * axes[2]
    slip = float(axes[0] @ (velocity + np.cross(spin, toe)))
    return MODES[slip > STARTS, float(axes[1] @ spin) > STARTS]
