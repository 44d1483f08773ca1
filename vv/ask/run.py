"""What comes back from a code: observables, cost, model, energy, or why there are none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from vv.ask.observables import Observable
from vv.ask.status import Status
from vv.scene import Form, Term, Vector


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
