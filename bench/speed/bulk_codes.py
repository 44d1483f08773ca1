"""Steps a scene of many spheres with dem, LIGGGHTS, LAMMPS and YADE, for benches.

Each function returns the CPU ns per sphere and step, without set-up, and the kinetic energy [J] and
the contacts at the end, which show that all codes solved the same scene. LIGGGHTS and LAMMPS
rebuild neighbour lists only when necessary. LAMMPS is the Python package `lammps`, in an
environment that VV_LAMMPS names; it needs `mpich` beside it.
"""

from __future__ import annotations

import os
import re
import resource
import subprocess
import tempfile
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from adapters import yade
from adapters.liggghts.batch import MPI
from adapters.liggghts.deck import silent_deck
from adapters.liggghts.setup import set_up
from vv.ask import Ask, History, Knobs
from vv.engines.dem.bulk.model import bulk
from vv.scene import Form, Scene
from vv.scene.neighbours import overlapping

DT = 2e-5
WALL = "granular hooke {kn!r} 0 tangential linear_history {ks!r} 0 {mu!r} damping mass_velocity"
EVERY = " every 1 check no"  # as an answer needs it
TOLD = """\
compute ke all ke
compute turning all erotate/sphere
compute touching all contact/atom
compute contacts all reduce sum c_touching
thermo_style custom c_ke c_turning c_contacts
thermo_modify norm no"""
ROW = r"(?m)^\s+([-+.e\d]+)\s+([-+.e\d]+)\s+([-+.e\d]+)\s*$"
LAMMPS = """\
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
read_data spheres.data
pair_style gran/hooke/history {kn!r} {ks!r} 0 0 {mu!r} 0
pair_coeff * *
neigh_modify delay 0 every 1 check yes
{walls}
fix moving all nve/sphere
fix weight all gravity {g!r} vector 0 0 -1
fix slowed all viscous {eta!r}
timestep {dt!r}
{told}
run {steps}
"""


class Cost(NamedTuple):
    """CPU ns per sphere and step, and the kinetic energy [J] and the contacts at the end."""

    ns: float
    energy: float
    contacts: float


def ours(scene: Scene, steps: int) -> Cost:
    """The cost in dem: a run minus its set-up."""
    model, s = bulk(scene), scene.spheres
    assert model is not None
    n = len(s)
    path, energy, watched = model.outputs(2, tuple(range(n)))
    rest = (*model.state, 1.0, 0.0)
    move, clocks = model.kernel(), list[float]()
    move(path[:1], energy[:1], watched, steps, DT, *rest)
    clocks.append(time.process_time())
    for lines in (1, 2):
        assert move(path[:lines], energy[:lines], watched, steps, DT, *rest) == lines
        clocks.append(time.process_time())
    spent = clocks[2] - clocks[1] - (clocks[1] - clocks[0])
    contacts = len(overlapping(replace(s, position=s.position + path[1, :, :3])))
    return Cost(1e9 * spent / n / steps, float(energy[1, 0]), contacts)


def asked(scene: Scene, steps: int) -> Ask:
    """The ask to run steps without output."""
    return Ask(scene, History(steps * DT, steps * DT), (), Knobs(DT), energies=(Form.KINETIC,))


def liggghts(scene: Scene, steps: int) -> Cost:
    """The cost in LIGGGHTS: a run minus its set-up."""
    text = verbose_deck(scene, steps)
    return difference(["liggghts"], text, "log.liggghts", len(scene.spheres), steps)


def verbose_deck(scene: Scene, steps: int) -> str:
    """A deck for LIGGGHTS whose log states the kinetic energy and the contacts."""
    text = silent_deck(set_up(asked(scene, steps), "default"))
    assert EVERY in text
    return text.replace(EVERY, "").replace("thermo_style    custom step atoms", TOLD)


def lammps(scene: Scene, steps: int) -> Cost:
    """The cost in LAMMPS, which has the contact law as its style gran/hooke/history.

    In versions up to July 2025 walls of that style multiply the shear spring by the contact radius,
    about 1e-3 m, so that they have almost no friction. Therefore walls have the style granular.
    """
    home, law, s = Path(os.environ["VV_LAMMPS"]), scene.contact, scene.spheres
    style = WALL.format(kn=law.kn, ks=law.ks, mu=law.mu)
    walls = []
    for k, wall in enumerate(scene.walls):
        axis, place = int(np.abs(wall.normal).argmax()), float(wall.point @ abs(wall.normal))
        sides = f"{place!r} NULL" if wall.normal.sum() > 0 else f"NULL {place!r}"
        walls.append(f"fix wall{k} all wall/gran {style} {'xyz'[axis]}plane {sides}")
    text = LAMMPS.format(
        kn=law.kn, ks=law.ks, mu=law.mu, walls="\n".join(walls), eta=scene.eta, dt=DT,
        g=float(-scene.gravity[2]), told=TOLD, steps=steps,
    )  # fmt: skip
    density = s.mass / (4.0 / 3.0 * np.pi * s.radius**3)
    rows = np.column_stack([2 * s.radius, density, s.position])
    low, high = s.position.min(0) - 0.1, s.position.max(0) + 0.1
    data = ["spheres", "", f"{len(s)} atoms", "1 atom types", ""]
    data += [
        f"{float(a)!r} {float(b)!r} {c}lo {c}hi" for a, b, c in zip(low, high, "xyz", strict=True)
    ]
    data += ["", "Atoms", ""]
    data += [f"{i + 1} 1 " + " ".join(map(repr, row)) for i, row in enumerate(rows.tolist())]
    data += ["", "Velocities", ""]
    data += [
        f"{i + 1} " + " ".join(map(repr, row)) + " 0 0 0"
        for i, row in enumerate(s.velocity.tolist())
    ]
    program = [str(home / "bin" / "lmp")]
    return difference(
        program, text, "log.lammps", len(s), steps,
        files={"spheres.data": "\n".join(data) + "\n"}, LD_LIBRARY_PATH=str(home / "lib"),
    )  # fmt: skip


def difference(
    program: Sequence[str], text: str, log: str, n: int, steps: int,
    files: dict[str, str] | None = None, **more: str,
) -> Cost:  # fmt: skip
    """The cost of a deck: a run with its steps minus one without."""
    spent = []
    for run in (0, steps):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "in").write_text(re.sub(r"(?m)^run .*", f"run {run}", text))
            for name, held in (files or {}).items():
                Path(folder, name).write_text(held)
            command = [*program, "-in", "in", "-echo", "none", "-screen", "/dev/null"]
            before = child_seconds()
            subprocess.run(
                command, cwd=folder, env={**os.environ, **MPI, **more}, check=True, timeout=500,
                capture_output=True,
            )  # fmt: skip
            spent.append(child_seconds() - before)
            told = Path(folder, log).read_text()
    moving, turning, contacts = map(float, re.findall(ROW, told)[-1])
    return Cost(1e9 * (spent[1] - spent[0]) / n / steps, moving + turning, contacts / 2)


def yades(scene: Scene, steps: int) -> Cost:
    """The cost in YADE, by its adapter."""
    ask = asked(scene, steps)
    with tempfile.TemporaryDirectory() as folder:
        (run,) = yade.ADAPTER.run([replace(ask, energies=())], "default", Path(folder), 0.0)
    assert run.steps >= steps, run.reason
    return Cost(1e9 * run.cost.solve_cpu / len(scene.spheres) / steps, np.nan, np.nan)


def child_seconds() -> float:
    """The CPU seconds of all child processes that have ended."""
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    return spent.ru_utime + spent.ru_stime
