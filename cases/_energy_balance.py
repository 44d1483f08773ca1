"""The quantity `balance`: the energy that a code's own ledger leaves unexplained."""

from __future__ import annotations

import math
from collections.abc import Mapping

from vv.ask import Method, Run
from vv.case import Exact, Scalar, Tolerance


def balance(within: Mapping[Method, Tolerance]) -> Scalar:
    """Energy that no term of the ledger explains, over the largest energy stored.

    Judged only in codes that report a ledger.
    """
    what = "energy that no term of the ledger explains, over the largest energy stored"
    return Scalar(
        "balance",
        "|E - W|/W",
        "",
        what,
        _unaccounted,
        0.0,
        1.0,
        Exact(within),
        is_reported=_has_ledger,
    )


def _unaccounted(run: Run) -> float:
    return run.ledger.unaccounted / run.ledger.peak if run.ledger else math.nan


def _has_ledger(run: Run) -> bool:
    return run.ledger is not None
