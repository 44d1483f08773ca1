"""Imports YADE into its own Python, and defines how a run is rejected."""

import glob
import os
import sys
import types
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")  # read when YADE is imported
FOLDER = os.environ.get("VV_YADE") or next(iter(glob.glob("/usr/lib/*/yade-double/py")), "")
WITHIN_YADE = "yade" in sys.modules  # true if started by `yade script.py`
UNASKED = FOLDER and not WITHIN_YADE  # there is no interactive user
if UNASKED:
    sys.path.insert(0, FOLDER)
    # YADE needs only IPython's version here; importing it would take a third of the start-up
    sys.modules["IPython"] = prompt = types.ModuleType("IPython")
    vars(prompt)["__version__"] = "0.0"
import yade  # noqa: E402
from yade import utils  # noqa: E402
from yade import wrapper as yd  # noqa: E402

if UNASKED:
    del sys.modules["IPython"]  # later imports get the real module

__all__ = ["FOLDER", "WITHIN_YADE", "O", "RunError", "timed", "utils", "yade", "yd"]
O = yade.O  # noqa: E741  # the name every YADE script uses


class RunError(Exception):
    """A run that must not count, with its status and reason."""

    def __init__(self, status: str, reason: str) -> None:
        super().__init__(reason)
        self.status = status


def timed(clock: Any, work: Any, *given: Any) -> float:
    """The seconds that a function takes by a clock, such as that of CPU time."""
    start = clock()
    work(*given)
    return float(clock() - start)
