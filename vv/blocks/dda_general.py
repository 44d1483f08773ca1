"""Builds the general model of DDA: any blocks and walls, with all the unknowns they have."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.blocks.dda_formulation import Formulation
from vv.blocks.dda_limits import FLOAT, GRIP, REACH, STATIC, STATIC_STEPS
from vv.blocks.dda_springs import Springs
from vv.blocks.dda_unknowns import columns, rates
from vv.blocks.geometry import depth_axis, planes, shapes
from vv.scene import Scene, Term, Vector

BODIES, ENDS = 4, 6  # where these stand in what the kernel is told


@dataclass(frozen=True, eq=False)
class General:
    """Any number of blocks and walls, with six unknowns a block in a plane, or twelve in space.

    Locked translations and rotations, and strains that a formulation leaves out, are no unknowns.
    """

    scene: Scene
    formulation: Formulation

    @property
    def unknowns(self) -> int:
        """Columns that the kernel is given."""
        return sum(len(columns(b, self.scene.axes, self.formulation)[0]) for b in self.scene.blocks)

    @property
    def terms(self) -> frozenset[Term]:
        """What the kernel is given of the scene."""
        return self.scene.terms()

    @property
    def words(self) -> str:
        """The model in words."""
        plane = ", prisms in a plane" if depth_axis(self.scene).any() else ""
        strains = "" if self.formulation.elastic is None else " that deform"
        spins = any(block.free_spin.sum() > 1 for block in self.scene.blocks)
        torque = ", without gyroscopic torque" if spins and not self.formulation.turns else ""
        count = len(self.scene.blocks)
        return f"{self.unknowns} unknowns of {count} blocks{strains}{plane}{torque}"

    def outputs(self, rows: int, watched: tuple[int, ...]) -> tuple[Any, ...]:
        """What the kernel fills first, and the blocks it watches."""
        energy, report = np.empty((rows, 13)), np.empty((rows, 9))
        return np.empty((rows, len(watched), 6)), energy, report, np.array(watched, np.int64)

    def arguments(self, step: tuple[Any, ...], law: Springs) -> tuple[Any, ...]:
        """What the kernel is told; step: stride, dt, settling, tolerance, iterations."""
        begun = self.pressed(law, step[-2:]) if self.formulation.pressed else self.motion()
        return (*step, *self.told(begun, self.formulation.dd, law))

    def pressed(self, law: Springs, rule: tuple[Any, ...]) -> Any:
        """The start once contacts carry the loads at rest, as if no friction were exceeded.

        A few steps so long that inertia is next to nothing take it there. Blocks stay as they
        are if one of them rests on nothing. rule: when an iteration ends.
        """
        start, moving = self.motion(), self.motion().velocity
        heaviest = max(block.mass for block in self.scene.blocks)
        slow = float(np.sqrt(2 * heaviest * STATIC / law.kn))
        start.velocity[:] = 0.0
        gripping = Springs(law.kn, law.ks, GRIP)
        told = self.told(start, 0.0, gripping)
        self.kernel()(*self.outputs(1, ()), 1, slow, STATIC_STEPS, *rule, *told)
        end, bodies = told[ENDS], told[BODIES]
        end.velocity[:] = start.velocity[:] = moving
        most = np.linalg.norm(bodies.weight + bodies.load, axis=1).sum() / law.kn
        far = np.linalg.norm(end.centre - start.centre, axis=1).max()
        return end if far <= FLOAT * most else start

    def told(self, begun: Any, dd: float, law: Springs) -> tuple[Any, ...]:
        """What the kernel is told after the step."""
        from vv.drive import NO_MOTION, drive, drives

        scene, blocks, way = self.scene, self.scene.blocks, self.formulation
        base, starts = drives(tuple(wall.motion for wall in scene.walls))
        shape = shapes(blocks)
        return (
            way.terms,
            way.turns,
            dd,
            float(self.formulation.charged),
            self.bodies(),
            begun,
            self.motion(),
            shape,
            np.array([bool(b.free.any() or b.free_spin.any()) for b in blocks]),
            planes(scene),
            base,
            starts,
            drive(scene.shaking or NO_MOTION),
            depth_axis(scene),
            REACH * float(shape.size.min()),
            law.kn,
            law.ks or 0.0,
            law.mu or 0.0,
            self.elastic(),
        )

    def bodies(self) -> Any:
        """The unknowns as the kernel receives them."""
        from vv.blocks.dda_bodies import Bodies

        scene, blocks = self.scene, self.scene.blocks
        parts = [columns(block, scene.axes, self.formulation) for block in blocks]
        mass = np.array([block.mass for block in blocks])
        return Bodies(
            start=np.cumsum([0, *(len(part[0]) for part in parts)]).astype(np.int64),
            line=np.concatenate([part[0] for part in parts]),
            slope=np.concatenate([part[1] for part in parts]),
            mass=mass,
            weight=mass[:, None] * scene.gravity,
            load=np.array([block.load for block in blocks]),
        )

    def elastic(self) -> Vector:
        """The stiffness of strains (q, 12) [N m], in the order of each block's unknowns."""
        whole = np.zeros((self.unknowns, 12))
        first = 0
        for block in self.scene.blocks:
            part = columns(block, self.scene.axes, self.formulation)[2]
            whole[first : first + len(part), : len(part)] = part
            first += len(part)
        return whole

    def motion(self) -> Any:
        """The start as the kernel receives it."""
        from vv.blocks.dda_bodies import Motion

        scene, blocks = self.scene, self.scene.blocks
        shape = shapes(blocks)
        centre = np.array([block.centroid() for block in blocks])
        owner = np.repeat(np.arange(len(blocks)), np.diff(shape.vertex_start))
        starts = [rates(b, scene.axes, self.formulation) for b in blocks]
        velocity = np.concatenate(starts)
        second = [0.5 * np.trace(b.inertia) * np.eye(3) - b.inertia for b in blocks]
        vertex = shape.vertex + centre[owner]
        start = (vertex, shape.normal.copy(), centre, np.array(second), velocity, 0 * velocity)
        return Motion(*start)

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.blocks.dda_kernel import move_blocks

        return move_blocks

    def watched(self, path: Vector, index: int) -> Vector:
        """Displacement and velocity (k, 6) of the block observed as the index-th."""
        return np.asarray(path[:, index])
