"""Prepares an ask for a compiled kernel, and makes a Run from the kernel's output."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.ask import Ask, Ledger, Model, Run, Status
from vv.engines.dem.bulk.model import Bulk, BulkState, bulk
from vv.engines.dem.critical_step import critical_step
from vv.engines.dem.deepest import deepest
from vv.engines.dem.idle import idle
from vv.engines.dem.leapfrog import CENTRED, Leapfrog
from vv.engines.dem.limits import BLOW_UP, GAIN
from vv.engines.dem.line.model import Line, line
from vv.engines.dem.pressed.model import Pressed, pressed
from vv.engines.dem.refusals import refuses, wants_all
from vv.engines.dem.space.model import Space, SpaceState, space
from vv.engines.dem.terms.bonds import Bonds, shared_bonds
from vv.scene import Form, Scene, Vector
from vv.standins.stand_in import SpringScene, spring_scene

FORMS = tuple(Form)  # the columns of a ledger, in their order
EPS = float(np.finfo(float).eps)
ROUNDINGS = 16  # rounding units of the peak energy, allowed per step
GAINED = "energy created [J]"
"""Created energy in a scene with bonds: at most (w dt)^2/4 of the peak, or w dt/2 if lagged.

The latter comes from a start half a step late. A contact that closes within a step creates kn (v
dt)^2/8, which is as much if all energy is in its motion.
"""
COULOMB = 1e-9  # relative to the largest force: friction is limited to mu N within rounding
DEPTH = "penetration [m]"
SOFT = 0.1  # relative to the smallest radius: contact laws do not hold at larger overlaps


@dataclass(frozen=True, eq=False)
class PreparedSpheres:
    """An ask prepared for any number of solves: a `vv.codes.timing.Prepared`.

    system: the smallest model that serves its scene; stand_in: that scene, in which springs
    represent rigid contact and blocks; threads: how many share the bonds or many free spheres,
    which does not change the answer.
    """

    ask: Ask
    leapfrog: Leapfrog
    system: Line | Pressed | Bulk | Space
    stand_in: SpringScene
    threads: int = 1

    @property
    def model(self) -> Model:
        """The model that was built; unknowns are counted in the arrays that the kernel receives."""
        unknowns = sum(array.size for array in self.system.unknowns)
        words = (self.system.words, *self.stand_in.notes, f"largest stable dt {self.limit:.4g} s")
        terms = self.system.terms | self.stand_in.terms | idle(self.stand_in.scene)
        return Model(unknowns, terms, "; ".join(words))

    @functools.cached_property
    def limit(self) -> float:
        """The largest stable step [s]."""
        return critical_step(self.stand_in.scene, self.leapfrog)

    @functools.cached_property
    def arguments(self) -> tuple[Any, ...]:
        """The arguments of the kernel: outputs, stride, dt, the scene, the leapfrog."""
        goal, dt = self.ask.goal, self.ask.dt
        outputs = self.system.outputs(len(goal.times(dt)), self.spheres)
        state, leapfrog = self.system.state, (self.leapfrog.lag, self.leapfrog.back)
        if self.threads > 1:
            state = _with_threads(state, self.threads)
        return (*outputs, goal.stride(dt), dt, *state, *leapfrog)

    @functools.cached_property
    def spheres(self) -> tuple[int, ...]:
        """The observed spheres; raises ValueError for a body that is not a sphere."""
        return tuple(self.stand_in.scene.sphere_index(what.body) for what in self.ask.observables)

    def warm(self) -> None:
        """Load or compile the kernel for these arguments; no step is taken."""
        path, energy, *rest = self.arguments
        self._call(path[:1], energy[:1], *rest)

    def solve(self) -> int:
        """Run the kernel over all steps; return how many rows of the outputs are valid.

        Raises ValueError for more threads than numba may have.
        """
        return self._call(*self.arguments)

    def _call(self, *arguments: Any) -> int:
        if self.threads == 1:
            return self._entry(*arguments)
        from vv.engines.kernels.threads import on_threads

        return on_threads(self.threads, self._entry, arguments)

    @functools.cached_property
    def _entry(self) -> Callable[..., int]:
        """The compiled kernel for arguments of these types."""
        from vv.engines.kernels.compiled import entry

        return entry(self.system.kernel(), self.arguments)

    def run(self, rows: int) -> Run:
        """The Run from a solve that returned `rows`; its cost is left empty."""
        goal, dt = self.ask.goal, self.ask.dt
        path, energy = self.arguments[:2]
        whole = rows == len(path)
        values = {
            what: self.system.observed(path[:rows], index, sphere, what)
            for index, (what, sphere) in enumerate(
                zip(self.ask.observables, self.spheres, strict=True)
            )
        }
        return Run(
            status=Status.RAN if whole else Status.DIVERGED,
            reason="" if whole else self._why(energy, rows),
            times=goal.times(dt)[:rows],
            values=values,
            steps=goal.stride(dt) * (rows - 1 if whole else rows),
            model=self.model,
            ledger=self._ledger(path, energy) if whole else None,
            energies=self._energies(path[:rows], energy[:rows]),
        )

    def _energies(self, path: Vector, energy: Vector) -> dict[Form, Vector]:
        """The requested forms of energy, (k,) each; zeros for forms that the scene lacks."""
        if not self.ask.energies:
            return {}
        terms = self.system.held(path, energy)
        told = dict(zip(FORMS[: len(terms.T)], terms.T, strict=True))
        none = np.zeros(len(terms))
        return {form: np.array(told.get(form, none)) for form in self.ask.energies}

    def _why(self, energy: Vector, row: int) -> str:
        step = row * self.ask.goal.stride(self.ask.dt)
        when = f"by step {step}, t = {step * self.ask.dt:.6g} s"
        held, put_in = energy[row, :3].sum(), self.system.put_in(energy)
        if not np.isfinite(held):
            return f"{when}: the state is not finite"
        return (
            f"{when}: energy {held:.4g} J, kinetic and elastic, from {put_in:.4g} J at the start; "
            f"the limits are {GAIN:g} times all energy put in, and {BLOW_UP:g} times for m v+^2/2"
        )

    def _ledger(self, path: Vector, energy: Vector) -> Ledger:
        terms = self.system.held(path, energy)
        put_in = self.system.put_in(energy)
        peak = max(put_in, float(terms[:, :3].sum(axis=1).max()))
        bound = self.system.bound(energy, self.leapfrog, self.ask.dt)
        if bound is not None:
            # each step rounds the stored energies and every sum of work
            rounded = ROUNDINGS * peak + float(np.abs(terms).max())
            bound += rounded * EPS * (self.ask.goal.steps(self.ask.dt) + 1)
            bound = min(bound, peak)
        gap = terms.sum(axis=1) - put_in
        audits = {} if isinstance(self.system, Line) else dict(_audits(self.stand_in.scene, terms))
        if isinstance(self.system, Bulk | Space) and DEPTH in audits:
            audits[DEPTH] = self._depth(path, terms, audits[DEPTH])
        if self.stand_in.scene.bonds is not None:
            order = 2 if self.leapfrog == CENTRED else 1
            audits[GAINED] = float(gap.max(initial=0.0)), peak * (self.ask.dt / self.limit) ** order
        return Ledger(
            terms={form.value: float(terms[-1, k]) for k, form in enumerate(FORMS[: len(terms.T)])},
            unaccounted=float(np.abs(gap).max()),
            peak=peak,
            bound=bound,
            audits=audits,
        )

    def _depth(self, path: Vector, terms: Vector, told: tuple[float, float]) -> tuple[float, float]:
        """The deepest overlap [m] at the highest spring energy and at the end, and its limit.

        With several contacts, the overlap of one contact that holds all energy is too high an
        estimate. Where it exceeds the limit, walls are fixed and all moving spheres are observed,
        the actual overlaps are computed.
        """
        if told[0] <= told[1]:
            return told
        rows = int(terms[:, 1].argmax()), len(path) - 1
        scene = self.stand_in.scene
        if any(wall.motion is not None for wall in scene.walls):
            return told
        found = [deepest(scene, self.spheres, path[row, :, :3]) for row in rows]
        seen = [one for one in found if one is not None]
        return (max(seen), told[1]) if seen else told


def prepare(ask: Ask, leapfrog: Leapfrog, threads: int = 1) -> PreparedSpheres:
    """The ask, prepared with the smallest model that serves its scene."""
    stand_in = spring_scene(ask)
    scene, charged = stand_in.scene, stand_in.charged
    small = None if wants_all(ask) else line(scene) or pressed(scene, charged)
    system = small or bulk(scene) or space(scene, charged)
    return PreparedSpheres(ask, leapfrog, system, stand_in, threads)


def _with_threads(state: Any, threads: int) -> Any:
    """The arguments of a kernel, with threads in all parts that can use them."""
    if isinstance(state, BulkState):
        return state._replace(threads=threads)
    if isinstance(state, SpaceState):
        kept = (shared_bonds(t, threads) if isinstance(t, Bonds) else t for t in state.terms)
        return state._replace(terms=tuple(kept))
    return state


def solve(ask: Ask, leapfrog: Leapfrog) -> Run:
    """Solve an ask once, or refuse it for the reason that `refuses` gives."""
    reason = refuses(ask)
    if reason is not None:
        return Run(Status.REFUSED, reason)
    program = prepare(ask, leapfrog)
    return program.run(program.solve())


def _audits(scene: Scene, terms: Vector) -> Iterator[tuple[str, tuple[float, float]]]:
    """Checks of overlap and friction from the energies of springs (k, 2) [J] at the outputs.

    The overlap is an upper bound: that of one contact which holds all the energy. Friction is
    checked only for one sphere on one wall without dashpots: otherwise energies do not tell contact
    forces apart. Models with one unknown are not checked, since they have no normal spring beside
    the tangential one.
    """
    law, normal, shear = scene.contact, terms[:, 1], terms[:, 2]
    if not law.kn > 0 or not len(scene.spheres) or scene.bonds is not None:
        return
    radius = float(scene.spheres.radius.min())
    yield DEPTH, (float(np.sqrt(2 * normal.max() / law.kn)), SOFT * radius)
    if len(scene.spheres) == len(scene.walls) == 1 and not law.eta_n > 0:
        push, drag = np.sqrt(2 * law.kn * normal), np.sqrt(2 * law.ks * shear)
        beyond = float((drag - law.mu * push).max())
        yield "Coulomb: friction beyond mu N [N]", (max(beyond, 0.0), COULOMB * float(push.max()))
