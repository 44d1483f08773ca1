"""Bounds of a block on a base that lifts it too: upwards, and of the whole distance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cases.blocks.parts.responding._bounds import (
    EPS,
    GAP,
    LOCATED,
    MASS,
    SPRING,
    STEP,
    directions,
    in_plane,
)
from cases.blocks.parts.responding._slow import Path
from vv.ask import Knobs, Method
from vv.case import Exact, Parameters, Tolerance


def in_space(p: Parameters, path: Path, way: float) -> Exact:
    """Of the whole distance; way: the largest displacement [m]."""
    level = in_plane(p, path, way)
    if directions(p) < 3:
        return level
    lifted = vertical(p, way).tolerances
    sprung = {m: _both(p, level.tolerances[m], lifted[m]) for m in (Method.PENALTY, Method.LAGGING)}
    return replace(level, tolerances={**level.tolerances, **sprung})


def _both(p: Parameters, level: Tolerance, lifted: Tolerance) -> Tolerance:
    """Of both errors on springs; without friction nothing happens along the base."""
    if not p["mu"]:
        return lifted
    at = Knobs(kn=SPRING)
    return Tolerance(
        float(np.hypot(level.uncut(at), lifted.uncut(at))),
        f"{level.reason}. Across the plane, {lifted.reason}",
        kn=SPRING,
        softness=level.softness,
        late=level.late + lifted.late,
        slack=level.slack,
    )


def vertical(p: Parameters, way: float) -> Exact:
    """Upwards: the block follows the base, and sinks into springs that lift it.

    way: the largest displacement [m].
    """
    omega = 2 * np.pi * p["fz"]
    lift, near = p["Dz"] * omega**2 / way, MASS * omega**2 / SPRING
    sinks = Tolerance(
        max(float(2 * MASS * lift / SPRING / max(1 - near, EPS)), 1e-9),
        "the block sinks by m z''/kn as the base lifts it, and rises by as much as the base lets "
        "it down, both over 1 - m w^2/kn; z'' is Dz w^2 at most. If this force begins half a step "
        "late or early, the block oscillates on its springs by z'' dt/2 sqrt(m/kn), over "
        "sqrt(1 - kn dt^2/(4 m)) in explicit steps, 1.005 at the longest",
        kn=SPRING,
        softness=1,
        late=float(lift / 2 * np.sqrt(MASS / SPRING / (1 - SPRING * STEP**2 / (4 * MASS)))),
    )
    turned = omega * STEP
    rests = Tolerance(
        max(float(p["Dz"] * turned**3 / 6 / way), GAP),
        "contact is rigid: the block has the velocity of the base at the ends of a step. The mean "
        "of both is off by Dz w (w dt)^2/12, which the next step makes up for; twice that is "
        "allowed, and a gap at the start",
        dt=STEP,
        order=3,
        floor=GAP,
        slack="a code that closes all gaps at the end of a step has rounding errors only",
    )
    return Exact({
        Method.EXACT: Tolerance(1e-12, LOCATED),
        Method.SECOND_ORDER: rests,
        Method.STRAIGHT: rests,
        Method.FIRST_ORDER: Tolerance(
            1e-9,
            "the block follows the base half a step late",
            late=float(omega) / 2,
            slack="some schemes have velocities at half steps, and no such delay",
        ),
        Method.PENALTY: sinks,
        Method.LAGGING: sinks,
    })  # fmt: skip
