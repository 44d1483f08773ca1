"""A sphere that cannot turn skids over a wall and leaves it: friction while pressure changes."""

from __future__ import annotations

import functools
import math

import numpy as np

from cases._energy_balance import balance
from reference_solutions.contact import skid
from vv.ask import Displacement, History, Knobs, Method, Observable, Velocity
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Vector, Wall

RADIUS = 0.1  # m; does not enter the answer
AXES = np.array([[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]]) / 3  # across, along, locked
STEPS, LASTS, SEEN = (0.1, 0.05, 0.025, 0.0125), 4.0, 0.1  # steps, duration and outputs, times w
LAW = ("m", "kn", "ks", "mu", "vn", "vt")


def _scene(p: Parameters) -> Scene:
    """The sphere touches the wall at t = 0; nothing else acts on it."""
    sphere = Spheres(
        position=RADIUS * AXES[:1],
        velocity=np.array([[-p["vn"], p["vt"], 0.0]]) @ AXES,
        radius=np.array([RADIUS]),
        mass=np.array([p["m"]]),
        free=np.array([[True, True, False]]),
    )
    contact = Contact(p["kn"], p["ks"], p["mu"])
    return Scene((Wall(np.zeros(3), AXES[0]), sphere), contact, axes=AXES)


def _declare(variant: str, p: Parameters) -> Trial:
    law, unit = {name: p[name] for name in LAW}, math.sqrt(p["m"] / p["kn"])
    if not p["vn"] * unit < RADIUS / 10:
        raise ValueError(
            f"vn = {p['vn']!r} m/s, kn = {p['kn']!r} N/m; the sphere would sink by "
            f"{p['vn'] * unit:.6g} m; it must be below a tenth of the radius, {RADIUS / 10:g} m"
        )
    goal = History(LASTS * unit, SEEN * unit)

    def answer(which: int, t: Vector) -> Vector:
        return skid.motion(t, **law)[which]

    seen: tuple[Observable, ...] = (Displacement(1), Velocity(1))
    judge = _judge(unit)
    motions = [
        Motion(what, AXES[:2], functools.partial(answer, i), goal.times(None), size)
        for i, (what, size) in enumerate(zip(seen, ("m", "m/s"), strict=True))
    ]
    parts = [
        motion.component(k, f"{name}_{where}", f"{meaning} {where} the wall", judge)
        for motion, name, meaning in zip(motions, "dv", ("displacement", "velocity"), strict=True)
        for k, where in enumerate(("across", "along"))
    ]
    levels = {
        level: tuple(Knobs(dt=step * unit) for step in STEPS[:rungs])
        for level, rungs in ((Level.QUICK, 2), (Level.DEFAULT, 3), (Level.PAPER, 4))
    }
    return Trial(Ladder(_scene(p), goal, seen, levels), (*parts, balance(judge.tolerances)))


def _judge(unit: float) -> Exact:
    """unit: 1/w [s]."""
    coarsest = STEPS[0]
    return Exact({
        Method.EXACT: Tolerance(1e-12, "two events, located to rounding"),
        Method.SECOND_ORDER: Tolerance(
            coarsest**2 / 5,
            "an error of (w dt)^2/24 in the phase of half an oscillation; the contact opens within "
            "a step, which changes the force there by a fraction of (w dt)^2/2",
            dt=coarsest * unit, order=2,
        ),
    })  # fmt: skip


CASE = Case(
    name="skid",
    title="A sphere that skids",
    source=Source(
        "Walton (1993), Numerical simulation of inclined chute flows of monodisperse, inelastic, "
        "frictional spheres, Mechanics of Materials 16, 239-247",
        "10.1016/0167-6636(93)90048-V",
        "If slip lasts throughout the contact, the tangential impulse is mu times the normal one. "
        "The sphere does not rotate and kn has no losses: its normal velocity is reversed, and "
        "its tangential velocity is reduced.",
    ),
    parameters=(
        Parameter("m", 1.0, "kg", "mass"),
        Parameter("kn", 1e6, "N/m", "contact stiffness"),
        Parameter("ks", 8e5, "N/m", "shear stiffness"),
        Parameter("mu", 0.4, "", "friction coefficient"),
        Parameter("vn", 0.01, "m/s", "speed towards the wall"),
        Parameter("vt", 0.02, "m/s", "speed along the wall"),
    ),
    variants=(
        Variant("wall", "oblique to the frame, slip throughout",
                "q'' = -mu kn U/m, U = vn/w sin(wt); it leaves with vt - 2 mu vn",
                inert=frozenset({"ks"})),
    ),
    declare=_declare,
)  # fmt: skip
