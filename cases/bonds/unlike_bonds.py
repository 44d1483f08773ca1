"""Unlike spheres in a row on unlike bonds: along the row, hung from one, and spinning about it."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from reference_solutions.bonds import unlike_row
from vv.ask import Displacement, History, Knobs, Method, Observable, Reaction
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Quantity,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
    remembered,
)
from vv.scene import Bonds, Contact, Pairs, Scene, Spheres, Vector

X, ACROSS = np.array([1.0, 0.0, 0.0]), np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
PLACE = np.array([0.0, 1.7, 0.8, 2.1])  # m: neither bodies nor bonds are in the row's order
RADIUS = np.array([0.35, 0.15, 0.4, 0.2])  # m
MASS = np.array([2.0, 1.0, 5.0, 3.0])  # of m
KN, KS = np.array([3.0, 1.0, 2.0]), np.array([1.0, 3.0, 2.0])  # of kn and ks
TRIANGLE = np.array([[2, 1], [0, 1], [2, 0]])
LINE = np.array([[2, 0], [2, 1], [3, 1]])
STRETCHED = np.array([1.0, -0.5, -1.5])  # of the stretch
THROWN = np.array([1.0, -2.0, 0.5])  # of v, along the row
ASIDE = np.array([[1.0, 0.0], [0.5, 0.7], [0.0, -1.0], [-1.0, 0.3]])  # of v, across it
SPIN = np.array([1.0, -0.4, 1.3, 2.0])  # of spin


def _row(p: Parameters, bonds: Pairs) -> unlike_row.Row:
    n = int(bonds.max()) + 1
    return unlike_row.Row(p["m"] * MASS[:n], PLACE[:n], bonds, p["kn"] * KN)


def _scene(p: Parameters, row: unlike_row.Row, ks: float, **motion: Any) -> Scene:
    """The row along x; motion: velocity and what is free, or the spin, of its spheres."""
    n, (i, j) = len(row.m), row.bonds.T
    spheres = Spheres(np.outer(row.x, X), radius=RADIUS[:n], mass=row.m, **motion)
    length = np.abs(row.x[j] - row.x[i]) - p["stretch"] * STRETCHED
    bonds = Bonds(row.bonds, length, row.kn, ks * KS)
    return Scene((spheres,), Contact(p["kn"]), p["eta"], gravity=p["g"] * X, bonds=bonds)


def _declare(variant: str, p: Parameters) -> Trial:
    goal = History(p["duration"], p["duration"] / 60)
    if variant == "slowed":
        return _slowed(p, goal)
    if variant != "hung" and p["stretch"]:
        raise ValueError(f"stretch = {p['stretch']!r} m; in the variant '{variant}' it must be 0")
    if p["eta"]:
        raise ValueError(f"eta = {p['eta']!r} N s/m; only the variant 'slowed' has drag")
    return _spinning(p, goal) if variant == "spinning" else _along(p, goal, variant == "hung")


def _along(p: Parameters, goal: History, held: bool) -> Trial:
    """The row of three spheres, each bonded to both others, free to move along the row."""
    row = _row(p, TRIANGLE)
    free, thrown = np.outer(np.ones(3, bool), X > 0), p["v"] * THROWN
    # along the row only: some codes give no reaction of a sphere that is locked in all directions
    if held:
        free[0], thrown[0] = [False, True, False], 0.0
    scene = _scene(p, row, 0.0, velocity=np.outer(thrown, X), free=free)
    assert scene.bonds is not None
    law: dict[str, Any] = {"row": row, "length": scene.bonds.length, "g": p["g"]}
    move: Callable[..., tuple[Vector, Vector]] = functools.partial(
        unlike_row.along, held=held, **law
    )

    def histories(t: Vector, v: Vector) -> Vector:
        return np.column_stack(move(t, v=v))  # displacements of all spheres, then the reaction

    exact, times = remembered(functools.partial(histories, v=thrown)), goal.times(None)
    late = [histories(times, _behind(thrown, free @ X, p, **law))]
    early = [exact(times * (1 + _square(row, p) / 24)), histories(times, _raised(thrown, row, p))]
    judges, moving = _judges(p, exact(times), early, late, AHEAD), range(int(held), 3)
    quantities = _displacements(exact, judges, moving, times)
    seen: tuple[Observable, ...] = (*map(Displacement, moving), *([Reaction(0)] * held))
    if held:
        quantities.append(Series(
            "R", "R", "N", "force that holds the first sphere against its bonds and its weight",
            lambda run: run.values[Reaction(0)] @ X, lambda t: exact(t)[:, 3], judges[3],
        ))  # fmt: skip
    return Trial(Ladder(scene, goal, seen, _levels(p)), tuple(quantities))


def _slowed(p: Parameters, goal: History) -> Trial:
    """The row of three spheres, slowed by drag along the row."""
    if p["g"]:
        raise ValueError(f"g = {p['g']!r} m/s2; the variant 'slowed' has no gravity")
    most = 0.5 * p["m"] / (COARSEST * _unit(p))
    if not p["eta"] < most:
        raise ValueError(
            f"eta = {p['eta']!r} N s/m; it must be below {most:.6g} N s/m, from which on drag "
            "takes half of the lightest sphere's velocity in the coarsest step"
        )
    row, thrown = _row(p, TRIANGLE), p["v"] * THROWN
    free = np.outer(np.ones(3, bool), X > 0)
    scene = _scene(p, row, 0.0, velocity=np.outer(thrown, X), free=free)
    assert scene.bonds is not None
    law: dict[str, Any] = {"length": scene.bonds.length, "eta": p["eta"]}
    move: Callable[..., Vector] = functools.partial(unlike_row.slowed, **law)
    exact, times = remembered(functools.partial(move, row=row, v=thrown)), goal.times(None)
    lighter = dataclasses.replace(row, m=row.m - p["eta"] * COARSEST * _unit(p) / 2)
    late = [
        move(times, row=lighter, v=thrown),  # -eta (v - a dt/2) is drag on a mass m - eta dt/2
        move(times, row=row, v=_behind(thrown, free @ X, p, row=row, **law)),
    ]
    dt = COARSEST * _unit(p)
    leapt = unlike_row.leapt(times, row, length=scene.bonds.length, v=thrown, eta=p["eta"], dt=dt)
    start = thrown - p["eta"] / row.m * dt**2 / 4 * unlike_row.accelerations(
        v=thrown, row=row, **law
    )
    early = [leapt, move(times, row=row, v=start)]
    judges = _judges(p, exact(times), early, late, AHEAD_WITH_DRAG)
    quantities = _displacements(exact, judges, range(3), times)
    seen = tuple(map(Displacement, range(3)))
    return Trial(Ladder(scene, goal, seen, _levels(p)), tuple(quantities))


def _displacements(
    exact: Callable[[Vector], Vector], judges: list[Exact], moving: range, times: Vector
) -> list[Quantity]:
    """The displacements of spheres along the row."""

    def path(body: int) -> Callable[[Vector], Vector]:
        return lambda t: exact(t)[:, body, None]

    return [
        Motion(Displacement(body), X[None], path(body), times, "m").component(
            0, f"x{body}", f"displacement of the sphere {body} along the row", judges[body]
        )
        for body in moving
    ]


def _behind(v: Vector, free: Vector, p: Parameters, **law: Any) -> Vector:
    """The velocities (N,) at t = 0 of a scheme that starts half the coarsest step late."""
    late = free * unlike_row.accelerations(v=v, **law) * COARSEST * _unit(p) / 2
    return np.asarray(v - late)


def _square(row: unlike_row.Row, p: Parameters) -> float:
    """(w dt)^2 of the fastest mode at the coarsest step."""
    return (unlike_row.highest_frequency(row) * COARSEST * _unit(p)) ** 2


def _raised(v: Vector, row: unlike_row.Row, p: Parameters) -> Vector:
    """The velocities (N,) at t = 0 that cause the amplitudes of a leapfrog."""
    return np.asarray(v * (1 + _square(row, p) / 8))


def _judges(
    p: Parameters, known: Vector, early: list[Vector], late: list[Vector], why: str
) -> list[Exact]:
    """The judge of each column of the histories `known` (k, q).

    early: histories (k, q) that differ by what the steps of a leapfrog change, for the reason
    `why`; late: those of bodies on which forces act half the coarsest step late.
    """
    size = np.abs(known).max(axis=0)

    def off(others: list[Vector]) -> Vector:
        total = np.asarray(sum(np.abs(one - known).max(axis=0) for one in others))
        over = np.divide(total, size, out=np.zeros_like(size), where=size > 0)
        return np.asarray(SPARE * over)

    return [
        _judge(COARSEST * _unit(p), why, *both)
        for both in zip(off(early), off(early + late), strict=True)
    ]


def _spinning(p: Parameters, goal: History) -> Trial:
    """A line of four bonded spheres that spin about it and oscillate across it."""
    row, spin, aside = _row(p, LINE), p["spin"] * SPIN, p["v"] * ASIDE
    free = np.ones((4, 3), bool)
    scene = _scene(
        p, row, p["ks"], velocity=aside @ ACROSS, free=free, spin=np.outer(spin, X), free_spin=free
    )
    exact = remembered(
        functools.partial(unlike_row.across, row=row, r=RADIUS, ks=p["ks"] * KS, spin=spin, v=aside)
    )

    def path(body: int) -> Callable[[Vector], Vector]:
        return lambda t: exact(t)[:, body]

    dt, twist = COARSEST * _unit(p), float(np.abs(spin[row.bonds].mean(axis=1)).max())
    turned = twist * max(twist * p["duration"], 1.0) / 2
    radians = FASTEST * p["duration"] / _unit(p)
    ahead = SHARE * (FASTEST * COARSEST) ** 2 / 24 * radians
    judge = _judge(dt, AHEAD, ahead, turned=turned)
    times = goal.times(None)
    quantities = tuple(
        Motion(Displacement(body), ACROSS, path(body), times, "m").component(
            k, f"{'yz'[k]}{body}", f"displacement of the sphere {body} along {'yz'[k]}", judge
        )
        for body in range(4)
        for k in range(2)
    )
    return Trial(Ladder(scene, goal, tuple(map(Displacement, range(4))), _levels(p)), quantities)


def _unit(p: Parameters) -> float:
    """The time in which the lightest sphere advances by a radian on the stiffest spring [s]."""
    return float(np.sqrt(p["m"] / max(p["kn"], p["ks"])))


def _levels(p: Parameters) -> dict[Level, tuple[Knobs, ...]]:
    rungs = tuple(Knobs(COARSEST * _unit(p) / 2**i) for i in range(4))
    return {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}


def _judge(dt: float, why: str, ahead: float, late: float = 0.0, turned: float = 0.0) -> Exact:
    """ahead, late: errors at the coarsest step dt of a leapfrog, as `why` says, and by late forces.

    turned: relative growth of shears that a step rotates to first order, or how far those are off
    that a step rotates half a step late, over the step [1/s].
    """
    exact = Tolerance(1e-11, "the answer is a sum of modes without events, known to rounding")
    second = Tolerance(
        max(ahead, LEAST), why + TURNED,
        dt=dt, order=2, floor=LEAST, late=turned, slack=TURNS_RIGHT if turned else "",
    )  # fmt: skip
    behind = Tolerance(max(late, LEAST), LATE, dt=dt, order=1)
    return Exact({
        Method.EXACT: exact,
        Method.LINEARISED: exact,
        Method.LEAPFROG: second,
        Method.LATE_LEAPFROG: behind if late > ahead else second,
    }, not_judged=dict.fromkeys((Method.SECOND_ORDER, Method.FIRST_ORDER), OTHERS))  # fmt: skip


# across the row: frequency of the fastest oscillation times the unit of time, and its share
FASTEST, SHARE = 2.0, 1 / 3
LEAST, SPARE = 1e-7, 1.2
COARSEST = 0.05  # of the time that `_unit` returns
OTHERS = "the bound is that of the phase of a leapfrog"
AHEAD = (
    "a leapfrog is ahead of each mode by up to (w dt)^2/24 of the time, w of the fastest mode, "
    "which changes the answer by that much, and a velocity at the start causes an amplitude that "
    "is larger by (w dt)^2/8; terms of higher order add less than a fifth"
)
AHEAD_WITH_DRAG = (
    "the central differences of a leapfrog add dt^2/12 (x'''' + 2 eta/m x''') to the equation "
    "and -dt^2/6 x''' to the velocity at the start, which change the answer by that much; a mass "
    "larger by eta dt/2 takes eta dt^2/4m of the acceleration from the velocity of the first half "
    "step. Terms of higher order add less than a fifth"
)
LATE = (
    "weight or drag that acts half a step late is a start with a dt/2 less velocity, and masses "
    "smaller by eta dt/2, which change the answer by that much; the phase of a leapfrog is added, "
    "and less than a fifth for higher orders"
)
TURNED = (
    "; some codes rotate the shear with the twist W of its bond to first order, by which it grows "
    "by (W dt)^2/2 a step, or half a step late, by which it is off by W dt/2"
)
TURNS_RIGHT = (
    "a code that rotates the shear exactly is off by the phase alone, which is small for spheres "
    "that mostly drift"
)
MODES = "M u'' + K u = f, exactly in its modes"
CASE = Case(
    name="unlike-bonds",
    title="Unlike spheres on unlike bonds",
    source=Source(
        "Goldstein (1980), Classical mechanics, 2nd ed., Addison-Wesley",
        "",
        "Chapter 6, small oscillations. Masses, radii, lengths and stiffnesses all differ, and "
        "neither bodies nor bonds are numbered along the row, so that a mix-up of any two is seen. "
        "Spheres that spin about the row rotate the shear of their bonds with the mean of their "
        "spins; the oscillation across the row is small and linear.",
    ),
    parameters=(
        Parameter("m", 1.0, "kg", "mass of the lightest sphere"),
        Parameter("kn", 1e4, "N/m", "stiffness of the softest bond"),
        Parameter("ks", 4e3, "N/m", "shear stiffness of the bond that is softest in shear"),
        Parameter("v", 0.1, "m/s", "speed of the first sphere at the start"),
        Parameter("stretch", 1e-3, "m", "stretch of the first bond at the start"),
        Parameter("g", 9.81, "m/s2", "gravity along the row"),
        Parameter("spin", 5.0, "1/s", "spin of the first sphere about the row"),
        Parameter("eta", 0.0, "N s/m", "drag on every sphere"),
        Parameter("duration", 0.3, "s", "time simulated"),
    ),
    variants=(
        Variant(
            "row", "three spheres, each bonded to both others, free to move along the row", MODES,
            {"g": 0.0, "stretch": 0.0}, frozenset({"ks", "spin"}),
        ),
        Variant(
            "hung", "the same, hung from the first", MODES, inert=frozenset({"ks", "spin"}),
        ),
        Variant(
            "slowed", "three spheres, each bonded to both others, slowed by drag along the row",
            "x' = A x for positions and velocities, x = exp(A t) x(0)",
            {"g": 0.0, "eta": 20.0}, frozenset({"ks", "spin"}),
        ),
        Variant(
            "spinning", "a row of four spheres, each bonded to its neighbours, that spin and "
                        "oscillate sideways",
            "x' = A x for positions, velocities, spins across the row and shears, x = exp(A t) "
            "x(0)",
            {"v": 1e-4, "stretch": 0.0, "g": 0.0}, frozenset({"kn"}),
        ),
    ),
    declare=_declare,
)  # fmt: skip
