"""The interface of a code: its schemes, refusals, description, native input and runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

import numpy as np

from vv.ask import Ask, Displacement, Method, Model, Run, SearchVariable, Status, Velocity
from vv.scene import Form, Scene, Term, in_frame

Waiting = Callable[[], AbstractContextManager[None]]
# The classes of a leapfrog with springs: for rigid contact, and for dashpots that use the velocity
# of half a step before.
LEAPFROG_ON_SPRINGS: Mapping[Term, Method] = {
    Term.RIGID_CONTACT: Method.PENALTY,
    Term.CONTACT_VISCOSITY: Method.LATE_LEAPFROG,
    Term.HERTZ_VISCOSITY: Method.LATE_LEAPFROG,
}


@dataclass(frozen=True)
class Scheme:
    """One way in which a code solves scenes.

    knobs: names of the fields of Knobs it has. terms: what it supports. method: its class;
    `lowered` names the terms with which it is declared to be of another class. observables: the
    kinds it can report; energies: the forms it can report over time. why_not: why it lacks a term,
    in the code's own words; raises ValueError for a term that it has. pace: approximate CPU seconds
    per step, and in addition per step and body; zero if no setting is to be left out.
    """

    name: str
    summary: str
    method: Method
    terms: frozenset[Term]
    knobs: tuple[str, ...] = ("dt",)
    lowered: Mapping[Term, Method] = field(default_factory=dict)
    observables: frozenset[type] = frozenset({Displacement, Velocity})
    energies: frozenset[Form] = frozenset()
    why_not: Mapping[Term, str] = field(default_factory=dict)
    pace: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        for term in sorted(self.terms & self.why_not.keys(), key=lambda term: term.value):
            raise ValueError(f"why_not of scheme {self.name!r} has {term}, which its terms have")

    def method_for(self, terms: frozenset[Term]) -> Method:
        """The class of the method on a scene with these terms."""
        return next((m for term, m in self.lowered.items() if term in terms), self.method)


@dataclass(frozen=True)
class Found:
    """Whether a code can run here.

    files: what its results depend on besides our sources. load: loads the modules that every worker
    needs, once, before workers are forked. may_wait: gives a block in which its program, after an
    answer, waits for more asks (`vv.codes.reused_program`); None if the program always ends.
    """

    installed: bool
    version: str = ""
    path: str = ""
    how_to_install: str = ""
    files: tuple[Path, ...] = ()
    load: Callable[[], None] | None = None
    may_wait: Waiting | None = None

    @property
    def worker_stays(self) -> bool:
        """Whether a worker may take more batches: none of its programs ends with a batch.

        A code without files is computed in the worker itself.
        """
        return self.may_wait is not None or not self.files


class Adapter(Protocol):
    """A code as the framework sees it. A module in adapters/ ends in ADAPTER = one of these."""

    @property
    def name(self) -> str:
        """The code's name in selections, records and labels."""

    @property
    def schemes(self) -> tuple[Scheme, ...]:
        """Its schemes; the first is the default."""

    def found(self) -> Found:
        """Look for the code on this machine; this is quick and imports no heavy libraries."""

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """Why an ask is refused although all its terms are supported; else None."""

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The model that would be built for an ask: unknowns, terms, and the mapping in words."""

    def native(self, ask: Ask, scheme: str) -> str:
        """The code's own input for an ask, which runs alone; for in-house codes a Python script."""

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Yield one Run per ask, in order, each as soon as it is complete.

        scratch: an empty folder. repeat: 0 for one solve; otherwise solves are repeated for about
        that many CPU seconds, and the smallest cost is reported. Only the cost of such a run is
        used: a code that writes no output while it is timed returns no values.
        """


def known_beforehand(adapter: Adapter, scheme: Scheme, ask: Ask, found: Found) -> Run | None:
    """The run of a scheme that refuses or is not installed, else None; refusals come first."""
    missing = unsupported(scheme, ask.scene.terms())
    if missing:
        terms = ", ".join(sorted(_lacked(scheme, term) for term in missing))
        return Run(Status.REFUSED, f"{adapter.name}/{scheme.name} does not support: {terms}")
    if hidden := unreported(scheme, ask):
        return Run(Status.REFUSED, f"{adapter.name}/{scheme.name} does not report: {hidden}")
    if ask.knobs.dd is not None and "dd" not in scheme.knobs:
        return Run(Status.REFUSED, f"its steps keep all velocity, not dd = {ask.knobs.dd:g}")
    reason = no_steps(ask) or adapter.refuses(ask, scheme.name)
    if reason is not None:
        return Run(Status.REFUSED, reason)
    return None if found.installed else Run(Status.NOT_INSTALLED, found.how_to_install)


def _lacked(scheme: Scheme, term: Term) -> str:
    why = scheme.why_not.get(term)
    return f"{term.value} ({why})" if why else term.value


def no_steps(ask: Ask) -> str | None:
    """Why the step does not fit an ask: longer than its duration, or missing in a search."""
    dt = ask.knobs.dt
    if dt is None and ask.search is not None and ask.search.variable is SearchVariable.STEP:
        return "it has no time step, so that there is no largest stable one"
    if dt is None or ask.goal.steps(dt) > 0:
        return None
    return f"dt = {dt:g} s is longer than the {ask.goal.duration:g} s to be run"


def no_drag(scene: Scene) -> str | None:
    """Why a scheme that differs from the default in drag only refuses a scene: it has no drag."""
    return None if scene.eta else "there is no drag, so that the result would be that of `default`"


def no_sphere(ask: Ask, scene: Scene) -> str | None:
    """Why a code of spheres cannot report an observable: its body is not a sphere."""
    try:
        for seen in ask.observables:
            scene.sphere_index(seen.body)
    except ValueError as error:
        return str(error)
    return None


def behind_wall(scene: Scene) -> str | None:
    """Why a code with walls as surfaces refuses a scene: a sphere's centre is behind a wall."""
    for number, wall in enumerate(scene.walls):
        height = (scene.spheres.position - wall.point) @ wall.normal
        if height.min() <= 0:
            return (
                f"the centre of sphere {int(height.argmin())} lies behind wall {number}; walls "
                "there push from a surface, not from a half-space"
            )
    return None


def turned_spin_lock(scene: Scene, what_locks: str) -> str | None:
    """Why a code that can lock rotation only about its own axes refuses a scene."""
    partly = any(free.any() and not free.all() for free in scene.spheres.free_spin)
    mixed = any(in_frame(scene.axes, block.free_spin) is None for block in scene.blocks)
    if mixed or (partly and not np.array_equal(scene.axes, np.eye(3))):
        return f"rotation is locked about some axes of a turned frame; {what_locks}"
    return None


def unsupported(scheme: Scheme, terms: frozenset[Term]) -> frozenset[Term]:
    """The terms a scene has and a scheme lacks; the framework refuses unless this is empty."""
    return terms - scheme.terms


def unreported(scheme: Scheme, ask: Ask) -> str | None:
    """Which requested observables a scheme cannot report, in words; None if it reports all."""
    kinds = {type(what) for what in ask.observables} - scheme.observables
    forms = [form for form in ask.energies if form not in scheme.energies]
    energy = [f"energy over time ({'; '.join(form.value for form in forms)})"] if forms else []
    return ", ".join([*sorted(kind.__name__ for kind in kinds), *energy]) or None
