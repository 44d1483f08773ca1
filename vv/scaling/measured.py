"""Measures the CPU time of a sphere and step in each code, in several rounds over all codes."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from vv.ask import Status
from vv.codes import Adapter, Scheme
from vv.codes.adapter import known_beforehand
from vv.scaling.stack import CONTACTS, asked, stack
from vv.scaling.triad import bandwidth, least_traffic
from vv.scene import Scene

WORK = 400_000  # approximate number of spheres times steps in a measurement
FEWEST = 100  # spheres
BRIEF, LONGER, ROUNDS = 2, 4, 3  # the fewest steps; ratio of the longer run to the shorter
HUGE = 300_000  # spheres, from which one round is enough, since set-up takes most of the time


@dataclass(frozen=True)
class Size:
    """The CPU seconds per sphere and step at one number of spheres, by scheme.

    memory: the bandwidth [bytes/s]; failed: why a scheme gave no cost; it is then not run with more
    spheres.
    """

    spheres: int
    steps: int
    memory: float
    seconds: dict[str, float] = field(default_factory=dict)
    failed: dict[str, str] = field(default_factory=dict)

    @property
    def limit(self) -> float:
        """The seconds per sphere and step at the bandwidth of the memory, without caches."""
        return least_traffic(CONTACTS) / self.memory


def sizes(largest: int) -> tuple[int, ...]:
    """The fewest spheres and ten times as many, again and again, and the largest."""
    if largest < FEWEST:
        raise ValueError(f"largest = {largest}; scaling starts at {FEWEST} spheres")
    tens = [FEWEST * 10**k for k in range(len(str(largest))) if FEWEST * 10**k < largest]
    return (*tens, largest)


def costs_by_size(schemes: Iterable[tuple[Adapter, Scheme]], largest: int) -> Iterator[Size]:
    """The costs at each size, from small to large; a scheme that failed is not run again."""
    left = list(schemes)
    for n in sizes(largest):
        found = _measure(left, n)
        left = [(code, one) for code, one in left if label(code, one) not in found.failed]
        yield found


def label(code: Adapter, scheme: Scheme) -> str:
    """CODE/SCHEME."""
    return f"{code.name}/{scheme.name}"


def can_step(code: Adapter, scheme: Scheme) -> bool:
    """Whether a scheme can run the scene, as far as is known without running it."""
    return known_beforehand(code, scheme, asked(stack(FEWEST), BRIEF), code.found()) is None


def _measure(schemes: Sequence[tuple[Adapter, Scheme]], n: int) -> Size:
    """The cost from the difference of a longer and a shorter run, without the start of a run."""
    scene, steps = stack(n), max(BRIEF, WORK // n)
    n = len(scene.spheres)
    size = Size(n, steps * LONGER, bandwidth())
    least: dict[str, list[float]] = {}
    for _ in range(ROUNDS if n < HUGE else 1):
        for code, scheme in schemes:
            name = label(code, scheme)
            if name not in size.failed:
                told = _costs(code, scheme, scene, steps)
                if isinstance(told, str):
                    size.failed[name] = told
                else:
                    least[name] = [
                        min(pair) for pair in zip(told, least.get(name, told), strict=True)
                    ]
    for name, (short, long) in least.items():
        if name not in size.failed:
            size.seconds[name] = (long - short) / (n * steps * (LONGER - 1))
    return size


def _costs(code: Adapter, scheme: Scheme, scene: Scene, steps: int) -> list[float] | str:
    """CPU seconds of a shorter and a longer run, or why there are none."""
    asks = [asked(scene, steps), asked(scene, LONGER * steps)]
    settled = known_beforehand(code, scheme, asks[0], code.found())
    if settled is not None:
        return settled.reason
    with tempfile.TemporaryDirectory(prefix="vv-scaling-") as folder:
        runs = list(code.run(asks, scheme.name, Path(folder), 0.0))
    for run in runs:
        if run.status is not Status.RAN:
            return f"{run.status.value}: {run.reason}"
        if run.cost.whole:
            return "its program does not report the cost of its steps alone"
    return [run.cost.solve_cpu for run in runs]
