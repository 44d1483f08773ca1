"""Judges the support of shaken blocks by momentum: impulse of the base minus that of blocks."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from vv.ask import Impulse, Method, Observable, Run, Velocity
from vv.case import Exact, Parameters, Quantity, Series, Tolerance
from vv.scene import Scene, Vector

SOLVED = Tolerance(
    1e-10,
    "whatever contacts do, all momentum comes from outside. What is left of it is rounding: 1e-16 "
    "of each force and step, or of gaps of 1e-16 m on springs of 1e9 N/m, which is 1e-11 of the "
    "weight at each of a hundred contacts",
    slack="most roundings are smaller, and cancel",
)


def watched(scene: Scene, bed: int) -> tuple[Observable, ...]:
    """What the balance of a scene needs: how all that moves does, and what the bed's locks give."""
    moving = (body for body in range(len(scene.blocks)) if body != bed)
    return (*map(Velocity, moving), Impulse(bed))


def balance(scene: Scene, bed: int, p: Parameters) -> tuple[Quantity, ...]:
    """The impulse of the bed's locks less the momentum of the blocks: what loads alone explain.

    The scene stands in a frame that moves as D (1 - cos 2 pi f t) along x, or in none.
    """
    mass = sum(block.mass for block in scene.blocks)
    shaken, rate = scene.shaking is not None, 2 * np.pi * p["f"]
    hardest = shaken * p["D"] * rate**2
    loads = mass * (p["g"] + hardest) * p["duration"] or 1.0
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
    """Of a step that takes the shaking of its end.

    rate [1/s]: what a second of the largest shaking is of all that loads give, and a tenth more.
    """
    return Tolerance(
        SOLVED.value,
        "a step that takes the shaking of its end gives dt/2 M (a(t) - a(0)) too much, at most M D "
        "w^2 dt, and a tenth more for the next term of Euler and Maclaurin's sum",
        late=rate, slack="a step that is cut has the shaking of an earlier time",
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
