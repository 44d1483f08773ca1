"""Spheres strike a wall along its normal, with losses or without, by Hertz's law or on springs."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np

from cases._energy_balance import balance
from cases.impact.parts._materials import (
    CHUNG_OOI_2011,
    defaults,
    mass,
    moduli,
    require_shallow,
)
from cases.impact.parts._peaks import growth, smooth_maximum
from reference_solutions.impact import hertz, spring, viscous
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Scalar,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Contact, Hertz, Scene, Spheres, Wall

X = np.array([1.0, 0.0, 0.0])
STEPS = (100, 200, 400, 1600)  # in the duration of an impact without losses
LOSSY = 6400  # with losses too, at the finest level: dashpots leave larger errors
SEEN, LASTS = 100, 1.8  # outputs in that duration, and the duration of the run over it
STARTS = 4  # outputs until the step in which contact began no longer shows in the force
RESTITUTIONS = (0.2, 0.4, 0.6, 0.8, 1.0)
QUICK = (0.4, 1.0)


def _elastic(p: Parameters) -> dict[str, float]:
    """m, K and v as `reference_solutions.impact.hertz` takes them."""
    factor = hertz.normal_factor(modulus=moduli(p, 1).modulus, radius=p["R"])
    return {"m": mass(p), "K": factor, "v": p["v"]}


def _spring(p: Parameters) -> float:
    """kn [N/m] of a spring that yields as far as the elastic sphere does, without losses."""
    return float(mass(p) * (p["v"] / hertz.deepest(**_elastic(p))) ** 2)


def _contact(kind: str, p: Parameters) -> Contact:
    """The law, with the damping that leaves the restitution e."""
    if kind == "hertz":
        return Contact(0.0, hertz=Hertz(moduli(p, 1).modulus, damping=viscous.damping(p["e"])))
    kn = _spring(p)
    return Contact(kn, eta_n=2.0 * spring.damping(p["e"]) * math.sqrt(kn * mass(p)))


def _exact_values(kind: str, p: Parameters) -> dict[str, float]:
    """The exact figures by name."""
    if kind == "hertz":
        elastic, z = _elastic(p), viscous.damping(p["e"])
        return {
            "restitution": p["e"],
            "deepest": viscous.deepest(z, **elastic),
            "cleared": viscous.cleared(z, **elastic),
            "force": viscous.largest_force(z, **elastic),
        }
    law = {"m": mass(p), "kn": _spring(p), "z": spring.damping(p["e"])}
    return {
        "restitution": p["e"],
        "deepest": spring.deepest(v=p["v"], **law),
        "cleared": spring.cleared(**law),
        "force": spring.largest_force(v=p["v"], **law),
    }


def _largest_overlap(run: Run) -> float:
    """The largest overlap [m], interpolated by positions and velocities at outputs."""
    from scipy.interpolate import CubicHermiteSpline

    overlap, rate = (-run.values[kind(0)] @ X for kind in (Displacement, Velocity))
    path = CubicHermiteSpline(run.times, overlap, rate)
    return float(path(path.derivative().roots(extrapolate=False)).max(initial=0.0))


def _force(p: Parameters, run: Run) -> float:
    """The largest force [N], from the deceleration of the sphere by fourth-order differences."""
    slowing = growth(run.values[Velocity(0)] @ X, run.times[1])
    return mass(p) * smooth_maximum(slowing[STARTS:])


def _end_of_overlap(run: Run) -> float:
    """The time at which the overlap ends, extrapolated back from the end of the run."""
    way, speed = (float((run.values[kind(0)] @ X)[-1]) for kind in (Displacement, Velocity))
    return float(run.times[-1]) - way / speed if speed > 0 and way > 0 else math.nan


def _scene(kind: str, p: Parameters) -> Scene:
    """The sphere touches the wall at t = 0."""
    sphere = Spheres(
        position=p["R"] * X[None],
        velocity=-p["v"] * X[None],
        radius=np.array([p["R"]]),
        mass=np.array([mass(p)]),
        free=np.array([[True, False, False]]),
    )
    return Scene((sphere, Wall(np.zeros(3), X)), _contact(kind, p))


def _declare(variant: str, p: Parameters) -> Trial:
    kind = variant.partition("-")[0]
    due, unit = _exact_values(kind, p), hertz.contact_time(**_elastic(p))
    require_shallow(due["deepest"], p["R"])
    interval = unit / SEEN
    goal = History(interval * math.ceil(LASTS * due["cleared"] / interval), interval)
    steps = (*STEPS, LOSSY) if p["e"] < 1.0 else STEPS
    rungs = tuple(Knobs(dt=unit / n) for n in steps)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}
    read: dict[str, Callable[[Run], float]] = {
        "restitution": lambda run: float((run.values[Velocity(0)] @ X)[-1]) / p["v"],
        "deepest": _largest_overlap,
        "cleared": _end_of_overlap,
        "force": functools.partial(_force, p),
    }
    z = viscous.damping(p["e"])
    scalars = [
        Scalar(
            name,
            symbol,
            unit_of,
            meaning,
            read[name],
            due[name],
            due[name],
            _judge(unit, z, BETWEEN.get(name, 1e-12)),
        )
        for name, symbol, unit_of, meaning in QUANTITIES
        if name != "force" or p["e"] > SUDDEN[kind]
    ]
    study = Ladder(_scene(kind, p), goal, (Displacement(0), Velocity(0)), levels)
    return Trial(study, (*scalars, _balance(unit)))


def _judge(unit: float, z: float, read: float) -> Exact:
    """unit: duration of an impact without losses [s]; z: damping; read: error of interpolation."""
    dt = unit / STEPS[0]
    return Exact({
        Method.EXACT: Tolerance(read, "events are located to rounding; the error of interpolation "
                                "between outputs remains", slack=BESIDE),
        Method.SECOND_ORDER: Tolerance(
            10.0 / STEPS[0] ** 2,
            "an error of (w dt)^2/24 of the phase, with the largest w of the contact, 1.2 times "
            "pi/tc; as much for the steps in which contact begins and ends; speeds are means of "
            "two steps. The floor is the error of interpolation between outputs",
            dt=dt, order=2, floor=max(read, 1e-6), slack=SYMMETRIC,
        ),
        Method.FIRST_ORDER: Tolerance(
            0.5 * math.pi * max(1.0, 1.2 * math.pi * z**2) / STEPS[0],
            "a viscous force that is half a step late acts as if the mass were smaller by a "
            "fraction z w dt, w up to 1.2 pi/tc: that increases z by half of the fraction, and log "
            "e falls by up to pi times as much",
            dt=dt, order=1,
        ),
    })  # fmt: skip


def _balance(unit: float) -> Scalar:
    step = Tolerance(
        5.0 / STEPS[0] ** 2, "the bound of the path: energy oscillates by (w dt)^2/4 at most",
        dt=unit / STEPS[0], order=2,
    )  # fmt: skip
    exact = Tolerance(1e-12, "one event; only rounding errors remain")
    return balance({Method.EXACT: exact, Method.SECOND_ORDER: step, Method.FIRST_ORDER: step})


BESIDE = "an output may fall close to the largest overlap"
SYMMETRIC = "without losses the impact is symmetric in time, and returns its speed at any phase"
BETWEEN = {"deepest": 1e-8, "force": 2e-6}  # errors of interpolation between outputs
SUDDEN = {"hertz": 0.3, "linear": 0.35}
"""Restitutions up to which a dashpot has its largest force at the start, or too early for outputs:
on a spring at (3 acos z - pi)/(w sqrt(1 - z^2)), within the first six outputs from z = 0.45 on."""
QUANTITIES = (
    ("restitution", "e", "", "speed after the impact over that before"),
    ("deepest", "U_max", "m", "largest overlap"),
    ("cleared", "t0", "s", "time at which the overlap ends, from the position at the end"),
    ("force", "F_max", "N", "largest force, from the deceleration of the sphere"),
)
FORMULAS = {
    "hertz": "m U'' = -max(0, K U^(3/2) + 2 z sqrt(3/2 m K) U^(1/4) U'), K = 4/3 E sqrt(R); "
    "e = exp(-b (pi - 2 asin b)/sqrt(1 - b^2)), b = z sqrt(6/5)",
    "linear": "m U'' = -max(0, kn U + 2 z sqrt(m kn) U'); "
    "e = exp(-z (pi - 2 asin z)/sqrt(1 - z^2))",
}
LAWS = {"hertz": "Hertz and Tsuji", "linear": "a spring and a dashpot"}
NOTE = (
    "The force never pulls, so that contact ends before the overlap does; the damping leaves the "
    "restitution e with this rule. Codes whose contact may pull need less damping for the same e. "
    "The linear spring yields as far as the elastic sphere does without losses. Tests 1 and 2 with "
    "Hertz's law are in the case hertz-impact."
)
CASE = Case(
    name="restitution",
    title="A sphere strikes a wall and loses speed: tests 1 to 3",
    source=Source(CHUNG_OOI_2011.citation, CHUNG_OOI_2011.doi, NOTE),
    parameters=(
        Parameter("young", 380e9, "Pa", "Young's modulus of the sphere"),
        Parameter("poisson", 0.23, "", "Poisson's ratio of the sphere"),
        Parameter("rho", 4000.0, "kg/m3", "density of the sphere"),
        Parameter("R", 0.0025, "m", "radius of the sphere"),
        Parameter("v", 3.9, "m/s", "speed towards the wall"),
        Parameter("e", 1.0, "", "restitution"),
    ),
    variants=(
        *(
            Variant(
                f"{kind}-{e:g}", f"test 3: {LAWS[kind]}, restitution {e:g}", FORMULAS[kind],
                {"e": e}, level=Level.QUICK if e in QUICK else Level.DEFAULT,
            )
            for kind in LAWS
            for e in RESTITUTIONS
        ),
        *(
            Variant(
                f"linear-{stuff}", f"test {test} on springs: {stuff}", FORMULAS["linear"],
                {**defaults(stuff), "R": radius, "v": speed}, level=Level.DEFAULT,
            )
            for test, stuff, radius, speed in (
                (1, "glass", 0.01, 10.0),
                (1, "limestone", 0.01, 10.0),
                (2, "aluminium", 0.1, 0.2),
                (2, "magnesium", 0.1, 0.2),
            )
        ),
    ),
    declare=_declare,
)  # fmt: skip
