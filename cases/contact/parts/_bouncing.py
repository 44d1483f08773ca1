"""Scenes, exact paths and steps of spheres that bounce on a floor or on each other."""

from __future__ import annotations

import math

import numpy as np

from reference_solutions.contact import bounce, bouncing_pair
from vv.ask import History
from vv.case import Parameters
from vv.scene import Contact, Scene, Spheres, Vector, Wall, rotated, rotation_about_z

ANGLE = 0.9  # rad; arbitrary, far from every axis and diagonal
GOAL = History(duration=0.036, interval=1e-4)
STIFFEST = 1.5  # shear stiffness over the normal one, up to which contacts decide the step
X, Y, Z = np.eye(3)


def mass_of(p: Parameters, r: float) -> float:
    """The mass [kg] of a sphere of radius r [m]."""
    return float(p["rho"] * 4 / 3 * np.pi * r**3)


def on_floor(p: Parameters, held: bool) -> Scene:
    """A sphere thrown along x over a floor; held: locked along y, in which a load pushes it."""
    r = p["r1"]
    sphere = Spheres(
        position=(r + p["gap"]) * Z[None],
        velocity=(p["v_t"] * X - p["v_n"] * Z)[None],
        radius=np.array([r]),
        mass=np.array([mass_of(p, r)]),
        free=np.array([[True, not held, True]]),
        spin=p["w1"] * Y[None],
        free_spin=np.array([[not held, True, not held]]),
        load=p["load"] * Y[None],
    )
    contact = Contact(p["kn"], p["ks"], p["mu"])
    return Scene((Wall(np.zeros(3), Z), sphere), contact, gravity=-p["g"] * Z)


def pair_scene(p: Parameters) -> Scene:
    """Two free spheres on a line oblique to the frame, which the load presses together."""
    r = np.array([p["r1"], p["r2"]])
    spheres = Spheres(
        position=np.array([np.zeros(3), (r.sum() + p["gap"]) * X]),
        velocity=np.array([np.zeros(3), p["v_t"] * Y - p["v_n"] * X]),
        radius=r,
        mass=np.array([mass_of(p, one) for one in r]),
        free=np.ones((2, 3), bool),
        spin=np.array([p["w1"] * Z, p["w2"] * Z]),
        free_spin=np.ones((2, 3), bool),
        load=np.array([p["load"] * X, -p["load"] * X]),
    )
    scene = Scene((spheres,), Contact(p["kn"], p["ks"], p["mu"]))
    return rotated(scene, rotation_about_z(ANGLE))


def floor_path(p: Parameters, t: Vector) -> Vector:
    """Exact displacements (k, 3) [m] of the sphere on the floor at times t (k,) [s]."""
    same = {name: p[name] for name in ("rho", "kn", "ks", "mu", "g", "gap", "v_n", "v_t")}
    moved = bounce.floor(t, r=p["r1"], w=p["w1"], **same)
    return np.stack([moved[:, 0], np.zeros(len(t)), moved[:, 1]], axis=1)


def pair_path(p: Parameters, body: int, t: Vector) -> Vector:
    """Exact displacements (k, 2) [m] of one of two, along the first line of centres and across it.

    body: 0 or 1. t: (k,) [s].
    """
    return bouncing_pair.pair(t, **{k: v for k, v in p.items() if k != "g"})[:, 2 * body :][:, :2]


def require_shallow(alone: bool, p: Parameters) -> None:
    """Raise ValueError where the first contact overlaps by more than a tenth of the radius."""
    if alone:
        light, pull, small = 1 / mass_of(p, p["r1"]), p["g"], p["r1"]
    else:
        light = 1 / mass_of(p, p["r1"]) + 1 / mass_of(p, p["r2"])
        pull, small = p["load"] * light, min(p["r1"], p["r2"])
    swing = 1 / math.sqrt(p["kn"] * light)  # 1/k
    closing = math.sqrt(max(p["v_n"] ** 2 + 2 * pull * p["gap"], 0.0))
    depth = pull * swing**2 + math.hypot(pull * swing**2, closing * swing)
    if not depth < small / 10:
        raise ValueError(
            f"kn = {p['kn']!r} N/m; the bodies overlap by {depth:.4g} m at most; it must be below "
            f"a tenth of the radius, {small / 10:g} m"
        )


def require_meeting(p: Parameters) -> None:
    """Raise ValueError where two spheres do not meet before the end."""
    pull = p["load"] * (1 / mass_of(p, p["r1"]) + 1 / mass_of(p, p["r2"]))
    closing = math.sqrt(max(p["v_n"] ** 2 + 2 * pull * p["gap"], 0.0))
    if not 2 * p["gap"] < (closing + p["v_n"]) * GOAL.duration:
        raise ValueError(
            f"gap = {p['gap']!r} m, v_n = {p['v_n']!r} m/s; the spheres must meet within "
            f"{GOAL.duration:g} s"
        )


def coarsest_step(usual: float, own: Parameters, alone: bool, p: Parameters) -> float:
    """The coarsest step [s]: `usual` at own parameters, as long a part of a contact elsewhere.

    Shorter where shear springs swing faster than normal ones, and no longer than the interval of
    outputs.
    """

    def lasts(q: Parameters) -> float:
        light = 1 / mass_of(q, q["r1"]) + (0.0 if alone else 1 / mass_of(q, q["r2"]))
        return 1 / math.sqrt(q["kn"] * light)

    stiffest = max(1.0, p["ks"] / (STIFFEST * p["kn"]))
    ratio = lasts(p) / lasts(own) / math.sqrt(stiffest)
    return min(usual * ratio, GOAL.interval)
