"""Solves an ask about rigid blocks with exact Coulomb friction: from the ask to its run."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.ask import Ask, Displacement, Impulse, Ledger, Model, Reaction, Run, Status
from vv.engines.blocks.checks import (
    block_index,
    moves_where_locked,
    overlaps,
    strained,
    undetermined,
    unsupported,
)
from vv.engines.rigid.general.model import Space
from vv.engines.rigid.limits import CONVERGED
from vv.engines.rigid.point.model import Point, point
from vv.engines.rigid.scales import scales
from vv.scene import Vector

LEDGER = (
    "kinetic",
    "friction dissipation",
    "impact dissipation",
    "base potential",
    "shaking potential",
    "potential of gravity and loads",
    "taken by removal of penetration",
    "taken by rotation of lever arms",
)
SIGNS = np.array([1.0, 1.0, 1.0, -1.0, -1.0, -1.0, 1.0, 1.0])
EPS = float(np.finfo(float).eps)
ROUNDINGS = 64  # allowed per step, in units of eps times the peak energy


@dataclass(frozen=True, eq=False)
class PreparedRigidBlocks:
    """An ask that is prepared to be solved as often as wanted: a `vv.codes.timing.Prepared`.

    system: the smallest model of its scene.
    """

    ask: Ask
    system: Point | Space

    @property
    def model(self) -> Model:
        """The model that was built."""
        return Model(self.system.unknowns, self.system.terms, self.system.words)

    @functools.cached_property
    def arguments(self) -> tuple[Any, ...]:
        """The arguments of the kernel: output arrays, stride, dt, and the scene."""
        goal, dt = self.ask.goal, self.ask.dt
        outputs = self.system.outputs(len(goal.times(dt)), self.watched)
        return (*outputs, goal.stride(dt), dt, *self.system.arguments(dt))

    @functools.cached_property
    def watched(self) -> tuple[int, ...]:
        """The observed blocks; raises ValueError for a body that is no block."""
        return tuple(block_index(self.ask.scene, what.body) for what in self.ask.observables)

    def warm(self) -> None:
        """Load or compile the kernel for these arguments; no step is taken."""
        path, energy, report, reaction, *rest = self.arguments
        self.system.kernel()(path[:1], energy[:1], report[:1], reaction[:1], *rest)

    def solve(self) -> int:
        """Run the kernel over all steps; returns the number of valid rows of the outputs."""
        return self.system.kernel()(*self.arguments)

    @property
    def energies(self) -> Vector:
        """The ledger's terms (k, 8) [J] over time, whose sum is constant, after a solve."""
        return np.asarray(self.system.joules(self.arguments[1]) * SIGNS + 0.0)

    @property
    def report(self) -> Vector:
        """Rows (k, 4) of residual [m/s], sweeps, deepest penetration [m] and divisions of steps."""
        return np.asarray(self.arguments[2])

    @property
    def reactions(self) -> Vector:
        """Forces (k, w, 3) of the walls on the blocks [N] over time, after a solve."""
        return self.system.newtons(self.arguments[3])

    def run(self, rows: int) -> Run:
        """The run of a solve that returned `rows` valid rows; its cost is left empty."""
        goal, dt, path = self.ask.goal, self.ask.dt, self.arguments[0]
        whole = rows == len(path)
        values = {}
        for index, what in enumerate(self.ask.observables):
            moved = self.system.watched(path[:rows], index)
            values[what] = moved[:, :3] if isinstance(what, Displacement) else moved[:, 3:6]
            if isinstance(what, Reaction | Impulse) and isinstance(self.system, Space):
                acted, times = self.arguments[3][:rows], goal.times(dt)[:rows]
                forces, impulses = self.system.locked(acted, self.watched[index], times)
                values[what] = forces if isinstance(what, Reaction) else impulses
        model, steps = self.model, goal.stride(dt) * (rows - 1 if whole else rows)
        return Run(
            status=Status.RAN if whole else Status.DIVERGED,
            reason="" if whole else f"by step {steps}: the state is not finite",
            times=goal.times(dt)[:rows],
            values=values,
            steps=steps,
            model=Model(model.unknowns, model.terms, f"{model.note}; {self._worst(rows)}"),
            ledger=self._ledger() if whole else None,
        )

    def _worst(self, rows: int) -> str:
        report = self.report[: rows + 1]  # including the row in which it diverged
        residual, sweeps, deepest, _ = report.max(axis=0)
        cuts = report[:, 3].sum()
        return (
            f"worst step: residual {residual:.3g} m/s after {sweeps:.0f} sweeps, penetration "
            f"{deepest:.3g} m; {cuts:.0f} divisions of steps at landings and ends of slip"
        )

    def _ledger(self) -> Ledger:
        terms, steps = self.energies, self.ask.goal.steps(self.ask.dt) + 1
        put_in, largest = float(terms[0].sum()), float(np.abs(terms).sum(axis=1).max())
        rounding = ROUNDINGS * EPS * steps * max(largest, self._balanced())
        unaccounted = float(np.abs(terms.sum(axis=1) - put_in).max())
        residual = float(self.report[:, 0].max())
        audits = {"residual of contact [m/s]": (residual, CONVERGED * scales(self.ask.scene).speed)}
        left = self._left_by_contacts()
        if left > 0.0 and self.system.closes:  # residuals exchange energy between terms
            audits["energy beyond rounding [J]"] = (unaccounted, rounding + self._left_in_motion())
        if isinstance(self.system, Point):
            lost = np.diff(terms[:, 1] + terms[:, 2])
            audits["energy created [J]"] = (float(-lost.clip(max=0.0).sum()), rounding)
        return Ledger(
            terms=dict(zip(LEDGER, terms[-1].tolist(), strict=True)),
            unaccounted=unaccounted,
            peak=max(put_in, float(terms[:, 0].max())),
            bound=rounding + left if self.system.closes else None,
            audits=audits,
        )

    def _balanced(self) -> float:
        """The kinetic energy [J] that weights and loads give in a step and contacts take back."""
        mass = sum(block.mass for block in self.ask.scene.blocks)
        return 0.5 * mass * (scales(self.ask.scene).weight * self.ask.dt) ** 2

    def _left_by_contacts(self) -> float:
        """A bound on the energy [J] exchanged by contacts because of their residual velocities.

        It is the sum of forces times residuals times the output interval. For one block all forces
        are those of walls; those between blocks are not recorded, and the bound is then zero.
        """
        if len(self.ask.scene.blocks) > 1:
            return 0.0
        pressed = np.linalg.norm(self.reactions, axis=2).max(axis=0).sum()
        return float(pressed * self.report[:, 0].sum() * self.ask.goal.interval)

    def _left_in_motion(self) -> float:
        """The kinetic energy [J] that residual velocities may change: momentum times their sum.

        The works of contacts on both sides of a groove cancel, but not the velocity along it that
        the rounding of their impulses leaves.
        """
        (block,) = self.ask.scene.blocks
        momentum = math.sqrt(2 * block.mass * float(self.energies[:, 0].max()))
        return momentum * float(self.report[:, 0].sum())


def prepare(ask: Ask) -> PreparedRigidBlocks:
    """The prepared ask, with the smallest model that its scene allows."""
    held = any(isinstance(what, Reaction | Impulse) for what in ask.observables)
    return PreparedRigidBlocks(ask, (None if held else point(ask.scene)) or Space(ask.scene))


def solve(ask: Ask) -> Run:
    """Solve an ask once, without its cost; the run is refused if `refuses` gives a reason."""
    reason = refuses(ask)
    if reason is not None:
        return Run(Status.REFUSED, reason)
    program = prepare(ask)
    return program.run(program.solve())


def refuses(ask: Ask) -> str | None:
    """Why an ask cannot be solved; None if it can."""
    dt, goal, scene = ask.knobs.dt, ask.goal, ask.scene
    if dt is None:
        return "Knobs.dt is None; rigid blocks need a step"
    if goal.steps(dt) == 0:
        return f"dt = {dt!r} s leaves no step in History.duration = {goal.duration!r} s"
    if not scene.blocks:
        return "the scene has no block"
    if len(scene.spheres):
        return "the scene has spheres; rigid blocks have contacts with blocks and walls only"
    if np.isfinite(scene.contact.kn):
        return f"Contact.kn = {scene.contact.kn!r} N/m; rigid contact has no stiffness"
    checks = (strained, moves_where_locked, unsupported, undetermined, overlaps)
    return next((reason for check in checks if (reason := check(scene))), None)
