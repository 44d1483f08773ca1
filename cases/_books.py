"""How far a code's own energy ledger is from closing, for cases to judge."""

from __future__ import annotations

import math
from collections.abc import Mapping

from vv.ask import Method, Run
from vv.case import Exact, Scalar, Tolerance


def balance(within: Mapping[Method, Tolerance]) -> Scalar:
    """Energy that no term of the ledger explains, over the largest held; told by codes with one."""
    what = "energy that no term explains, over the largest held"
    return Scalar("balance", "|E - W|/W", "", what, _open_by, 0.0, 1.0, Exact(within), told=_kept)


def _open_by(run: Run) -> float:
    return run.ledger.unaccounted / run.ledger.peak if run.ledger else math.nan


def _kept(run: Run) -> bool:
    return run.ledger is not None
