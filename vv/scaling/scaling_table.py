"""The costs of scenes of growing size, as a table of text and as JSON."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from vv.scaling.measured import Size
from vv.scaling.stack import CONTACTS
from vv.scaling.triad import least_traffic

LIMIT = "memory"


def heading(labels: Sequence[str]) -> Iterator[str]:
    """The heading of the table."""
    yield (
        "CPU time per sphere and step [ns], without set-up: spheres with rotation and friction in "
        "a box"
    )
    yield f"{'spheres':>9}" + "".join(f"  {name:>{_wide(name)}}" for name in (*labels, LIMIT))


def row(size: Size, labels: Sequence[str]) -> str:
    """A row of the table."""
    told = [(name, size.seconds.get(name)) for name in labels] + [(LIMIT, size.limit)]
    cells = (f"  {_ns(seconds):>{_wide(name)}}" for name, seconds in told)
    return f"{size.spheres:>9}" + "".join(cells)


def notes(found: Sequence[Size]) -> Iterator[str]:
    """Notes below the table: the last column, schemes without figures, and how costs grow."""
    best = max(size.memory for size in found)
    yield (
        f"{LIMIT}: the time to read and write {least_traffic(CONTACTS):g} bytes per sphere "
        "(position, velocity, spin, contact springs) at the bandwidth of a triad of arrays in the "
        f"same run, {best / 1e9:.1f} GB/s at most; small scenes fit into the caches"
    )
    for size in found:
        for name, why in size.failed.items():
            yield f"{name} with {size.spheres} spheres: {why}"
    for name in {name: None for size in found for name in size.seconds}:
        costs = {size.spheres: size.seconds[name] for size in found if name in size.seconds}
        few, many = min(costs), max(costs)
        if many > few and costs[few] > 0:
            times = costs[many] / costs[few]
            yield f"{name}: a sphere costs {times:.2f} times as much among {many} as among {few}"


def document(found: Sequence[Size]) -> dict[str, Any]:
    """The costs as JSON, in SI units."""
    return {
        "what": "CPU seconds of a sphere in a step",
        "bytes": least_traffic(CONTACTS),
        "sizes": [
            {
                "spheres": size.spheres,
                "steps": size.steps,
                "bandwidth": size.memory,
                "limit": size.limit,
                "seconds": size.seconds,
                "failed": size.failed,
            }
            for size in found
        ],
    }


def _wide(name: str) -> int:
    return max(7, len(name))


def _ns(seconds: float | None) -> str:
    return "-" if seconds is None else f"{1e9 * seconds:.0f}"
