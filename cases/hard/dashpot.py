"""A sphere hits a wall, or another one: a spring and a dashpot that never pull."""

from __future__ import annotations

import functools
import math

import numpy as np

from cases._energy_balance import balance
from reference_solutions.contact import dashpot
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    ComponentAlong,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Scalar,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Vector, Wall

RADIUS = 0.1  # m; does not enter the answer
Z, N = np.array([0.0, 0.0, 1.0]), np.array([2.0, -1.0, 2.0]) / 3
RATIO = 3.0  # mass ratio of a pair
RATIOS = (0.0, 0.1, 0.3, 0.6, 0.9, 0.99)
STEPS, LASTS = (0.02, 0.01, 0.005, 0.0025), 4.0  # steps and duration, times w
SEEN = STEPS[-1]  # between outputs, times w


def _scene(p: Parameters) -> Scene:
    """The sphere touches the wall at t = 0; nothing else acts on it."""
    sphere = Spheres(
        position=RADIUS * Z[None],
        velocity=-p["v"] * Z[None],
        radius=np.array([RADIUS]),
        mass=np.array([p["m"]]),
        free=np.array([[False, False, True]]),
    )
    viscous = 2 * p["z"] * math.sqrt(p["kn"] * p["m"])
    return Scene((Wall(np.zeros(3), Z), sphere), Contact(p["kn"], eta_n=viscous))


def _pair(p: Parameters) -> Scene:
    """Two free spheres touch head-on at t = 0, their centre of mass at rest; m is reduced mass."""
    masses = p["m"] * np.array([1 + RATIO, 1 + 1 / RATIO])
    spheres = Spheres(
        position=np.array([0 * N, 2 * RADIUS * N]),
        velocity=p["v"] * np.outer(p["m"] / masses * [1, -1], N),
        radius=np.full(2, RADIUS),
        mass=masses,
        free=np.ones((2, 3), bool),
    )
    viscous = 2 * p["z"] * math.sqrt(p["kn"] * p["m"])
    return Scene((spheres,), Contact(p["kn"], eta_n=viscous))


def _relative_motion(variant: str, kind: type[Displacement] | type[Velocity], run: Run) -> Vector:
    """The relative displacement or velocity (k,) of the bodies along the normal, apart positive."""
    if variant.startswith("pair"):
        return np.asarray((run.values[kind(1)] - run.values[kind(0)]) @ N)
    return np.asarray(run.values[kind(1)] @ Z)


def _declare(variant: str, p: Parameters) -> Trial:
    law = {name: p[name] for name in ("m", "kn", "z")}
    pair = variant.startswith("pair")
    unit, lasting = math.sqrt(p["m"] / p["kn"]), dashpot.contact_time(**law)
    judge = _judge(p["z"], unit, _late_force(p["z"], unit))
    away, speed = (
        functools.partial(_relative_motion, variant, kind) for kind in (Displacement, Velocity)
    )
    returned = Scalar(
        "restitution", "e", "", "speed after the contact over that before",
        lambda run: float(speed(run)[-1]) / p["v"], dashpot.restitution(p["z"]),
        dashpot.restitution(p["z"]), _judge(p["z"], unit, _restitution_bound(p["z"], unit)),
    )  # fmt: skip
    lasted = Scalar(
        "lasting", "tc", "s", "time for which the contact force acts, from the outputs",
        lambda run: _contact_time(run.times, speed(run)), lasting, lasting, _time_bounds(unit),
    )  # fmt: skip
    path = Series(
        "overlap", "u", "m", "overlap, negative after the contact",
        (lambda run: -away(run)) if pair else ComponentAlong(Displacement(1), -Z),
        functools.partial(dashpot.overlap, **law, v=p["v"]), judge,
    )  # fmt: skip
    levels = {
        level: tuple(Knobs(dt=step * unit) for step in steps) for level, steps in RUNGS.items()
    }
    goal = History(LASTS * unit, SEEN * unit)
    scene, bodies = (_pair(p), (0, 1)) if pair else (_scene(p), (1,))
    seen = tuple(kind(body) for kind in (Displacement, Velocity) for body in bodies)
    return Trial(Ladder(scene, goal, seen, levels), (path, returned, lasted, _balance(unit)))


def _contact_time(times: Vector, speed: Vector) -> float:
    """The middle of the last interval in which the speed still changed."""
    changing = np.flatnonzero(np.abs(speed - speed[-1]) > STILL * np.abs(speed).max())
    last = changing[-1:]
    return float(times[last[0] : last[0] + 2].mean()) if len(last) else math.nan


def _judge(z: float, unit: float, first_order: Tolerance) -> Exact:
    """unit: 1/w [s]; errors are relative to the largest height, or to the restitution."""
    step, quick = STEPS[0], 2 * max(z, LIGHT)
    return Exact({
        Method.EXACT: Tolerance(1e-13, "one event, located to rounding"),
        Method.SECOND_ORDER: Tolerance(
            (1 + quick**2) * step**2,
            "an error of (w dt)^2 of the oscillation and of its end; the viscous force changes 2 z "
            "times as fast as the oscillation",
            dt=step * unit, order=2,
        ),
        Method.FIRST_ORDER: first_order,
    })  # fmt: skip


def _late_force(z: float, unit: float) -> Tolerance:
    """For the path, with a viscous force half a step late; unit: 1/w [s]."""
    return Tolerance(
        math.pi / 2 * max(z, LIGHT) * STEPS[0],
        "a viscous force that is half a step late acts as if the mass were m (1 - z w dt): the "
        "contact, which lasts for pi/w at most, is shorter by a fraction z w dt/2",
        dt=STEPS[0] * unit, order=1,
    )  # fmt: skip


def _restitution_bound(z: float, unit: float) -> Tolerance:
    """For the restitution, with the same force; unit: 1/w [s]."""
    step = STEPS[0]
    return Tolerance(
        math.pi / 2 * z**2 * step + step**2,
        "a mass of m (1 - z w dt) increases z by a fraction z w dt/2, and log e falls by at most "
        "pi per unit of z; the oscillation and its end add (w dt)^2",
        dt=step * unit, order=1,
    )  # fmt: skip


def _balance(unit: float) -> Scalar:
    """unit: 1/w [s]."""
    step = Tolerance(
        0.5 * STEPS[0] ** 2,
        "a contact that closes or opens within a step causes an error of up to (w dt)^2/2",
        dt=STEPS[0] * unit, order=2, slack=SPENT,
    )  # fmt: skip
    exact = Tolerance(1e-12, "one event; only rounding errors remain")
    return balance({Method.EXACT: exact, Method.SECOND_ORDER: step, Method.FIRST_ORDER: step})


def _time_bounds(unit: float) -> Exact:
    """unit: 1/w [s]; a contact lasts at least twice as long."""
    seen = "half of the interval between two outputs"
    step = Tolerance(
        STEPS[0], f"{seen}, which is a step, and one more step, since the force ends at the end of "
        "a step",
        dt=STEPS[0] * unit, order=1,
    )  # fmt: skip
    exact = Tolerance(SEEN / 2, f"{seen}")
    return Exact({Method.EXACT: exact, Method.SECOND_ORDER: step, Method.FIRST_ORDER: step})


SPENT = "with strong damping little speed is left when the contact opens"
LIGHT = 0.05  # of critical damping: with less, the bound is that at this value
# of the speed: more than rounding errors, and less than a force changes in an interval
STILL = 1e-10
COARSE = STEPS[:3:2]
RUNGS = {Level.QUICK: COARSE, Level.DEFAULT: (*COARSE, STEPS[3]), Level.PAPER: STEPS}
FORMULA = (
    "m u'' = -max(0, kn u + c u'), c = 2 z sqrt(kn m); e = exp(-z (pi - 2 asin z)/sqrt(1 - z^2)), "
    "tc = (pi - 2 asin z)/sqrt(kn/m (1 - z^2))"
)
CASE = Case(
    name="dashpot",
    title="Restitution of a spring and a dashpot",
    source=Source(
        "Schwager and Poeschel (2007), Coefficient of restitution and linear-dashpot model "
        "revisited, Granular Matter 9(6), 465-469",
        "10.1007/s10035-007-0065-z",
        "The contact ends when its force would pull, before the overlap ends. A code that goes on "
        "to the end of the overlap has a restitution of exp(-pi z/sqrt(1 - z^2)), two billionths "
        "of the right value at z = 0.99.",
    ),
    parameters=(
        Parameter("m", 1.0, "kg", "mass; of a pair, the reduced mass"),
        Parameter("kn", 1e6, "N/m", "contact stiffness"),
        Parameter("z", 0.0, "", "damping over critical damping"),
        Parameter("v", 0.01, "m/s", "speed towards the wall, or each other"),
    ),
    variants=(
        *(
            Variant(
                f"z-{z:g}", f"{z:g} of critical damping" if z else "without damping", FORMULA,
                {"z": z}, level=Level.QUICK if z in (0.0, 0.6, 0.99) else Level.DEFAULT,
            )
            for z in RATIOS
        ),
        Variant(
            "pair-0.6", "two free spheres of mass ratio 3, head-on along no axis of the "
            "frame", FORMULA,
            {"z": 0.6},
        ),
    ),
    declare=_declare,
)  # fmt: skip
