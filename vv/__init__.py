"""vv: verification and validation of contact mechanics codes.

May import: cli, output.
"""

from __future__ import annotations

import importlib
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
    # Not imported here: solvers import this file, and must not be run again when output changes.
    found: pd.DataFrame = importlib.import_module("vv.output.table").results(source)
    return found
