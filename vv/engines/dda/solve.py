"""Prepares an ask for a DDA kernel, and makes a Run from the kernel's output."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.ask import (
    Ask,
    Displacement,
    Impulse,
    Ledger,
    Model,
    Observable,
    Reaction,
    Run,
    Status,
    Strain,
)
from vv.engines.blocks.checks import block_index, size
from vv.engines.blocks.geometry import Index
from vv.engines.dda.formulation import Formulation
from vv.engines.dda.general.grooves import along_groove
from vv.engines.dda.general.model import General
from vv.engines.dda.limits import COULOMB, GAIN, MOMENTUM, REACH
from vv.engines.dda.ordering import short_rows
from vv.engines.dda.point.model import Sliding, sliding
from vv.engines.dda.refusals import refuses, settles
from vv.engines.dda.springs import springs
from vv.engines.dda.stepping import IMPLICIT, LEAPING, Steps
from vv.scene import Vector

LEDGER = (
    "kinetic",
    "normal elastic",
    "shear elastic",
    "strain elastic",
    "friction dissipation",
    "numerical dissipation",
    "kinetic damping dissipation",
    "gravity potential",
    "load potential",
    "base potential",
    "shaking potential",
    "created by new contacts and inertia",
)
SIGNED = "numerical energy loss of generalised alpha, of either sign"
LEAPT = "numerical energy loss of impacts and of steps with velocities at their middle"
HELD, WORKS = slice(0, 4), slice(7, 12)
NUMERICAL, CREATED = 5, 12
EPS = float(np.finfo(float).eps)
ROUNDINGS = 64  # rounding units of the peak energy, allowed per step


@dataclass(frozen=True, eq=False)
class PreparedBlocks:
    """An ask prepared for any number of solves: a `vv.codes.timing.Prepared`.

    system: the smallest model that serves its scene; place: of each block of the scene in it.
    """

    ask: Ask
    formulation: Formulation
    system: Sliding | General
    place: Index

    @property
    def model(self) -> Model:
        """The model that was built, with the unknowns of the kernel."""
        law = springs(self.ask.scene, self.ask.knobs.kn, self.formulation)
        shear = "no friction" if law.ks is None else f"ks {law.ks:.4g} N/m"
        words = f"{self.system.words}; kn {law.kn:.4g} N/m, {shear} at each; {self._start()}"
        return Model(self.system.unknowns, self.system.terms, words)

    @functools.cached_property
    def arguments(self) -> tuple[Any, ...]:
        """The arguments of the kernel: outputs, the step, the scene."""
        goal, dt = self.ask.goal, self.ask.dt
        outputs = self.system.outputs(len(goal.times(dt)), self.watched)
        steps = Steps(goal.stride(dt), dt, self.settling)
        law = springs(self.ask.scene, self.ask.knobs.kn, self.formulation)
        return (*outputs, *self.system.arguments(steps, law))

    @functools.cached_property
    def watched(self) -> tuple[int, ...]:
        """The places of the observed blocks; raises ValueError for a body that is not a block."""
        blocks = (block_index(self.ask.scene, what.body) for what in self.ask.observables)
        return tuple(int(self.place[block]) for block in blocks)

    @property
    def settling(self) -> int:
        """The number of steps of gravity before t = 0; 0 unless `settles` allows them."""
        return round(self.formulation.settling / self.ask.dt) if settles(self.ask.scene) else 0

    def warm(self) -> None:
        """Load or compile the kernel for these arguments; no step is taken."""
        path, energy, report, *rest = self.arguments
        self._entry(path[:0], energy[:0], report[:0], *rest)

    def solve(self) -> int:
        """Run the kernel over all steps; return how many rows of the outputs are valid."""
        return self._entry(*self.arguments)

    @functools.cached_property
    def _entry(self) -> Callable[..., int]:
        """The compiled kernel for arguments of these types."""
        from vv.engines.kernels.compiled import entry

        return entry(self.system.kernel(), self.arguments)

    def run(self, rows: int) -> Run:
        """The Run from a solve that returned `rows`; its cost is left empty."""
        goal, dt = self.ask.goal, self.ask.dt
        path, energy, report = self.arguments[:3]
        whole = rows == len(path)
        seen = enumerate(self.ask.observables)
        values = {what: self._seen(what, path[:rows], index) for index, what in seen}
        steps = goal.stride(dt) * (rows - 1 if whole else rows)
        model = self.model
        note = f"{model.note}; {self._worst(report[rows - 1 if whole else rows])}"
        return Run(
            status=Status.RAN if whole else Status.DIVERGED,
            reason="" if whole else self._why(energy, rows),
            times=goal.times(dt)[:rows],
            values=values,
            steps=steps + self.settling,
            model=Model(model.unknowns, model.terms, note),
            ledger=self._ledger(energy, report[-1]) if whole else None,
        )

    def _seen(self, what: Observable, path: Vector, index: int) -> Vector:
        if isinstance(what, Strain):
            return self.system.strains(path, index)
        if isinstance(what, Reaction | Impulse) and isinstance(self.system, General):
            times = self.ask.goal.times(self.ask.dt)[: len(path)]
            forces, impulses = self.system.locked(path, index, self.watched[index], times)
            return forces if isinstance(what, Reaction) else impulses
        moved = self.system.watched(path, index)
        return moved[:, :3] if isinstance(what, Displacement) else moved[:, 3:]

    def _start(self) -> str:
        pressed = "pressed by their loads" if self.formulation.pressed else "as placed"
        pressed += ", shear springs charged" if self.formulation.charged else ""
        pressed += ", multipliers carry forces" if self.formulation.multipliers else ""
        settled = f", after {self.settling} steps of gravity alone" if self.settling else ""
        return f"contacts start {pressed}{settled}"

    def _worst(self, report: Vector) -> str:
        residual, most, deepest, cuts, failed, solved, excess, *_ = report
        return (
            f"worst step: friction off by {residual:.3g} N, {most:.0f} iterations, penetration "
            f"{deepest:.3g} m, {excess:.3g} N beyond mu N; {solved:.0f} solutions, {cuts:.0f} "
            f"cuts, {failed:.0f} parts of steps kept unconverged"
        )

    def _why(self, energy: Vector, row: int) -> str:
        step = row * self.ask.goal.stride(self.ask.dt)
        when = f"by step {step}, t = {step * self.ask.dt:.6g} s"
        held = energy[row, HELD].sum()
        if not np.isfinite(held):
            return f"{when}: the state is not finite"
        return f"{when}: {held:.4g} J, kinetic and elastic, exceed {GAIN:g} times all energy put in"

    def _ledger(self, energy: Vector, report: Vector) -> Ledger:
        terms = energy[:, :12].copy()
        terms[:, WORKS] *= -1.0
        terms += 0.0
        put_in = float(terms[0].sum())
        largest = np.abs(terms).sum(axis=1).max()
        steps = self.ask.goal.steps(self.ask.dt) + 1
        created = float(energy[-1, CREATED])
        quickest = max(terms[:, 0].tolist() + report[9:].tolist())  # also between rows
        rounding = ROUNDINGS * EPS * steps * float(largest)
        return Ledger(
            terms=dict(zip(self._names(), terms[-1].tolist(), strict=True)),
            unaccounted=float(np.abs(terms.sum(axis=1) - put_in).max()),
            peak=max(put_in, float(terms[:, HELD].sum(axis=1).max())),
            bound=rounding + self._worked(report, quickest),
            audits=dict(self._audits(report, created, rounding)),
        )

    def _names(self) -> list[str]:
        """The ledger's names; only a step with forces at its end is sure to lose energy."""
        other = {IMPLICIT: LEDGER[NUMERICAL], LEAPING: LEAPT}.get(self.formulation.stepping, SIGNED)
        return [*LEDGER[:NUMERICAL], other, *LEDGER[NUMERICAL + 1 :]]

    def _audits(
        self, report: Vector, created: float, rounding: float
    ) -> Iterator[tuple[str, tuple[float, float]]]:
        """The laws that the scheme promises: the largest violation in a step, and the limit.

        Energy is not checked where newly detected contacts can create it, or friction that lags:
        that exceeds mu N, and stores more energy in springs than was put into them.
        """
        excess, adrift, peak = (float(number) for number in report[6:9])
        deepest = float(report[2])
        lags = not np.isfinite(self.formulation.tolerance)
        if isinstance(self.system, Sliding) and not (lags and self.formulation.charged):
            yield "energy created [J]", (created, rounding)
        if not lags:
            yield "Coulomb: friction beyond mu N [N]", (excess, COULOMB * peak)
        yield "error of the momentum balance [N]", (adrift, max(MOMENTUM * peak, self._roundings()))
        smallest = min(size(block) for block in self.ask.scene.blocks)
        yield "penetration [m]", (deepest, REACH * smallest)

    def _worked(self, report: Vector, kinetic: float) -> float:
        """A bound of the work [J] of forces that are in the momentum but not in the energy balance.

        Gaps have the rounding error of positions, which stiff springs turn into forces. They are at
        most the largest momentum error of a step, and act along the path of the lightest block at
        the largest kinetic energy. Friction that lags is in both, as the solution used it.
        """
        lightest = min(block.mass for block in self.ask.scene.blocks)
        adrift, path = float(report[7]), np.sqrt(2 * kinetic / lightest) * self.ask.goal.duration
        return adrift * float(path)

    def _roundings(self) -> float:
        """The force [N] that corresponds to the rounding of the momenta at t = 0."""
        rates = (
            block.mass * (np.linalg.norm(block.velocity) + size(block) * np.linalg.norm(block.spin))
            for block in self.ask.scene.blocks
        )
        return ROUNDINGS * EPS * float(sum(rates)) / self.ask.dt


def prepare(ask: Ask, formulation: Formulation) -> PreparedBlocks:
    """The ask, prepared with the smallest model that serves its scene."""
    dd = ask.knobs.dd
    choices = formulation if dd is None else dataclasses.replace(formulation, dd=dd)
    held = any(isinstance(what, Reaction | Impulse) for what in ask.observables)
    small = sliding(ask.scene, choices) if choices.stepping == IMPLICIT and not held else None
    scene, place = short_rows(along_groove(ask.scene) if choices.multipliers else ask.scene)
    return PreparedBlocks(ask, choices, small or General(scene, choices), place)


def solve(ask: Ask, formulation: Formulation) -> Run:
    """Solve an ask once, or refuse it for the reason that `refuses` gives."""
    reason = refuses(ask)
    if reason is not None:
        return Run(Status.REFUSED, reason)
    program = prepare(ask, formulation)
    return program.run(program.solve())
