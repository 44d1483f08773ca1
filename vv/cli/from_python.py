"""Runs cases from Python: what `vv run` does, with a table as the answer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from vv.case import Level
from vv.cli import options
from vv.plan.project import find

if TYPE_CHECKING:
    import pandas as pd


def verify(
    selection: Sequence[str], codes: str, level: str, settings: Sequence[str], rungs: Sequence[str]
) -> pd.DataFrame:
    """The results of a selection, from the store where they stand. As `vv.verify` has it."""
    from vv.cli import invocation
    from vv.output.table import table
    from vv.plan.plan import Options
    from vv.run.session import Limits

    project, named = options.with_programs(find(), codes)
    chosen = Options(Level(level), named, tuple(settings), options.knobs(list(rungs)))
    plan = options.plan_of(project, list(selection), chosen)
    limits = Limits(options.workers(0), options.TIMEOUT)
    return table(invocation.carried_out(project, plan, limits).records)
