"""What a case does with its scenes: a study expands, at a level, to the asks it needs."""

from __future__ import annotations

import enum
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from vv.ask import Ask, Bracket, History, Knobs, Observable
from vv.scene import Scene


class Level(enum.Enum):
    """How much of a case runs; a level never changes a scene, a tolerance or a reference."""

    QUICK = "quick"
    DEFAULT = "default"
    PAPER = "paper"


def grid(dt: Sequence[float], kn: Sequence[float]) -> tuple[Knobs, ...]:
    """Rungs at every stiffness [N/m] and every step [s]: an error over both makes a map."""
    return tuple(Knobs(step, stiffness) for stiffness in kn for step in dt)


@dataclass(frozen=True, eq=False)
class Ladder:
    """One scene at rungs of finer and finer knobs, each judged against a reference.

    rungs: level -> knobs, coarsest first. timed: the rungs that the timing phase measures.
    """

    scene: Scene
    goal: History
    observables: tuple[Observable, ...]
    rungs: Mapping[Level, tuple[Knobs, ...]]
    timed: tuple[Knobs, ...] = ()

    def __post_init__(self) -> None:
        missing = [level.value for level in Level if not self.rungs.get(level)]
        if missing:
            raise ValueError(f"Ladder.rungs has none at level {missing[0]}; each level needs one")

    def ask(self, knobs: Knobs) -> Ask:
        """The question put at one rung."""
        return Ask(self.scene, self.goal, self.observables, knobs)


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

Study = Ladder | Search
