"""Whether costs can be trusted: two timing sessions on a busy machine must tell the same story."""

import json
import multiprocessing
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from bench.evidence import conclude

LEAST, APART = 1e-3, 0.25  # CPU seconds from which figures must agree, and within what
SELECTION = ("single-contact", "incline:newmark-30", "responding-block:1d")
Place = tuple[str, str, str, float | None, float | None]


def busy() -> None:
    """Keep a core busy for ever."""
    while True:
        sum(range(100_000))


def session(folder: Path, number: int) -> dict[Place, tuple[float, float]]:
    """Place -> (least, most) CPU seconds of its repeats, in a timing session of its own."""
    target = folder / f"{number}.json"
    command = [sys.executable, "-m", "vv", "speed", *SELECTION, "--fresh", "--json", str(target)]
    env = {**os.environ, "VV_DATA": str(folder / "data")}
    subprocess.run(command, env=env, check=True, capture_output=True)
    efforts: Sequence[dict[str, Any]] = json.loads(target.read_text())["efforts"]
    return {
        (e["case"], e["variant"], e["label"], p["dt"], p["kn"]): (
            p["cpu"],
            p["cpu"] * (1 + p["spread"]),
        )
        for e in efforts
        for p in e["points"]
        if p["cpu"] is not None
    }


def reversed_ranks(
    one: dict[Place, tuple[float, float]], two: dict[Place, tuple[float, float]]
) -> list[str]:
    """Pairs on one variant and rung whose intervals lie apart in both sessions, the other way."""
    found = []
    for a in one:
        for b in one:
            if (a[:2], a[3:]) == (b[:2], b[3:]) and one[a][1] < one[b][0] and two[b][1] < two[a][0]:
                found.append(f"{a} and {b[2]}")
    return found


def main() -> None:
    """Measure and judge."""
    load = multiprocessing.Process(target=busy, daemon=True)
    load.start()
    with tempfile.TemporaryDirectory() as folder:
        one, two = (session(Path(folder), number) for number in (1, 2))
    load.terminate()
    long = [place for place in one if one[place][0] >= LEAST]
    gaps = {place: abs(two[place][0] / one[place][0] - 1) for place in long}
    worst = max(gaps, key=lambda place: gaps[place])
    turned = reversed_ranks(one, two)
    conclude(
        "cost-trust",
        {
            "figures": len(one),
            "of at least a millisecond": len(long),
            "largest disagreement": gaps[worst],
            "at": str(worst),
            "disagree": sum(gap > APART for gap in gaps.values()),
            "reversed rankings": turned,
        },
        {
            "CPU figures of a millisecond and more agree within 25 %": max(gaps.values()) <= APART,
            "no ranking is reversed": not turned,
        },
    )


if __name__ == "__main__":
    main()
