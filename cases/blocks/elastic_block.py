"""A block of uniform strain: at rest, oscillating when its weight sets in, and spinning."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
STEPS, STIFF = (0.02, 0.01, 0.005, 0.0025), 1e4  # steps times w, springs over E a b/L
# time between outputs, times w, and their number: a period and a half
SEEN, OUTPUTS = 4 * STEPS[0], 118
FIRST = 1.3  # bound of the damping of the first mode of a bar, over w dt
APART = 12  # outputs: about one radian of the oscillation
# steps, springs and duration of the block that comes to rest
SLOW, SOFT, LONG = (1.0, 0.5), 50.0, 200.0


def _scene(variant: str, p: Parameters) -> Scene:
    """The block, on a smooth base unless it spins."""
    sides, spins = np.array(_sides(p)), variant == "spun"
    vertices, faces = box_geometry(sides[2] / 2 * Z, sides / 2, np.eye(3))
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


def _sides(p: Parameters) -> exact.Sides:
    return p["a"], p["b"], p["L"]


def _law(p: Parameters) -> dict[str, Any]:
    return {"sides": _sides(p), "rho": p["rho"], "young": p["E"], "poisson": p["nu"]}


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
    strain = exact.resting(**_law(p), g=p["g"])
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
    path = functools.partial(exact.standing, **_law(p), g=p["g"], along=(2,))
    return (
        _strain_along(2, path, p, _swing_bounds(1.0, 1.0, w)),
        Scalar("frequency", "w_e/w", "", "frequency over sqrt(3 E/rho)/L",
               lambda run: _frequency(run) / w, 1.0, 1.0, _frequency_bounds(w)),
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
        return exact.standing(t, **_law(p), g=p["g"])

    shares, squares = exact.standing_modes(**_law(p), g=p["g"])
    rates, amplitude = np.sqrt(squares) / w, np.abs(path(_period(p))).max() / 2
    damped, lowered = (np.maximum(1.0, shares @ rates**n / amplitude) for n in (2, 3))
    return tuple(
        _strain_along(axis, path, p, _swing_bounds(float(damped[axis]), float(lowered[axis]), w))
        for axis in (2, 0, 1)
    )


def _spun(p: Parameters, w: float) -> tuple[Quantity, ...]:
    def path(t: Vector) -> Vector:
        return exact.seen_from_rest(exact.spinning(t, **_law(p), spin=p["spin"]), p["spin"] * t)

    return tuple(
        _strain_along(
            axis,
            path,
            p,
            Exact(
                {
                    method: _with_slowing(tolerance, float(slowed))
                    for method, tolerance in _swing_bounds(
                        float(quick), float(quick), w
                    ).tolerances.items()
                },
                not_judged={Method.LAGGING: NO_PULL},
            ),
        )
        for axis, (quick, slowed) in enumerate(zip(_quick(p, w), _slowed(p, w), strict=True))
    )


def _slowed(p: Parameters, w: float) -> Vector:
    """What strains change of each strain (3,) of a spun block, over the largest of all.

    A block strained by e spins slower, at 1 - 2 e, and its inertia grows to 1 + 2 e. Of w_j^2 e a
    mode lacks 4 e by the first and 4 e by the second, in products of two oscillations: 8 e at rest,
    and, as part of them has the frequency w_j of the mode, w_j t/2 times that.
    """
    shares, squares = exact.spun_modes(**_law(p), spin=p["spin"])
    followed = 1.0 + np.sqrt(squares) / w * OUTPUTS * SEEN / 2
    return np.asarray(8.0 * shares @ followed)


def _with_slowing(bound: Tolerance, slowed: float) -> Tolerance:
    """A bound that contains what the strains change of themselves."""
    return replace(
        bound,
        reason=f"{bound.reason}. The answer is linear in the strains e, which slow the spin and "
        "add inertia: 8 e of them, and w t/2 times that, as a part follows each mode",
        more=lambda kn: slowed,
    )


def _quick(p: Parameters, w: float) -> Vector:
    """The damping of each strain (3,) of a spun block, over that of a bar of frequency w [1/s].

    A mode of frequency w_j loses w_j^2 dt t/4 of its amplitude; the largest strain is twice the
    amplitude of a bar.
    """
    shares, squares = exact.spun_modes(**_law(p), spin=p["spin"])
    spun = exact.spinning(_period(p), **_law(p), spin=p["spin"])
    lost = shares @ (squares / w**2) * OUTPUTS * SEEN / 4 / np.abs(spun).max()
    return np.asarray(lost / FIRST)


def _strain_along(
    axis: int, path: Callable[[Vector], Vector], p: Parameters, judge: Exact
) -> Series:
    """The strain along an axis; every error is relative to the largest strain of all."""
    name = f"e_{'xyz'[axis]}"
    period = _period(p)
    return Series(
        name, name, "", f"strain along {name[-1]}",
        lambda run: np.asarray(run.values[STRAIN][:, axis]),
        lambda t: path(t)[:, axis], judge, lambda: float(np.abs(path(period)).max()),
    )  # fmt: skip


def _period(p: Parameters) -> Vector:
    """Times over a period of a bar on its base [s]."""
    w = exact.first(side=p["L"], rho=p["rho"], young=p["E"])
    return np.linspace(0.0, 2 * math.pi, 200) / w


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


def _swing_bounds(quick: float, lowered: float, w: float) -> Exact:
    """quick: damping of all modes over that of the first mode of a bar, of frequency w [1/s].

    lowered: the errors of their phases over that of the same mode.
    """
    step = Tolerance(
        max(5 / STIFF, FIRST * quick * STEPS[0]),
        "DDA's step has the damping ratio w dt/4: an error of (1 - exp(-w dt w t/4))/2 of the "
        "largest strain, 1.2 w dt after a period and a half. The damping of faster modes grows "
        "with the square of their frequency",
        dt=STEPS[0] / w, order=1, floor=5 / STIFF,
    )  # fmt: skip
    second = Tolerance(
        max(5 / STIFF, 2.0 * lowered * STEPS[0] ** 2),
        "the generalised-alpha method lowers the frequency by (w dt)^2/8, a phase error of 1.2 "
        "(w dt)^2 radians over a period and a half, which grows with the cube of the frequency; "
        "the floor is the compliance of the springs at the edges",
        dt=STEPS[0] / w, order=2, floor=5 / STIFF,
    )  # fmt: skip
    return Exact({Method.PENALTY: step, Method.LAGGING: step, Method.DAMPED: second})


def _frequency_bounds(w: float) -> Exact:
    step = Tolerance(
        STEPS[0] ** 2,
        "an error of (w dt)^2; the floor is the compliance of the springs at two edges, 9/16 of E "
        "a b/(L kn)",
        dt=STEPS[0] / w, order=2, floor=1 / STIFF,
    )  # fmt: skip
    return Exact({Method.PENALTY: step, Method.LAGGING: step})


SHORT = (
    "the strain of a column under its own weight rises from zero at the top to rho g L/E at the "
    "foot. Its centroid sinks by rho g L^2/(3 E), a third more than with uniform strain; the "
    "displacement of its top is the same with both"
)
HIGH = (
    "the first mode of the continuum is a quarter of a sine, with pi/sqrt(12) of this frequency; "
    "uniform strain makes a block stiffer, by 10 % in frequency"
)
DAMPED = Exact(
    dict.fromkeys(
        (Method.PENALTY, Method.LAGGING),
        Tolerance(1e-3, "the springs at the edges soften the block by a fraction of 1e-4"),
    ),
    not_judged={
        Method.DAMPED: "this class integrates by another scheme, which the case damped-swing judges"
    },
)
GROWS = "it grows with the step and the frequency: 2.3 % is its value at 14.66 Hz and 1e-3 s"
NO_PULL = "formulations of this class may lack the centrifugal force, the only cause of strain here"
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
