"""Measures the cost of a step of many spheres in dem and other codes, and how it grows.

`python -m bench.speed.bulk [packs] [threads] [stacks]` steps settled packs and stacks of spheres
with rotation, friction and drag, in several rounds over all codes. It prints the least CPU time per
sphere and step; the kinetic energy and the contacts at the end show that all codes solved the same
scene. The limit by the memory bandwidth is that of a triad of arrays. Packs are also stepped with
two threads and with two ranks of LIGGGHTS, by wall time, which needs two free cores. LAMMPS is
included if VV_LAMMPS is set.
"""

from __future__ import annotations

import os
import resource
import sys
from collections.abc import Callable

import numpy as np

from adapters import liggghts, yade
from bench.chance.packs import settled
from bench.evidence import conclude
from bench.speed import bulk_codes, bulk_shared
from bench.speed.bulk_codes import Cost
from bench.speed.bulk_shared import Shared
from vv.scaling.stack import stack
from vv.scaling.triad import bandwidth
from vv.scene import Scene

PACKS = {10_000: 300, 50_000: 60}  # steps
STACKS = {100: 20000, 1000: 2000, 10_000: 200, 50_000: 60, 200_000: 20, 1_000_000: 6}
BESIDE, ROUNDS = 50_000, 3  # the most spheres for other codes; rounds
FLAT, MEMORY = 1.25, 3e9
TIMES = {
    "liggghts": 1.8,
    "yade": 5.0,
    "lammps": 1.3,
}  # the least speed-ups in a settled pack
WINDOW = {10_000: 20, 50_000: 20}  # steps of packs on two cores
TWO, SAME = 1.5, 0.01  # the least speed-up over two ranks; relative agreement of kinetic energies
SHARED = {
    "dem, one thread": (bulk_shared.ours, 1),
    "dem, two threads": (bulk_shared.ours, 2),
    "liggghts, two ranks": (bulk_shared.liggghts, 2),
}
MOVED = 700.0  # bytes that a step reads and writes per sphere, by counting the arrays


def codes() -> dict[str, Callable[[Scene, int], Cost]]:
    """The codes that can run here."""
    found: dict[str, Callable[[Scene, int], Cost]] = {"dem": bulk_codes.ours}
    if liggghts.ADAPTER.found().installed:
        found["liggghts"] = bulk_codes.liggghts
    if yade.ADAPTER.found().installed:
        found["yade"] = bulk_codes.yades
    if "VV_LAMMPS" in os.environ:
        found["lammps"] = bulk_codes.lammps
    return found


def in_turn(name: str, scene: Scene, steps: int, figures: dict[str, float]) -> dict[str, float]:
    """The least cost in each code [ns] of several rounds; adds figures of each code."""
    least: dict[str, float] = {}
    for _ in range(ROUNDS if len(scene.spheres) < 1_000_000 else 1):
        for code, run in codes().items():
            if code == "dem" or len(scene.spheres) <= BESIDE:
                cost = run(scene, min(steps, 1000) if code == "yade" else steps)
                least[code] = min(cost.ns, least.get(code, np.inf))
                if np.isfinite(cost.energy):
                    figures[f"{name}: {code}, energy of motion [J]"] = cost.energy
                    figures[f"{name}: {code}, contacts"] = cost.contacts
    for code, ns in least.items():
        figures[f"{name}: {code}, CPU ns a sphere and step"] = ns
        print(name, code, f"{ns:.1f} ns", flush=True)
    return least


def on_two_cores(n: int, figures: dict[str, float]) -> dict[str, bool]:
    """Time a settled pack on one and two threads and on two ranks of LIGGGHTS; returns the bars."""
    name, found = f"pack of {n}", in_rounds(settled(n), WINDOW[n])
    figures |= {f"{name}: {who}, wall ns a sphere and step": run.ns for who, run in found.items()}
    one, two, ranks = found.values()
    figures[f"{name}: two threads, times one"] = one.ns / two.ns
    figures[f"{name}: two threads, times two ranks of liggghts"] = ranks.ns / two.ns
    figures[f"{name}: load of the machine"] = os.getloadavg()[0]
    print(name, {who: round(run.ns, 1) for who, run in found.items()}, flush=True)
    return {
        f"{name}: two threads {TWO:g} times two ranks of liggghts": ranks.ns >= TWO * two.ns,
        f"{name}: two threads and one have the same energy": one.energy == two.energy,
        f"{name}: liggghts has it to {SAME:g}": abs(ranks.energy / two.energy - 1.0) <= SAME,
    }


def in_rounds(scene: Scene, steps: int) -> dict[str, Shared]:
    """The cost of each parallel run, the least of several alternating rounds."""
    found: dict[str, Shared] = {}
    for _ in range(ROUNDS):
        for who, (run, share) in SHARED.items():
            told = run(scene, steps, share)
            found[who] = min(told, found.get(who, told))
    return found


def packs(figures: dict[str, float]) -> dict[str, bool]:
    """Time settled packs in all codes, on one core; returns the bars."""
    bars: dict[str, bool] = {}
    for n, steps in PACKS.items():
        least = in_turn(f"pack of {n}", settled(n), steps, figures)
        for code, times in TIMES.items():
            if code in least:
                ratio = figures[f"pack of {n}: times {code}"] = least[code] / least["dem"]
                bars[f"pack of {n}: {times:g} times {code}"] = ratio >= times
    return bars


def threads(figures: dict[str, float]) -> dict[str, bool]:
    """Time settled packs on two cores; returns the bars."""
    bars: dict[str, bool] = {}
    for n in WINDOW if liggghts.ADAPTER.found().installed else ():
        bars |= on_two_cores(n, figures)
    return bars


def stacks(figures: dict[str, float]) -> dict[str, bool]:
    """Time stacks of all sizes; returns the bars."""
    grown = {n: in_turn(f"stack of {n}", stack(n), s, figures)["dem"] for n, s in STACKS.items()}
    peak = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    figures["a million spheres, GB at most"] = peak / 1e9
    return {
        "from 1e4 to 2e5 spheres flat to 25 %": grown[200_000] < FLAT * grown[10_000],
        "a million spheres take less than 3 GB": peak < MEMORY,
    }


PARTS = {"packs": packs, "threads": threads, "stacks": stacks}


def main(*parts: str) -> None:
    """Measure and judge."""
    memory = bandwidth() / 1e9
    figures = {"memory, GB/s": memory, "ns a sphere and step at that": MOVED / memory}
    bars: dict[str, bool] = {}
    for part in parts or PARTS:
        bars |= PARTS[part](figures)
    conclude("bulk", figures, bars)


if __name__ == "__main__":
    main(*sys.argv[1:])
