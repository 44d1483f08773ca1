"""Runs cases from Python, for notebooks and scripts: what `vv run` does, with a table as answer.

It is not in `vv/__init__.py`, which every module imports, since results would then depend on the
command line.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from vv.base import closure
from vv.base.closure import OUR_PACKAGES
from vv.base.errors import UsageError
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
    are not computed again; no report is written. Raises UsageError for what does not exist and
    where a file that this process has loaded was edited since, ValueError for another level.
    """
    from vv.plan.plan import Options
    from vv.run.limits import Limits

    _require_unchanged()
    project, named = options.with_programs(find(), codes)
    chosen = Options(Level(level), named, tuple(settings), options.knobs(list(rungs)))
    limits = Limits(options.workers(0), options.TIMEOUT)
    try:
        plan = options.plan_of(project, list(selection), chosen)
        return table(invocation.carry_out_with_progress(project, plan, limits).records)
    finally:
        _note_loaded()


def _require_unchanged() -> None:
    """Raise UsageError for edited files: Python would go on with what it loaded before."""
    if changed := closure.changed_files():
        names = ", ".join(map(str, changed))
        raise UsageError(f"files have changed since they were loaded: restart Python ({names})")


def _note_loaded() -> None:
    """Take the digests of the modules loaded so far, also of those that a failed plan loaded."""
    ours = [m for name, m in [*sys.modules.items()] if name.partition(".")[0] in OUR_PACKAGES]
    files = [Path(module.__file__).resolve() for module in ours if module.__file__]
    closure.source_digest([file for file in files if file.is_file()])
