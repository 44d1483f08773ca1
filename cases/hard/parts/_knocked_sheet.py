"""Energies of a knocked sheet of spheres: observed, reported by codes, and their bounds."""

from __future__ import annotations

import functools

import numpy as np

from vv.ask import Displacement, Method, Run, Velocity
from vv.case import Exact, Judge, Parameters, Quantity, Scalar, Shown, Tolerance
from vv.scene import Form, Scene, Vector

RADIUS = 0.05  # m; enters the moment of inertia
FIRST = 3  # walls stand before the spheres
STEPS = (2e-4, 1e-4, 5e-5)  # s; the fastest oscillation has a period of about 2e-3 s
HELD = (Form.KINETIC, Form.NORMAL, Form.SHEAR, Form.GRAVITY)
LOST = Form.FRICTION
REPORTED = (*HELD, LOST)
BOTH = Method.SECOND_ORDER, Method.FIRST_ORDER
OPENS = 0.8  # v/w over the least overlap: at 0.95 a contact opened in one of 107 sheets drawn
NOTHING = Exact(dict.fromkeys(BOTH, Tolerance(
    1e-12, "friction dissipates a positive amount or nothing in each step: only rounding is left"
)))  # fmt: skip
LEFT = Shown(
    "the energy dissipated depends on every single slip; codes may be compared with each other"
)


def observed_energies(scene: Scene, p: Parameters, gains: Judge) -> tuple[Quantity, ...]:
    """Shear springs and spins are not observed: energy that they return counts as a gain.

    gains: how these are judged.
    """
    initial, held = _initial_energy(scene, p), functools.partial(observed_energy, scene)
    return (
        Scalar(
            "gained", "max(E(t) - E(s))", "J",
            "largest increase, since any earlier time s, of kinetic energy, potential energy and "
            "energy of normal springs together", lambda run: _rise(held(run)),
            0.0, initial, gains,
        ),
        Scalar(
            "above", "max(E(t) - E(0))", "J", "largest rise of that energy above its initial "
            "value, when shear springs and spins hold none",
            lambda run: float((held(run) - held(run)[0]).max()), 0.0, initial, _excess_bounds(p),
        ),
        Scalar(
            "left", "E - Er", "J",
            "mean of that energy over the second half of the run, above that of the sheet at rest",
            lambda run: float(held(run)[len(run.times) // 2 :].mean() - held(run)[0]) + initial,
            None, initial, LEFT,
        ),
    )  # fmt: skip


def _excess_bounds(p: Parameters) -> Exact:
    """The bound of a leapfrog, with the highest frequency of a sheet, w^2 = 6 kn/m."""
    second = Tolerance(
        float(6.0 * p["kn"] / p["m"] * STEPS[0] ** 2 / 8),
        "friction only dissipates energy; the energy of a leapfrog at whole steps oscillates by a "
        "relative (w dt)^2/8",
        dt=STEPS[0], order=2,
        slack="where friction takes more than the oscillation gives, the energy never rises above "
        "its first value: the error is nil",
    )  # fmt: skip
    return Exact(dict.fromkeys(BOTH, second))


def require_closed(scene: Scene, p: Parameters) -> None:
    """Refuse a sheet in which contacts open, since their energy depends on when in a step they do.

    A sphere moves by v/w against a spring kn, w^2 = kn/m; two that part do so by little more, as
    each has several springs.
    """
    least = float(np.concatenate(_overlaps(scene, scene.spheres.position[None]), axis=1).min())
    moved = p["v"] / np.sqrt(p["kn"] / p["m"])
    if not moved <= OPENS * least:
        raise ValueError(
            f"v = {p['v']!r} m/s; contacts open, by about v/sqrt(kn/m) = {moved:.3g} m: the least "
            f"overlap at rest must be {1 / OPENS:g} times as large at least, and is {least:.3g} m"
        )


def reported_energies(scene: Scene, p: Parameters) -> tuple[Quantity, ...]:
    """All energy, as the code reports it: friction only dissipates, so no loss hides a gain."""
    initial = _initial_energy(scene, p)
    return (
        Scalar(
            "gained", "max(E(t) - E(s))", "J",
            "largest increase, since any earlier time s, of all stored energy",
            lambda run: _rise(sum((run.energies[form] for form in HELD), np.zeros(1))),
            0.0, initial, _gain_bounds(p),
        ),
        Scalar(
            "returned", "max(Q(s) - Q(t))", "J",
            "largest decrease, since any earlier time s, of the energy dissipated by friction",
            lambda run: _rise(-run.energies[LOST]), 0.0, initial, NOTHING,
        ),
    )  # fmt: skip


def _gain_bounds(p: Parameters) -> Exact:
    """The part of a leapfrog's oscillation of energy, see `_excess_bounds`, that it does not count.

    The energy counted, m v- v+/2 plus that of springs, is constant for constant springs. Normals
    rotate by up to v/w over the distance 2 r of centres, w^2 = kn/m, and change them by as much.
    """
    w = np.sqrt(p["kn"] / p["m"])
    value = float(6.0 * (w * STEPS[0]) ** 2 / 8 * p["v"] / w / (2.0 * RADIUS))
    why = (
        "no contact opens, and a leapfrog conserves m v- v+/2 plus the energy of closed springs, "
        "except that normals rotate, by v/(2 r w) in an oscillation: this part of (w dt)^2/8"
    )
    return Exact({
        method: Tolerance(max(value, 1e-12), why, dt=STEPS[0], order=order)
        for method, order in ((Method.SECOND_ORDER, 2), (Method.FIRST_ORDER, 1))
    })  # fmt: skip


def _initial_energy(scene: Scene, p: Parameters) -> float:
    """The kinetic energy at the start [J]."""
    return float(0.5 * p["m"] * p["v"] ** 2 * len(scene.spheres))


def _rise(energy: Vector) -> float:
    """The largest increase of a history (k,) above any of its earlier values."""
    return float((energy - np.minimum.accumulate(energy)).max())


def observed_energy(scene: Scene, run: Run) -> Vector:
    """Translational kinetic energy, potential of gravity and normal springs, (k,) [J]."""
    spheres, law = scene.spheres, scene.contact
    bodies = range(FIRST, FIRST + len(spheres))
    u = np.stack([run.values[Displacement(body)] for body in bodies], axis=1)
    v = np.stack([run.values[Velocity(body)] for body in bodies], axis=1)
    overlaps = _overlaps(scene, spheres.position + u)
    springs = 0.5 * law.kn * sum((np.maximum(o, 0.0) ** 2).sum(axis=1) for o in overlaps)
    motion = 0.5 * (spheres.mass * (v**2).sum(axis=2)).sum(axis=1)
    return np.asarray(motion + springs - u @ scene.gravity @ spheres.mass)


def _overlaps(scene: Scene, x: Vector) -> list[Vector]:
    """Overlaps [m] of neighbours in the sheet, and with each wall, (k, pairs) at centres (k, n, 3).

    Neighbours are at most a tenth of a radius apart at t = 0.
    """
    spheres, (i, j) = scene.spheres, np.triu_indices(len(scene.spheres), 1)
    reach = spheres.radius[i] + spheres.radius[j]
    start = spheres.position
    near = reach - np.linalg.norm(start[j] - start[i], axis=1) > -0.1 * RADIUS
    i, j, reach = i[near], j[near], reach[near]
    found = [reach - np.linalg.norm(x[:, j] - x[:, i], axis=2)]
    for wall in scene.walls:
        beside = spheres.radius - (start - wall.point) @ wall.normal > -0.1 * RADIUS
        found.append(spheres.radius[beside] - (x[:, beside] - wall.point) @ wall.normal)
    return found
