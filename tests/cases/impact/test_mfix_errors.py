"""Claims about errors of steps in MFiX's tests: separate programs of few lines make them."""

import math

import numpy as np
import pytest

from cases.impact.parts import _mfix_errors
from reference_solutions.impact.dropped import Drop, path
from reference_solutions.impact.sinking import Sinking, motion

UNTIL, G = 0.35, 9.80665  # s, m/s2


def sunk(law: Sinking, dt: float, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Depths and speeds at whole steps, with drag of the mean of speeds half a step apart."""
    place, middle = 0.0, law.v0 + dt / 2 * float(law.rate(law.v0))
    places, speeds = [0.0], [law.v0]
    for _ in range(steps):
        place += dt * middle
        later = middle
        for _ in range(60):
            later = middle + dt * float(law.rate((middle + later) / 2))
        places.append(place)
        speeds.append((middle + later) / 2)
        middle = later
    return np.array(places), np.array(speeds)


@pytest.mark.parametrize(
    ("d", "rho", "viscosity", "v0"),
    [(1e-4, 2e3, 1.8e-5, 0.4), (3e-3, 2e3, 1.8e-5, 0.4), (1e-4, 3e4, 1e-6, 5.0), (2e-3, 2, 1, 1)],
)
def test_a_leapfrog_has_nearly_the_error_that_its_modified_equation_gives(
    d: float, rho: float, viscosity: float, v0: float
) -> None:
    law = Sinking(d, rho, 1.2, viscosity, G, v0)
    unit = min(1 / law.quickest, UNTIL)
    dt = 0.025 * unit
    steps = min(math.floor(UNTIL / dt), 2000)
    seen, exact = sunk(law, dt, steps), motion(dt * np.arange(steps + 1), law)
    bounds = _mfix_errors.lags(law, steps * dt, unit)
    for found, right, most in zip(seen, exact, bounds, strict=True):
        error = np.abs(found - right).max() / np.abs(right).max()
        assert 0.85 * most < error / 0.025**2 < most


def bounced(drop: Drop, height: float, dt: float, steps: int, start: float) -> np.ndarray:
    """Heights at whole steps, with the dashpot of the speed half a step before.

    start: the part of a step by which the first force is late.
    """
    w, at, speed, heights = math.sqrt(drop.kn / drop.m), height, 0.0, [height]
    for step in range(steps):
        push = max(0.0, -w * w * at - 2 * drop.z * w * speed) if at < 0 else 0.0
        speed += dt * (push - drop.g) * (0.5 + start if step == 0 else 1.0)
        at += dt * speed
        heights.append(at)
    return np.array(heights)


@pytest.mark.parametrize("start", [0.0, 0.5])
@pytest.mark.parametrize(
    ("kn", "z", "bounces"), [(3e4, 0.0, 1), (3e4, 0.3, 1), (3e7, 0.03, 5), (3e9, 0.1, 3)]
)
def test_forces_half_a_step_late_stay_within_the_sum_of_their_effects(
    kn: float, z: float, bounces: int, start: float
) -> None:
    m, fall = 10.9, 0.4
    drop, w = Drop(m, kn, z, G), math.sqrt(kn / m)
    pieces, worst = drop.pieces(fall, bounces), 0.0
    bound = _mfix_errors.half_steps(drop, pieces)
    slow = G / (w * math.sqrt(2 * G * fall))
    for phase in np.linspace(1.0, 1.02, 7):  # contacts begin at other fractions of a step
        dt = 2e-3 * phase / w
        steps = math.floor((pieces[-1].since + pieces[-1].speed / G) / dt)
        exact = path(dt * np.arange(steps + 1), fall, bounces, drop)
        error = np.abs(bounced(drop, fall, dt, steps, start) - exact).max()
        second = _mfix_errors.delay(bounces, slow) * (w * dt) ** 2
        worst = max(worst, (error / np.abs(exact - fall).max() - second) / (w * dt))
    assert worst < bound
    assert worst > (0.05 if start or z else -1.0) * bound
