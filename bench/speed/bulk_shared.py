"""Steps a scene of many spheres with two threads of dem and two ranks of LIGGGHTS, for benches.

Threads and ranks wait awake for each other, so that CPU time says nothing: wall ns of a sphere in a
step are told, without set-up, and the energy of motion [J] after the first steps, which shows that
all did the same. Whatever else runs makes them longer. They are therefore the least of many windows
of few steps each, as some of these have both cores to themselves.
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
BEFORE = "newton "  # a command that stands before the box is made
WINDOWS, PAUSE = 25, 0.03  # in a call; between them [s], so that other processes have their turn


class Shared(NamedTuple):
    """Wall ns of a sphere in a step, the least of many windows; energy of motion [J]."""

    ns: float
    energy: float


def ours(scene: Scene, steps: int, threads: int) -> Shared:
    """What dem takes: a run less its set-up. One thread is a kernel without any."""
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
    """What LIGGGHTS' own loop takes; its box is halved across, so that ranks have as much to do."""
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
