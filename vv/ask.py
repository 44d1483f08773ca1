"""What a case asks of a code and what comes back: Ask, Run, observables and statuses."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from vv.digest import digest
from vv.energy import Form
from vv.scene import Scene, Term, Vector


class Status(enum.Enum):
    """What happened to a job; the value is the phrase shown to people."""

    RAN = "ran"
    REFUSED = "refused"
    NOT_INSTALLED = "not installed"
    ERROR = "error"
    TIMEOUT = "timeout"
    DIVERGED = "diverged"
    NOT_RUN = "not run"
    TOO_LONG = "too long"


class Method(enum.Enum):
    """The class of a method: it decides which tolerance of a quantity applies."""

    EXACT = "exact to rounding"
    LINEARISED = "exact to first order in the displacements"
    SECOND_ORDER = "second order in dt"
    FIRST_ORDER = "first order in dt"
    PENALTY = "penalty contact"
    LAGGING = "penalty contact whose friction lags behind the load"


@dataclass(frozen=True)
class Displacement:
    """Observable: the displacement of a body's centre since t = 0, (3,) per time [m]."""

    body: int


@dataclass(frozen=True)
class Velocity:
    """Observable: the velocity of a body's centre, (3,) per time [m/s]."""

    body: int


@dataclass(frozen=True)
class Reaction:
    """Observable: the force on a body by what locks its translation, (3,) per time [N]."""

    body: int


@dataclass(frozen=True)
class Strain:
    """Observable: the normal strains of a block along the scene's axes, (3,) per time.

    They turn with the block, as its stress does, where a scheme does not say otherwise.
    """

    body: int


Observable = Displacement | Velocity | Reaction | Strain


@dataclass(frozen=True)
class History:
    """Goal: observables over `duration` [s], about every `interval` [s].

    Raises ValueError unless 0 < interval <= duration.
    """

    duration: float
    interval: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.duration) and 0 < self.interval <= self.duration):
            raise ValueError(
                f"History.duration = {self.duration!r} s, interval = {self.interval!r} s; "
                "0 < interval <= duration must hold"
            )

    def stride(self, dt: float) -> int:
        """How many steps of dt [s] lie between two outputs."""
        return max(1, round(self.interval / dt))

    def steps(self, dt: float) -> int:
        """How many steps are taken: the last output is the last one within the duration."""
        stride = self.stride(dt)
        return int((self.duration / dt) * (1 + 1e-12) + 1e-9) // stride * stride

    def times(self, dt: float | None) -> Vector:
        """Output times [s], from 0, at whole steps; dt None gives the plain grid."""
        if dt is None:
            outputs = int(self.duration / self.interval * (1 + 1e-12))
            return np.asarray(self.interval * np.arange(outputs + 1), float)
        return np.asarray(dt * np.arange(0, self.steps(dt) + 1, self.stride(dt)), float)


@dataclass(frozen=True)
class Knobs:
    """Numerical settings of a run: dt [s]; kn [N/m] where the scene's contact is rigid.

    None means that the scheme has no such knob. Raises ValueError unless positive.
    """

    dt: float | None = None
    kn: float | None = None

    def __post_init__(self) -> None:
        for name, unit in (("dt", "s"), ("kn", "N/m")):
            value = getattr(self, name)
            if value is not None and not (np.isfinite(value) and value > 0):
                raise ValueError(f"{name} = {value!r} {unit}; a knob must be positive and finite")


@dataclass(frozen=True)
class Bracket:
    """Where to search for the largest stable step: from Knobs.dt to `span` times as much.

    A step is stable if the run comes to its end and no component of an observable exceeds
    `bound`, in the observable's unit. `tries` steps at once are spread over the bracket, and then
    over the gap between the last stable and the first unstable one, `rounds` times in all.
    Raises ValueError.
    """

    span: float
    bound: float
    tries: int = 10
    rounds: int = 3

    def __post_init__(self) -> None:
        if not (np.isfinite(self.span) and self.span > 1):
            raise ValueError(f"Bracket.span = {self.span!r}; a bracket must span more than 1")
        if not (np.isfinite(self.bound) and self.bound > 0):
            raise ValueError(f"Bracket.bound = {self.bound!r}; a bound must be positive and finite")
        if self.tries < 2 or self.rounds < 1:
            raise ValueError(
                f"Bracket.tries = {self.tries}, rounds = {self.rounds}; at least 2 and 1 are needed"
            )

    def limits(self, tried: Vector) -> tuple[float, float | None]:
        """The last step [s] below all unstable ones, 0 for none, and the least unstable one.

        tried: as in a Run.
        """
        lost = np.flatnonzero(~(tried[:, 1] <= self.bound))
        first = int(lost[0]) if len(lost) else len(tried)
        stable = float(tried[first - 1, 0]) if first else 0.0
        return stable, float(tried[first, 0]) if len(lost) else None


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


@dataclass(frozen=True)
class Cost:
    """Seconds spent, part by part; solve_cpu is the stepping loop alone, of one solve.

    repeats: how many solves were timed; spread: (maximum - minimum)/minimum of their
    solve_cpu, whose minimum is what solve_cpu states.
    """

    startup: float = 0.0
    setup: float = 0.0
    solve_cpu: float = 0.0
    solve_wall: float = 0.0
    output: float = 0.0
    repeats: int = 1
    spread: float = 0.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not value >= 0:
                raise ValueError(f"Cost.{name} = {value!r}; a cost cannot be negative")


@dataclass(frozen=True)
class Model:
    """What a scheme really built: its unknowns, the terms it carries, and how in words."""

    unknowns: int
    terms: frozenset[Term]
    note: str = ""


@dataclass(frozen=True)
class Ledger:
    """Energy at the end of a run [J], by name, and what no term explains.

    unaccounted: the largest |sum of terms - energy put in| seen; peak: the largest total held;
    bound: what the scheme promises for unaccounted, None where it promises nothing. audits: name
    of a law, such as momentum, Coulomb or penetration -> (largest breach seen, breach allowed).
    """

    terms: Mapping[str, float]
    unaccounted: float
    peak: float
    bound: float | None = None
    audits: Mapping[str, tuple[float, float]] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Run:
    """What came of an ask: a status with its reason and, if it ran, the observables.

    times: (k,) [s]; values: observable -> (k, 3), in the scene's frame; energies: form -> (k,)
    [J], where they were asked. tried: of a search, (n, 2)
    the steps tried, ascending [s], and the largest component of an observable in each run, inf
    where it did not come to its end; the times and values are then those of the first step.
    """

    status: Status
    reason: str = ""
    times: Vector = field(default_factory=lambda: np.zeros(0))
    values: Mapping[Observable, Vector] = field(default_factory=dict)
    cost: Cost = field(default_factory=Cost)
    steps: int = 0
    model: Model | None = None
    ledger: Ledger | None = None
    energies: Mapping[Form, Vector] = field(default_factory=dict)
    tried: Vector = field(default_factory=lambda: np.zeros((0, 2)))
