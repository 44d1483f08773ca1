"""A block on undamped shear springs vibrates while it rests, and slides too far for it."""

from typing import Any

import numba
import numpy as np
import pytest

from reference_solutions.blocks import incline

DIP, FRICTION, GRAVITY, UNTIL = 45.0, 50.0, 9.81, 6.0  # deg, deg, m/s2, s
ALONG, ASIDE = (2.0, 1.0), (1.0, 2.0)  # m/s2, Hz
SHEAR, MASS = 25.0, 2500.0  # ks over kn as in the stand-in of a block, kg


def _slid(
    w: float,
    damping: float,
    dip: float,
    mu: float,
    along: tuple[float, float],
    aside: tuple[float, float],
) -> tuple[float, float]:
    """Where the block is at last: a mass on a spring whose load friction limits, w dt = 0.05."""
    dt, ca, sa = 0.05 / w, np.cos(dip), np.sin(dip)
    x, y, vx, vy, sx, sy = 0.0, 0.0, 0.0, 0.0, GRAVITY * sa / w**2, 0.0
    for step in range(round(UNTIL / dt)):
        t = step * dt
        shaking = along[0] * np.sin(2 * np.pi * along[1] * t)
        limit = mu * (GRAVITY * ca - shaking * sa)
        over = w * w * np.hypot(sx, sy) / limit
        slips = over > 1
        if slips:
            sx, sy = sx / over, sy / over
        drag = 0.0 if slips else damping * w
        vx += dt * (GRAVITY * sa + shaking * ca - w * w * sx - drag * vx)
        vy += dt * (aside[0] * np.sin(2 * np.pi * aside[1] * t) - w * w * sy - drag * vy)
        x, y, sx, sy = x + dt * vx, y + dt * vy, sx + dt * vx, sy + dt * vy
    return x, y


slid: Any = numba.njit(_slid)


def error(kn: float, damping: float) -> float:
    """The error of the last place over the distance of the exact one."""
    angles = np.radians(DIP), np.tan(np.radians(FRICTION))
    place = np.array(slid(np.sqrt(SHEAR * kn / MASS), damping, *angles, ALONG, ASIDE))
    times = np.array([0.0, UNTIL])
    drive = {"ax": ALONG[0], "fx": ALONG[1], "ay": ASIDE[0], "fy": ASIDE[1]}
    exact = incline.two_directions(times, **drive, alpha=DIP, phi=FRICTION, g=GRAVITY)[-1]
    return float(np.linalg.norm(place - exact) / np.linalg.norm(exact))


@pytest.mark.shows(
    "an independent program with the same springs and no damping is 1.4e-4, 5.7e-5 and 2.4e-5 off "
    "at 1e9, 1e10 and 1e11 N/m"
)
@pytest.mark.parametrize(("kn", "off"), [(1e9, 1.4e-4), (1e10, 5.7e-5), (1e11, 2.4e-5)])
def test_undamped_vibration_at_rest_costs_more_than_a_stretch(kn: float, off: float) -> None:
    assert error(kn, 0.0) == pytest.approx(off, rel=0.05)


@pytest.mark.shows(
    "With the spring damped at rest, these errors are below 3.8e-6, 6.4e-7 and 1.5e-7"
)
@pytest.mark.parametrize(("kn", "most"), [(1e9, 3.8e-6), (1e10, 6.4e-7), (1e11, 1.5e-7)])
def test_without_that_vibration_the_slide_is_right(kn: float, most: float) -> None:
    assert error(kn, 0.4) < most
