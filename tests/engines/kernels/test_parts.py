"""Claims about parts of kernels: each is linked wherever a kernel needs it."""

import subprocess
import sys
from pathlib import Path

from tests import ROOT

CALLED_FIRST_IN_VAIN = """
from vv.engines.kernels.compiled import called, compiled


@called
def deepest(x: float) -> float:
    return x * x + 1.0


@called
def first(x: float) -> float:
    y = x
    if x < x:
        y = deepest(x)
    return y + 1.0


@called
def second(x: float) -> float:
    return deepest(x) + 2.0


@compiled
def kernel(x: float) -> float:
    return first(x) + second(x)


print(kernel(3.0))
"""


def test_a_part_whose_first_caller_does_without_it_is_there_for_the_next(tmp_path: Path) -> None:
    script = tmp_path / "kernels.py"
    script.write_text(CALLED_FIRST_IN_VAIN)
    command = [sys.executable, str(script)]
    env = {"PYTHONPATH": str(ROOT), "VV_CACHE": str(tmp_path / "cache")}
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "16.0\n"), done.stderr
