"""Measures the cost of the first run of each in-house code, and of compiling its kernels."""

import resource
import subprocess
import sys
import tempfile
from pathlib import Path

from bench.evidence import conclude, usual

FIRST = 10.0  # the most CPU seconds of the first run of one case
TOGETHER = 45.0  # the most CPU seconds for compiling the kernels of all engines
RUNS = (
    ("exact", "single-contact:T1"),
    ("dem", "single-contact:T1"),
    ("dem", "close-packed-lattice"),
    ("dem", "crowd"),
    ("dda", "responding-block:3d-turning"),
    ("rigid", "responding-block:3d-turning"),
)
ENGINES = ("dem", "dda", "rigid")


def spent(selection: str, code: str, kernels: str) -> float:
    """The CPU seconds of a run at level quick with an empty store, worker processes included."""
    command = [sys.executable, "-m", "vv", "run", selection, "--codes", code, "--level", "quick"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.TemporaryDirectory() as data:
        env = usual(VV_CACHE=kernels, VV_DATA=data)
        done = subprocess.run(command, env=env, check=False, capture_output=True, text=True)
    if done.returncode:
        said = [line for line in done.stdout.splitlines() if line.startswith(("red", "gate"))]
        said = said or done.stderr.splitlines()
        raise SystemExit(
            f"{' '.join(command[2:])} ended with {done.returncode}; its time means nothing: "
            f"{'; '.join(said) or 'no word'}"
        )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def first(selection: str, code: str) -> tuple[float, float]:
    """The CPU seconds of a run without compiled kernels, and of the next run with them."""
    with tempfile.TemporaryDirectory() as folder:
        kernels = str(Path(folder) / "kernels")
        return spent(selection, code, kernels), spent(selection, code, kernels)


def main() -> None:
    """Measure and judge."""
    runs = {f"{case} in {code}": first(case, code) for code, case in RUNS}
    whole = {f"all kernels of {code}": first("--all", code) for code in ENGINES}
    compiling = {name: cold - warm for name, (cold, warm) in whole.items()}
    conclude(
        "first-runs",
        {
            "first run [CPU s]": {name: cold for name, (cold, _) in runs.items()},
            "second run [CPU s]": {name: warm for name, (_, warm) in runs.items()},
            "compiling [CPU s]": compiling,
        },
        {
            f"every first run takes at most {FIRST:g} s of CPU": all(
                cold <= FIRST for cold, _ in runs.values()
            ),
            f"all kernels together take at most {TOGETHER:g} s": sum(compiling.values())
            <= TOGETHER,
        },
    )


if __name__ == "__main__":
    main()
