"""Measures the speed-up of a second thread on a bonded lattice, and compares all bits.

`python -m bench.speed.lattice_threads [SIZE...]` runs the same steps of blocks with breakable bonds
on one and two threads, in turn, and compares the least wall times. It needs two free cores.
"""

import sys
import time

import numpy as np

from bench.evidence import conclude
from bench.speed.bonded_lattice import DT, KINDS, scene
from reference_solutions.bonds.close_packed_lattice import SIZES, lattice
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import dem

D, WORK, ROUNDS = 1e-3, 4e5, 20  # particle-steps in a run; number of runs of each kind
TIMES = 1.6  # the least speed-up over one thread
SIZES_ASKED = (2166, 10985, 37681)


def program(size: int, steps: int, threads: int = 1, strength: float = 0.05) -> dem.PreparedSpheres:
    """The program for a block of elements at random velocities, with bonds of a strength [N]."""
    block = lattice(*SIZES[size], D)
    seen = tuple(Displacement(i) for i in range(0, size, 7))
    goal = History(steps * DT, steps * DT)
    ask = Ask(scene(block, strength), goal, seen, Knobs(DT))
    return dem.prepare(ask, dem.CENTRED, threads)


def seconds(size: int) -> tuple[float, float, bool]:
    """The wall seconds per step on one and two threads, and whether both give the same bits."""
    steps = max(20, int(WORK / size))
    few, many = [
        [program(size, n, threads, KINDS["breakable"]) for threads in (1, 2)] for n in (1, steps)
    ]
    least = np.full((2, 2), np.inf)
    for _ in range(ROUNDS):
        for kind, pair in enumerate((few, many)):
            for index, one in enumerate(pair):
                begun = time.perf_counter()
                one.solve()
                least[kind, index] = min(least[kind, index], time.perf_counter() - begun)
    alone, shared = (least[1] - least[0]) / (steps - 1)
    told = [[array.tobytes() for array in p.arguments[:2]] for p in many]
    return float(alone), float(shared), told[0] == told[1]


def main(*sizes: int) -> None:
    """Measure and judge."""
    figures, bars = {}, {}
    for size in sizes or SIZES_ASKED:
        alone, shared, same = seconds(size)
        figures[f"{size}: ms a step, one thread"] = 1e3 * alone
        figures[f"{size}: ms a step, two threads"] = 1e3 * shared
        figures[f"{size}: times as fast"] = alone / shared
        bars[f"{size}: the same bits"] = same
        bars[f"{size}: at least {TIMES:g} times as fast"] = alone >= TIMES * shared
    conclude("lattice-threads", figures, bars)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
