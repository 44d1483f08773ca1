"""Adapters of the codes that are part of vv, each made from the functions of an engine."""

from __future__ import annotations

import functools
import importlib.util
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import vv
from vv.ask import Ask, Model, Run
from vv.codes.adapter import Found, Scheme
from vv.codes.script import python_script
from vv.codes.timing import Prepared, run_timed


@dataclass(frozen=True)
class Solver:
    """How an engine solves asks by one scheme.

    function: the name of the function of the engine's module that a script calls. refuses: why it
    refuses an ask although it has every term. describe: the model that it would build. solve: the
    run, with its cost; repeat [CPU s] is that of `vv.codes.Adapter.run`.
    """

    scheme: Scheme
    function: str
    refuses: Callable[[Ask], str | None]
    describe: Callable[[Ask], Model]
    solve: Callable[[Ask, float], Run]


@dataclass(frozen=True)
class InHouse:
    """An in-house code: see `vv.codes.Adapter`.

    module: the module of the engine, which scripts import. solvers: one for each scheme, the
    default first. found: checks whether the code can run here.
    """

    name: str
    module: str
    solvers: tuple[Solver, ...]
    found: Callable[[], Found]

    @property
    def schemes(self) -> tuple[Scheme, ...]:
        """Its schemes; the first is the default."""
        return tuple(solver.scheme for solver in self.solvers)

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """Why an ask is refused although all its terms are supported; else None."""
        return self._solver(scheme).refuses(ask)

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The smallest model of the scene."""
        return self._solver(scheme).describe(ask)

    def native(self, ask: Ask, scheme: str) -> str:
        """A Python script that calls the engine."""
        return python_script(ask, self.module, self._solver(scheme).function)

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Solve the asks in this process, one after another."""
        for ask in asks:
            yield self._solver(scheme).solve(ask, repeat)

    def _solver(self, scheme: str) -> Solver:
        return next(solver for solver in self.solvers if solver.scheme.name == scheme)


def compiled(
    scheme: Scheme,
    function: str,
    refuses: Callable[[Ask], str | None],
    prepare: Callable[[Ask], Prepared[Any]],
) -> Solver:
    """The solver of an engine that prepares a solve, which numba's kernels then carry out.

    For the cost see `run_timed`.
    """

    def describe(ask: Ask) -> Model:
        return prepare(ask).model

    def solve(ask: Ask, repeat: float) -> Run:
        return run_timed(functools.partial(prepare, ask), repeat)

    return Solver(scheme, function, refuses, describe, solve)


def part_of_vv() -> Found:
    """Whether kernels can be compiled here; numba is loaded once, for all workers."""
    if importlib.util.find_spec("numba") is None:
        return Found(False, how_to_install="pip install numba")
    return Found(True, vv.__version__, load=_load_compiler)


def _load_compiler() -> None:
    from vv.engines.kernels import compiled

    compiled.load()
