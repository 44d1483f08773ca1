"""Sliding and shaken blocks at the settings of the paper, with its own measure of error."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks.incline import CASE as INCLINE
from cases.blocks.responding_block import CASE as RESPONDING_BLOCK
from vv.ask import Knobs, Run
from vv.case import (
    Case,
    Ladder,
    Level,
    Parameters,
    Quantity,
    Scalar,
    Series,
    Shown,
    Source,
    Trial,
    Variant,
)
from vv.scene import Block, Scene, Vector, box_geometry, polyhedron_inertia

TABLE_1 = ((1.0, 1.0, 0.5), 2700.0)  # sides [m], kg/m3
TABLE_2 = ((2.0, 2.0, 0.1), 2250.0)


class Setting(NamedTuple):
    """A variant of another case at the paper's setting, and what the paper says of its error.

    steps [s] and kn [N/m] of the rungs, the paper's first; its error is below limit [%] after [s].
    """

    case: Case
    variant: str
    block: tuple[tuple[float, float, float], float]
    steps: tuple[float, ...]
    kn: float
    says: str
    after: float
    limit: float


def _fall(phi: int) -> Setting:
    return Setting(INCLINE, f"gravity-45-{phi}", TABLE_1, (1e-3, 5e-4, 2.5e-4), 4e8,
                   "below 1 % after 0.2 s (Fig. 12)", 0.2, 1.0)  # fmt: skip


def _launch(v: str) -> Setting:
    return Setting(INCLINE, f"launch-{v}", TABLE_1, (1e-4,), 4e8,
                   "below 1 % after 0.5 s (Fig. 13)", 0.5, 1.0)  # fmt: skip


def _shaken(variant: str, figure: int, limit: float, kn: float = 1e9) -> Setting:
    says = f"below {limit:g} %, mostly (Fig. {figure})"
    return Setting(RESPONDING_BLOCK, variant, TABLE_2, (1e-4,), kn, says, 0.1, limit)


SETTINGS = {
    **{f"fall-{phi}": _fall(phi) for phi in (10, 20, 30)},
    **{f"launch-{v}": _launch(v) for v in ("0.01", "0.1", "1")},
    "sine": Setting(INCLINE, "newmark-3d", TABLE_1, (1e-4,), 7e9,
                    "below 3 %, mostly (Fig. 14)", 0.2, 3.0),
    "2hz": _shaken("1d", 18, 3.0),
    "3hz": _shaken("1d-3hz", 18, 3.0),
    "5hz": _shaken("1d-5hz", 18, 10.0),
    "0.3m": _shaken("1d-0.3m", 19, 7.0),
    "0.5m": _shaken("1d-0.5m", 19, 1.0),
    "1m": _shaken("1d-1m", 19, 1.0),
    "mu-0.1": _shaken("1d-mu-0.1", 20, 1.0),
    "mu-1": _shaken("1d-mu-1", 20, 7.0),
    "2d": _shaken("2d", 21, 10.0),
    "3d-1e7": _shaken("3d", 23, 3.0, 1e7),
    "3d-1e8": _shaken("3d", 23, 10.0, 1e8),
    "3d-1e9": _shaken("3d", 23, 10.0, 1e9),
}  # fmt: skip

ONE_OF_A_FIGURE = ("launch-0.1", "sine", "5hz", "0.5m", "mu-1", "2d", "3d-1e8")
USUAL = {
    **dict.fromkeys(ONE_OF_A_FIGURE, Level.DEFAULT),
    **dict.fromkeys(("fall-30", "2d"), Level.QUICK),  # each scheme runs one of them
}


def _declare(variant: str, _: Parameters) -> Trial:
    own = SETTINGS[variant]
    base = own.case.declare(own.variant, own.case.defaults(own.variant))
    study = base.study
    assert isinstance(study, Ladder)
    rungs = dict.fromkeys(Level, tuple(Knobs(dt, own.kn) for dt in own.steps))
    made = Ladder(_with_block(study.scene, own), study.goal, study.observables, rungs)
    level = [q for q in base.quantities if isinstance(q, Series)][:2]  # figures show no heights
    return Trial(made, (*base.quantities, *_published(own, level)))


def _with_block(scene: Scene, own: Setting) -> Scene:
    """The scene with the paper's block in place of its own."""
    sides, density = own.block
    (wall,), (block,) = scene.walls, scene.blocks
    half = np.array(sides) / 2
    out = half[2] * wall.normal
    vertices, faces = box_geometry(wall.point + out, half, scene.axes)
    mass, inertia = polyhedron_inertia(vertices, faces, density)
    made = Block(
        block.name, vertices, faces, mass, inertia, block.velocity, block.free, block.free_spin
    )
    return dataclasses.replace(scene, bodies=(wall, made))


def _published(own: Setting, axes: list[Series]) -> tuple[Quantity, ...]:
    error = functools.partial(_error, own, axes)
    return (
        Scalar("E_N", "E_N", "", f"largest E_N [%] after {own.after:g} s; the paper: {own.says}",
               lambda run: float(error(run).max()), None, 1.0, Shown(UNBOUNDED)),
        Scalar("E_N at the end", "E_N(T)", "", "E_N [%] at the last output",
               lambda run: float(error(run)[-1]), None, 1.0, Shown(UNBOUNDED)),
        Scalar("share", "n/N", "", f"part of the outputs with E_N below {own.limit:g} %",
               lambda run: float((error(run) < own.limit).mean()), None, 1.0, Shown(UNBOUNDED)),
    )  # fmt: skip


def _error(own: Setting, axes: list[Series], run: Run) -> Vector:
    """E_N = |d_A - d_N|/d_A [%] (Eq. 9) of displacements, where the exact one is not 0."""
    late = run.times >= own.after
    found, due = (_size([np.asarray(f(one)) for one in axes])[late] for f in _routes(run))
    there = np.abs(due) > 0.0
    return np.asarray(100.0 * np.abs(found[there] / due[there] - 1.0))


def _routes(run: Run) -> tuple[Callable[[Series], Vector], Callable[[Series], Vector]]:
    return lambda one: one.observe(run), lambda one: _exact(one, run)


def _exact(one: Series, run: Run) -> Vector:
    assert one.reference is not None
    return one.reference(run.times)


def _size(parts: list[Vector]) -> Vector:
    """The displacement in one direction; in two its magnitude, as in the figures."""
    return parts[0] if len(parts) == 1 else np.hypot(*parts)


UNBOUNDED = (
    "relative to the displacement at the same time, the error has no bound where that returns to "
    "zero; what is judged is the error relative to the largest displacement"
)
CASE = Case(
    name="published-settings",
    title="Blocks at the settings of the paper",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Tables 1 and 2: 1 x 1 x 0.5 m, 2700 kg/m3, 4e8 N/m (7e9 under the sine), 1e-3 s (1e-4 "
        "for launches and the sine); 2 x 2 x 0.1 m, 2250 kg/m3, 1e9 N/m, 1e-4 s. What the paper "
        "does not give is chosen as in the cases `incline` and `responding-block`.",
    ),
    parameters=(),
    variants=tuple(
        Variant(
            name, f"{own.case.name}:{own.variant} at {own.steps[0]:g} s and {own.kn:g} N/m",
            own.case.variant(own.variant).formula,
            level=USUAL.get(name, Level.PAPER),
        )
        for name, own in SETTINGS.items()
    ),
    declare=_declare,
    published={name: own.says for name, own in SETTINGS.items()},
)  # fmt: skip
