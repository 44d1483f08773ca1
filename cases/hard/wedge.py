"""A wedge, or a sphere, slides down a groove: the narrower, the harder its sides are pressed."""

from __future__ import annotations

import functools
import math

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from reference_solutions.hard import wedge, wedge_on_springs
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    Case,
    Check,
    ComponentAlong,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Scene, Spheres, Vector, Wall, polyhedron_inertia

WEDGE = Displacement(2)
HALF, DENSITY = 0.5, 2500.0  # m, half of its width on top, height and length; kg/m3
OUTLINE = ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
LAW = ("dip", "xi", "g")
GOAL = History(1.0, 0.02)


def _axes(dip: float) -> Vector:
    """Rows: down the groove, across it, and out of it."""
    i = math.radians(dip)
    return np.array([[math.cos(i), 0, -math.sin(i)], [0, 1, 0], [math.sin(i), 0, math.cos(i)]])


def _friction(p: Parameters) -> float:
    """The friction coefficient that balances the part `held` of the downhill force."""
    return p["held"] * math.tan(math.radians(p["dip"])) / wedge.pressing(p["xi"])


def _scene(p: Parameters) -> Scene:
    """Two walls, and between them a wedge cut off below, so that its size does not depend on xi."""
    axes, h = _axes(p["dip"]), p["xi"] / 2
    foot = HALF - HALF * math.tan(h)
    cut = np.array([[-foot, -HALF], [foot, -HALF], [HALF, 0.0], [-HALF, 0.0]])
    vertices = np.array([along * axes[0] + point @ axes[1:] for along in (HALF, -HALF)
                         for point in cut])  # fmt: skip
    mass, inertia = polyhedron_inertia(vertices, OUTLINE, DENSITY)
    free, still = np.ones(3, bool), np.zeros(3, bool)
    block = Block("wedge", vertices, OUTLINE, mass, inertia, np.zeros(3), free, still)
    walls = [
        Wall(side * HALF * axes[1], -side * math.cos(h) * axes[1] + math.sin(h) * axes[2])
        for side in (1.0, -1.0)
    ]
    gravity = np.array([0.0, 0.0, -p["g"]])
    return Scene((*walls, block), Contact(np.inf, mu=_friction(p)), gravity=gravity, axes=axes)


def _sphere_scene(p: Parameters) -> Scene:
    """A sphere that cannot turn on the same two walls, pressed by N/kn into each."""
    axes, h = _axes(p["dip"]), p["xi"] / 2
    normals = [-side * math.cos(h) * axes[1] + math.sin(h) * axes[2] for side in (1.0, -1.0)]
    pressed = p["m"] * p["g"] * math.cos(math.radians(p["dip"])) / (2 * math.sin(h))
    sphere = Spheres(
        position=((RADIUS - pressed / p["kn"]) / math.sin(h) * axes[2])[None],
        velocity=np.zeros((1, 3)),
        radius=np.array([RADIUS]),
        mass=np.array([p["m"]]),
        free=np.ones((1, 3), bool),
    )
    walls = [Wall(np.zeros(3), normal) for normal in normals]
    contact = Contact(p["kn"], p["kn"], _friction(p))
    return Scene((*walls, sphere), contact, gravity=np.array([0.0, 0.0, -p["g"]]), axes=axes)


def _sphere_trial(p: Parameters) -> Trial:
    """The sphere on springs, with which its exact displacement is known."""
    if not 0 < p["held"] < 1:
        raise ValueError(
            f"held = {p['held']!r}; friction must balance a part of the downhill "
            "force, between 0 and 1"
        )
    scene, law = _sphere_scene(p), {name: p[name] for name in (*LAW, "m")}
    w = math.sqrt(2 * p["kn"] / p["m"])
    s = Series(
        "s", "s", "m", "displacement down the groove",
        ComponentAlong(WEDGE, scene.axes[0]),
        functools.partial(wedge_on_springs.slid, mu=_friction(p), ks=p["kn"], **law),
        _spring_bounds(w), still=0.5 * p["g"] * SECONDS**2,
    )  # fmt: skip
    rungs = tuple(Knobs(dt=angle / w) for angle in ANGLES)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}
    return Trial(Ladder(scene, History(SECONDS, SECONDS / 50), (WEDGE,), levels), (s,))


def _declare(variant: str, p: Parameters) -> Trial:
    if not p["xi"] < math.pi / 2:
        raise ValueError(f"xi = {p['xi']!r} rad; it must be below pi/2, or the wedge has no foot")
    if not 0 <= p["dip"] < 90:
        raise ValueError(
            f"dip = {p['dip']!r} degrees; it must be 0 or more and below 90, or the groove carries "
            "nothing down along its axis"
        )
    if variant == "sphere":
        return _sphere_trial(p)
    if p["held"] == 1:
        raise ValueError(
            f"held = {p['held']!r}; it must differ from 1, where rounding decides whether the "
            "wedge slides"
        )
    scene = _scene(p)
    law = {name: p[name] for name in LAW}
    s = Series(
        name="s",
        symbol="s",
        unit="m",
        meaning="displacement down the groove",
        observe=ComponentAlong(WEDGE, scene.axes[0]),
        reference=functools.partial(wedge.slid, mu=_friction(p), **law),
        judge=_judge(p, p == CASE.defaults(variant)),
        still=0.5 * p["g"] * GOAL.duration**2,
    )
    return Trial(Ladder(scene, GOAL, (WEDGE,), LEVELS), (s,))


def _judge(p: Parameters, own: bool) -> Exact:
    """The bounds of each class of method.

    own: the parameters are the case's, at which codes come closer than they promise.
    """
    rigid = _on_rigid_contact(p, own)
    if p["xi"] < 0.05:
        return Exact(rigid, not_judged={Method.PENALTY: SUNK, Method.LAGGING: SUNK})
    swings = Tolerance(
        5e-4 / p["xi"] ** 2 * max(_left(p), 0.1) ** 2,
        "the wedge sinks by N/(kn sin(xi/2)) and oscillates, and its friction with it. The error "
        "of the displacement grows with the ratio of friction to the downhill force that is left, "
        "and with its square, since the wedge then stops in each oscillation",
        kn=1e9, softness=0.5,
        slack="springs that start charged with the weight neither sink nor oscillate",
    )  # fmt: skip
    if p["held"] > JUST:
        return Exact({**rigid, Method.PENALTY: swings}, not_judged={Method.LAGGING: HELD_BACK})
    lagging = Tolerance(
        6e-2, "friction is that of the previous iteration, while the wedge sinks and oscillates"
    )
    return Exact({**rigid, Method.PENALTY: swings, Method.LAGGING: lagging})


def _left(p: Parameters) -> float:
    """Friction over the downhill force that is left."""
    return p["held"] / (1 - p["held"]) if p["held"] < 1 else 1.0


def _on_rigid_contact(p: Parameters, own: bool) -> dict[Method, Tolerance]:
    """The bounds of methods whose contact is rigid."""
    xi, held, magnified = p["xi"], p["held"], max(_left(p), 1.0)
    driven = max(math.sin(math.radians(p["dip"])) * (1 - held), EPS) if held < 1 else 1.0
    solved = max(2e-12 / xi, 1e-11) * magnified
    second = Tolerance(
        (solved if own else max(solved, SOLVED / driven)) + EPS / xi**2 * magnified,
        "constant forces are integrated exactly; contacts are solved to 1e-12 m/s, and at other "
        "parameters to 2e-11 of the velocity that weight gains in a step, which adds up to that "
        "part of g, over the acceleration that remains; a narrow groove magnifies residuals by "
        "1/sin(xi/2); rounding of the force on a side, W/(2 sin(xi/2)), moves the wedge sideways, "
        "and 1/sin(xi/2) times as far out of the groove; rounding of the displacement adds 1e-11",
        slack="a wedge in the middle of its groove is rounded alike on both sides",
    )
    return {
        Method.EXACT: Tolerance(1e-12, "the answer is a parabola, exact to rounding"),
        Method.SECOND_ORDER: second,
        Method.STRAIGHT: second,
        Method.FIRST_ORDER: Tolerance(
            1e-2,
            "a start half a step late is an error of dt/2 in a second; twice that is allowed",
            dt=1e-2,
            order=1,
            slack="forces are constant: a scheme that starts in time has rounding errors only",
        ),
    }


# of the downhill force: with more friction than that, lagging friction holds the wedge back
JUST = 0.6
HELD_BACK = "friction of the previous iteration stops a wedge that oscillates and should slide"


def _spring_bounds(w: float) -> Exact:
    """w: frequency of the oscillation on the shear springs [1/s]."""
    coarsest = ANGLES[0] / w
    return Exact({
        Method.EXACT: Tolerance(1e-12, "one event, located to rounding"),
        Method.SECOND_ORDER: Tolerance(
            ANGLES[0] ** 2 / 4 * 2 / (w * SECONDS),
            "slip begins within a step, which changes its initial speed by a fraction of (w dt)^2; "
            "that speed causes 2/(w T) of the displacement",
            dt=coarsest, order=2,
        ),
        Method.FIRST_ORDER: Tolerance(
            2 * coarsest / SECONDS, "weight acts half a step late, an error of dt over the 0.1 s "
            "of the run; twice that is allowed",
            dt=coarsest, order=1,
        ),
    })  # fmt: skip


EPS = float(np.finfo(float).eps)
SOLVED = 2e-11  # residual of contacts over the velocity that weight gains in a step
RADIUS, ANGLES = 0.5, (0.2, 0.1, 0.05)  # m, which does not enter the answer; steps times w
SECONDS = 0.1
SUNK = "springs let the wedge sink by W/(4 kn sin^2(xi/2)): it falls through a narrow groove"
RUNGS = (Knobs(1e-2, 1e9), Knobs(5e-3, 1e9), Knobs(5e-3, 1e10), Knobs(2.5e-3, 1e10))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS[:3], Level.PAPER: RUNGS}
FORMULA = "s'' = g (sin i - mu cos i/sin(xi/2)), N = W cos i/(2 sin(xi/2))"
CASE = Case(
    name="wedge",
    title="A wedge in a narrow groove",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Only gravity acts. The opening angle is chosen, and friction such that half of the "
        "downhill force remains. The wedge cannot rotate.",
    ),
    parameters=(
        Parameter("dip", 30.0, "degrees", "inclination of the groove"),
        Parameter("xi", 1.0, "rad", "angle between the sides of the groove"),
        Parameter("held", 0.5, "", "fraction of the downhill force that friction balances"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("m", 1000.0, "kg", "mass of the sphere"),
        Parameter("kn", 1e9, "N/m", "stiffness of its contacts, along and across"),
    ),
    variants=(
        *(Variant(f"xi-{xi:g}", f"sides that open by {xi:g} rad", FORMULA, {"xi": xi},
                frozenset({"xi", "m", "kn"}), Level.QUICK if xi in (1.0, 1e-6) else Level.DEFAULT)
          for xi in (1.0, 0.1, 0.01, 1e-6)),
        Variant(
            "sphere", "a sphere that cannot rotate, on springs along and across both sides",
            "m s'' = m g sin i - 2 ks s until ks s = mu N, then constant; N as above; ks = kn",
            inert=frozenset({"xi"}),
        ),
    ),
    declare=_declare,
    # at 1e-6 rad the residual of impulses changes by 5e-7 with processors that fuse products
    enforced=frozenset(Check) - {Check.REGRESSION},
)  # fmt: skip
