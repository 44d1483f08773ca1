"""A sphere on springs in a corner whose walls move, and on one wall, with drag and loads."""

from __future__ import annotations

import functools
import math

import numpy as np

from cases._sines import harmonic
from cases.hard.parts import _shaken_bounds
from cases.hard.parts._shaken_bounds import LASTS, RADIUS, SPEED, STEPS
from reference_solutions.contact import shaken_spring
from reference_solutions.contact.shaken_spring import Sine
from vv.ask import Displacement, History, Knobs
from vv.case import (
    Case,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Source,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Vector, Wall

# along no axis of the frame
AXES = np.array([[2.0, 2.0, 1.0], [-2.0, 1.0, 2.0], [1.0, -2.0, 2.0]]) / 3
KS, MU = 0.7, 0.9  # ks/kn on one wall, and friction enough: no contact slips or opens
# along each axis: amplitude over u, omega/w, phase; of the walls, and of the sphere's shaking
MOVED = ((0.10, 0.31, 0.4), (0.08, 0.57, -1.1), (0.12, 0.43, 2.0))
SHAKEN = ((0.05, 0.47, 1.3), (0.06, 0.29, -0.5), (0.04, 0.61, 0.2))
SEEN = 0.2  # time between outputs, times w
RUNGS = {Level.QUICK: STEPS[:3:2], Level.DEFAULT: STEPS[:3], Level.PAPER: STEPS}


def _rate(p: Parameters) -> float:
    """w = sqrt(kn/m) [rad/s]."""
    return math.sqrt(p["kn"] / p["m"])


def _sine(p: Parameters, scale: float, part: tuple[float, float, float]) -> Sine:
    size, ratio, phase = part
    return Sine(size * scale, ratio * _rate(p), phase)


def _drives(variant: str, p: Parameters) -> tuple[dict[int, Sine], dict[int, Sine]]:
    """The motions of the walls [m] and the shaking of the sphere [m/s2], by the axes of each."""
    along = {"corner": (0, 1, 2), "wall": (0, 1), "viscous": ()}[variant]
    shake = p["u"] * _rate(p) ** 2
    moved = {i: _sine(p, p["u"], MOVED[i]) for i in along}
    return moved, {i: _sine(p, shake, SHAKEN[i]) for i in along}


def _scene(variant: str, p: Parameters) -> Scene:
    """The sphere overlaps every wall by u, where weight and load keep it at rest."""
    moved, shaken = _drives(variant, p)
    one = variant == "wall"
    motions = [moved] if one else [{i: moved[i]} if moved else {} for i in range(3)]
    walls = [
        Wall(np.zeros(3), AXES[i], harmonic(motion, AXES) if motion else None)
        for i, motion in enumerate(motions)
    ]
    pressed = -p["kn"] * p["u"] * np.array([1.0, 0.1, 0.0] if one else [1.0, 1.0, 1.0])
    gravity = -p["g"] * np.array([0.0, 0.0, 1.0])
    free = np.array([True, True, not one])
    sphere = Spheres(
        position=((RADIUS - p["u"]) * np.array([1.0, not one, not one]) @ AXES)[None],
        velocity=(p["u"] * _rate(p) * SPEED * free @ AXES)[None],
        radius=np.array([RADIUS]),
        mass=np.array([p["m"]]),
        free=free[None],
        load=(pressed @ AXES - p["m"] * gravity)[None],
    )
    unit = 2 * math.sqrt(p["kn"] * p["m"])
    contact = Contact(p["kn"], KS * p["kn"] if one else 0.0, MU if one else 0.0, p["zn"] * unit)
    shaking = harmonic(shaken, AXES) if shaken else None
    return Scene((*walls, sphere), contact, p["z"] * unit, gravity, AXES, shaking)


def _path(variant: str, p: Parameters, t: Vector) -> Vector:
    """The exact displacements (k, d) along the axes."""
    moved, shaken = _drives(variant, p)
    one, unit = variant == "wall", 2 * math.sqrt(p["kn"] * p["m"])
    columns = [
        shaken_spring.displacement(
            t,
            m=p["m"],
            k=p["kn"] * (KS if one and i else 1.0),
            c=(p["z"] + p["zn"]) * unit,
            v=float(p["u"] * _rate(p) * SPEED[i]),
            force=-0.1 * p["kn"] * p["u"] if one and i else 0.0,
            shaking=[shaken[i]] if shaken else [],
            base=[moved[i]] if moved else [],
        )
        for i in range(2 if one else 3)
    ]
    return np.stack(columns, axis=1)


def _declare(variant: str, p: Parameters) -> Trial:
    if variant != "viscous" and p["zn"]:
        raise ValueError(f"zn = {p['zn']!r}; only the variant 'viscous' has viscous contacts")
    if not p["u"] < RADIUS / 20:
        raise ValueError(
            f"u = {p['u']!r} m; it must be below {RADIUS / 20:g} m, so that overlaps, which reach "
            "twice as much, stay below a tenth of the radius"
        )
    if not p["z"] + p["zn"] < 1:
        raise ValueError(
            f"z + zn = {p['z'] + p['zn']!r}; it must be below 1, so that the sphere oscillates"
        )
    one, unit = variant == "wall", 1 / _rate(p)
    scene, goal = _scene(variant, p), History(LASTS * unit, SEEN * unit)
    seen = Displacement(1) if one else Displacement(3)
    motion = Motion(
        seen, AXES[: 2 if one else 3], functools.partial(_path, variant, p), goal.times(None), "m"
    )
    own, step = p == CASE.defaults(variant), _shaken_bounds.coarsest(p)
    judge = _shaken_bounds.judge(p, unit, step, own)
    parts = [
        motion.component(i, f"q{i + 1}", f"displacement along the {word} axis", judge)
        for i, word in enumerate(("first", "second", "third")[: 2 if one else 3])
    ]
    finer = step / STEPS[0] * unit
    levels = {
        level: tuple(Knobs(dt=one * finer) for one in steps) for level, steps in RUNGS.items()
    }
    distance = motion.distance(_shaken_bounds.judge(p, unit, step, own, len(parts)))
    balance = _shaken_bounds.balance(p, unit, step, own, one)
    return Trial(Ladder(scene, goal, (seen,), levels), (*parts, distance, balance))


FORMULA = (
    "m q'' + c q' + k (q - Q) = F + m a along each axis, Q = A (sin(omega t + phi) - sin phi): "
    "steady motion Im(k A e^{i(omega t + phi)}/(k - m omega^2 + i c omega)) and so on, and a free "
    "oscillation e^{-c t/2m} that meets the initial state"
)
SCALES = frozenset({"m", "kn", "g"})  # all times are in 1/w, and a load makes up for the weight
CASE = Case(
    name="shaken-corner",
    title="A sphere in a shaken corner",
    source=Source(
        "Rao (2011), Mechanical Vibrations, 5th edition, Pearson, chapter 3",
        "",
        "Harmonic force and motion of the base of a damped mass. Between three walls at right "
        "angles one sphere acts as three such masses; every term of a code that is linear acts at "
        "once.",
    ),
    parameters=(
        Parameter("m", 1.0, "kg", "mass"),
        Parameter("kn", 1e6, "N/m", "contact stiffness"),
        Parameter("u", 1e-5, "m", "overlap at rest"),
        Parameter("z", 0.05, "", "drag over critical drag"),
        Parameter("zn", 0.0, "", "viscosity of contacts over the critical one"),
        Parameter("g", 9.81, "m/s2", "gravity, which the load balances"),
    ),
    variants=(
        Variant("corner", "three moving walls, and shaking of the sphere", FORMULA, inert=SCALES),
        Variant("wall", "one wall that moves along its normal and its plane, to which the sphere "
                        "sticks", FORMULA,
                inert=SCALES),
        Variant("viscous", "thrown into three fixed walls with viscous contact", FORMULA,
                {"zn": 0.1}, SCALES),
    ),
    declare=_declare,
)  # fmt: skip
