"""How long the command line takes: quick looks, a cold run of everything, and the same again."""

import os
import resource
import subprocess
import sys
import tempfile
import time

from bench.evidence import conclude


def spent(*words: str, **environment: str) -> tuple[float, float]:
    """(CPU seconds, wall seconds) of `vv` with its children."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    env = {**os.environ, **environment}
    subprocess.run([sys.executable, "-m", "vv", *words], env=env, check=True, capture_output=True)
    wall, after = time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return cpu, wall


def main() -> None:
    """Measure and judge."""
    looks = {
        f"vv {words} [CPU s]": min(spent(*words.split())[0] for _ in range(5))
        for words in ("list", "--help")
    }
    with tempfile.TemporaryDirectory() as data:
        cold = spent("run", "--all", VV_DATA=data)[1]
        warm = min(spent("run", "--all", VV_DATA=data)[1] for _ in range(3))
    figures = {**looks, "vv run --all, cold [s]": cold, "vv run --all, again [s]": warm}
    conclude(
        "command-line",
        figures,
        {
            "looks take at most 0.4 s of CPU": max(looks.values()) <= 0.4,
            "cold run of everything takes at most 30 s": cold <= 30,
            "the same again takes at most 2 s": warm <= 2,
        },
    )


if __name__ == "__main__":
    main()
