"""The answer of a code: observables, cost, model and energy, or the reason why it has none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from vv.ask.observables import Observable
from vv.ask.status import Status
from vv.scene import Form, Term, Vector


@dataclass(frozen=True)
class Cost:
    """Time spent on a run [s], by part; solve_cpu is the CPU time of the stepping loop alone.

    repeats: the number of timed solves; solve_cpu is their minimum, and spread is (maximum -
    minimum)/minimum. whole: solve_cpu and solve_wall are those of the whole process, including
    start and output, since nothing better is known. Raises ValueError for a negative cost.
    """

    startup: float = 0.0
    setup: float = 0.0
    solve_cpu: float = 0.0
    solve_wall: float = 0.0
    output: float = 0.0
    repeats: int = 1
    spread: float = 0.0
    whole: bool = False

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not value >= 0:
                raise ValueError(f"Cost.{name} = {value!r}; a cost cannot be negative")


@dataclass(frozen=True)
class Model:
    """What a scheme actually solved: number of unknowns, terms modelled, and a note in words."""

    unknowns: int
    terms: frozenset[Term]
    note: str = ""


@dataclass(frozen=True)
class Ledger:
    """The energy balance of a run: energies and works at its end [J] by name, and the remainder.

    terms: name -> energy or work; unaccounted: the largest |sum of them - initial energy| over the
    run [J]; peak: the largest energy stored [J]; bound: the limit that the scheme declares for
    unaccounted, or None. audits: name of a law (momentum, Coulomb, penetration) -> (largest
    violation, violation allowed).
    """

    terms: Mapping[str, float]
    unaccounted: float
    peak: float
    bound: float | None = None
    audits: Mapping[str, tuple[float, float]] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Run:
    """The outcome of an ask: a status with its reason and, if it ran, the observables.

    times: (k,) [s]; values: observable -> (k, 3) in the scene's frame; energies: form -> (k,) [J]
    if they were asked for. tried: (n, 2), of a search: the steps [s] or factors on the shaking that
    were tried, ascending, and the largest component of an observable at each, inf if the run did
    not reach its end. Times and values of a search are those of the first try.
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
