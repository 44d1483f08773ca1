"""The reasons why dem cannot solve an ask, and why its step is too large to be stable."""

from __future__ import annotations

import math

import numpy as np

from vv.ask import Ask, Reaction
from vv.engines.dem.critical_step import critical_step, highest_delay
from vv.engines.dem.idle import why_left_out
from vv.engines.dem.leapfrog import CENTRED, Leapfrog
from vv.engines.dem.safe_step import PACKED
from vv.scene import Scene
from vv.scene.scene import LOCKED_SPEED
from vv.standins.stand_in import spring_scene
from vv.standins.stand_in import why_no_spring_scene as why_not_rigid


def refuses(ask: Ask) -> str | None:
    """Why the ask cannot be solved as it stands; None if it can."""
    dt, goal = ask.knobs.dt, ask.goal
    if dt is None:
        return "Knobs.dt is None; an explicit scheme needs a step"
    if goal.steps(dt) == 0:
        return f"dt = {dt!r} s leaves no step in History.duration = {goal.duration!r} s"
    reason = why_not_rigid(ask)
    if reason is not None:
        return reason
    scene = spring_scene(ask).scene
    return (
        _spins_where_locked(scene)
        or _coincident(scene)
        or _unknown_reaction(ask, scene)
        or _reversed_viscous_force(scene, dt)
        or why_left_out(scene, wants_all(ask))
    )


def wants_all(ask: Ask) -> bool:
    """Whether the ask needs the general model, which alone has all energies and reactions."""
    return bool(ask.energies) or any(isinstance(what, Reaction) for what in ask.observables)


def unstable(ask: Ask, leapfrog: Leapfrog) -> str | None:
    """Why the step of an ask is too large, with the largest stable step and its rule; else None.

    Such an ask may still be solved, to see the instability.
    """
    dt = ask.knobs.dt
    limit = critical_step(spring_scene(ask).scene, leapfrog)
    if dt is None or dt <= limit:
        return None
    late = (ask.scene.eta > 0 or ask.scene.contact.viscous) and leapfrog.lag > 0.5
    rule = "2 (sqrt(n^2 + w^2) - n)/w^2, n = eta/2m + eta_n/kn w^2/2" if late else "2/w"
    return (
        f"dt = {dt:.6g} s is beyond the largest stable step {limit:.6g} s = {rule}, w the highest "
        f"frequency of its contacts; {PACKED * limit:.3g} s is stable however equal spheres touch"
    )


def _spins_where_locked(scene: Scene) -> str | None:
    spheres = scene.spheres
    parts = spheres.spin @ scene.axes.T
    size = np.abs(parts).max(axis=1, keepdims=True, initial=0.0)
    for i, axis in np.argwhere(~spheres.free_spin & (np.abs(parts) > LOCKED_SPEED * size))[:1]:
        along = f"{parts[i, axis]:.6g} 1/s along a locked axis"
        return f"Spheres.spin[{i}] has {along}; a locked body must not turn there"
    return None


def _coincident(scene: Scene) -> str | None:
    position = scene.spheres.position
    order = np.lexsort(position.T)
    same = np.flatnonzero(~np.diff(position[order], axis=0).any(axis=1))
    if len(same):
        first, second = np.sort(order[same[0] : same[0] + 2])
        return (
            f"spheres {first} and {second} have the same centre, so that their contact has no "
            "normal"
        )
    return None


def _reversed_viscous_force(scene: Scene, dt: float) -> str | None:
    """Why the step is refused where it would reverse a viscous force within half a step.

    The force would then alternate, and create energy.
    """
    ratio = highest_delay(scene) if scene.contact.viscous else 0.0
    longest = 0.5 / ratio * critical_step(scene, CENTRED) ** 2 if ratio else math.inf
    if dt <= longest:
        return None
    return (
        f"dt = {dt:.6g} s is beyond {longest:.6g} s = 2 kn/(eta_n w^2), in half of which a "
        "viscous contact stops an approach; w is the highest frequency of its contacts"
    )


def _unknown_reaction(ask: Ask, scene: Scene) -> str | None:
    """Why a reaction is refused: forces on bodies at rest are summed in one common row."""
    for what in ask.observables:
        if isinstance(what, Reaction):
            i = scene.sphere_index(what.body)
            moving = scene.spheres.free[i].any() or scene.spheres.free_spin[i].any()
            if not (moving or scene.locked_velocity[i].any()):
                return f"the reaction on body {what.body}, which cannot move, is not modelled"
    return None
