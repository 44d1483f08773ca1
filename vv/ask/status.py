"""The status of a job, and the classes of method."""

from __future__ import annotations

import enum


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
    """The accuracy that a scheme claims; it decides which tolerance of a quantity applies."""

    EXACT = "exact to rounding"
    LINEARISED = "exact to first order in the displacements"
    LEAPFROG = "second order in dt, a leapfrog"
    LATE_LEAPFROG = "first order in dt, a leapfrog with forces half a step late"
    SECOND_ORDER = "second order in dt"
    FIRST_ORDER = "first order in dt"
    STRAIGHT = "first order in dt, of second in positions where slip keeps its line"
    PENALTY = "penalty contact"
    DAMPED = "penalty contact, second order in dt by generalised alpha of radius 1/2"
    LAGGING = "penalty contact whose friction lags behind the load"

    @property
    def general(self) -> Method:
        """The wider class whose tolerances apply if a class has none."""
        return _GENERAL.get(self, self)


_GENERAL = {
    Method.LEAPFROG: Method.SECOND_ORDER,
    Method.LATE_LEAPFROG: Method.FIRST_ORDER,
    Method.STRAIGHT: Method.FIRST_ORDER,
    Method.DAMPED: Method.PENALTY,
}
