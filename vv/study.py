"""What a case does with its scenes: a study expands, at a level, to the asks it needs."""

from __future__ import annotations

import enum
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from vv.ask import Ask, History, Knobs, Observable
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
