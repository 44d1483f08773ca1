"""A block on an incline: gravity, an initial velocity, and Newmark's harmonic accelerations."""

from __future__ import annotations

import functools

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases._penalty import RUNGS, levels
from cases.blocks.parts import _incline_bounds
from cases.blocks.parts._incline_bounds import DENSITY, SIDE
from reference_solutions.blocks import incline
from vv.ask import Displacement, History, Knobs
from vv.case import (
    Case,
    ComponentAlong,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Quantity,
    Series,
    Source,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Harmonic, Scene, Vector, Wall, box_geometry, polyhedron_inertia

FREE, FLAT = "two-directions-turning", 0.2  # a plate [m high] that can turn
FIRST = "gravity-10"  # the variant whose block is listed before its wall
BLOCK = Displacement(1)
STIFFER = Knobs(2.5e-4, 1e9)
# In two directions: only on springs as stiff do shaking across the dip and its frequency, 1 % off,
# exceed the bound of what springs and steps delay; a plate has a spring at each of its corners.
STIFFEST, AT_CORNERS = Knobs(5e-5, 3e9), Knobs(5e-5, 5e9)


def _axes(alpha: float) -> Vector:
    """Rows: down the dip, along the strike, out of the slope; x is horizontal, z up."""
    c, s = np.cos(np.radians(alpha)), np.sin(np.radians(alpha))
    return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])


def _scene(variant: str, p: Parameters) -> Scene:
    """A cube that cannot rotate, or a plate that can, on a plane that dips towards +x."""
    axes = _axes(p["alpha"])
    half = np.array([SIDE, SIDE, FLAT if variant == FREE else SIDE]) / 2
    vertices, faces = box_geometry(half[2] * axes[2], half, axes)
    mass, inertia = polyhedron_inertia(vertices, faces, DENSITY / (2 * half[2]))
    block = Block(
        "block", vertices, faces, mass, inertia,
        velocity=p["v0"] * axes[0],
        free=np.array([True, p["Ay"] > 0, True]),
        free_spin=np.full(3, variant == FREE),
    )  # fmt: skip
    wall = Wall(np.zeros(3), axes[2])
    amplitude, frequency = np.array([p["A"], p["Ay"], 0.0]), np.array([p["f"], p["fy"], 0.0])
    shaking = Harmonic(amplitude, frequency) if amplitude.any() else None
    contact = Contact(np.inf, mu=float(np.tan(np.radians(p["phi"]))))
    gravity = np.array([0.0, 0.0, -p["g"]])
    bodies = (block, wall) if variant == FIRST else (wall, block)
    return Scene(bodies, contact, gravity=gravity, axes=axes, shaking=shaking)


def _declare(variant: str, p: Parameters) -> Trial:
    if not 0 <= p["phi"] < 90:
        raise ValueError(f"phi = {p['phi']!r} deg; a friction angle must be from 0 to below 90")
    if p["Ay"] < 0:
        raise ValueError(f"Ay = {p['Ay']!r} m/s2; an amplitude must be zero or more")
    if variant == FREE and not np.tan(np.radians(p["phi"])) * FLAT < SIDE:
        raise ValueError(f"phi = {p['phi']!r} deg; the plate would tip")
    scene, goal = _scene(variant, p), History(p["duration"], p["duration"] / 400)
    quantities = (_dip_and_strike if p["Ay"] > 0 else _along_dip)(p, scene, goal)
    timed = (RUNGS[0], STIFFER) if variant in ("newmark-30", "two-directions") else ()
    rungs = levels(STIFFER)
    if p["Ay"] > 0:
        stiffest = AT_CORNERS if variant == FREE else STIFFEST
        rungs = {level: (*own, stiffest) for level, own in rungs.items()}
    return Trial(Ladder(scene, goal, _observed(scene), rungs, timed), quantities)


def _observed(scene: Scene) -> tuple[Displacement]:
    """The observable: the displacement of the block, whichever body that is."""
    return (Displacement(scene.body_numbers(Block)[0]),)


def _along_dip(p: Parameters, scene: Scene, goal: History) -> tuple[Quantity, ...]:
    """The motion along the dip."""
    (seen,) = _observed(scene)
    names = ("alpha", "phi", "A", "f", "g", "v0")
    own = any(p == CASE.defaults(one.name) for one in CASE.variants)
    return (
        Series(
            name="d",
            symbol="d",
            unit="m",
            meaning="displacement down the dip",
            observe=ComponentAlong(seen, scene.axes[0]),
            reference=functools.partial(incline.newmark, **{name: p[name] for name in names}),
            judge=_incline_bounds.along_dip(p, own),
            still=_incline_bounds.free_fall(p),
        ),
    )


def _dip_and_strike(p: Parameters, scene: Scene, goal: History) -> tuple[Quantity, ...]:
    """The motion along dip and strike, whose direction rotates."""
    if p["v0"]:
        raise ValueError(
            f"v0 = {p['v0']!r} m/s; a block shaken along the strike too must start at rest"
        )
    drive = {"ax": p["A"], "fx": p["f"], "ay": p["Ay"], "fy": p["fy"]}
    law = {name: p[name] for name in ("alpha", "phi", "g")}

    def path(t: Vector) -> Vector:
        return incline.two_directions(t, **drive, **law)

    motion = Motion(
        BLOCK, scene.axes[:2], path, goal.times(None), "m", _incline_bounds.free_fall(p)
    )
    swept = scene.unknowns() > len(scene.axes)
    along, aside = _incline_bounds.in_two_directions(p, swept, motion.size)
    return (
        motion.component(0, "d", "displacement down the dip", along),
        motion.component(1, "s", "displacement along the strike", aside),
        motion.distance(along),
    )


def _undriven() -> tuple[Variant, ...]:
    """Gravity alone at several friction angles, and a launch."""
    still = {"A": 0.0, "duration": 1.0}
    launched = {**still, "alpha": 45.0, "phi": 20.0}
    undriven = frozenset({"f", "fy"})
    found = [
        Variant(
            f"gravity-{phi}", f"gravity alone, alpha 28, phi {phi}" + BEFORE * (phi == 10), FALL,
            {**still, "phi": phi}, undriven, Level.DEFAULT if phi in (15, 20) else Level.QUICK,
        )
        for phi in (5, 10, 15, 20, 25)
    ]  # fmt: skip
    found += [
        Variant(f"gravity-45-{phi}", f"gravity alone, alpha 45, phi {phi}", FALL,
                {**still, "alpha": 45.0, "phi": phi}, undriven,
                Level.QUICK if phi == 10 else Level.DEFAULT)
        for phi in (10, 20, 30)
    ]  # fmt: skip
    found += [
        Variant(
            f"launch-{v0:g}", f"launched down the dip at {v0:g} m/s", FALL,
            {**launched, "v0": v0}, undriven,
        )
        for v0 in (0.01, 0.1, 1.0)
    ]  # fmt: skip
    return tuple(found)


def _driven() -> tuple[Variant, ...]:
    """Newmark's sine, and two sines at right angles."""
    sine, one_way = {"alpha": 20.0, "A": 5.0}, frozenset({"fy"})
    return (
        *(
            Variant(f"newmark-{phi}", f"horizontal sine, phi {phi}", NEWMARK,
                    {**sine, "phi": phi}, one_way, Level.QUICK if phi == 30 else Level.DEFAULT)
            for phi in (22, 30, 35)
        ),
        Variant("newmark-3d", "horizontal sine on a steep slope", NEWMARK,
                {"alpha": 45.0, "phi": 50.0, "A": 2.0}, one_way, Level.DEFAULT),
        Variant("two-way", "a sine strong enough to drive the block uphill too", NEWMARK,
                {**sine, "phi": 30.0, "A": 20.0}, one_way),
        Variant("two-directions", "a sine along the dip and one along the strike", TURN,
                {"alpha": 45.0, "phi": 50.0, "A": 2.0, "Ay": 1.0, "fy": 2.0, "duration": 6.0}),
        Variant(FREE, "the same for a plate that is free to rotate, but does not", TURN,
                {"alpha": 45.0, "phi": 50.0, "A": 2.0, "Ay": 1.0, "fy": 2.0, "duration": 3.0}),
        Variant("at-yield", "phi = alpha: the velocity touches zero once a cycle", NEWMARK,
                {**sine, "phi": 20.0}, one_way | {"g"}),
    )  # fmt: skip


BEFORE = ", with the block listed before the slope"
FALL = "d = v0 t + (g/2)(sin alpha - cos alpha tan phi) t^2"
NEWMARK = (
    "d'' = g (sin alpha - cos alpha tan phi) + A sin(wt) (cos alpha + sin alpha tan phi) while it "
    "slides down; at rest until A sin(wt) > g tan(phi - alpha)"
)
TURN = (
    "w' = T - F w/|w|, w the slip, T = (g sin alpha + ax cos alpha, ay), "
    "F = tan phi (g cos alpha - ax sin alpha); at rest while |T| <= F"
)
CASE = Case(
    name="incline",
    title="Block on an incline",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Fig. 3 does not give A and f: 5 m/s2 and 1 Hz are chosen. Eq. 8 lacks the term "
        "(A/w)(cos alpha + sin alpha tan phi) t. A block launched horizontally as in Sec. 4.1.2 "
        "would leave the plane: here it is launched down the dip, with phi = 20 chosen. The motion "
        "of Fig. 15 is not given either: two sines are chosen. g = 9.81 m/s2.",
    ),
    parameters=(
        Parameter("alpha", 28.0, "deg", "slope"),
        Parameter("phi", 30.0, "deg", "friction angle"),
        Parameter("A", 5.0, "m/s2", "amplitude of the horizontal acceleration"),
        Parameter("f", 1.0, "Hz", "its frequency"),
        Parameter("Ay", 0.0, "m/s2", "amplitude of the acceleration along the strike"),
        Parameter("fy", 1.0, "Hz", "its frequency"),
        Parameter("v0", 0.0, "m/s", "initial velocity down the dip"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("duration", 5.0, "s", "time simulated"),
    ),
    variants=(*_undriven(), *_driven()),
    declare=_declare,
    published={
        "Fig. 2": "2D-DDA under gravity: relative error 0.05 % at phi = 5, rising to just below "
        "8 % at phi = 25.",
        "Fig. 3": "2D-DDA under the sine: below 1 % most of the time.",
        "Fig. 12": "3D-DDA under gravity at 45 degrees, phi 10, 20 and 30: below 1 % after 0.2 s.",
        "Figs. 13, 14": "3D-DDA: below 1 % after 0.5 s of a launch; below 3 % most of the time "
        "under the sine.",
        "Fig. 15": "3D-DDA under sines in two directions: about 8 % at the end.",
    },
)
