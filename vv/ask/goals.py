"""Duration and output times of a run, its numerical setting, and the bracket of a search."""

from __future__ import annotations

import enum
from dataclasses import dataclass, field

import numpy as np

from vv.scene import Vector


@dataclass(frozen=True)
class History:
    """Report observables from 0 to `duration` [s], about every `interval` [s].

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
        """Number of steps of dt [s] between two outputs."""
        return max(1, round(self.interval / dt))

    def steps(self, dt: float) -> int:
        """Number of steps of dt [s] up to the last output within the duration."""
        stride = self.stride(dt)
        return int((self.duration / dt) * (1 + 1e-12) + 1e-9) // stride * stride

    def times(self, dt: float | None) -> Vector:
        """Output times (k,) [s] from 0, at whole steps of dt, or every `interval` if dt is None."""
        if dt is None:
            outputs = int(self.duration / self.interval * (1 + 1e-12))
            return np.asarray(self.interval * np.arange(outputs + 1), float)
        return np.asarray(dt * np.arange(0, self.steps(dt) + 1, self.stride(dt)), float)


@dataclass(frozen=True)
class Knobs:
    """One numerical setting: step dt [s], and stiffness kn [N/m] if the contact is rigid.

    None means that the scheme has no such knob. dd: the fraction of the velocity that is kept from
    step to step (kinetic damping); None keeps all, and a scheme without this knob refuses any other
    value. Raises ValueError unless dt and kn are positive and finite, and dd is between 0 and 1.
    """

    dt: float | None = None
    kn: float | None = None
    dd: float | None = field(default=None, metadata={"omitted": True})  # of records, if None

    def __post_init__(self) -> None:
        for name, unit in (("dt", "s"), ("kn", "N/m")):
            value = getattr(self, name)
            if value is not None and not (np.isfinite(value) and value > 0):
                raise ValueError(f"{name} = {value!r} {unit}; a knob must be positive and finite")
        if self.dd is not None and not 0 <= self.dd <= 1:
            raise ValueError(f"dd = {self.dd!r}; a step keeps a fraction between 0 and 1")


NO_STIFFNESS = (  # why codes on springs refuse rigid contact
    "these settings give no kn, which codes on springs need for rigid contact: "
    "Knobs(dt=..., kn=1e9)"
)


class SearchVariable(enum.Enum):
    """What a search varies: the step [s], or the factor by which shaking is multiplied."""

    STEP = "dt"
    SHAKING = "times the shaking"


@dataclass(frozen=True)
class Bracket:
    """The values among which the largest stable one is searched, and how.

    Steps range from Knobs.dt to `span` times that; the factor on the shaking ranges from 1 to
    `span`. A value is stable if the run reaches its end and no component of an observable exceeds
    `bound`, in the observable's unit. In each of `rounds` rounds, `tries` values are tried: first
    over the bracket, then between the last stable value and the first unstable one. Raises
    ValueError unless span > 1, bound > 0, tries >= 2 and rounds >= 1.
    """

    span: float
    bound: float
    tries: int = 10
    rounds: int = 3
    variable: SearchVariable = SearchVariable.STEP

    def __post_init__(self) -> None:
        if not (np.isfinite(self.span) and self.span > 1):
            raise ValueError(f"Bracket.span = {self.span!r}; a bracket must span more than 1")
        if not (np.isfinite(self.bound) and self.bound > 0):
            raise ValueError(f"Bracket.bound = {self.bound!r}; a bound must be positive and finite")
        if self.tries < 2 or self.rounds < 1:
            raise ValueError(
                f"Bracket.tries = {self.tries}, rounds = {self.rounds}; at least 2 and 1 are needed"
            )

    def stability_limits(self, tried: Vector) -> tuple[float, float | None]:
        """The largest value below all unstable ones (0 if none), and the smallest unstable one.

        tried: (n, 2), as in Run.tried. The second value is None if all were stable.
        """
        lost = np.flatnonzero(~(tried[:, 1] <= self.bound))
        first = int(lost[0]) if len(lost) else len(tried)
        stable = float(tried[first - 1, 0]) if first else 0.0
        return stable, float(tried[first, 0]) if len(lost) else None
