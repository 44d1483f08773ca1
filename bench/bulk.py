"""What a step of many spheres costs in dem, and how that grows, beside LIGGGHTS and YADE.

`python -m bench.bulk` stacks spheres that turn, rub and are slowed on a floor, N = 1e2 to 1e6, and
steps them with each code, one after the other and over again: the least CPU time per sphere and
step, with the energy of motion at the end, which shows that all did the same. Beside them stands
the bandwidth of the memory, as sums of arrays have it.
"""

from __future__ import annotations

import os
import re
import resource
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

from adapters import liggghts, yade
from adapters.liggghts.batch import MPI
from adapters.liggghts.deck import silent_deck
from adapters.liggghts.setup import set_up
from bench.evidence import conclude
from vv.ask import Ask, History, Knobs
from vv.engines import dem
from vv.scene import Contact, Form, Scene, Spheres, Wall

SIZES = {100: 20000, 1000: 4000, 10_000: 400, 50_000: 80, 200_000: 30, 1_000_000: 8}  # steps of dem
BESIDE, ROUNDS, DT, RADIUS = 50_000, 3, 2e-5, 0.01  # the others up to so many spheres
TIMES_LIGGGHTS, TIMES_YADE, FLAT, MEMORY = 1.8, 5.0, 1.25, 3e9
EVERY = " every 1 check no"  # as an answer needs it; a fast LIGGGHTS seeks neighbours when it must


def stack(n: int) -> Scene:
    """Spheres of one size in a cubic lattice, each in contact with six, in no order."""
    random, width = np.random.default_rng(1), int(np.ceil(n ** (1 / 3)))
    grid = np.stack(np.meshgrid(*[np.arange(width)] * 3, indexing="ij"), 3).reshape(-1, 3)
    grid = random.permutation(grid[np.argsort(grid[:, 2], kind="stable")][:n])
    all_free, mass = np.ones((n, 3), bool), np.full(n, 0.01)
    spheres = Spheres(
        np.asarray(RADIUS * (1.998 * grid + 0.999), float), 0.01 * random.normal(size=(n, 3)),
        np.full(n, RADIUS), mass, all_free, free_spin=all_free,
    )  # fmt: skip
    floor, gravity = Wall(np.zeros(3), np.eye(3)[2]), np.array([0.0, 0.0, -9.81])
    return Scene((spheres, floor), Contact(1e5, 2e4, 0.3), eta=0.1, gravity=gravity)


def asked(n: int, steps: int) -> Ask:
    """Steps without output."""
    return Ask(stack(n), History(steps * DT, steps * DT), (), Knobs(DT), energies=(Form.KINETIC,))


def ours(n: int, steps: int) -> tuple[float, float]:
    """CPU ns of a sphere in a step, and the energy of motion at the end [J]."""
    program = dem.prepare(asked(n, steps), dem.LAGGED)
    program.warm()
    begun = time.process_time()
    assert program.solve() == 2
    return 1e9 * (time.process_time() - begun) / n / steps, float(program.arguments[1][-1, 0])


def child_seconds() -> float:
    """CPU seconds of all children that have ended."""
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    return spent.ru_utime + spent.ru_stime


def lammps(n: int, steps: int) -> tuple[float, float]:
    """The same of LIGGGHTS: a run less its set-up."""
    text = silent_deck(set_up(asked(n, steps), "default"))
    assert EVERY in text
    text = text.replace(EVERY, "").replace("thermo_style    custom step atoms",
        "compute ke all ke\ncompute turning all erotate/sphere\n"
        "thermo_style    custom c_ke c_turning\nthermo_modify   norm no")  # fmt: skip
    spent = []
    for run in (0, steps):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "in").write_text(re.sub(r"(?m)^run .*", f"run {run}", text))
            before = child_seconds()
            command = ["liggghts", "-in", "in", "-echo", "none", "-screen", "/dev/null"]
            subprocess.run(command, cwd=folder, env={**os.environ, **MPI}, check=True, timeout=500)
            spent.append(child_seconds() - before)
            log = Path(folder, "log.liggghts").read_text()
    moving, turning = re.findall(r"(?m)^\s+([-+.e\d]+)\s+([-+.e\d]+)\s*$", log)[-1]
    return 1e9 * (spent[1] - spent[0]) / n / steps, float(moving) + float(turning)


def yades(n: int, steps: int) -> float:
    """CPU ns of a sphere in a step of YADE."""
    ask = Ask(stack(n), History(steps * DT, steps * DT), (), Knobs(DT))
    with tempfile.TemporaryDirectory() as folder:
        (run,) = yade.ADAPTER.run([ask], "default", Path(folder), 0.0)
    assert run.steps >= steps, run.reason
    return 1e9 * run.cost.solve_cpu / n / steps


def bandwidth() -> float:
    """GB/s of a sum of two arrays that no cache holds, the best of ten."""
    one, two = np.ones(20_000_000), np.ones(20_000_000)
    out, least = np.empty_like(one), np.inf
    for _ in range(10):
        begun = time.perf_counter()
        np.add(one, two, out=out)
        least = min(least, time.perf_counter() - begun)
    return float(3 * out.nbytes / least / 1e9)


def main() -> None:
    """Measure and judge."""
    figures: dict[str, float] = {"memory, GB/s": bandwidth()}
    bars: dict[str, bool] = {}
    least: dict[tuple[str, int], float] = {}
    for n, steps in SIZES.items():
        for _ in range(ROUNDS if n < 1_000_000 else 1):
            mine, energy = ours(n, steps)
            costs = {"dem": mine}
            if n <= BESIDE and liggghts.ADAPTER.found().installed:
                costs["liggghts"], other = lammps(n, steps)
                figures[f"{n}: energy of motion in liggghts over that in dem"] = other / energy
            if n <= BESIDE and yade.ADAPTER.found().installed:
                costs["yade"] = yades(n, min(steps, 1000))
            for code, cost in costs.items():
                least[code, n] = min(cost, least.get((code, n), np.inf))
        for (code, size), cost in least.items():
            if size == n:
                figures[f"{n}: {code}, CPU ns a sphere and step"] = cost
                print(n, code, f"{cost:.1f} ns", flush=True)
    peak = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    figures["a million spheres, GB at most"] = peak / 1e9
    bars["a million spheres take less than 3 GB"] = peak < MEMORY
    bars["from 1e4 to 2e5 spheres flat to 25 %"] = (
        least["dem", 200_000] < FLAT * least["dem", 10_000]
    )
    for code, times in (("liggghts", TIMES_LIGGGHTS), ("yade", TIMES_YADE)):
        for n in (10_000, 50_000):
            if (code, n) in least:
                ratio = figures[f"{n}: times {code}"] = least[code, n] / least["dem", n]
                bars[f"{n}: {times:g} times {code}"] = ratio >= times
    conclude("bulk", figures, bars)


if __name__ == "__main__":
    main()
