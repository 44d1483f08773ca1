"""One question to a code: a scene, what is observed of it, and at which settings."""

from __future__ import annotations

from dataclasses import dataclass, field

from vv.ask.goals import Bracket, History, Knobs
from vv.ask.observables import Observable
from vv.base.digest import digest
from vv.scene import Form, Scene


@dataclass(frozen=True, eq=False)
class Ask:
    """One question to a code: this scene, with these knobs, observed so.

    search: None, or where to look for the largest stable step; the ask is then that of the first
    step tried, and the goal of any other is as many steps long. energies: forms of energy of the
    whole scene that are wanted over time, beside the observables.
    """

    scene: Scene
    goal: History
    observables: tuple[Observable, ...]
    knobs: Knobs = field(default_factory=Knobs)
    search: Bracket | None = None
    energies: tuple[Form, ...] = ()

    def digest(self) -> str:
        """Fingerprint of everything that decides the answer."""
        asked = self.observables, self.knobs, self.search, self.energies
        return digest(self.scene.digest(), self.goal, *asked)

    @property
    def dt(self) -> float:
        """The step [s], for what cannot do without; raises ValueError if there is none."""
        if self.knobs.dt is None:
            raise ValueError("Knobs.dt is None; a step is needed")
        return float(self.knobs.dt)  # a numpy scalar would be written with its type

    def at(self, dt: float) -> Ask:
        """The same question at another step [s], over as many steps; no search."""
        ratio = dt / (self.knobs.dt or dt)
        goal = History(self.goal.duration * ratio, self.goal.interval * ratio)
        knobs = Knobs(dt, self.knobs.kn)
        return Ask(self.scene, goal, self.observables, knobs, energies=self.energies)
