"""The energy ledger of a slip that turns; every energy and work is integrated by itself."""

from __future__ import annotations

import numpy as np

from vv.ask import Ledger
from vv.engines.exact.ledger import derivative, product_integral
from vv.engines.exact.path import taylor_sum
from vv.engines.exact.slide.ledger import ledger_on_wall
from vv.engines.exact.slide.system import forces, ground
from vv.engines.exact.turn.path import Turn
from vv.engines.exact.turn.series import ORDER
from vv.scene import Vector


def turn_ledger(path: Turn) -> Ledger:
    """Energies at the end of a slip that turns, with the terms of `slide_ledger`."""
    slider = path.slider
    place, rate = taylor_sum(path.series, path.end)
    times = np.append(path.start, path.start[-1] + path.end[-1] * path.h[-1])
    place = np.vstack((np.zeros((1, 2)), place))
    rate = np.vstack((slider.slip, rate / path.h[:, None]))
    displacement, velocity = path.motion_in_space(place, rate, times)
    return ledger_on_wall(slider, displacement, velocity, _works(path))


def _works(path: Turn) -> tuple[Vector, Vector, Vector]:
    """Works (p,) [J] against friction, of the shaking and of the wall, in each piece.

    The contact force over the mass is the acceleration less that of all other forces.
    """
    slider = path.slider
    per_time = 1 / path.h[:, None, None]
    slip = per_time * derivative(path.series) @ slider.axes
    accelerated = per_time * derivative(per_time * derivative(path.series)) @ slider.axes
    wall = per_time * derivative(_series(path, np.vstack((np.zeros(3), slider.base))))
    shaken = _series(path, np.vstack((np.zeros(3), slider.shaking)))
    push = accelerated + _series(path, ground(slider) - forces(slider))
    return (
        _integral(path, -push, slip),
        _integral(path, shaken, slip + wall),
        _integral(path, push, wall),
    )


def _series(path: Turn, row: Vector) -> Vector:
    """Taylor coefficients (p, ORDER + 1, 3) of row[0] + row[1:] @ sines, row (1 + k, 3)."""
    slider, rank = path.slider, np.arange(ORDER + 1)
    omega = 2 * np.pi * slider.frequency
    angle = np.outer(path.start, omega) + slider.phase
    quarter = np.sin(angle[:, None] + np.pi / 2 * (rank[:, None] % 4))
    growth = np.cumprod(np.maximum(rank, 1).astype(float))[:, None]
    size = (path.h[:, None, None] * omega) ** rank[:, None] / growth
    series = (quarter * size) @ row[1:]
    series[:, 0] += row[0]
    return np.asarray(series)


def _integral(path: Turn, force: Vector, velocity: Vector) -> Vector:
    """Mass times the integral of a product over each piece, (p,) [J]."""
    work = product_integral(path.end, force, velocity).sum(axis=1)
    return np.asarray(path.slider.mass * path.h * work)
