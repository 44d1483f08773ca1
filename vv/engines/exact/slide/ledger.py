"""The energy ledger of a slide; every energy and work is integrated separately and exactly."""

from __future__ import annotations

import numpy as np

from vv.ask import Ledger
from vv.engines.exact.ledger import derivative, ledger_of_terms, product_integral, sum_so_far
from vv.engines.exact.path import taylor_sum
from vv.engines.exact.slide.path import Slide
from vv.engines.exact.slide.system import Slider, TurningSlider
from vv.scene import Vector


def slide_ledger(path: Slide) -> Ledger:
    """The energies [J] at the end of a slide, with the conventions of `vv.engines.exact.ledger`.

    Work done by shaking and by the moving wall counts as negative, so that the sum of all terms is
    the energy at t = 0. The power of the wall is the contact force times the wall's velocity.
    """
    displacement, velocity = path.motion_in_space(*_ends(path), path.waves)
    return ledger_on_wall(path.slider, displacement, velocity, _works(path))


def ledger_on_wall(
    slider: Slider | TurningSlider,
    displacement: Vector,
    velocity: Vector,
    works: tuple[Vector, Vector, Vector],
) -> Ledger:
    """The ledger of a body on a wall from its motion in space at the ends of pieces, (p + 1, 3).

    works: three arrays (p,) [J], the work against friction, by shaking and by the wall in each
    piece.
    """
    friction, shaking, base = works
    terms = {
        "kinetic": 0.5 * slider.mass * (velocity**2).sum(axis=1),
        "friction dissipation": sum_so_far(friction),
        "gravity potential": -slider.mass * displacement @ slider.gravity,
        "load potential": -displacement @ slider.load,
        "work left to shaking": -sum_so_far(shaking),
        "work left to the wall": -sum_so_far(base),
    }
    return ledger_of_terms(terms, 1)


def _ends(path: Slide) -> tuple[Vector, Vector]:
    """Position [m] and speed [m/s] along the slip at t = 0 and the end of each piece, (p + 1,)."""
    place, rate = taylor_sum(path.series[:, :, None], path.end)
    return (
        np.concatenate(((0.0,), place[:, 0])),
        np.concatenate(((path.slider.speed,), rate[:, 0] * path.clock.rate)),
    )


def _works(path: Slide) -> tuple[Vector, Vector, Vector]:
    """The work (p,) [J] against friction, by shaking and by the wall in each piece."""
    slider = path.slider
    sign = np.array([state.sign for state in path.states], float)[:, None]
    pressing, relative_drive = (
        path.series_of_row(slider.pressing),
        path.series_of_row(slider.relative_drive),
    )
    wall, lift = (_rate(path, path.series_of_row(_row(slider.base, a))) for a in _axes(path))
    speed = _rate(path, path.series)
    shaken, lifted = (path.series_of_row(_row(slider.shaking, a)) for a in _axes(path))
    rub = np.where(
        sign == 0, -relative_drive if slider.mu > 0 else 0.0, -sign * slider.mu * pressing
    )
    return (
        _integral(path, slider.mu * pressing, sign * (speed - wall)),
        _integral(path, shaken, speed) + _integral(path, lifted, lift),
        _integral(path, rub, wall) + _integral(path, pressing, lift),
    )


def _axes(path: Slide) -> tuple[Vector, Vector]:
    """The directions of the slip and of the normal."""
    return path.slider.along, path.slider.normal


def _row(amplitude: Vector, axis: Vector) -> Vector:
    """The row (1 + k,) of sines of amplitudes (k, 3), projected on an axis."""
    return np.concatenate(((0.0,), amplitude @ axis))


def _rate(path: Slide, series: Vector) -> Vector:
    """The time derivatives (p, order + 1) of polynomials whose variable counts cells."""
    return np.asarray(path.clock.rate * derivative(series[:, :, None])[:, :, 0])


def _integral(path: Slide, force: Vector, velocity: Vector) -> Vector:
    """The work (p,) [J] of accelerations at velocities in each piece: mass times the integral."""
    work = product_integral(path.end, force[:, :, None], velocity[:, :, None])[:, 0]
    return np.asarray(path.slider.mass / path.clock.rate * work)
