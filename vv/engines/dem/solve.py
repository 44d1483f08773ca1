"""Turns an ask into a program for a compiled kernel, and what the kernel wrote into a Run."""

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
from vv.engines.dem.terms.bonds import Bonds
from vv.scene import Form, Scene, Vector
from vv.standins.stand_in import SpringScene, spring_scene

FORMS = tuple(Form)  # the columns of a ledger, in their order
EPS = float(np.finfo(float).eps)
ROUNDINGS = 16  # of the peak energy, allowed for each step
GAINED = "energy that comes from nowhere [J]"
"""In a scene with bonds: (w dt)^2/4 of what is held at most, w dt/2 from a start half a step late.

A contact that closes within a step brings kn (v dt)^2/8, which is as much if all is in its motion.
"""
COULOMB = 1e-9  # of the largest force: friction is cut to mu N as it is found
DEPTH = "penetration [m]"
SOFT = 0.1  # of the smallest radius: a deeper overlap is no contact of spheres any more


@dataclass(frozen=True, eq=False)
class PreparedSpheres:
    """An ask ready to be solved as often as wanted: a `vv.codes.timing.Prepared`.

    system: the smallest model of its scene; stand_in: that scene, with what stands in for what
    springs cannot do. threads: that share the bonds, or the spheres where they are many and free;
    the answer is the same.
    """

    ask: Ask
    leapfrog: Leapfrog
    system: Line | Pressed | Bulk | Space
    stand_in: SpringScene
    threads: int = 1

    @property
    def model(self) -> Model:
        """What was built; unknowns are counted in the arrays that the kernel is given."""
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
        """What the kernel is called with: outputs, stride, dt, the scene, the leapfrog."""
        goal, dt = self.ask.goal, self.ask.dt
        outputs = self.system.outputs(len(goal.times(dt)), self.spheres)
        state, leapfrog = self.system.state, (self.leapfrog.lag, self.leapfrog.back)
        if self.threads > 1:
            state = _shared(state, self.threads)
        return (*outputs, goal.stride(dt), dt, *state, *leapfrog)

    @functools.cached_property
    def spheres(self) -> tuple[int, ...]:
        """The spheres observed; raises ValueError for a body that is none."""
        return tuple(self.stand_in.scene.sphere_index(what.body) for what in self.ask.observables)

    def warm(self) -> None:
        """Load or compile the kernel for these arguments; no step is taken."""
        path, energy, *rest = self.arguments
        self._call(path[:1], energy[:1], *rest)

    def solve(self) -> int:
        """Run the kernel over all steps; returns how many rows of the outputs are good.

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
        """The kernel for arguments of these types."""
        from vv.engines.kernels.compiled import entry

        return entry(self.system.kernel(), self.arguments)

    def run(self, rows: int) -> Run:
        """The Run of a solve that returned `rows`; its cost is left empty."""
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
        """The forms asked for, (k,) each; zeros for what the scene does not have."""
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
            f"{when}: energy {held:.4g} J of motion and springs from {put_in:.4g} J at the start; "
            f"the bounds are {GAIN:g} times all that was put in, {BLOW_UP:g} times for m v+^2/2"
        )

    def _ledger(self, path: Vector, energy: Vector) -> Ledger:
        terms = self.system.held(path, energy)
        put_in = self.system.put_in(energy)
        peak = max(put_in, float(terms[:, :3].sum(axis=1).max()))
        bound = self.system.bound(energy, self.leapfrog, self.ask.dt)
        if bound is not None:
            # each step rounds what is held, and every sum of work that it adds to
            rounded = ROUNDINGS * peak + float(np.abs(terms).max())
            bound += rounded * EPS * (self.ask.goal.steps(self.ask.dt) + 1)
            bound = min(bound, peak)
        gap = terms.sum(axis=1) - put_in
        audits = {} if isinstance(self.system, Line) else dict(_audits(self.stand_in.scene, terms))
        if isinstance(self.system, Bulk) and DEPTH in audits:
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
        """The deepest overlap [m] where most is pressed and at the end, and what is allowed.

        That of one contact which holds all the energy says nothing of thousands: where it is
        beyond what is allowed, and all that moves is watched, overlaps are looked at themselves.
        """
        if told[0] <= told[1]:
            return told
        rows = int(terms[:, 1].argmax()), len(path) - 1
        scene = self.stand_in.scene
        found = [deepest(scene, self.spheres, path[row, :, :3]) for row in rows]
        seen = [one for one in found if one is not None]
        return (max(seen), told[1]) if seen else told


def prepare(ask: Ask, leapfrog: Leapfrog, threads: int = 1) -> PreparedSpheres:
    """The program of an ask, with the smallest model its scene allows."""
    stand_in = spring_scene(ask)
    scene, charged = stand_in.scene, stand_in.charged
    small = None if wants_all(ask) else line(scene) or pressed(scene, charged)
    system = small or bulk(scene) or space(scene, charged)
    return PreparedSpheres(ask, leapfrog, system, stand_in, threads)


def _shared(state: Any, threads: int) -> Any:
    """What a kernel is given, with threads for all of it that can be shared out."""
    if isinstance(state, BulkState):
        return state._replace(threads=threads)
    if isinstance(state, SpaceState):
        kept = (t._replace(threads=threads) if isinstance(t, Bonds) else t for t in state.terms)
        return state._replace(terms=tuple(kept))
    return state


def solve(ask: Ask, leapfrog: Leapfrog) -> Run:
    """Solve an ask once; refused if `refuses` says why."""
    reason = refuses(ask)
    if reason is not None:
        return Run(Status.REFUSED, reason)
    program = prepare(ask, leapfrog)
    return program.run(program.solve())


def _audits(scene: Scene, terms: Vector) -> Iterator[tuple[str, tuple[float, float]]]:
    """What the springs' energies (k, 2) [J] at the outputs say of friction and overlap.

    The overlap is the largest there can be: that of one contact which holds all the energy. Of
    several contacts none can be told from another, nor what a dashpot pushes, and their friction
    is not audited. A model
    of one unknown holds no normal spring beside its shear spring and has nothing to tell.
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
