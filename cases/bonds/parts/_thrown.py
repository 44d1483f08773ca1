"""The unit of four bonded elements disturbed at rest: it breathes, or rotates as a whole."""

from __future__ import annotations

import functools

import numpy as np

from cases.bonds.parts._unit import CORNERS, EDGES, OUT, ROUND, SEEN, unit
from reference_solutions.bonds import turned_unit
from vv.ask import History, Knobs, Method
from vv.case import (
    ComponentAlong,
    Exact,
    Ladder,
    Level,
    Parameters,
    Series,
    Tolerance,
    Trial,
)
from vv.scene import Vector

AXES = np.eye(3)
SWING = History(duration=2e-6, interval=2e-8)
THROWN = 1e-8  # s: the coarsest step for oscillations
STRETCHED = "at this angle the rotation stretches the unit, which is a nonlinear effect"
LINEAR = 1e-5  # strain beyond which the square of the angle shows in the oscillation


def breathing(p: Parameters) -> Trial:
    """All bonds oscillate in phase; none rotates."""
    return _swinging(p, OUT, p["kn"])


def turned(p: Parameters) -> Trial:
    """The unit rotates as a whole, which shear springs of elements that cannot rotate resist."""
    if abs(p["strain"]) > LINEAR:
        return _turned_far(p)
    return _swinging(p, ROUND, p["gamma"] * p["kn"])


def _swinging(p: Parameters, shape: Vector, stiffness: float) -> Trial:
    """The start of a mode of the shape (4, 3) at 2 sqrt(stiffness/m); strain is its amplitude."""
    w = 2 * np.sqrt(stiffness / p["m"])
    scene = unit(p, 0.0, velocity=p["d"] * p["strain"] * w * shape)
    sizes = p["d"] * p["strain"] * shape
    largest = np.abs(shape).argmax(axis=1)
    parts = tuple(
        _part(w, sizes, body, axis.item()) for body, axis in enumerate(largest) if sizes[body].any()
    )
    return Trial(Ladder(scene, SWING, SEEN, levels(THROWN)), parts)


def _turned_far(p: Parameters) -> Trial:
    """The same start by an angle so large that the rotation stretches the unit too."""
    ks = p["gamma"] * p["kn"]
    w = 2 * np.sqrt(ks / p["m"])
    velocity = p["d"] * p["strain"] * w * ROUND
    scene = unit(p, 0.0, velocity=velocity)
    path = turned_unit.path(p["d"] * CORNERS, EDGES, velocity, m=p["m"], kn=p["kn"], ks=ks)
    size = float(np.abs(p["d"] * p["strain"] * ROUND).max())
    parts = tuple(
        Series(
            f"u{body}{'xyz'[axis]}", f"u_{body}{'xyz'[axis]}", "m",
            f"displacement of element {body} along {'xyz'[axis]}",
            ComponentAlong(SEEN[body], AXES[axis]),
            functools.partial(_of_path, path, body, axis), _far_bounds(w), size,
        )
        for body in range(4)
        for axis in range(3)
        if body or axis == 2
    )  # fmt: skip
    return Trial(Ladder(scene, SWING, SEEN, levels(THROWN)), parts)


def _of_path(path: turned_unit.Path, body: int, axis: int, t: Vector) -> Vector:
    """Displacement [m] of a body along an axis at times [s]; the path is solved to the last."""
    return path(t)[:, body, axis]


def _part(w: float, sizes: Vector, body: int, axis: int) -> Series:
    return Series(
        f"u{body}{'xyz'[axis]}",
        f"u_{body}{'xyz'[axis]}",
        "m",
        f"displacement of element {body} along {'xyz'[axis]}",
        ComponentAlong(SEEN[body], AXES[axis]),
        lambda t: sizes[body, axis] * np.sin(w * t),
        _bounds(w),
    )


def levels(coarsest: float) -> dict[Level, tuple[Knobs, ...]]:
    rungs = tuple(Knobs(dt=coarsest / 2**i) for i in range(4))
    return {Level.QUICK: rungs[:3:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}


def _bounds(w: float) -> Exact:
    """w: frequency of the oscillation [1/s], which lasts for SWING."""
    angle, whole = w * THROWN, w * SWING.duration
    return Exact(
        {
            Method.EXACT: Tolerance(
                1e-13, "the answer is a sine whose frequency is known to rounding"
            ),
            Method.LINEARISED: Tolerance(
                1e-13, "no bond rotates, so that the linear answer is exact"
            ),
            Method.SECOND_ORDER: Tolerance(
                angle**2 / 24 * max(whole, 1.0) * 1.7,
                "the phase error (w dt)^2/24 w t of a leapfrog, and some (w dt)^2 by its start",
                dt=THROWN, order=2,
            ),
            Method.FIRST_ORDER: Tolerance(
                angle,
                "a start half a step late shifts the phase by w dt/2", dt=THROWN, order=1,
            ),
        },
        not_judged={
            Method.PENALTY: "contacts that represent bonds would open at such amplitudes"
        },
    )  # fmt: skip


def _far_bounds(w: float) -> Exact:
    """The bounds at an angle at which the unit stretches as it rotates."""
    swung = _bounds(w)
    kept = {m: swung.tolerances[m] for m in (Method.SECOND_ORDER, Method.FIRST_ORDER)}
    path = Tolerance(1e-9, "the reference path is integrated to 1e-12 a step")
    return Exact(
        {**kept, Method.EXACT: path}, not_judged={**swung.not_judged, Method.LINEARISED: STRETCHED}
    )
