"""The energy ledger of a slip that changes direction; every term is integrated separately."""

from __future__ import annotations

import numpy as np

from vv.ask import Ledger
from vv.engines.exact.ledger import derivative
from vv.engines.exact.path import taylor_sum
from vv.engines.exact.slide.ledger import ledger_on_wall
from vv.engines.exact.slide.system import forces, ground
from vv.engines.exact.turn.path import Turn
from vv.scene import Vector

NODES = 14  # of Gauss's rule: exact to rounding, as pieces are far shorter than series converge


def turn_ledger(path: Turn) -> Ledger:
    """Energies at the end of a slip that changes direction; terms are those of `slide_ledger`."""
    slider = path.slider
    curve, rate = taylor_sum(path.series, path.end)
    times = np.append(path.start, path.start[-1] + curve[-1, 2])
    place = np.vstack((np.zeros((1, 2)), curve[:, :2]))
    velocity = np.vstack((slider.slip, rate[:, :2] / rate[:, 2:]))
    return ledger_on_wall(slider, *path.motion_in_space(place, velocity, times), _works(path))


def _works(path: Turn) -> tuple[Vector, Vector, Vector]:
    """The work (p,) [J] against friction, by shaking and by the wall in each piece.

    The contact force over the mass is the acceleration minus that by all other forces. Integrals
    are those of Gauss's rule.
    """
    slider, nodes = path.slider, np.polynomial.legendre.leggauss(NODES)
    works = np.zeros((3, len(path)))
    for node, weight in zip(*nodes, strict=True):
        x = path.end * (1 + node) / 2
        curve, rate = taylor_sum(path.series, x)
        bend = taylor_sum(derivative(path.series), x)[1]
        slip, way, passed = rate[:, :2] @ slider.axes, rate[:, :2] / rate[:, 2:], rate[:, 2:]
        accelerated = (bend[:, :2] - way * bend[:, 2:]) / passed**2 @ slider.axes
        angle = np.outer(path.start + curve[:, 2], 2 * np.pi * slider.frequency) + slider.phase
        wall = passed * (np.cos(angle) @ (2 * np.pi * slider.frequency[:, None] * slider.base))
        sines = np.hstack((np.ones((len(path), 1)), np.sin(angle)))
        push = accelerated + sines @ (ground(slider) - forces(slider))
        shaken = sines[:, 1:] @ slider.shaking
        powers = ((-push, slip), (shaken, slip + wall), (push, wall))
        share = slider.mass * weight * path.end / 2
        works += [share * (force * moved).sum(axis=1) for force, moved in powers]
    friction, shaking, base = works
    return friction, shaking, base
