"""Studies: what a variant does with its scene, as a list of settings for each level."""

from __future__ import annotations

import enum
import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from vv.ask import Ask, Bracket, History, Knobs, Observable, SearchVariable
from vv.scene import Scene
from vv.scene.energy import Form

COUNTED = 2.0**53  # steps: above it not every whole number is a float


class Level(enum.Enum):
    """How much of a case runs; scenes, tolerances and references are the same at all levels."""

    QUICK = "quick"
    DEFAULT = "default"
    PAPER = "paper"

    @property
    def rank(self) -> int:
        """0 for the lowest level; each level runs all that the levels below it run."""
        return list(Level).index(self)


def knob_grid(dt: Sequence[float], kn: Sequence[float]) -> tuple[Knobs, ...]:
    """Settings for every stiffness [N/m] and every step [s], for a map of errors over both."""
    return tuple(Knobs(step, stiffness) for stiffness in kn for step in dt)


@dataclass(frozen=True, eq=False)
class Ladder:
    """One scene at finer and finer settings, each judged against the reference.

    rungs: level -> settings, coarsest first. timed: the settings that timing sessions measure.
    energies: forms of energy of the scene that are to be reported over time. search: None, or the
    bracket in which each setting searches for the largest shaking under which the scene stays
    stable, upwards from that of the scene. cpu_limit: CPU time allowed for a setting [s]; a setting
    that would take longer, according to the pace that a scheme declares, is not run, and its record
    says so.
    """

    scene: Scene
    goal: History
    observables: tuple[Observable, ...]
    rungs: Mapping[Level, tuple[Knobs, ...]]
    timed: tuple[Knobs, ...] = ()
    energies: tuple[Form, ...] = ()
    cpu_limit: float = math.inf
    search: Bracket | None = None

    def __post_init__(self) -> None:
        if self.search is not None and self.search.variable is not SearchVariable.SHAKING:
            raise ValueError("Ladder.search.variable = STEP; a ladder has steps of its own")
        missing = [level.value for level in Level if not self.rungs.get(level)]
        if missing:
            raise ValueError(
                f"Ladder.rungs is empty at level {missing[0]}; each level needs a setting"
            )
        for dt in {knobs.dt for level in self.rungs.values() for knobs in level if knobs.dt}:
            if not self.goal.duration / dt <= COUNTED:
                raise ValueError(
                    f"Ladder.goal.duration = {self.goal.duration!r} s; it takes "
                    f"{self.goal.duration / dt:.3g} steps of {dt!r} s, of which at most "
                    f"{COUNTED:.3g} can be counted"
                )

    def ask(self, knobs: Knobs) -> Ask:
        """The ask at one setting."""
        return Ask(self.scene, self.goal, self.observables, knobs, self.search, self.energies)


@dataclass(frozen=True, eq=False)
class Search:
    """A search for the largest stable step of one scene, from dt [s] upwards.

    A run that diverges is a result here, not a failure. Each run takes `steps` steps. kn: the
    stiffness of springs that represent rigid contact [N/m], if the contact is rigid.
    """

    scene: Scene
    observables: tuple[Observable, ...]
    dt: float
    steps: int
    bracket: Bracket
    kn: float | None = None
    timed: tuple[Knobs, ...] = ()

    def __post_init__(self) -> None:
        if self.steps < SEARCH_OUTPUTS:
            raise ValueError(
                f"Search.steps = {self.steps}; there must be at least {SEARCH_OUTPUTS}"
            )

    @property
    def rungs(self) -> Mapping[Level, tuple[Knobs, ...]]:
        """The setting at which the search begins, the same at all levels."""
        return dict.fromkeys(Level, (Knobs(self.dt, self.kn),))

    @property
    def goal(self) -> History:
        """Duration and output interval of the run at the first step."""
        return History(self.steps * self.dt, self.steps * self.dt / SEARCH_OUTPUTS)

    def ask(self, knobs: Knobs) -> Ask:
        """The ask to a scheme with these knobs; the search begins at their dt."""
        first = Ask(self.scene, self.goal, self.observables, Knobs(self.dt, knobs.kn))
        goal = first.at(knobs.dt or self.dt).goal
        return Ask(self.scene, goal, self.observables, knobs, self.bracket)


SEARCH_OUTPUTS = 20  # in each run of a search; a step is judged by the largest value among them


@dataclass(frozen=True, eq=False)
class Grid:
    """A map: one scene at several stiffnesses, and at steps in units of its critical step.

    A run that diverges is a result here, not a failure. A step that a code refuses only because it
    is long is run nevertheless. steps: level -> steps over critical(kn) [s]; kn: level ->
    stiffnesses of springs that represent rigid contact [N/m], None for a scene with elastic
    contact. scene_with_kn: kn -> the scene with that stiffness, if kn is part of the scene and not
    a knob. cpu_limit: as in Ladder.
    """

    scene: Scene
    goal: History
    observables: tuple[Observable, ...]
    steps: Mapping[Level, tuple[float, ...]]
    critical: Callable[[float | None], float]
    kn: Mapping[Level, tuple[float | None, ...]] = field(default_factory=lambda: OWN_STIFFNESS)
    scene_with_kn: Callable[[float], Scene] | None = None
    cpu_limit: float = math.inf
    timed: tuple[Knobs, ...] = ()

    def __post_init__(self) -> None:
        missing = [level.value for level in Level if not (self.steps[level] and self.kn[level])]
        if missing:
            raise ValueError(
                f"Grid.steps or Grid.kn is empty at level {missing[0]}; each level needs values"
            )

    @property
    def rungs(self) -> Mapping[Level, tuple[Knobs, ...]]:
        """Every step at every stiffness, rounded to 12 digits so that equal steps compare equal."""
        return {
            level: tuple(
                Knobs(float(f"{step * self.critical(kn):.12g}"), kn)
                for kn in self.kn[level]
                for step in steps
            )
            for level, steps in self.steps.items()
        }

    def ask(self, knobs: Knobs) -> Ask:
        """The ask at one point of the map."""
        scene = self.scene_with_kn(knobs.kn) if self.scene_with_kn and knobs.kn else self.scene
        return Ask(scene, self.goal, self.observables, knobs)


def why_too_long(
    study: Ladder | Search | Grid, knobs: Knobs, pace: tuple[float, float]
) -> str | None:
    """Why a setting is not run, because it would exceed `cpu_limit`; None if it is run.

    pace: CPU time of the scheme per step, and per step and body [s].
    """
    if isinstance(study, Search) or knobs.dt is None:
        return None
    steps = study.goal.steps(knobs.dt)
    each = pace[0] + pace[1] * (len(study.scene.spheres) + len(study.scene.blocks))
    if steps * each <= study.cpu_limit:
        return None
    return (
        f"not run: {steps:.2g} steps of about {each:g} s each; the limit is {study.cpu_limit:g} s, "
        f"{study.cpu_limit / each:.2g} steps"
    )


def settings_of(study: Ladder | Search | Grid, knobs: Knobs) -> Iterator[Knobs]:
    """The settings of a study at all levels, with those knobs alone that `knobs` has too."""
    names = [name for name, value in vars(knobs).items() if value is not None]
    for one in itertools.chain(*study.rungs.values()):
        yield Knobs(**{name: getattr(one, name) for name in names})


def has_setting(study: Ladder | Search | Grid, knobs: Knobs) -> bool:
    """Whether knobs are a setting of a study at any level, as far as a scheme has them."""
    return knobs in settings_of(study, knobs)


def knobs_in_scene(study: Ladder | Search | Grid) -> tuple[str, ...]:
    """Names of the knobs that change the scene itself, whether or not a scheme has them."""
    return ("kn",) if isinstance(study, Grid) and study.scene_with_kn else ()


OWN_STIFFNESS: Mapping[Level, tuple[float | None, ...]] = dict.fromkeys(Level, (None,))
Study = Ladder | Search | Grid
