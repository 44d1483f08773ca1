"""Judges the support of shaken blocks: the impulse of the base minus the momentum of the blocks."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from vv.ask import Impulse, Method, Observable, Run, Velocity
from vv.case import Exact, Parameters, Quantity, Series, Tolerance
from vv.scene import Scene, Vector

SOLVED = Tolerance(
    1e-10,
    "contacts only exchange momentum, so that all of it comes from outside. Rounding errors "
    "remain: 1e-16 of each force and step, or of gaps of 1e-16 m on springs of 1e9 N/m, which is "
    "1e-11 of the weight at each of a hundred contacts",
    slack="most rounding errors are smaller, and they cancel",
)


def watched(scene: Scene, bed: int) -> tuple[Observable, ...]:
    """The observables of the balance: the velocity of each moving block, the impulse of the bed."""
    moving = (body for body in range(len(scene.blocks)) if body != bed)
    return (*map(Velocity, moving), Impulse(bed))


def balance(scene: Scene, bed: int, p: Parameters) -> tuple[Quantity, ...]:
    """The impulse of the bed's locks minus the momentum of the blocks, which only loads determine.

    The frame of the scene moves as D (1 - cos 2 pi f t) along x, or does not move.
    """
    mass = sum(block.mass for block in scene.blocks)
    shaken, rate = scene.shaking is not None, 2 * np.pi * p["f"]
    hardest = shaken * p["D"] * rate**2
    loads = mass * (p["g"] + hardest) * p["duration"]
    late = _late(1.1 * mass * hardest / loads)
    along = dict.fromkeys(_METHODS, SOLVED) | dict.fromkeys((Method.PENALTY, Method.LAGGING), late)

    def shook(t: Vector) -> Vector:
        return shaken * mass * p["D"] * rate * np.sin(rate * t)

    return (
        Series(
            "given along", "J_x", "N s", "impulse along the base minus momentum of the blocks",
            _given(scene, bed, 0), shook, Exact(along), scale=loads,
        ),
        Series(
            "given upwards", "J_z", "N s", "vertical impulse of the base minus momentum of the "
                                           "blocks",
            _given(scene, bed, 2), lambda t: mass * p["g"] * t,
            Exact(dict.fromkeys(_METHODS, SOLVED)), scale=loads,
        ),
    )  # fmt: skip


_METHODS = (Method.SECOND_ORDER, Method.PENALTY, Method.LAGGING)


def _late(rate: float) -> Tolerance:
    """For a step that uses the shaking at its end.

    rate [1/s]: 1.1 times the largest force of the shaking over the impulse of all loads.
    """
    return Tolerance(
        SOLVED.value,
        "a step that uses the shaking at its end gives an impulse that is too large by M (a(t) - "
        "a(0)) dt/2, at most M D w^2 dt; a tenth more is allowed for the next term of the "
        "Euler-Maclaurin sum",
        late=rate, slack="a step that is cut short uses the shaking of an earlier time",
    )  # fmt: skip


def _given(scene: Scene, bed: int, axis: int) -> Callable[[Run], Vector]:
    masses: Mapping[int, float] = {
        body: block.mass for body, block in enumerate(scene.blocks) if body != bed
    }

    def given(run: Run) -> Vector:
        total = np.array(run.values[Impulse(bed)][:, axis])
        for body, mass in masses.items():
            velocity = run.values[Velocity(body)][:, axis]
            total -= mass * (velocity - velocity[0])
        return total

    return given
