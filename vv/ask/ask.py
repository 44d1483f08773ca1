"""One question to a code: a scene, the observables wanted, a duration and a setting."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from vv.ask.goals import Bracket, History, Knobs
from vv.ask.observables import Observable
from vv.base.digest import digest
from vv.scene import Form, Scene, with_shaking_times


@dataclass(frozen=True, eq=False)
class Ask:
    """One question to a code: solve this scene with these knobs and report these observables.

    search: None, or the bracket in which the largest stable step, or shaking, is searched; knobs,
    goal and scene are then those of the first try, and runs at other steps take the same number of
    steps. energies: forms of energy of the whole scene that are to be reported over time.
    """

    scene: Scene
    goal: History
    observables: tuple[Observable, ...]
    knobs: Knobs = field(default_factory=Knobs)
    search: Bracket | None = None
    energies: tuple[Form, ...] = ()

    def digest(self) -> str:
        """SHA-256 digest of everything that the answer depends on."""
        asked = self.observables, self.knobs, self.search, self.energies
        return digest(self.scene.digest(), self.goal, *asked)

    @property
    def dt(self) -> float:
        """The step [s]; raises ValueError if there is none."""
        if self.knobs.dt is None:
            raise ValueError("Knobs.dt = None; this scheme needs a step")
        return float(self.knobs.dt)  # a numpy scalar would be written with its type

    def at(self, dt: float) -> Ask:
        """The same question at another step [s], over as many steps and without a search."""
        ratio = dt / (self.knobs.dt or dt)
        goal = History(self.goal.duration * ratio, self.goal.interval * ratio)
        knobs = replace(self.knobs, dt=dt)
        return Ask(self.scene, goal, self.observables, knobs, energies=self.energies)

    def shaken(self, times: float) -> Ask:
        """The same question with the shaking multiplied by a factor, without a search."""
        scene = with_shaking_times(self.scene, times)
        return replace(self, scene=scene, search=None)
