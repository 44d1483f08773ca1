"""A prism topples on the edge of another that crosses its own: two edges touch at a point."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from cases.hard.parts._bounced_slip import Held, slipped
from reference_solutions.blocks import toppling
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Sign,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Scene, Vector, polyhedron_inertia, volume_and_centroid

UP = np.array([0.0, 0.0, 1.0])
HEADING = np.radians(20)  # of the lower edge from x
BELOW, ABOVE = (0.5, -0.5), (0.4, 0.6)  # m: half the width and the height of the triangles
LONG = {"lower": 2.0, "upper": 1.5}  # m: lengths of the edges, which cross at their middles
LEAST, STEEP = 30.0, 0.75  # deg, rad: other edges are far, and the lower faces fall by pi/4
APART = 1e-10  # gap at t = 0 [m]: too small to be seen, and well above rounding errors
FACES = ((0, 1, 2), (5, 4, 3), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0))
PRISM = Displacement(1)
# s, N/m and kg/m3: where bounds are stated; springs are as stiff for the mass at all densities
STEP, SPRING, DENSE = 1e-3, 1e8, 2500.0


class _Fall(NamedTuple):
    """How long it falls [s], how it leans in the end [rad], what its centre moves [m], m h^2/I."""

    duration: float
    end: float
    way: float
    share: float
    held: Held


def _prism(along: Vector, length: float, width: float, height: float) -> Vector:
    """Vertices (6, 3) of a prism whose first edge is centred on the origin; its base is level."""
    across = np.cross(UP, along)
    ends = [-length / 2 * along, length / 2 * along]
    base = [height * UP - side * width * across for side in (1, -1)]
    corners = np.array([end + corner for end in ends for corner in (0 * UP, *base)])
    return corners if height > 0 else corners[[0, 2, 1, 3, 5, 4]]


def _turned(vectors: Vector, axis: Vector, angle: float) -> Vector:
    """Vectors (k, 3) turned about an axis (Rodrigues)."""
    along = np.outer(vectors @ axis, axis)
    return along + math.cos(angle) * (vectors - along) + math.sin(angle) * np.cross(axis, vectors)


def _axes(p: Parameters) -> Vector:
    """Rows: along the lower edge, across it and up."""
    along = np.array([np.cos(HEADING), np.sin(HEADING), 0.0])
    return np.stack([along, np.cross(UP, along), UP])


def _scene(p: Parameters) -> tuple[Scene, float, float]:
    """The scene, the height h of the centre over the edge [m], and m h^2/I about the edge."""
    axes = _axes(p)
    own = _turned(axes[:1], UP, np.radians(p["crossing"]))[0]
    upright = _prism(own, LONG["upper"], *ABOVE)
    vertices = _turned(upright, axes[0], p["theta"]) + APART * UP
    mass, inertia = polyhedron_inertia(vertices, FACES, p["rho"])
    height = float(volume_and_centroid(upright, FACES)[1] @ UP)
    below = _prism(axes[0], LONG["lower"], *BELOW)
    none, still = np.zeros(3, bool), np.zeros(3)
    lower = Block("lower", below, FACES, *polyhedron_inertia(below, FACES, p["rho"]),
                  velocity=still, free=none, free_spin=none)  # fmt: skip
    upper = Block("upper", vertices, FACES, mass, inertia, velocity=still, free=~none,
                  free_spin=np.array([True, False, False]))  # fmt: skip
    scene = Scene((lower, upper), Contact(np.inf, mu=p["mu"]), gravity=-p["g"] * UP, axes=axes)
    about = float(axes[0] @ inertia @ axes[0])
    return scene, height, mass * height**2 / (about + mass * height**2)


def _held(p: Parameters, height: float, lam: float) -> Held:
    """The contact of the edges.

    Raises ValueError where other edges or faces touch, or friction does not hold the contact.
    """
    t = np.linspace(0, p["duration"], 401)
    theta = toppling.angle(t, theta0=p["theta"], lam=lam)
    if not (theta[-1] < STEEP and LEAST <= p["crossing"] <= 180 - LEAST):
        raise ValueError(
            f"crossing = {p['crossing']!r} deg, theta = {theta[-1]:.6g} rad at the end; edges "
            f"alone touch from {LEAST} to {180 - LEAST} deg and below {STEEP} rad"
        )
    swing = 2 * lam**2 * (np.cos(p["theta"]) - np.cos(theta))
    along = np.abs(p["g"] * np.sin(theta) - height * lam**2 * np.sin(theta))
    pressed = p["g"] * np.cos(theta) - height * swing
    needed = float((along / pressed).max())
    if not p["mu"] > needed:
        raise ValueError(f"mu = {p['mu']!r}; it must exceed {needed:.6g}, or the edges slip")
    return Held(t, p["mu"] * pressed, along / (p["mu"] * pressed))


def _spring(p: Parameters) -> float:
    """The stiffness [N/m] of springs on which the prism oscillates as one of the usual density."""
    return SPRING * (p["rho"] / DENSE)


def _bounds(
    lam: float, mass: float, weight: float, kn: float, fall: _Fall
) -> dict[Method, Tolerance]:
    """lam: the rate at which it topples [1/s]; mass [kg]; weight [N]; kn [N/m]."""
    turns = Tolerance(
        (lam * STEP) ** 2,
        "an error of (lam dt)^2, lam the rate at which it topples",
        dt=STEP,
        order=2,
    )
    sunk = 2 * weight / (kn * fall.way) * (1 + fall.share * math.sin(fall.end))
    late, w = lam / 4 * _grown(lam * fall.duration), math.sqrt(kn / mass)
    sinks = Tolerance(
        sunk,
        "the prism sinks into its contact spring, which starts slack, and oscillates on it: by "
        "2 m g/kn at most, beside what its centre moves. The force that stops it turns the prism "
        "that leans by theta, by which the centre moves m h^2/I sin(theta) times as far. A step of "
        "first order has the moment of its start, dt/2 too early: it topples at a rate that is "
        "lam^2 dt/4 off, and x = lam t later its centre is off by lam dt/4 times (x cosh x - "
        "sinh x)/(cosh x - 1) of what it moves. While it bounces, friction may not hold the edges, "
        "which slip as a block on a shaken base does, until implicit steps have damped that",
        kn=kn,
        softness=1,
        late=late,
        least=lambda dt: sunk + late * dt + slipped(fall.held, w, dt) / fall.way,
    )  # fmt: skip
    return {
        Method.SECOND_ORDER: turns,
        Method.STRAIGHT: turns,
        Method.FIRST_ORDER: Tolerance(
            lam * STEP / 2 / math.tanh(lam * fall.duration / 2),
            "speeds of the end of a step let it topple half a step too early: after x = lam t that "
            "is lam dt/2 times sinh x/(cosh x - 1) of what its centre moves",
            dt=STEP,
            order=1,
        ),
        Method.PENALTY: sinks,
        Method.LAGGING: sinks,
    }


def _grown(x: float) -> float:
    """(x cosh x - sinh x)/(cosh x - 1), which lies between 2x/3 and x, also where x is rounding."""
    return min(x, max(2 * x / 3, x - (math.sinh(x) - x) / (2 * math.sinh(x / 2) ** 2)))


def _declare(variant: str, p: Parameters) -> Trial:
    scene, height, share = _scene(p)
    lam = math.sqrt(p["g"] / height * share)
    held = _held(p, height, lam)
    goal = History(p["duration"], p["duration"] / 50)

    def path(t: Vector) -> Vector:
        theta = toppling.angle(t, theta0=p["theta"], lam=lam)
        fallen = np.stack([np.zeros_like(theta), -np.sin(theta), np.cos(theta)], axis=1)
        return np.asarray(height * (fallen - fallen[0]))

    motion = Motion(PRISM, scene.axes, path, goal.times(None), "m")
    way = float(np.linalg.norm(path(goal.times(None)), axis=1).max())
    end = float(toppling.angle(p["duration"], theta0=p["theta"], lam=lam))
    mass, fall = scene.blocks[1].mass, _Fall(p["duration"], end, way, share, held)
    bounds = _bounds(lam, mass, mass * p["g"], _spring(p), fall)
    lagging = {} if p == CASE.defaults(variant) else {Method.LAGGING: bounds.pop(Method.LAGGING)}
    judge = Exact(bounds, not_judged=dict.fromkeys(lagging, SLIPS))
    parts = tuple(
        motion.component(i, name, f"displacement of the centre {where}", how)
        for i, (name, where, how) in enumerate(
            (
                ("x", "along the lower edge", ALONG),
                ("y", "across the lower edge", judge),
                ("z", "upwards", judge),
            )
        )
    )
    return Trial(
        Ladder(scene, goal, (PRISM,), _levels(_spring(p))), (*parts, motion.distance(judge))
    )


def _levels(kn: float) -> dict[Level, tuple[Knobs, ...]]:
    rungs = tuple(Knobs(dt, kn) for dt in (STEP, STEP / 2, STEP / 4))
    return {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}


CLASSES = (
    Method.SECOND_ORDER, Method.STRAIGHT, Method.FIRST_ORDER, Method.PENALTY, Method.LAGGING,
)  # fmt: skip
NO_FORCE = "no force acts along the edge: only rounding errors of some hundred steps remain"
SLIPS = (
    "the edges are pressed by less than friction needs whenever the prism bounces on its spring, "
    "and lagging friction then lets them slip, again and again: how far is not bounded"
)
ALONG = Exact(dict.fromkeys(CLASSES, Tolerance(1e-11, NO_FORCE)))
CASE = Case(
    name="knife-edge",
    title="A prism on a knife edge",
    source=Source(
        "Landau and Lifshitz (1976), Mechanics, 3rd edition, Butterworth-Heinemann, section 11",
        "",
        "The pendulum of problem 1, upside down. Two crossed edges touch at a point, which "
        "friction holds in place. The contact normal is perpendicular to both edges and rotates "
        "with the prism.",
    ),
    parameters=(
        Parameter("crossing", 60.0, "deg", "angle between the edges"),
        Parameter("theta", 0.1, "rad", "initial lean of the prism"),
        Parameter("rho", 2500.0, "kg/m3", "density"),
        Parameter("mu", 0.8, "", "friction coefficient"),
        Parameter("g", 9.81, "m/s2", "gravity", Sign.POSITIVE),
        Parameter("duration", 0.5, "s", "time simulated"),
    ),
    variants=(
        Variant(
            "topples", "from rest at a lean of 0.1 rad",
            "sin(theta/2) = sin(theta0/2)/dn(lam t), k = cos(theta0/2), lam^2 = m g h/I",
            inert=frozenset({"rho", "mu"}),
        ),
    ),
    declare=_declare,
)  # fmt: skip
