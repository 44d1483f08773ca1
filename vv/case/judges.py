"""How a quantity is judged: norms, tolerances and judges, each with its reason."""

from __future__ import annotations

import enum
import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from vv.ask import Knobs, Method


class Norm(enum.Enum):
    """How a series is compared with its reference."""

    MAX = "max|e| / max|ref|"
    FINAL = "|e| / |ref| at the final time"
    POINTWISE = "max |e/ref| where |ref| >= 1 % of max|ref|"
    L2 = "||e||_2 / ||ref||_2"


LOOSEST = 0.1  # relative error that no tolerance exceeds, however coarse the step


@dataclass(frozen=True)
class Tolerance:
    """A bound on an error and why: value at the step dt [s], growing as dt**order above floor.

    With kn [N/m], it is the value at that stiffness of springs that stand in for rigid contact,
    and falls as kn**-softness. It grows to LOOSEST at most: an answer farther off than that is
    wrong at any step.

    slack: why the bound is more than a hundred times what codes reach, where it is.
    """

    value: float
    reason: str
    dt: float | None = None
    order: int = 0
    floor: float = 0.0
    slack: str = ""
    kn: float | None = None
    softness: float = 0.0

    def __post_init__(self) -> None:
        if not 0 < self.value <= LOOSEST:
            raise ValueError(
                f"Tolerance.value = {self.value!r}; it must be positive and {LOOSEST:g} at most"
            )
        for name, unit in (("dt", "s"), ("kn", "N/m")):
            at = getattr(self, name)
            if at is not None and not 0 < at < math.inf:
                raise ValueError(f"Tolerance.{name} = {at!r} {unit}; it must be positive")
        for power, knob in (("order", "dt"), ("softness", "kn")):
            exponent, given = getattr(self, power), getattr(self, knob) is not None
            if not (exponent == 0 or (exponent > 0 and given)):
                rule = f"it must not be negative, and needs the {knob} it grows from"
                raise ValueError(f"Tolerance.{power} = {exponent!r}; {rule}")
        if not 0 <= self.floor <= self.value:
            raise ValueError(
                f"Tolerance.floor = {self.floor!r}; it must lie in [0, {self.value!r}]"
            )

    def at(self, knobs: Knobs) -> float:
        """The bound for a run with these knobs."""
        bound = self.value
        if self.dt is not None and knobs.dt is not None:
            bound *= (knobs.dt / self.dt) ** self.order
        if self.kn is not None and knobs.kn is not None:
            bound *= (self.kn / knobs.kn) ** self.softness
        return min(LOOSEST, max(self.floor, bound))


@dataclass(frozen=True)
class Exact:
    """Judge: the error against a reference, in a norm, within the tolerance of the method.

    shown: why methods that promise no answer here are not judged; their result is shown.
    """

    tolerances: Mapping[Method, Tolerance]
    norm: Norm = Norm.MAX
    shown: Mapping[Method, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Interval:
    """Judge: the value itself must lie within [low, high]."""

    low: float
    high: float
    reason: str


@dataclass(frozen=True)
class Invariant:
    """Judge: the value must be conserved: |value - reference| <= bound times the scale."""

    bound: float
    reason: str


@dataclass(frozen=True)
class Shown:
    """No judge: the value is shown, with the reason why it is not judged."""

    reason: str


Judge = Exact | Interval | Invariant | Shown


def judge_of(judge: Judge, method: Method) -> Judge:
    """How a quantity with that judge is judged in a method."""
    if isinstance(judge, Exact) and method in judge.shown:
        return Shown(judge.shown[method])
    return judge
