"""Times the command line: quick commands, and invocations with an empty or a full store."""

import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from bench.evidence import conclude, usual

ROOT = Path(__file__).parents[2]
LOOKS = ("list", "--help")


def spent(words: str, folder: Path = ROOT, **environment: str) -> tuple[float, float]:
    """The (CPU seconds, wall seconds) of `vv` with its children, in a folder."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    env = usual(PYTHONPATH=str(ROOT), **environment)
    command = [sys.executable, "-m", "vv", *words.split()]
    subprocess.run(command, cwd=folder, env=env, check=True, capture_output=True)
    wall, after = time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return cpu, wall


def alone(folder: Path, case: str) -> Path:
    """A project with this case only, copied to a folder."""
    for content in ("adapters", "cases", "reference_solutions"):
        kept = shutil.ignore_patterns("__pycache__", "baselines", "recorded")
        shutil.copytree(ROOT / content, folder / content, ignore=kept)
    for path in (folder / "cases").rglob("*.py"):
        if path.name[0] != "_" and path.stem != case.replace("-", "_"):
            path.unlink()
    (folder / "vv.toml").write_text("alone = true\n")
    return folder


def cold_and_again(folder: Path, words: str) -> tuple[float, float]:
    """The wall seconds of an invocation with an empty store, and of its repetition."""
    with tempfile.TemporaryDirectory() as data:
        cold = spent(words, folder, VV_DATA=data)[1]
        return cold, min(spent(words, folder, VV_DATA=data)[1] for _ in range(3))


def main() -> None:
    """Measure and judge."""
    looks = max(min(spent(words)[0] for _ in range(5)) for words in LOOKS)
    with tempfile.TemporaryDirectory() as folder:
        one, one_again = cold_and_again(alone(Path(folder), "single-contact"), "run --all")
    every, again = cold_and_again(ROOT, "run --all")
    gate, gate_again = cold_and_again(ROOT, "gate --require yade,liggghts")
    with tempfile.TemporaryDirectory() as data:
        spent("gate --level quick", VV_DATA=data)
        other = spent("gate --level quick --jobs 2", VV_DATA=data)[1]
    figures = {
        "vv list, vv --help [CPU s]": (looks, 0.4),
        "single-contact alone, cold [s]": (one, 30),
        "single-contact alone, again [s]": (one_again, 2),
        "vv run --all, cold [s]": (every, 300),
        "vv run --all, again [s]": (again, 2),
        "vv gate, cold [s]": (gate, 60),
        "vv gate, again [s]": (gate_again, 3),
        "vv gate, in other words on a warm store [s]": (other, 3),
    }
    bars = {f"{what}: at most {bar}": found <= bar for what, (found, bar) in figures.items()}
    conclude("command-line", {what: found for what, (found, _) in figures.items()}, bars)


if __name__ == "__main__":
    main()
