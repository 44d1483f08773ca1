"""Steps a scene of many spheres with two threads of dem and two ranks of LIGGGHTS, for benches.

Threads and ranks wait for each other in busy loops, so that CPU time means nothing. The figures are
wall ns per sphere and step, without set-up, and the kinetic energy [J] after the first steps, which
shows that all solved the same scene. Other processes increase wall times; therefore the minimum of
many short windows is taken, some of which have both cores to themselves.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

from adapters.liggghts.costs import LOOP
from bench.speed.bulk_codes import DT, ROW, verbose_deck
from vv.engines.dem.bulk.model import bulk
from vv.engines.kernels.threads import on_threads
from vv.scene import Scene

RANKS = ["mpirun", "--allow-run-as-root", "--bind-to", "none", "--oversubscribe", "-np"]
BEFORE = "newton "  # the command before which processors are assigned
WINDOWS, PAUSE = 25, 0.03  # windows in a call; pause between them [s], for other processes


class Shared(NamedTuple):
    """Wall ns per sphere and step, the minimum of many windows; kinetic energy [J]."""

    ns: float
    energy: float


def ours(scene: Scene, steps: int, threads: int) -> Shared:
    """The cost in dem: a run minus its set-up. One thread uses the kernel without threads."""
    model = bulk(scene)
    assert model is not None
    path, energy, watched = model.outputs(2, (0,))
    state = model.state._replace(threads=threads if threads > 1 else None)
    rest, least = (watched, steps, DT, *state, 1.0, 0.0), {1: np.inf, 2: np.inf}
    on_threads(threads, model.kernel(), (path[:1], energy[:1], *rest))
    for _ in range(WINDOWS):
        for lines, before in least.items():
            time.sleep(PAUSE)
            begun = time.perf_counter()
            on_threads(threads, model.kernel(), (path[:lines], energy[:lines], *rest))
            least[lines] = min(before, time.perf_counter() - begun)
    ns = 1e9 * (least[2] - least[1]) / len(scene.spheres) / steps
    return Shared(ns, float(energy[1, 0]))


def liggghts(scene: Scene, steps: int, ranks: int) -> Shared:
    """The cost of the loop of LIGGGHTS; its box is divided so that all ranks have equal work."""
    text = verbose_deck(scene, steps)
    assert text.count(BEFORE) == text.count(f"run             {steps}\n") == 1
    text = text.replace(BEFORE, f"processors {ranks} 1 1\n{BEFORE}")
    again = f"shell sleep {PAUSE}\nrun {steps} pre no\n"
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "in").write_text(text + again * (WINDOWS - 1))
        command = [*RANKS, str(ranks), "liggghts", "-in", "in", "-echo", "none", "-screen", "none"]
        subprocess.run(command, cwd=folder, check=True, timeout=500, capture_output=True)
        told = Path(folder, "log.liggghts").read_text()
    spent = min(map(float, LOOP.findall(told)))
    moving, turning, _ = map(float, re.findall(ROW, told)[1])
    return Shared(1e9 * spent / len(scene.spheres) / steps, moving + turning)
