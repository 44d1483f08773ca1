"""A loaded block that slips without stopping along a shaking slope, under many drives at once."""

from __future__ import annotations

import numpy as np

from cases._energy_balance import balance
from cases._penalty import levels
from cases._sines import harmonic
from cases.blocks.parts._laden_bounds import DRIFTS, books, rises, slips, speeds
from cases.blocks.parts._laden_drives import STEP, Driven
from reference_solutions.blocks import laden_block
from reference_solutions.contact.shaken_spring import Sine
from vv.ask import Displacement, History, Knobs, Observable, Velocity
from vv.case import (
    Case,
    Ladder,
    Motion,
    Parameter,
    Parameters,
    Source,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Scene, Vector, Wall, box_geometry, polyhedron_inertia

HALF = {"level": 0.5, "turning": 0.1}  # half heights [m]; a plate does not tip
SIDE, DENSITY = 1.0, 2500.0  # m, kg/m3, which do not enter the answer
UP = np.array([0.0, 0.0, 1.0])
HEADING = np.radians(25)  # direction of the slip from x, along no axis of the frame
SAMPLES = 100
FINE = 200.0  # checks of the slip per second: 40 in a cycle of the fastest drive
APART = 1e-10  # gap at t = 0 [m]: too small to be seen, and well above rounding errors
SEEN: tuple[Observable, ...] = (Displacement(1), Velocity(1))


def _axes(p: Parameters) -> Vector:
    """Rows: along the slip, which is level; the wall's normal; and the third."""
    slip = np.array([np.cos(HEADING), np.sin(HEADING), 0.0])
    dip = np.cross(UP, slip)
    alpha = np.radians(p["alpha"])
    normal = np.cos(alpha) * UP + np.sin(alpha) * dip
    return np.stack([slip, normal, np.cross(slip, normal)])


def _sines(p: Parameters) -> tuple[Sine, Sine, Sine, Sine]:
    """The shaking along the slip and the normal, and the motion of the wall along both."""
    turn = 2 * np.pi
    return (
        Sine(p["a"], turn * 2.0, 0.7),
        Sine(0.6 * p["a"], turn * 5.0, -1.9),
        Sine(p["D"], turn * 3.0, 2.4),
        Sine(0.2 * p["D"], turn * 4.0, 1.0),
    )


def _scene(variant: str, p: Parameters) -> Scene:
    """A block on a slope; a load balances the component of its weight down the slope."""
    axes, gravity = _axes(p), -p["g"] * UP
    one, other, slid, lifted = _sines(p)
    half = np.array([SIDE / 2, HALF[variant], SIDE / 2])
    vertices, faces = box_geometry((half[1] + APART) * axes[1], half, axes)
    mass, inertia = polyhedron_inertia(vertices, faces, DENSITY)
    down = gravity @ axes[2] * axes[2]
    rising = lifted.amplitude * lifted.omega * np.cos(lifted.phase)
    block = Block(
        "block", vertices, faces, mass, inertia,
        velocity=p["v"] * axes[0] + rising * axes[1],
        load=mass * (p["push"] * axes[0] - p["press"] * axes[1] - down),
        free=np.ones(3, bool),
        free_spin=np.full(3, variant == "turning"),
    )  # fmt: skip
    wall = Wall(np.zeros(3), axes[1], harmonic({0: slid, 1: lifted}, axes))
    shaking = harmonic({0: one, 1: other}, axes)
    return Scene((wall, block), Contact(np.inf, mu=p["mu"]), gravity=gravity, shaking=shaking)


def _motion(p: Parameters, t: Vector) -> tuple[Vector, Vector]:
    """Displacements and velocities (k, 3) along the axes."""
    found = laden_block.motion(t, v=p["v"], mu=p["mu"], **_drives(p))
    none = np.zeros((len(t), 1))
    place, speed = (np.concatenate([part, none], axis=1) for part in found)
    return place, speed


def _drives(p: Parameters) -> laden_block.Drives:
    """The loads, the shaking and the lift that press and drive the block."""
    one, other, _, lifted = _sines(p)
    pressed = -p["press"] - p["g"] * np.cos(np.radians(p["alpha"]))
    return {"constant": (p["push"], pressed), "shaking": (one, other), "lifting": lifted}


def _check(variant: str, p: Parameters) -> None:
    """Raise ValueError for a block that would stop, lift off or tip."""
    fine = np.linspace(0, p["duration"], 1 + int(np.ceil(FINE * p["duration"])))
    press = laden_block.pressure(fine, **_drives(p))
    past = _motion(p, fine)[1][:, 0] - laden_block.wall_speed(fine, _sines(p)[2])
    for what, left, unit in (("pressure", press, "m/s2"), ("slip", past, "m/s")):
        if not left.min() > 0:
            at = f"{left.min():.6g} {unit} at t = {fine[left.argmin()]:.6g} s"
            raise ValueError(
                f"{what} = {at}; it must stay positive, so that the block presses and "
                "slips all the time"
            )
    if variant == "turning" and not p["mu"] * HALF[variant] < SIDE / 2:
        raise ValueError(f"mu = {p['mu']!r}; the plate would tip")


def _declare(variant: str, p: Parameters) -> Trial:
    goal = History(p["duration"], p["duration"] / SAMPLES)
    axes, times = _axes(p), goal.times(None)
    _check(variant, p)
    way = Motion(SEEN[0], axes, lambda t: _motion(p, t)[0], times, "m")
    speed = Motion(SEEN[1], axes, lambda t: _motion(p, t)[1], times, "m/s")
    mass = 2 * DENSITY * SIDE**2 * HALF[variant]
    late = STEP if variant == "level" else 0.0  # a leapfrog that starts late has no rotations
    by = _driven(p, mass, way.size, speed.size, late)
    _require_closed(by)
    parts = (
        way.component(0, "slip", "displacement along the slip", slips(by)),
        way.component(1, "rise", "displacement along the normal of the slope", rises(by)),
        way.component(2, "drift", "displacement down the slope, which the load prevents", DRIFTS),
        speed.component(0, "slipping", "velocity along the slip", speeds(by, 0)),
        speed.component(1, "rising", "velocity along the normal of the slope", speeds(by, 1)),
        balance(books(by)),
    )
    return Trial(Ladder(_scene(variant, p), goal, SEEN, levels(Knobs(1e-4, 1e9))), parts)


def _require_closed(by: Driven) -> None:
    """Raise ValueError where the oscillation on the softest springs would open the contact."""
    least, swing = float(by.pressed.min()), by.w * by.begins
    if not least > swing:
        raise ValueError(
            f"pressure = {least:.6g} m/s2 at the least; it must be above {swing:.6g} m/s2, by "
            "which the softest springs oscillate, so that they press all the time"
        )


def _driven(p: Parameters, mass: float, way: float, speed: float, late: float) -> Driven:
    """What drives the block, and its accelerations by differences of its velocity."""
    fine = np.linspace(0.0, p["duration"], 1 + int(np.ceil(10 * FINE * p["duration"])))
    drives, (one, other, _, lifted) = _drives(p), _sines(p)
    parts = ((1.0, one), (p["mu"], other), (p["mu"] * lifted.omega**2, lifted))
    parted = [by * of.amplitude * np.sin(of.omega * fine + of.phase) for by, of in parts]
    return Driven(
        times=fine, pressed=laden_block.pressure(fine, **drives), steady=-drives["constant"][1],
        pulled=np.gradient(_motion(p, fine)[1][:, :2], fine, axis=0),
        drives=np.stack(parted, axis=1), mass=mass, mu=p["mu"],
        way=way, speed=speed, gap=APART, late=late,
    )  # fmt: skip


SLIP = (
    "s'' = a_s - mu (D'' - a_n), a the accelerations by weight, load and shaking, D the lift of "
    "the slope"
)
CASE = Case(
    name="laden-block",
    title="A loaded block on a shaking slope",
    source=Source(
        "Newmark (1965), Effects of earthquakes on dams and embankments, Geotechnique 15(2), "
        "139-160",
        "10.1680/geot.1965.15.2.139",
        "The block slips under changing pressure, always in one direction, so that every drive "
        "contributes in closed form: dead load, shaking and a lifting wall, each with a phase.",
    ),
    parameters=(
        Parameter("alpha", 30.0, "deg", "slope"),
        Parameter("mu", 0.3, "", "friction coefficient"),
        Parameter("v", 3.0, "m/s", "initial velocity along the slope, horizontal"),
        Parameter("push", 0.5, "m/s2", "dead load along the slip, over mass"),
        Parameter("press", 2.0, "m/s2", "dead load into the slope, over mass"),
        Parameter("a", 1.5, "m/s2", "amplitude of the shaking along the slip"),
        Parameter("D", 0.02, "m", "amplitude of the slope along the slip"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("duration", 0.5, "s", "time simulated"),
    ),
    variants=(
        Variant("level", "a cube that cannot turn, launched horizontally along the slope", SLIP),
        Variant("turning", "a plate that is free to rotate, but does not", SLIP),
    ),
    declare=_declare,
)  # fmt: skip
