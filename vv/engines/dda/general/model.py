"""Builds the general model of DDA: any blocks and walls, with all their unknowns."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from vv.engines.blocks.checks import size
from vv.engines.blocks.geometry import Shapes, depth_axis, planes, shapes
from vv.engines.dda.formulation import Formulation
from vv.engines.dda.general.unknowns import initial_rates, unknowns_of
from vv.engines.dda.limits import (
    EASED,
    EASING,
    EVENLY,
    FLOAT,
    GOES_ON,
    GRIP,
    HARDER,
    REACH,
    STATIC,
    STATIC_STEPS,
    UNLIKE,
)
from vv.engines.dda.springs import Springs
from vv.engines.dda.stepping import IMPLICIT, Steps
from vv.scene import Block, Scene, Term, Vector


@dataclass(frozen=True, eq=False)
class General:
    """The general model: up to six unknowns for a block in a plane, or twelve in space.

    Locked translations and rotations, and strains of rigid blocks, are not unknowns.
    """

    scene: Scene
    formulation: Formulation

    @property
    def unknowns(self) -> int:
        """The number of unknowns of all blocks."""
        return sum(len(part[0]) for part in self.parts)

    @functools.cached_property
    def parts(self) -> list[tuple[Vector, Vector, Vector]]:
        """The unknowns of each block, as `unknowns_of` returns them."""
        return [unknowns_of(block, self.scene.axes) for block in self.scene.blocks]

    @functools.cached_property
    def shape(self) -> Shapes:
        """The shapes of the blocks."""
        return shapes(self.scene.blocks)

    @property
    def terms(self) -> frozenset[Term]:
        """The terms of the scene, all of which are modelled."""
        return self.scene.terms()

    @property
    def words(self) -> str:
        """The description of the model."""
        blocks, choices = self.scene.blocks, self.formulation
        one = len(blocks) == 1
        shape = ", a prism in a plane" if one else ", prisms in a plane"
        plane = shape if depth_axis(self.scene).any() else ""
        soft = [block for block in blocks if block.strains]
        some = f", {len(soft)} of which deform" if soft else ""
        strains = f" that deform{'s' * one}" if len(soft) == len(blocks) else some
        spins = any(block.free_spin.sum() > 1 for block in blocks)
        torque = ", without gyroscopic torque" if spins and not choices.turns else ""
        turn = any(block.free_spin.any() for block in soft)
        behind = ", strains that do not rotate" if turn and not choices.follow else ""
        whose = "1 block" if one else f"{len(blocks)} blocks"
        return f"{self.unknowns} unknowns of {whose}{strains}{plane}{torque}{behind}"

    def outputs(self, rows: int, watched: tuple[int, ...]) -> tuple[Any, ...]:
        """The arrays that the kernel fills, and the blocks that it observes."""
        energy, report = np.empty((rows, 13)), np.empty((rows, 10))
        return np.empty((rows, len(watched), 21)), energy, report, np.array(watched, np.int64)

    def arguments(self, steps: Steps, law: Springs) -> tuple[Any, ...]:
        """The arguments of the kernel after the outputs."""
        initial = self.pressed(law) if self.formulation.pressed else self.motion()
        return steps, self.setting(self.formulation.dd, law), initial, self.motion()

    def pressed(self, law: Springs) -> Any:
        """The start, with contacts that carry the loads at rest as if friction were unlimited.

        If nothing moves at t = 0, wedges that friction does not hold are then released by `eased`.
        Elastic blocks start unstrained, and are pressed as if rigid, unless all are relaxed.
        """
        start, bodies = self.motion(), self.bodies()
        if all(block.elastic and block.elastic.relaxed for block in self.scene.blocks):
            return self.at_rest(law)._replace(velocity=start.velocity)
        stiff = self.stiff()
        rest = stiff.at_rest(law)
        if self.formulation.eased and self.wedged and not start.velocity.any():
            rest = stiff.eased(rest, law)
        own = np.arange(len(start.strain)) < np.repeat(bodies.strains, np.diff(bodies.start))
        start.strain[own] = rest.strain
        return rest._replace(velocity=start.velocity, strain=start.strain)

    def stiff(self) -> General:
        """The model with rigid blocks in place of elastic ones; itself if there are none."""
        scene = self.scene
        if not any(block.elastic for block in scene.blocks):
            return self
        bodies = (
            dataclasses.replace(body, elastic=None) if isinstance(body, Block) else body
            for body in scene.bodies
        )
        return General(dataclasses.replace(scene, bodies=tuple(bodies)), self.formulation)

    def implicit(self) -> General:
        """The model with the implicit steps of DDA; itself if it has these."""
        if self.formulation.stepping == IMPLICIT:
            return self
        return General(self.scene, dataclasses.replace(self.formulation, stepping=IMPLICIT))

    def at_rest(self, law: Springs) -> Any:
        """The positions in which contacts carry the loads, from a few steps with little inertia.

        Blocks stay in place if one of them is not supported. The first step shows this; further
        ones would move that block through the others.
        """
        gripping, start, end = Springs(law.kn, law.ks, GRIP), self.motion(), self.motion()
        start.velocity[:] = 0.0
        for steps in (1, STATIC_STEPS):
            end = self.settled(start, gripping, STATIC, steps)
            if np.linalg.norm(end.centre - start.centre, axis=1).max() > self.sinks(law):
                return start
        return end

    @property
    def wedged(self) -> bool:
        """Whether no block can rotate and walls have different normals: blocks may be wedged.

        On a single plane the normal forces do not depend on slip; blocks that can rotate would tilt
        by as far as they slide.
        """
        normals = [wall.normal for wall in self.scene.walls]
        unlike = any(np.linalg.norm(np.cross(normals[0], one)) > UNLIKE for one in normals[1:])
        return unlike and not any(block.free_spin.any() for block in self.scene.blocks)

    def eased(self, held: Any, law: Springs) -> Any:
        """The state in which wedges that friction does not hold slide steadily on their springs.

        Without it, tangential springs would accelerate them at t = 0, and a wedge would keep that
        velocity. Blocks slide some tens of times as far as the springs of `held` are compressed.
        Blocks that go on sliding start with springs that are stretched in the direction of their
        slip.
        """
        held.velocity[:] = 0.0
        end, over = held, EASING
        for _ in range(self.formulation.eased):
            one, two, end = (self.settled(held, law, over, n * EASED) for n in (1, 2, 3))
            early, late = two.strain - one.strain, end.strain - two.strain
            whole, over = end.strain - held.strain, HARDER * over
            if np.linalg.norm(late - early) <= EVENLY * np.linalg.norm(whole):
                break
        first = self.bodies().start
        for one in (slice(first[i], first[i + 1]) for i in range(len(self.scene.blocks))):
            if np.linalg.norm(late[one]) > GOES_ON * np.linalg.norm(whole[one]):
                end.strain[one] = late[one]
        return end

    def settled(self, start: Any, law: Springs, over: float, steps: int) -> Any:
        """The end of `steps` steps, each from rest; over: kn over the inertia stiffness."""
        heaviest = max(block.mass for block in self.scene.blocks)
        dt = float(np.sqrt(2 * heaviest * over / law.kn))
        end = self.motion()
        setting = self.implicit().setting(0.0, law)
        self.kernel()(*self.outputs(1, ()), Steps(1, dt, steps), setting, start, end)
        return end

    def sinks(self, law: Springs) -> float:
        """An upper bound, by orders of magnitude, of how far a supported block sinks [m]."""
        bodies = self.bodies()
        loads = np.linalg.norm(bodies.weight + bodies.load, axis=1).sum()
        soft = ((block.elastic, size(block)) for block in self.scene.blocks)
        return float(FLOAT * loads * (1 / law.kn + sum(1 / (e.young * h) for e, h in soft if e)))

    def setting(self, dd: float, law: Springs) -> Any:
        """The constant data as the kernel takes them; dd: see `Formulation`."""
        from vv.engines.dda.general.setting import Choices, Law, Rule, Setting
        from vv.engines.kernels.drive import NO_MOTION, drive, drives

        scene, choices = self.scene, self.formulation
        base, starts = drives(tuple(wall.motion for wall in scene.walls))
        told = Choices(
            choices.tolerance, choices.iterations, choices.newton, choices.multipliers,
            cast(Rule, tuple(choices.stepping)), choices.shaking_at, choices.terms, choices.turns,
            choices.follow, dd,
        )  # fmt: skip
        return Setting(
            bodies=self.bodies(),
            shapes=self.shape,
            moves=np.array([bool(b.free.any() or b.free_spin.any()) for b in scene.blocks]),
            planes=planes(scene),
            depth=depth_axis(scene),
            reach=REACH * float(self.shape.size.min()),
            base=base,
            starts=starts,
            shaking=drive(scene.shaking or NO_MOTION),
            elastic=self.elastic(),
            law=Law(law.kn, law.ks or 0.0, law.mu or 0.0, float(choices.charged)),
            choices=told,
        )

    def bodies(self) -> Any:
        """The unknowns as the kernel takes them."""
        from vv.engines.dda.general.bodies import Bodies

        scene, blocks = self.scene, self.scene.blocks
        parts = self.parts
        mass = np.array([block.mass for block in blocks])
        start = np.cumsum([0, *(len(part[0]) for part in parts)]).astype(np.int64)
        return Bodies(
            start=start,
            line=np.concatenate([part[0] for part in parts]),
            slope=np.concatenate([part[1] for part in parts]),
            strains=start[1:] - np.array([len(block.strains) for block in blocks]),
            mass=mass,
            weight=mass[:, None] * scene.gravity,
            load=np.array([block.load for block in blocks]),
        )

    def elastic(self) -> Vector:
        """The stiffness of strains (q, 12) [N m], in the order of each block's unknowns."""
        whole = np.zeros((self.unknowns, 12))
        first = 0
        for _, _, part in self.parts:
            whole[first : first + len(part), : len(part)] = part
            first += len(part)
        return whole

    def motion(self) -> Any:
        """The motion at the start as the kernel takes it."""
        from vv.engines.dda.general.bodies import Motion

        scene, blocks = self.scene, self.scene.blocks
        shape = self.shape
        centre = np.array([block.centroid() for block in blocks])
        owner = np.repeat(np.arange(len(blocks)), np.diff(shape.vertex_start))
        starts = [initial_rates(b, scene.axes) for b in blocks]
        velocity = np.concatenate(starts)
        second = [0.5 * np.trace(b.inertia) * np.eye(3) - b.inertia for b in blocks]
        vertex = shape.vertex + centre[owner]
        start = (vertex, shape.normal.copy(), centre, 0 * centre)
        return Motion(*start, np.array(second), velocity, 0 * velocity)

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.engines.dda.general.kernel import move_blocks

        return move_blocks

    def watched(self, path: Vector, index: int) -> Vector:
        """Displacement and velocity (k, 6) of the index-th observed block."""
        return np.asarray(path[:, index, :6])

    def strains(self, path: Vector, index: int) -> Vector:
        """Normal strains (k, 3) of the index-th observed block along the scene's axes."""
        tensor = path[:, index, 6:15].reshape(-1, 3, 3)
        return np.asarray(np.einsum("ar,krc,ac->ka", self.scene.axes, tensor, self.scene.axes))

    def locked(self, path: Vector, index: int, block: int, times: Vector) -> tuple[Vector, Vector]:
        """Forces (k, 3) [N] and impulses since t = 0 [N s] of locks of the index-th observed block.

        They balance all other forces on the block, which has number `block` in the scene.
        """
        one, axes = self.scene.blocks[block], self.scene.axes[~self.scene.blocks[block].free]
        steady = one.load + one.mass * self.scene.gravity
        forces = path[:, index, 15:18] + steady
        impulses = path[:, index, 18:21] + np.outer(times, steady)
        return -forces @ axes.T @ axes, -impulses @ axes.T @ axes
