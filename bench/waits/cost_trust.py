"""Checks whether two timing sessions on a busy machine give the same costs.

`python -m bench.waits.cost_trust [SELECTION...]` times all timed cases, or those named, twice,
while another process keeps each core busy.
"""

import contextlib
import itertools
import json
import multiprocessing
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from bench.evidence import conclude

LEAST, APART = (
    1e-3,
    0.25,
)  # CPU seconds above which figures must agree, and how closely
SINGLE, SLIDING = ("single-contact:T?",), ("incline:newmark-30", "incline:two-directions")
EVERYTHING = (*SINGLE, *SLIDING, *(f"responding-block:{n}d" for n in (1, 2, 3)))
Place = tuple[str, str, str, float | None, float | None]
Session = dict[Place, tuple[float, float]]


def burn(core: int) -> None:
    """Keep a core busy as long as the parent process lives."""
    parent = os.getppid()
    os.sched_setaffinity(0, {core})
    while os.getppid() == parent:
        sum(range(100_000))


@contextlib.contextmanager
def busy() -> Iterator[None]:
    """Keep all cores of this process busy in the block."""
    cores = os.sched_getaffinity(0)
    burners = [multiprocessing.Process(target=burn, args=(n,), daemon=True) for n in cores]
    for burner in burners:
        burner.start()
    try:
        yield
    finally:
        for burner in burners:
            burner.terminate()


def vv(folder: Path, *words: str) -> None:
    """Run a command of vv with its results in a folder."""
    env = {**os.environ, "VV_DATA": str(folder)}
    command = [sys.executable, "-m", "vv", *words]
    subprocess.run(command, env=env, check=True, capture_output=True)


def session(folder: Path, selection: Sequence[str]) -> Session:
    """Place -> (least, largest) CPU seconds of its repeats, from a new timing session."""
    shutil.rmtree(folder / "timings", ignore_errors=True)
    target = folder / "speed.json"
    vv(folder, "speed", *selection, "--json", str(target))
    efforts: Sequence[dict[str, Any]] = json.loads(target.read_text())["efforts"]
    return {
        (e["case"], e["variant"], e["label"], p["dt"], p["kn"]): (
            p["cpu"],
            p["cpu"] * (1 + p["spread"]),
        )
        for e in efforts
        for row in e["rows"]
        for p in row["points"]
        if p["cpu"] is not None
    }


def rankings(one: Session, two: Session) -> tuple[int, list[str]]:
    """The number of pairs on a variant that are distinct in both sessions, and reversed pairs."""
    apart, turned = 0, []
    for a, b in itertools.permutations(one, 2):
        if a[:2] == b[:2] and one[a][1] < one[b][0]:
            if two[b][1] < two[a][0]:
                turned.append(f"{a} and {b[2:]}")
            apart += two[b][1] < two[a][0] or two[a][1] < two[b][0]
    return apart, turned


def gaps(one: Session, two: Session) -> dict[Place, float]:
    """The relative difference of each figure of a millisecond or more, over the smaller one."""
    pairs = {place: sorted((one[place][0], two[place][0])) for place in one}
    return {place: high / low - 1 for place, (low, high) in pairs.items() if high >= LEAST}


def main() -> None:
    """Measure and judge."""
    selection = tuple(sys.argv[1:]) or EVERYTHING
    folder = Path(".vv").absolute() / "cost-trust"
    vv(folder, "run", *selection)
    with busy():
        one, two = session(folder, selection), session(folder, selection)
    assert one.keys() == two.keys(), "the sessions timed different things"
    found = gaps(one, two)
    worst = sorted(found, key=lambda place: -found[place])[:5]
    apart, turned = rankings(one, two)
    conclude(
        "cost-trust",
        {
            "figures": len(one),
            "of at least a millisecond": len(found),
            "largest disagreements": {str(place): found[place] for place in worst},
            "disagree": sum(gap > APART for gap in found.values()),
            "rankings": apart,
            "reversed rankings": turned,
        },
        {
            "CPU figures of a millisecond and more agree within 25 %": max(found.values()) <= APART,
            "no ranking is reversed": not turned,
        },
    )


if __name__ == "__main__":
    main()
