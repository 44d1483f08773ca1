"""A block on an incline: gravity, an initial velocity, and Newmark's harmonic accelerations."""

from __future__ import annotations

import functools

import numpy as np

from reference_solutions import incline
from vv.ask import Displacement, History, Knobs, Method, Run
from vv.block import box_geometry, polyhedron_inertia
from vv.case import (
    Case,
    Exact,
    Parameter,
    Parameters,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Harmonic, Scene, Vector, Wall
from vv.study import Ladder, Level

SIDE, DENSITY = 1.0, 2500.0  # m, kg/m3: a cube; neither enters the answer
BLOCK = Displacement(1)
X = np.array([1.0, 0.0, 0.0])


def _axes(alpha: float) -> Vector:
    """Rows: down the dip, along the strike, out of the slope; x is horizontal, z up."""
    c, s = np.cos(np.radians(alpha)), np.sin(np.radians(alpha))
    return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])


def _scene(p: Parameters) -> Scene:
    """A cube on a plane that falls towards +x; it cannot turn."""
    axes = _axes(p["alpha"])
    vertices, faces = box_geometry(SIDE / 2 * axes[2], np.full(3, SIDE / 2), axes)
    mass, inertia = polyhedron_inertia(vertices, faces, DENSITY)
    block = Block(
        "block", vertices, faces, mass, inertia,
        velocity=p["v0"] * axes[0],
        free=np.array([True, False, True]),
        free_spin=np.zeros(3, bool),
    )  # fmt: skip
    wall = Wall(np.zeros(3), axes[2])
    shaking = Harmonic(p["A"] * X, p["f"] * X) if p["A"] > 0 else None
    contact = Contact(np.inf, mu=float(np.tan(np.radians(p["phi"]))))
    gravity = np.array([0.0, 0.0, -p["g"]])
    return Scene((wall, block), contact, gravity=gravity, axes=axes, shaking=shaking)


def _along(run: Run, axis: Vector) -> Vector:
    return run.values[BLOCK] @ axis


def _declare(variant: str, p: Parameters) -> Trial:
    scene = _scene(p)
    names = ("alpha", "phi", "A", "f", "g", "v0")
    d = Series(
        name="d",
        symbol="d",
        unit="m",
        meaning="displacement down the dip",
        observe=functools.partial(_along, axis=scene.axes[0]),
        reference=functools.partial(incline.newmark, **{name: p[name] for name in names}),
        judge=Exact(TOLERANCES),
    )
    goal = History(p["duration"], p["duration"] / 400)
    return Trial(Ladder(scene, goal, (BLOCK,), LEVELS), (d,))


RUNGS = tuple(
    Knobs(dt, kn)
    for kn, steps in (
        (1e8, (1e-3, 5e-4, 2.5e-4)),
        (1e9, (1e-3, 5e-4, 2.5e-4)),
        (1e10, (5e-4, 2.5e-4, 1.25e-4)),
    )
    for dt in steps
)
LEVELS = {
    Level.QUICK: (RUNGS[3], RUNGS[5]),
    Level.DEFAULT: RUNGS,
    Level.PAPER: RUNGS,
}
TOLERANCES = {
    Method.EXACT: Tolerance(
        1e-12,
        "rounding of a few hundred located events",
        slack="gravity alone has no event, the sine has one or two a cycle; one bound serves all",
    ),
    Method.SECOND_ORDER: Tolerance(
        5e-5,
        "the trapezoidal rule integrates gravity exactly and the sine to (w dt)^2/12 a cycle; "
        "events are located within the step",
        dt=1e-3,
        order=2,
        floor=1e-7,
    ),
    Method.PENALTY: Tolerance(
        0.1,
        "the contact's springs yield by m g/kn and its shear spring slips late, whatever the step",
    ),
}


def _variants() -> tuple[Variant, ...]:
    """Gravity at several friction angles, a launch, and Newmark's sine."""
    still = {"A": 0.0, "duration": 1.0}
    launched = {**still, "alpha": 45.0, "phi": 20.0}
    sine = {"alpha": 20.0, "A": 5.0}
    found = [
        Variant(
            f"gravity-{phi}", f"gravity alone, alpha 28, phi {phi}", FALL, {**still, "phi": phi}
        )
        for phi in (5, 10, 15, 20, 25)
    ]
    found += [
        Variant(f"gravity-45-{phi}", f"gravity alone, alpha 45, phi {phi}", FALL,
                {**still, "alpha": 45.0, "phi": phi})
        for phi in (10, 20, 30)
    ]  # fmt: skip
    found += [
        Variant(
            f"launch-{v0:g}", f"thrown down the dip at {v0:g} m/s", FALL, {**launched, "v0": v0}
        )
        for v0 in (0.01, 0.1, 1.0)
    ]
    found += [
        Variant(f"newmark-{phi}", f"horizontal sine, phi {phi}", NEWMARK, {**sine, "phi": phi})
        for phi in (22, 30, 35)
    ]
    return (
        *found,
        Variant("newmark-3d", "horizontal sine on a steep slope", NEWMARK,
                {"alpha": 45.0, "phi": 50.0, "A": 2.0}),
        Variant("two-way", "a sine strong enough to drive the block uphill too", NEWMARK,
                {**sine, "phi": 30.0, "A": 20.0}),
        Variant("at-yield", "phi = alpha: the velocity touches zero once a cycle", NEWMARK,
                {**sine, "phi": 20.0}),
    )  # fmt: skip


FALL = "d = v0 t + (g/2)(sin alpha - cos alpha tan phi) t^2"
NEWMARK = (
    "d'' = g (sin alpha - cos alpha tan phi) + A sin(wt) (cos alpha + sin alpha tan phi) while it "
    "slides down; at rest until A sin(wt) > g tan(phi - alpha)"
)
CASE = Case(
    name="incline",
    title="Block on an incline",
    source=Source(
        "Yagoda-Biran and Hatzor (2016), Benchmarking the numerical Discontinuous Deformation "
        "Analysis method, Computers and Geotechnics 71, 30-46",
        "",
        "A and f of Fig. 3 are not given: A = 5 m/s2 and 1 Hz are chosen. Eq. 8 lacks "
        "(A/w)(cos alpha + sin alpha tan phi) t. The horizontal launch of Sec. 4.1.2 would leave "
        "the plane: the velocity is taken down the dip, with phi = 20 chosen. g = 9.81 m/s2.",
    ),
    parameters=(
        Parameter("alpha", 28.0, "deg", "slope"),
        Parameter("phi", 30.0, "deg", "friction angle"),
        Parameter("A", 5.0, "m/s2", "amplitude of the horizontal acceleration"),
        Parameter("f", 1.0, "Hz", "its frequency"),
        Parameter("v0", 0.0, "m/s", "initial velocity down the dip"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("duration", 5.0, "s", "time simulated"),
    ),
    variants=_variants(),
    declare=_declare,
    published={
        "Fig. 2": "2D-DDA under gravity: relative error 0.05 % at phi = 5, rising to just below "
        "8 % at phi = 25.",
        "Fig. 3": "2D-DDA under the sine: below 1 % most of the time.",
        "Figs. 13, 14": "3D-DDA: below 1 % after 0.5 s of a launch; below 3 % most of the time "
        "under the sine.",
    },
)
