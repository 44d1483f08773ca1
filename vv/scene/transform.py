"""Transforms scenes: rotation, order of bodies, dead loads in place of locks, more shaking."""

import dataclasses

import numpy as np

from vv.scene.arrays import Mask, Vector
from vv.scene.block import Block
from vv.scene.bodies import Harmonic, Pulse, Spheres, Wall
from vv.scene.initial_forces import initial_normal_forces
from vv.scene.scene import Scene
from vv.scene.terms import Term

DRIFT_TOLERANCE = (
    1e-9  # fraction of the largest displacement; rounding causes 1e-11, a wrong reaction far more
)
REST_TOLERANCE = 1e-12  # of a radius; rounding moves a sphere at rest under a dead load by less
Group = Spheres | Wall | Block


def rotation_about_z(angle: float) -> Vector:
    """The (3, 3) rotation by an angle [rad] about z."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def rotated(scene: Scene, rotation: Vector) -> Scene:
    """The whole scene rotated about the origin by a (3, 3) rotation matrix."""
    bodies = tuple(_rotated_group(group, rotation) for group in scene.bodies)
    return dataclasses.replace(
        scene,
        bodies=bodies,
        gravity=rotation @ scene.gravity,
        axes=scene.axes @ rotation.T,
        shaking=_rotated_shaking(scene.shaking, rotation),
    )


def with_shaking_times(scene: Scene, times: float) -> Scene:
    """The scene with all amplitudes of its shaking multiplied; raises ValueError without any."""
    if scene.wave is None:
        raise ValueError("Scene.shaking = None; there is none to be multiplied")
    wave = dataclasses.replace(scene.wave, amplitude=times * scene.wave.amplitude)
    ends = scene.shaking if isinstance(scene.shaking, Pulse) else None
    return dataclasses.replace(
        scene, shaking=dataclasses.replace(ends, wave=wave) if ends else wave
    )


def _rotated_group(group: Group, rotation: Vector) -> Group:
    if isinstance(group, Wall):
        normal = rotation @ group.normal
        return dataclasses.replace(
            group,
            point=rotation @ group.point,
            normal=normal / np.linalg.norm(normal),
            motion=_rotated_motion(group.motion, rotation),
        )
    place = "vertices" if isinstance(group, Block) else "position"
    names = (place, "velocity", "spin", "load")
    turned = {name: getattr(group, name) @ rotation.T for name in names}
    if isinstance(group, Block):
        inertia = rotation @ group.inertia @ rotation.T
        turned["inertia"] = (inertia + inertia.T) / 2
    return dataclasses.replace(group, **turned)


def _rotated_shaking(shaking: Harmonic | Pulse | None, rotation: Vector) -> Harmonic | Pulse | None:
    if isinstance(shaking, Pulse):
        wave = dataclasses.replace(shaking.wave, axes=shaking.wave.axes @ rotation.T)
        return dataclasses.replace(shaking, wave=wave)
    return _rotated_motion(shaking, rotation)


def _rotated_motion(motion: Harmonic | None, rotation: Vector) -> Harmonic | None:
    return motion and dataclasses.replace(motion, axes=motion.axes @ rotation.T)


def with_bodies_reversed(scene: Scene) -> Scene:
    """The scene with its n bodies in reversed order: body i becomes body n - 1 - i."""
    bodies = tuple(
        group.part(slice(None, None, -1)) if isinstance(group, Spheres) else group
        for group in reversed(scene.bodies)
    )
    last = sum(len(group) for group in bodies) - 1
    bonds = scene.bonds and dataclasses.replace(scene.bonds, pairs=last - scene.bonds.pairs)
    return dataclasses.replace(scene, bodies=bodies, bonds=bonds)


def in_frame(axes: Vector, free: Mask) -> Mask | None:
    """The mask (3,) of free frame axes that equals one along `axes` (3, 3); None if none does."""
    among = axes[free].T @ axes[free]
    alone = np.diag(np.diag(among) > 0.5)
    return np.diag(alone) if np.abs(among - alone).max() < 1e-12 else None


def with_loads_for_locks(scene: Scene) -> Scene:
    """The scene with dead loads in place of oblique locks, for codes that lock frame axes only.

    A sphere that is locked along a direction oblique to the frame becomes free there, and gets
    the constant reaction of the lock at t = 0 as a dead load. It stays at rest along that
    direction as long as the other forces do not change, as in contacts of constant overlap.
    Raises ValueError if a sphere moves along such a direction.
    """
    spheres = scene.spheres
    applied = spheres.mass[:, None] * scene.gravity + spheres.load
    if Term.OBLIQUE_LOCK in scene.terms():  # otherwise they are not used below
        applied = applied + initial_normal_forces(scene)
    load, free = spheres.load.copy(), np.array(spheres.free)
    for i in np.flatnonzero(_partly_locked(spheres)):
        locked = scene.axes[~spheres.free[i]]
        held = np.linalg.norm(locked, axis=0) > 1 - 1e-12
        if scene.locked_velocity[i][~held].any():
            raise ValueError(f"Spheres.velocity[{i}] has a part along an oblique locked direction")
        free[i] = ~held
        load[i] -= np.where(held, 0.0, locked.T @ (locked @ applied[i]))
    loose = dataclasses.replace(spheres, free=free, load=load)
    return dataclasses.replace(scene, bodies=_regrouped(scene, loose), axes=np.eye(3))


def spheres_held_by_loads(scene: Scene) -> list[int]:
    """Body numbers of the spheres whose oblique locks `with_loads_for_locks` replaces by loads."""
    if Term.OBLIQUE_LOCK not in scene.terms():
        return []
    partly = _partly_locked(scene.spheres)
    return [body for body, one in zip(scene.body_numbers(Spheres), partly, strict=True) if one]


def why_load_is_no_lock(scene: Scene, sphere: int, moved: Vector) -> str | None:
    """How a sphere moved along a direction in which it should be locked; None if it did not.

    moved: (k, 3) [m], its displacements in a run of `with_loads_for_locks(scene)`.
    """
    free = scene.spheres.free[sphere]
    if not free.any():
        return None
    along = np.abs(moved @ scene.axes.T).max(axis=0)
    away = float(along[~free].max(initial=0.0))
    if not away > max(DRIFT_TOLERANCE * along.max(), REST_TOLERANCE * scene.spheres.radius[sphere]):
        return None
    return (
        f"moved {away:.3g} m along a locked direction, where a constant load replaces the lock: "
        "the forces there did not stay constant"
    )


def why_locks_need_more_than_loads(scene: Scene) -> str | None:
    """Why constant dead loads cannot replace a scene's oblique locks; None if they can.

    The reaction of such a lock varies in time if the body acceleration or the motion of a wall
    has a component along it, or if the body is bonded.
    """
    if scene.bonds is not None and Term.OBLIQUE_LOCK in scene.terms():
        return "a bonded body is locked along a direction oblique to the frame; its pull varies"
    if Term.CARRIED in scene.terms() and Term.OBLIQUE_LOCK in scene.terms():
        return "a body moves along directions it is locked in, and locks are oblique to the frame"
    partly = _partly_locked(scene.spheres)
    locked = scene.axes[(~scene.spheres.free[partly]).any(axis=0)]
    oblique = locked[np.abs(locked).max(axis=1) < 1 - 1e-15]
    drives = (scene.wave, *(wall.motion for wall in scene.walls))
    for amplitude, _, _ in (sine for drive in drives if drive for sine in drive.sines()):
        if np.abs(oblique @ amplitude).max(initial=0.0) > 1e-12 * np.linalg.norm(amplitude):
            return (
                "a body is locked along a direction oblique to the frame, and driven along it; a "
                "dead load, which would stand for the lock, does not vary"
            )
    return None


def _partly_locked(spheres: Spheres) -> Mask:
    return np.asarray(spheres.free.any(axis=1) & ~spheres.free.all(axis=1))


def _regrouped(scene: Scene, spheres: Spheres) -> tuple[Group, ...]:
    """The scene's groups of bodies, with the data of all spheres replaced by those given."""
    bodies: list[Group] = []
    first = 0
    for group in scene.bodies:
        if isinstance(group, Spheres):
            bodies.append(spheres.part(slice(first, first + len(group))))
            first += len(group)
        else:
            bodies.append(group)
    return tuple(bodies)
