"""Runs cases from Python, for notebooks and scripts: what `vv run` does, with a table as answer.

It is not in `vv/__init__.py`, which every module imports, since results would then depend on the
command line.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from vv.case import Level
from vv.cli import invocation, options
from vv.output.table import table
from vv.plan.project import find

if TYPE_CHECKING:
    import pandas as pd


def verify(
    *selection: str,
    codes: str = "*",
    level: str = "default",
    settings: Sequence[str] = (),
    rungs: Sequence[str] = (),
) -> pd.DataFrame:
    """Run cases in codes as `vv run` does, and return the results as `vv.results` does.

    selection: FAMILY, CASE or CASE:VARIANT, with globs. codes: CODE[/SCHEME],... level: quick,
    default or paper. settings: texts NAME=VALUE[UNIT]. rungs: texts dt=..[,kn=..]. Stored results
    are not computed again; no report is written. Raises UsageError for what does not exist,
    ValueError for another level.
    """
    from vv.plan.plan import Options
    from vv.run.limits import Limits

    project, named = options.with_programs(find(), codes)
    chosen = Options(Level(level), named, tuple(settings), options.knobs(list(rungs)))
    plan = options.plan_of(project, list(selection), chosen)
    limits = Limits(options.workers(0), options.TIMEOUT)
    return table(invocation.carry_out_with_progress(project, plan, limits).records)
