"""Measures the cost of a whole run of one small case, and the part of imports in it."""

import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

from bench.evidence import conclude, usual

HEAVY = ("numba", "scipy", "matplotlib")
LOAD = """
import time
began = time.process_time()
from vv.plan.project import find
from vv.plan.plan import Options
from vv.plan.planning import make_plan
plan = make_plan(find(), ["single-contact:T1"], Options(codes=("dem/default",)))
planned = time.process_time()
import tempfile
from pathlib import Path
job = plan.jobs[0]
list(plan.adapters["dem"].run([job.ask], job.scheme, Path(tempfile.mkdtemp()), 0.0))
print(planned - began, time.process_time() - planned)
"""


def cpu(*command: str, **environment: str) -> float:
    """The CPU seconds of a command with its children."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(
        [sys.executable, *command], env=usual(**environment), check=True, capture_output=True
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def imported() -> list[str]:
    """The heavy libraries that `vv list` imports."""
    command = [sys.executable, "-X", "importtime", "-m", "vv", "list"]
    env = usual()
    told = subprocess.run(command, env=env, check=True, capture_output=True, text=True).stderr
    names = {line.rpartition("|")[2].strip().partition(".")[0] for line in told.splitlines()}
    return sorted(names & set(HEAVY))


def kernel(cache: str) -> float:
    """The CPU seconds of the first answer of the dem engine: import of numba, kernel, solve."""
    env = usual(VV_CACHE=cache)
    command = [sys.executable, "-c", LOAD]
    told = subprocess.run(command, env=env, check=True, capture_output=True, text=True).stdout
    return float(re.findall(r"\S+", told)[1])


def main() -> None:
    """Measure and judge; each figure is the least of a few."""
    figures: dict[str, object] = {}
    with tempfile.TemporaryDirectory() as data:
        for code in ("exact", "dem"):
            words = ("-m", "vv", "run", "single-contact:T1", "--codes", code, "--fresh")
            figures[code] = min(cpu(*words, VV_DATA=data) for _ in range(5))
        cache = str(Path(data) / "kernels")
        figures["first answer of dem, kernel compiled"] = kernel(cache)
        figures["first answer of dem, kernel from the cache"] = min(kernel(cache) for _ in range(3))
    for library in HEAVY:
        figures[f"import {library}"] = min(cpu("-c", f"import {library}") for _ in range(3))
    figures["import nothing"] = min(cpu("-c", "pass") for _ in range(3))
    figures["heavy imports of vv list"] = imported()
    conclude(
        "small-runs",
        {f"{name} [CPU s]" if isinstance(v, float) else name: v for name, v in figures.items()},
        {
            "exact takes less than 0.6 s of CPU": float(str(figures["exact"])) < 0.6,
            "dem takes less than 1.5 s of CPU": float(str(figures["dem"])) < 1.5,
            "vv list imports nothing heavy": not figures["heavy imports of vv list"],
        },
    )


if __name__ == "__main__":
    main()
