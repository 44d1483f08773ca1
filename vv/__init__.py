"""vv: verification and validation of contact mechanics codes.

May import: cli, output.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd

__version__ = "0.1.0"


def results(source: str | Path | None = None) -> pd.DataFrame:
    """Stored results as a table, a row for each record and quantity; for notebooks.

    source: a manifest of a store, or a document that `--json` wrote; if not given, the latest
    invocation of the project that the current folder lies in.
    """
    from vv.output import table

    return table.results(source)


def verify(
    *selection: str,
    codes: str = "*",
    level: str = "default",
    settings: Sequence[str] = (),
    rungs: Sequence[str] = (),
) -> pd.DataFrame:
    """Run cases in codes as `vv run` does, and return the results as `results` does.

    selection: FAMILY, CASE or CASE:VARIANT, with globs. codes: CODE[/SCHEME],... level: quick,
    default or paper. settings: texts NAME=VALUE[UNIT]. rungs: texts dt=..[,kn=..]. What is stored
    is not run again; no report is written. Raises UsageError for what does not exist.
    """
    from vv.cli import from_python

    return from_python.verify(selection, codes, level, settings, rungs)
