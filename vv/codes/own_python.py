"""Runs codes that are Python packages, each in a separate environment.

`make setup CODES=NAME` makes the environment .codes/NAME. A driver runs in it as one script, which
joins `vv.codes.driver_protocol` and the driver; nothing of vv is imported there.
"""

from __future__ import annotations

import ast
import functools
import json
import os
import pprint
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from vv.ask import Ask, Cost, Model, Run, Status
from vv.codes import driver_protocol, external
from vv.codes.adapter import Found
from vv.scene import Vector

CHECKOUT = Path(__file__).parents[2]
COSTS = ("setup", "solve_cpu", "solve_wall", "output", "repeats", "spread")
EMPTY = "ASK: dict[str, Any] | None = None\n"
Plan = Mapping[str, Any]


@dataclass(frozen=True)
class PythonEnvironment:
    """The environment of a code: its name here, and its packages; the first has its version."""

    name: str
    packages: tuple[str, ...]

    def find(self) -> Found:
        """Find its version, its Python, and the lists of its files with their digests."""
        chosen = os.environ.get("VV_CODES", "")
        places = [Path(chosen)] if chosen else [CHECKOUT / ".codes", Path.cwd() / ".codes"]
        return _find(self, tuple(places))


@functools.cache  # it is called for every job, and a search takes some milliseconds
def _find(home: PythonEnvironment, places: tuple[Path, ...]) -> Found:
    how = f"make setup CODES={home.name}, or set VV_CODES to a folder that holds {home.name}/"
    for place in places:
        python = place / home.name / "bin" / "python"
        sites = sorted((place / home.name).glob("lib/python*/site-packages"))
        lists = [
            record
            for package in home.packages
            for site in sites
            for record in sorted(site.glob(f"{package}-*.dist-info/RECORD"))
        ]
        if python.exists() and len(lists) == len(home.packages):
            version = lists[0].parent.name.removesuffix(".dist-info").rpartition("-")[2]
            return Found(True, version, str(python), how, (python.resolve(), *lists))
    return Found(False, how_to_install=how)


@dataclass(frozen=True)
class Driver:
    """The driver of a code: its environment, and the file of its script."""

    home: PythonEnvironment
    file: Path

    def script(self, plan: Plan | None = None, notes: str = "") -> str:
        """The script for the code's Python; with a plan it runs alone and prints the answer."""
        shared, own = Path(driver_protocol.__file__).read_text(), _alone(self.file.read_text())
        whole = f"{shared}\n\n{own}"
        if plan is None:
            return whole
        plain = json.loads(json.dumps(plan))  # numpy scalars would be written with their type
        literal = pprint.pformat(plain, width=99, sort_dicts=False)
        heading = "".join(f"# {note}\n" for note in notes.split("; ") if note)
        return whole.replace(EMPTY, f"{heading}ASK: dict[str, Any] | None = {literal}\n")

    def run(
        self,
        asks: Sequence[Ask],
        built: Sequence[tuple[Plan, Model, Vector]],
        scratch: Path,
        repeat: float,
    ) -> Iterator[Run]:
        """Run all asks in one program; `vv.codes.external` describes what happens if it dies.

        built: for each ask the input of the driver, the model, and the frame (3, 3) of the answer,
        its axes in the scene's as rows.
        """
        found = self.home.find()
        if not found.installed:
            yield from [Run(Status.NOT_INSTALLED, found.how_to_install)] * len(asks)
            return
        folder = external.new_folder(scratch)
        source = folder / f"in-{self.home.name}.py"
        source.write_text(self.script())
        files = [folder / f"ask-{number}.json" for number in range(len(asks))]
        for file, (plan, _, _) in zip(files, built, strict=True):
            file.write_text(json.dumps({**plan, "repeat": repeat}))

        def launch(indices: Sequence[int]) -> external.Process:
            # -E: environment variables for our own Python must not affect this one
            command = [found.path, "-E", str(source), *(str(files[i]) for i in indices)]
            return external.start(command, folder)

        def collect(index: int, program: external.Process) -> Run | None:
            _, model, frame = built[index]
            return parse(files[index], asks[index], model, frame, program.started)

        yield from external.run_batch(len(asks), launch, collect)


def parse(path: Path, ask: Ask, model: Model, frame: Vector, started: float) -> Run | None:
    """The Run in the answer to the ask in the file `path`; None if there is no answer yet.

    started: the start time of the program [s, monotonic]. An answer of another shape is an error.
    """
    answer = path.with_name(path.name + ".answer")
    if not answer.exists():
        return None
    facts = json.loads(answer.read_text())
    startup = max(facts["ready"] - started, 0.0) if facts["ready"] else 0.0
    cost = Cost(startup=startup, **{name: facts[name] for name in COSTS if name in facts})
    if facts["status"] != "ran":
        return Run(Status(facts["status"]), facts["reason"], cost=cost)
    values = np.load(path.with_name(path.name + ".npy"), allow_pickle=False)
    times = ask.goal.times(ask.dt)
    due = (len(ask.observables), len(times), 3)
    if values.shape != due:
        return Run(Status.ERROR, f"the answer has shape {values.shape}; {due} was asked for")
    seen = dict(zip(ask.observables, values @ frame, strict=True))
    return Run(Status.RAN, "", times, seen, cost, facts["steps"], model)


@functools.cache
def _alone(text: str) -> str:
    """A driver without its import of the shared part, which precedes it in the script."""
    shared = [
        range(node.lineno, (node.end_lineno or node.lineno) + 1)
        for node in ast.parse(text).body
        if isinstance(node, ast.ImportFrom) and node.module == driver_protocol.__name__
    ]
    lines = enumerate(text.splitlines(keepends=True), 1)
    return "".join(line for at, line in lines if not any(at in one for one in shared))
