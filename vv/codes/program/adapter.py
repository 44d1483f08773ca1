"""A declared program as a code of the framework; see `vv.codes.Adapter`."""

from __future__ import annotations

import dataclasses
import functools
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from vv.ask import Ask, Model, Run, Status
from vv.codes.adapter import Found, Scheme
from vv.codes.program import declared, process, question
from vv.codes.program.declared import Declared
from vv.codes.program.process import Question

PATIENCE = 10.0  # s that a program may take to print its version
UNSTATED = "version not stated"


def load(file: Path) -> Program:
    """The code that a TOML file declares; raises UsageError naming the entry and the rule."""
    return Program(declared.read(file.resolve()))


@dataclass(frozen=True)
class Program:
    """A program that reads ask.json and writes series.csv."""

    declared: Declared

    @property
    def name(self) -> str:
        """The name of the TOML file, with `-` where that has `_`."""
        return self.declared.name

    @property
    def schemes(self) -> tuple[Scheme, ...]:
        """Its schemes; the first is the default."""
        return self.declared.schemes

    def found(self) -> Found:
        """Where its command is, and the files that decide its results: TOML, command, and more."""
        command = self.declared.command
        path = shutil.which(command[0])
        if path is None:
            return Found(False, how_to_install=self._how_to_install())
        used = [Path(word) for word in (path, *command[1:]) if Path(word).is_file()]
        files = tuple(dict.fromkeys((*used, *self.declared.files)))
        return Found(True, _version(self.declared.version), path, files=files)

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """Nothing beforehand; the program itself may refuse."""
        return None

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The scene as it is; what the program makes of it, it may say in result.json."""
        return Model(ask.scene.unknowns(), ask.scene.terms())

    def native(self, ask: Ask, scheme: str) -> str:
        """The ask.json that the program is given."""
        knobs = next(one.knobs for one in self.schemes if one.name == scheme)
        return question.text(ask, scheme, knobs)

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """One process for each ask; as many as take `repeat` CPU seconds if it is to be timed."""
        for number, ask in enumerate(asks):
            asked = Question(ask, self.native(ask, scheme), self.describe(ask, scheme))
            runs = [process.run(self.declared.command, asked, scratch, f"{number}-0")]
            while _all_ran(runs) and sum(run.cost.solve_cpu for run in runs) < repeat:
                again = f"{number}-{len(runs)}"
                runs.append(process.run(self.declared.command, asked, scratch, again))
            yield _cheapest(runs) if _all_ran(runs) else runs[-1]

    def _how_to_install(self) -> str:
        command, build = self.declared.command[0], self.declared.install
        wrong = f"{command} is not executable" if Path(command).is_file() else f"no {command}"
        told = f"{wrong}, which {self.declared.file} names as its command"
        return f"{told}; to build it: {build}" if build else told


def _all_ran(runs: Sequence[Run]) -> bool:
    return all(run.status is Status.RAN for run in runs)


def _cheapest(runs: Sequence[Run]) -> Run:
    """The run that took least, with the number of all and their spread."""
    best = min(runs, key=lambda run: run.cost.solve_cpu)
    least, most = best.cost.solve_cpu, max(run.cost.solve_cpu for run in runs)
    spread = (most - least) / least if least > 0 else 0.0
    cost = dataclasses.replace(best.cost, repeats=len(runs), spread=spread)
    return dataclasses.replace(best, cost=cost)


@functools.cache
def _version(command: tuple[str, ...]) -> str:
    """The first line that the command for its version prints, asked once a process."""
    if not command:
        return UNSTATED
    try:
        done = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=PATIENCE,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"{UNSTATED}: {type(error).__name__}"
    lines = done.stdout[:1000].decode(errors="replace").strip().splitlines()
    return lines[0].strip()[:80] if lines and done.returncode == 0 else UNSTATED
