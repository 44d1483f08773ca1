"""The enums of records: outcomes, verdicts, kinds of study, quantity, judge and cost.

In JSON a member is its name in small letters, with hyphens.
"""

from __future__ import annotations

import enum


class Verdict(enum.Enum):
    """The verdict on a quantity of a run; the value is the word shown to people."""

    PASS = "pass"
    FAIL = "fail"
    XFAIL = "xfail"
    XPASS = "xpass"
    NO_REFERENCE = "shown only"


class Outcome(enum.Enum):
    """The outcome of a job, as summaries count it; the value is the word shown to people.

    If the job did not run it is the status, otherwise the worst verdict of its quantities. BLOW_UP:
    it diverged in a map, where this is a result, or by a known breach. NOT_REPORTED and
    NOT_CONSERVED apply to jobs that ran.
    """

    ERROR = "error"
    DIVERGED = "diverged"
    TIMEOUT = "timeout"
    NOT_RUN = "not run"
    REFUSED = "refused"
    NOT_INSTALLED = "not installed"
    TOO_LONG = "too long"
    BLOW_UP = "blow-up"
    NOT_REPORTED = "not reported"
    NOT_CONSERVED = "not conserved"
    FAIL = "fail"
    XPASS = "xpass"
    XFAIL = "xfail"
    PASS = "pass"
    NO_REFERENCE = "shown only"


class StudyKind(enum.Enum):
    """The kind of a study: a ladder of rungs, a search for the largest stable step, a map."""

    LADDER = "ladder"
    SEARCH = "search"
    GRID = "grid"


class QuantityKind(enum.Enum):
    """The form of a quantity: a number, values over time, a whole number, values over two axes."""

    SCALAR = "scalar"
    SERIES = "series"
    COUNT = "count"
    MAP = "map"


class JudgeKind(enum.Enum):
    """How a quantity is judged: by its error, by its value, as conserved, or not at all.

    MEASURED: by its distance from a measurement; CODE_TO_CODE: by its distance from the answer of
    another code. Neither distance is an error of the code.
    """

    EXACT = "exact"
    INTERVAL = "interval"
    INVARIANT = "invariant"
    SHOWN = "shown"
    MEASURED = "measured"
    CODE_TO_CODE = "code-to-code"


class CostKind(enum.Enum):
    """Whether a cost was measured alone on one core, or while other jobs ran."""

    INDICATIVE = "indicative"
    TIMED = "timed"
