"""What a case does with its scenes: a study expands, at a level, to the asks it needs."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from vv.ask import Ask, Bracket, History, Knobs, Observable
from vv.scene import Scene
from vv.scene.energy import Form


class Level(enum.Enum):
    """How much of a case runs; a level never changes a scene, a tolerance or a reference."""

    QUICK = "quick"
    DEFAULT = "default"
    PAPER = "paper"

    @property
    def rank(self) -> int:
        """0 for the least; a level runs what those below it run, and more."""
        return list(Level).index(self)


def grid(dt: Sequence[float], kn: Sequence[float]) -> tuple[Knobs, ...]:
    """Rungs at every stiffness [N/m] and every step [s]: an error over both makes a map."""
    return tuple(Knobs(step, stiffness) for stiffness in kn for step in dt)


@dataclass(frozen=True, eq=False)
class Ladder:
    """One scene at rungs of finer and finer knobs, each judged against a reference.

    rungs: level -> knobs, coarsest first. timed: the rungs that the timing phase measures.
    energies: forms of energy of the scene that are wanted over time. patience: CPU seconds for a
    rung, by the pace that a scheme states; one that would take longer is left out, and says so.
    """

    scene: Scene
    goal: History
    observables: tuple[Observable, ...]
    rungs: Mapping[Level, tuple[Knobs, ...]]
    timed: tuple[Knobs, ...] = ()
    energies: tuple[Form, ...] = ()
    patience: float = math.inf

    def __post_init__(self) -> None:
        missing = [level.value for level in Level if not self.rungs.get(level)]
        if missing:
            raise ValueError(f"Ladder.rungs has none at level {missing[0]}; each level needs one")

    def ask(self, knobs: Knobs) -> Ask:
        """The question put at one rung."""
        return Ask(self.scene, self.goal, self.observables, knobs, energies=self.energies)


@dataclass(frozen=True, eq=False)
class Search:
    """One scene at steps from dt [s] on, for the largest that keeps it within a bound.

    What diverges is data here: it is what the search is for. Each run takes `steps` steps;
    kn [N/m]: what stands in for rigid contact, if anything must.
    """

    scene: Scene
    observables: tuple[Observable, ...]
    dt: float
    steps: int
    bracket: Bracket
    kn: float | None = None
    timed: tuple[Knobs, ...] = ()

    def __post_init__(self) -> None:
        if self.steps < OUTPUTS:
            raise ValueError(f"Search.steps = {self.steps}; there must be at least {OUTPUTS}")

    @property
    def rungs(self) -> Mapping[Level, tuple[Knobs, ...]]:
        """Where the search begins, the same at all levels."""
        return dict.fromkeys(Level, (Knobs(self.dt, self.kn),))

    @property
    def goal(self) -> History:
        """What the first step is run over."""
        return History(self.steps * self.dt, self.steps * self.dt / OUTPUTS)

    def ask(self, knobs: Knobs) -> Ask:
        """The question put to a scheme that has these knobs; it begins at their dt."""
        first = Ask(self.scene, self.goal, self.observables, Knobs(self.dt, knobs.kn))
        goal = first.at(knobs.dt or self.dt).goal
        return Ask(self.scene, goal, self.observables, knobs, self.bracket)


OUTPUTS = 20  # of a run of a search, over which what it reaches is taken


@dataclass(frozen=True, eq=False)
class Grid:
    """One scene at steps in units of its critical step, and at several stiffnesses: a map.

    What diverges is data here, and a step that a code refuses while it takes shorter ones is run
    all the same. steps: level -> dt over `critical` of the stiffness [s]; kn: level -> stiffnesses
    [N/m] that stand in for rigid contact, None for a scene that has its own. own: the scene at
    a stiffness of its own, for which no scheme needs a knob. patience: as in Ladder.
    """

    scene: Scene
    goal: History
    observables: tuple[Observable, ...]
    steps: Mapping[Level, tuple[float, ...]]
    critical: Callable[[float | None], float]
    kn: Mapping[Level, tuple[float | None, ...]] = field(default_factory=lambda: OWN_STIFFNESS)
    own: Callable[[float], Scene] | None = None
    patience: float = math.inf
    timed: tuple[Knobs, ...] = ()

    def __post_init__(self) -> None:
        missing = [level.value for level in Level if not (self.steps[level] and self.kn[level])]
        if missing:
            raise ValueError(f"Grid has no steps or no kn at level {missing[0]}; each needs some")

    @property
    def rungs(self) -> Mapping[Level, tuple[Knobs, ...]]:
        """Every step at every stiffness; equal steps of several stiffnesses are equal to a bit."""
        return {
            level: tuple(
                Knobs(float(f"{step * self.critical(kn):.12g}"), kn)
                for kn in self.kn[level]
                for step in steps
            )
            for level, steps in self.steps.items()
        }

    def ask(self, knobs: Knobs) -> Ask:
        """The question put at one point of the map."""
        scene = self.own(knobs.kn) if self.own and knobs.kn else self.scene
        return Ask(scene, self.goal, self.observables, knobs)


def too_long(study: Ladder | Search | Grid, knobs: Knobs, pace: tuple[float, float]) -> str | None:
    """Why a scheme of that pace [s a step, s a step of a body] is not put to a rung, or None."""
    if isinstance(study, Search) or knobs.dt is None:
        return None
    steps = study.goal.steps(knobs.dt)
    each = pace[0] + pace[1] * (len(study.scene.spheres) + len(study.scene.blocks))
    if steps * each <= study.patience:
        return None
    return (
        f"not run: {steps:.2g} steps of some {each:g} s each; it is given {study.patience:g} s, "
        f"{study.patience / each:.2g} steps"
    )


def put_in(study: Ladder | Search | Grid) -> tuple[str, ...]:
    """The names of the knobs that a study puts into its scene, whatever knobs a scheme has."""
    return ("kn",) if isinstance(study, Grid) and study.own else ()


OWN_STIFFNESS: Mapping[Level, tuple[float | None, ...]] = dict.fromkeys(Level, (None,))
Study = Ladder | Search | Grid
