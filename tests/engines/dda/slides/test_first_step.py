"""Claims about the first step of a plate that slips fast, whose friction lags by a solution."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.scenes.blocks.dda_scenes import ALL, DOWN, FLOOR, G, asked, box, rates, run
from vv.engines.dda import DEFAULT, PUBLISHED
from vv.engines.dda.formulation import PUBLISHED_SHEAR
from vv.scene import Contact, Scene

MU, HEIGHT, WIDTH = 0.3, 0.1, 0.5  # half height and half width of the plate [m]
THROWN = Scene(
    (FLOOR, box((WIDTH, WIDTH, HEIGHT), 2500.0, free_spin=ALL)), Contact(math.inf, mu=MU),
    gravity=DOWN,
)  # fmt: skip
MASS = THROWN.blocks[0].mass


def lost(v: float, dt: float, kn: float) -> float:
    """The speed that friction takes beyond mu g dt, if its limit is that of corners that stick.

    Springs 4 ks hold the base, HEIGHT below the centre, against the inertia 2 m/dt^2 of an implicit
    step; the plate turns by an angle q, and its leading corners are pressed by kn WIDTH q more.
    """
    ks, inertia = 4 * PUBLISHED_SHEAR * kn, 2 * MASS / dt**2
    turns = inertia * (HEIGHT**2 + WIDTH**2) / 3 + 4 * kn * WIDTH**2 + ks * HEIGHT**2
    q = ks * HEIGHT * inertia * v * dt / ((inertia + ks) * turns - (ks * HEIGHT) ** 2)
    pressed = 2 * (MASS * G / 4 + kn * WIDTH * q)  # by both leading corners
    return MU * (pressed - MASS * G) * dt / MASS


def seen(v: float, dt: float, kn: float, way: object = PUBLISHED) -> float:
    """The speed that is lost beyond mu g t in some steps."""
    body = box((WIDTH, WIDTH, HEIGHT), 2500.0, free_spin=ALL, velocity=np.array([v, 0.0, 0.0]))
    scene = Scene((FLOOR, body), THROWN.contact, gravity=DOWN)
    done = run(asked(scene, dt, kn, 20 * dt, 10 * dt), way)  # type: ignore[arg-type]
    return float(v - MU * G * done.times[-1] - rates(done)[-1, 0])


@pytest.mark.shows("Its first solution lets all corners stick")
@pytest.mark.parametrize(("dt", "kn"), [(1e-3, 1e8), (1e-3, 1e9), (2e-4, 1e10)])
@pytest.mark.parametrize("v", [66.0, 300.0])
def test_a_fast_plate_loses_what_friction_takes_from_corners_that_stick(
    v: float, dt: float, kn: float
) -> None:
    """The speeds lost are 4e-3 to 3e-2 of v; a plate whose friction converges loses none."""
    assert seen(v, dt, kn) == pytest.approx(lost(v, dt, kn), rel=0.1)
    assert lost(v, dt, kn) > 3e-3 * v
    assert abs(seen(v, dt, kn, DEFAULT)) < 1e-3 * lost(v, dt, kn)


def test_a_slow_plate_is_not_tipped_and_loses_less_than_friction_takes_in_half_a_step() -> None:
    """A further solution then takes the pressure of one that slides."""
    assert lost(3.0, 1e-3, 1e8) > 3e-3 * 3.0
    assert abs(seen(3.0, 1e-3, 1e8)) < MU * G * 1e-3 / 2
