"""Codes that numba compiles: what their workers share is in memory before they start."""

from __future__ import annotations

import subprocess
import sys

from tests import ROOT

FIRST_CALL = """
import sys
from cases.contact.single_contact import CASE
from vv.ask import Knobs
from vv.engines import dem
from vv.codes.in_house import part_of_vv
part_of_vv().load()
before = set(sys.modules)
dem.solve_default(CASE.declare("T1", CASE.defaults("T1")).study.ask(Knobs(dt=1e-3)))
print([name for name in set(sys.modules) - before if name.startswith(("numba", "scipy"))])
"""


def test_the_first_kernel_of_a_worker_imports_no_more_of_the_compiler() -> None:
    command = [sys.executable, "-c", FIRST_CALL]
    for _ in range(2):  # the first call may have to compile
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
