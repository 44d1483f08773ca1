"""A block of uniform strain: at rest, oscillating when its weight sets in, and spinning."""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from cases.blocks.parts._elastic_bounds import (
    DAMPED,
    OUTPUTS,
    SEEN,
    STEPS,
    STIFF,
    frequency_bounds,
    law,
    of_coupled,
    of_spun,
    period,
    sides,
    swing_bounds,
)
from reference_solutions.blocks import elastic_block as exact
from reference_solutions.blocks import implicit_step
from vv.ask import Displacement, History, Knobs, Method, Run, Strain
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Series,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Elastic, Scene, Vector, Wall, box_geometry, polyhedron_inertia

Cvector = NDArray[np.complex128]
STRAIN, MOVED = Strain(0), Displacement(0)
Z = np.array([0.0, 0.0, 1.0])
APART = 12  # outputs: about one radian of the oscillation
# steps, springs and duration of the block that comes to rest
SLOW, SOFT, LONG = (1.0, 0.5), 50.0, 200.0


def _scene(variant: str, p: Parameters) -> Scene:
    """The block, on a smooth base unless it spins."""
    extent, spins = np.array(sides(p)), variant == "spun"
    vertices, faces = box_geometry(extent[2] / 2 * Z, extent / 2, np.eye(3))
    mass, inertia = polyhedron_inertia(vertices, faces, p["rho"])
    across = variant != "ringing"
    block = Block(
        "block", vertices, faces, mass, inertia, np.zeros(3),
        free=np.array([across, across, True]),
        free_spin=np.array([False, False, spins]),
        spin=p["spin"] * Z * spins,
        elastic=Elastic(p["E"], p["nu"]),
    )  # fmt: skip
    bodies = (block,) if spins else (block, Wall(np.zeros(3), Z))
    return Scene(bodies, Contact(np.inf), gravity=-p["g"] * Z * (not spins))


def _declare(variant: str, p: Parameters) -> Trial:
    w = exact.first(side=p["L"], rho=p["rho"], young=p["E"])
    bar = p["E"] * p["a"] * p["b"] / p["L"]
    if variant == "pressed":
        slowest = min(
            w, *(2 * exact.first(side=p[side], rho=p["rho"], young=p["E"]) for side in "ab")
        )
        rungs = tuple(Knobs(step / slowest, SOFT * bar) for step in SLOW)
        goal = History(LONG / slowest, LONG / slowest / 10)
    else:
        rungs = tuple(Knobs(step / w, STIFF * bar) for step in STEPS)
        goal = History(OUTPUTS * SEEN / w, SEEN / w)
    levels = {Level.QUICK: rungs[:3:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}
    study = Ladder(_scene(variant, p), goal, (STRAIN, MOVED), levels)
    return Trial(study, MEASURED[variant](p, w))


def _pressed(p: Parameters, w: float) -> tuple[Quantity, ...]:
    strain = exact.resting(**law(p), g=p["g"])
    size, sunk = abs(strain[2]), -strain[2] * p["L"] / 2
    still = Tolerance(
        1e-5 + 2 * size,
        "the damping of the step has brought the block to rest. The answer is linear in the "
        "strains, which are about a millionth: the error is of their size",
    )
    swings = {Method.DAMPED: "steps of this class hardly damp, so that the block still oscillates"}
    rests = Exact({Method.PENALTY: still, Method.LAGGING: still}, not_judged=swings)
    return (
        Scalar("axial", "e_z", "", "strain along z at the end, under half the weight",
               lambda run: _last(run, 2), strain[2], size, rests),
        Scalar("lateral", "e_x", "", "strain along x at the end: nu times as large, an extension",
               lambda run: _last(run, 0), strain[0], size, rests),
        Scalar("sunk", "d", "m", "downward displacement of the "
               "centroid", _sinking, sunk, sunk, rests),
        Scalar("sunk-continuum", "d/d_c", "", "the same over rho g L^2/(3 E) of a column",
               lambda run: 0.75 * _sinking(run) / sunk, None, 1.0, Shown(SHORT)),
    )  # fmt: skip


def _last(run: Run, axis: int) -> float:
    return float(run.values[STRAIN][-1, axis])


def _sinking(run: Run) -> float:
    return float(-run.values[MOVED][-1] @ Z)


def _ringing(p: Parameters, w: float) -> tuple[Quantity, ...]:
    path = functools.partial(exact.standing, **law(p), g=p["g"], along=(2,))
    return (
        _strain_along(2, path, p, swing_bounds(1.0, 1.0, w)),
        Scalar("frequency", "w_e/w", "", "frequency over sqrt(3 E/rho)/L",
               lambda run: _frequency(run) / w, 1.0, 1.0, frequency_bounds(w)),
        Scalar("frequency-continuum", "w_e/w_c", "", "the same over (pi/2) sqrt(E/rho)/L",
               lambda run: exact.STIFFER * _frequency(run) / w, None, 1.0, Shown(HIGH)),
        Scalar("damping", "zeta/zeta_dt", "", "damping ratio from the decrement of the "
               "oscillation, over that of the step, w "
               "dt/4", lambda run: _damping(run) / _step_damping(run, w), 1.0, 1.0,
               DAMPED),
        Scalar("damping ratio", "zeta", "", "damping ratio from the decrement of the "
               "oscillation", _damping, None, 1.0, Shown(GROWS)),
    )  # fmt: skip


def _coupled(p: Parameters, w: float) -> tuple[Quantity, ...]:
    def path(t: Vector) -> Vector:
        return exact.standing(t, **law(p), g=p["g"])

    return tuple(
        _strain_along(axis, path, p, judge)
        for axis, judge in zip((2, 0, 1), of_coupled(p, w), strict=True)
    )


def _spun(p: Parameters, w: float) -> tuple[Quantity, ...]:
    def path(t: Vector) -> Vector:
        return exact.seen_from_rest(exact.spinning(t, **law(p), spin=p["spin"]), p["spin"] * t)

    return tuple(_strain_along(axis, path, p, judge) for axis, judge in enumerate(of_spun(p, w)))


def _strain_along(
    axis: int, path: Callable[[Vector], Vector], p: Parameters, judge: Exact
) -> Series:
    """The strain along an axis; every error is relative to the largest strain of all."""
    name = f"e_{'xyz'[axis]}"
    times = period(p)
    return Series(
        name, name, "", f"strain along {name[-1]}",
        lambda run: np.asarray(run.values[STRAIN][:, axis]),
        lambda t: path(t)[:, axis], judge, lambda: float(np.abs(path(times)).max()),
    )  # fmt: skip


def _frequency(run: Run) -> float:
    """The frequency of the oscillation about its mean [1/s]."""
    return float(np.abs(np.angle(_roots(run))).max() / run.times[APART])


def _damping(run: Run) -> float:
    """The damping ratio of the oscillation about its mean: its decrement over its phase."""
    rate = np.log(_roots(run)[0])
    return float(-rate.real / abs(rate))


def _step_damping(run: Run, w: float) -> float:
    """The damping ratio that the steps of a run cause at the frequency w [1/s]."""
    return implicit_step.damping_ratio(w * float(run.times[-1]) / run.steps)


def _roots(run: Run) -> Cvector:
    """The pair of roots of the linear map over APART outputs, fitted."""
    e = run.values[STRAIN][:, 2]
    now, before = e[APART:-APART], e[: -2 * APART]
    known = np.stack([now, before, np.full(len(now), np.abs(e).max())], axis=1)
    trace, det, _ = np.linalg.lstsq(known, e[2 * APART :])[0]
    return np.asarray(np.roots([1.0, -trace, -det]), complex)


SHORT = (
    "the strain of a column under its own weight rises from zero at the top to rho g L/E at the "
    "foot. Its centroid sinks by rho g L^2/(3 E), a third more than with uniform strain; the "
    "displacement of its top is the same with both"
)
HIGH = (
    "the first mode of the continuum is a quarter of a sine, with pi/sqrt(12) of this frequency; "
    "uniform strain makes a block stiffer, by 10 % in frequency"
)
GROWS = "it grows with the step and the frequency: 2.3 % is its value at 14.66 Hz and 1e-3 s"
MEASURED = {"pressed": _pressed, "ringing": _ringing, "coupled": _coupled, "spun": _spun}
HELD = "m s_i^2/12 e_i'' + V sum_j C_ij e_j = F_i"
CASE = Case(
    name="elastic-block",
    title="A block that strains uniformly",
    source=Source(
        "Shi (1992), Discontinuous deformation analysis: a new numerical model for the statics and "
        "dynamics of deformable block structures, Engineering Computations 9(2), 157-168",
        "10.1108/eb023855",
        "The paper gives displacements that are linear in x; scenes and answers are ours. The "
        "answers hold for a block whose strain is uniform, not for a continuum: its first mode is "
        "sqrt(12)/pi = 1.103 times as fast, which is shown too. Base and sides are smooth.",
    ),
    parameters=(
        Parameter("L", 1.0, "m", "height"),
        Parameter("a", 2.0, "m", "side along x"),
        Parameter("b", 1.5, "m", "side along y"),
        Parameter("rho", 2500.0, "kg/m3", "density"),
        Parameter("E", 1e10, "Pa", "Young's modulus"),
        Parameter("nu", 0.25, "", "Poisson's ratio"),
        Parameter("g", 9.81, "m/s2", "gravity, applied at t = 0"),
        Parameter("spin", 5.0, "1/s", "spin about z"),
    ),
    variants=(
        Variant(
            "pressed",
            "at rest on its base, free to expand sideways",
            "e_z = -rho g L/(2 E), e_x = -nu e_z, d = rho g L^2/(4 E)",
            {},
            frozenset({"a", "b", "spin"}),
        ),
        Variant(
            "ringing",
            "weight applied to a block that can strain along z only",
            "e_z = -(rho g L/(2 E)) (1 - cos w t), w^2 = 3 E/(rho L^2)",
            {},
            frozenset({"a", "b", "nu", "spin"}),
        ),
        Variant(
            "coupled",
            "weight applied to a block free to expand sideways: three strains",
            f"{HELD}, 4 times the inertia along z, F_z = -m g L/2",
            {},
            frozenset({"spin"}),
        ),
        Variant(
            "spun",
            "a free block that starts to spin; a bar has w^2 = 12 E/(rho L^2)",
            f"{HELD}, F_i = m spin^2 s_i^2/12 along x and y",
            {},
            frozenset({"g"}),
        ),
    ),
    declare=_declare,
)
