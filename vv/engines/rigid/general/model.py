"""Builds the general model: blocks that translate and rotate, and touch each other and walls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.engines.blocks.geometry import depth_axis, planes, shapes
from vv.engines.rigid.limits import (
    BENDS,
    BORNE,
    CLOSE,
    COARSE,
    CRAWLS,
    FEWEST,
    FINE,
    FINEST,
    LONG,
    LOOSELY,
    MOST,
    SMALL,
    SMALL_MOST,
    TOUCHING,
)
from vv.engines.rigid.scales import Scales, scales, size_of_motion
from vv.scene import Mask, Scene, Term, Vector


@dataclass(frozen=True, eq=False)
class Space:
    """All blocks of a scene with six freedoms each, of which projectors remove the locked ones."""

    scene: Scene

    @property
    def terms(self) -> frozenset[Term]:
        """All terms of the scene."""
        return self.scene.terms()

    @property
    def unknowns(self) -> int:
        """The number of velocities and spins, including locked components."""
        return 6 * len(self.scene.blocks)

    @property
    def closes(self) -> bool:
        """Whether energies balance to rounding: not if inertia turns in the scene's frame."""
        return bool(self._flat or not any(b.free_spin.any() for b in self.scene.blocks))

    @property
    def _flat(self) -> bool:
        return bool(depth_axis(self.scene).any())

    @property
    def words(self) -> str:
        """A description of the model."""
        many = len(self.scene.blocks)
        if many == 1:
            return "1 block that moves and rotates" + (", a prism in a plane" if self._flat else "")
        return f"{many} blocks that move and rotate" + (", prisms in a plane" if self._flat else "")

    def outputs(self, rows: int, watched: tuple[int, ...]) -> tuple[Any, ...]:
        """The arrays that the kernel fills: path, energy, report, reaction, and watched blocks."""
        path = np.empty((rows, len(watched), 9))
        pressed = np.zeros((rows, len(self.scene.blocks) + len(self.scene.walls), 6))
        which = np.array(watched, np.int64)
        return path, np.empty((rows, 8)), np.empty((rows, 4)), pressed, which

    def arguments(self, dt: float) -> tuple[Any, ...]:
        """The arguments of the kernel that describe the scene, for a step dt [s]."""
        from vv.engines.kernels.drive import NO_MOTION, drive, drives
        from vv.engines.rigid.general.many import address
        from vv.engines.rigid.general.setting import Setting

        scene, blocks = self.scene, self.scene.blocks
        hold = np.array([_projector(scene.axes, block.free) for block in blocks])
        mass = np.array([block.mass for block in blocks])
        still = np.zeros((len(scene.walls), 3, 3))
        moving, starts = drives(tuple(wall.motion for wall in scene.walls))
        small, forms, known = len(blocks) <= SMALL, shapes(blocks), scales(scene)
        setting = Setting(
            shapes=forms,
            planes=planes(scene),
            depth=depth_axis(scene),
            moves=np.array([bool(b.free.any() or b.free_spin.any()) for b in blocks]),
            mass=mass,
            inertia=np.array([block.inertia for block in blocks]),
            inverse=np.concatenate([hold / mass[:, None, None], still]),
            hold_spin=np.array([_projector(scene.axes, block.free_spin) for block in blocks]),
            force=np.array([hold[i] @ (b.mass * scene.gravity + b.load)
                            for i, b in enumerate(blocks)]),
            mu=scene.contact.mu,
            slack=(TOUCHING if small else LOOSELY)
            * min(size_of_motion(block, scene.axes) for block in blocks),
            step=dt,
            pull=known.pull,
            braking=known.braking,
            tolerance=FINEST * min(known.speed, known.given + LONG * known.pull * dt)
            if small
            else min(COARSE * known.speed, CRAWLS * known.fall),
            finest=_finest(known, len(blocks)) * dt,
            fewest=0 if small else FEWEST,
            most=SMALL_MOST if small else MOST,
            bends=BENDS if small else 0,
            drives=moving,
            drive_start=starts,
            shaking=drive(scene.shaking or NO_MOTION),
            solver=0 if small else address(),
        )  # fmt: skip
        centre = np.array([block.centroid() for block in blocks])
        velocity = np.array([block.velocity for block in blocks])
        return setting, centre, velocity, np.array([block.spin for block in blocks])

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.engines.rigid.general.kernel import move_rigid

        return move_rigid

    def watched(self, path: Vector, index: int) -> Vector:
        """Displacement, velocity and spin (k, 9) of the block observed as the index-th."""
        return np.asarray(path[:, index])

    def joules(self, energy: Vector) -> Vector:
        """The energies (k, 8) [J], from those of the kernel."""
        return energy

    def newtons(self, reaction: Vector) -> Vector:
        """Forces of the walls on the blocks (k, w, 3) [N]."""
        return np.asarray(-reaction[:, len(self.scene.blocks) :, :3])

    def locked(self, reaction: Vector, block: int, times: Vector) -> tuple[Vector, Vector]:
        """Forces (k, 3) [N] and impulses since t = 0 (k, 3) [N s] of the locks on a block.

        They balance its other forces in the locked directions.
        """
        one = self.scene.blocks[block]
        steady = one.load + one.mass * self.scene.gravity
        locks = _projector(self.scene.axes, one.free) - np.eye(3)
        forces = reaction[:, block, :3] + steady
        return forces @ locks, (reaction[:, block, 3:] + np.outer(times, steady)) @ locks


def _projector(axes: Vector, free: Mask) -> Vector:
    """The projector (3, 3) on the free axes."""
    rows = axes[free]
    return np.asarray(rows.T @ rows)


def _finest(known: Scales, blocks: int) -> float:
    """The smallest residual asked, over the step [m/s2]; no bound for many blocks that move.

    Slip ends at ten times the residual (`least_slip_speed`), which is at most half of what CLOSE
    leaves of it.
    """
    if blocks <= SMALL:
        gripped = 0.05 * CLOSE * known.braking
        return min(FINE * known.weight, gripped) if gripped > 0.0 else FINE * known.weight
    at_rest = known.given == 0.0 and known.pull == known.weight
    return BORNE / blocks * known.weight if at_rest else np.inf
