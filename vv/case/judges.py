"""How a quantity is judged: norms of errors, tolerances and judges, with their reasons."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from vv.ask import Knobs, Method
from vv.case.code_to_code import CodeToCode
from vv.case.measured import Measured


class Norm(enum.Enum):
    """The norm in which a series is compared with its reference."""

    MAX = "max|e| / max|ref|"
    FINAL = "|e| / |ref| at the final time"
    POINTWISE = "max |e/ref| where |ref| >= 1 % of max|ref|"
    L2 = "||e||_2 / ||ref||_2"


LARGEST_TOLERANCE = 0.1  # relative error; a larger one is wrong at any step


@dataclass(frozen=True)
class Tolerance:
    """A bound on a relative error and the reason for it.

    value: the bound at the step dt [s] and at the stiffness kn [N/m] of springs that represent
    rigid contact. It scales as dt**order and kn**-softness with the setting. late [1/s] times the
    step is added, for events that take effect only at whole steps. The bound is never below `floor`
    nor, at a case's own parameters and settings, above LARGEST_TOLERANCE; at others it may be, and
    from 1 on a run is only shown. slack: the reason, if the bound is more than a hundred times the
    error that codes reach. least: the least bound at a step [s], for an error that grows faster
    than dt**order in long steps. more: what is added at a stiffness [N/m], for an error that is no
    power of it. Raises ValueError naming the field, the value and the rule.
    """

    value: float
    reason: str
    dt: float | None = None
    order: int = 0
    floor: float = 0.0
    slack: str = ""
    kn: float | None = None
    softness: float = 0.0
    late: float = 0.0
    least: Callable[[float], float] | None = None
    more: Callable[[float], float] | None = None

    def __post_init__(self) -> None:
        if not self.value > 0:
            raise ValueError(
                f"Tolerance.value = {self.value:.6g}; the relative error that it allows must be "
                "positive"
            )
        for name, unit in (("dt", "s"), ("kn", "N/m")):
            at = getattr(self, name)
            if at is not None and not 0 < at < math.inf:
                raise ValueError(f"Tolerance.{name} = {at!r} {unit}; it must be positive")
        for power, knob in (("order", "dt"), ("softness", "kn")):
            exponent, given = getattr(self, power), getattr(self, knob) is not None
            if not (exponent == 0 or (exponent > 0 and given)):
                rule = f"it must not be negative, and needs the {knob} it refers to"
                raise ValueError(f"Tolerance.{power} = {exponent!r}; {rule}")
        if not 0 <= self.late < math.inf:
            raise ValueError(f"Tolerance.late = {self.late!r} 1/s; it must be zero or more")
        if not 0 <= self.floor < math.inf:
            raise ValueError(f"Tolerance.floor = {self.floor!r}; it must be zero or more")

    def at(self, knobs: Knobs) -> float:
        """The bound at a setting."""
        return min(LARGEST_TOLERANCE, self.uncut(knobs))

    def uncut(self, knobs: Knobs) -> float:
        """The bound at a setting, which may exceed LARGEST_TOLERANCE."""
        bound = self.value
        if self.dt is not None and knobs.dt is not None:
            bound *= (knobs.dt / self.dt) ** self.order
        if self.kn is not None and knobs.kn is not None:
            bound *= (self.kn / knobs.kn) ** self.softness
        bound += self.late * (knobs.dt or 0.0)
        if self.more is not None and knobs.kn is not None:
            bound += self.more(knobs.kn)
        steep = self.least(knobs.dt) if self.least is not None and knobs.dt is not None else 0.0
        return max(self.floor, bound, steep)


@dataclass(frozen=True)
class Exact:
    """Judge: the error against the reference must be within the tolerance of the class of method.

    not_judged: class of method -> the reason why its result is shown and not judged. A class that
    is in neither mapping, such as a leapfrog, is judged as its general class.
    """

    tolerances: Mapping[Method, Tolerance]
    norm: Norm = Norm.MAX
    not_judged: Mapping[Method, str] = field(default_factory=dict)

    def tolerance(self, method: Method) -> Tolerance:
        """The tolerance for a class of method; raises KeyError where it has none."""
        own = method if method in self.tolerances else method.general
        return self.tolerances[own]


@dataclass(frozen=True)
class Interval:
    """Judge: the value itself must lie within [low, high]."""

    low: float
    high: float
    reason: str


@dataclass(frozen=True)
class Invariant:
    """Judge: a conserved value, |value - reference| <= bound times the scale."""

    bound: float
    reason: str


@dataclass(frozen=True)
class Shown:
    """No judgement: the value is only shown, with the reason."""

    reason: str


Judge = Exact | Interval | Invariant | Shown | Measured | CodeToCode


def judge_for_method(judge: Judge, method: Method) -> Judge:
    """The judge for a class of method: Shown, where `judge` has no tolerance for that class."""
    if not isinstance(judge, Exact):
        return judge
    for one in (method, method.general):
        if one in judge.not_judged:
            return Shown(judge.not_judged[one])
        if one in judge.tolerances:
            return judge
    return Shown(f"no tolerance for class {method.value}")


ELSEWHERE = "the parameters are not those of what was measured, or answered by another code"


def judge_at_other_parameters(judge: Judge) -> Judge:
    """The judge at parameters other than the case's own: Shown, if no answer is known there."""
    if isinstance(judge, CodeToCode) or (isinstance(judge, Measured) and not judge.law):
        return Shown(ELSEWHERE)
    return judge
