"""Adapter of a code that is a Python package and runs through a driver script."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from vv.ask import Ask, Model, Run, Status
from vv.codes.adapter import Found, Scheme
from vv.codes.own_python import Driver, Plan
from vv.scene import Scene, Vector


def as_it_is(scene: Scene) -> Scene:
    """The scene unchanged."""
    return scene


def no_fault(ask: Ask, run: Run) -> str | None:
    """None: no run is wrong."""
    return None


@dataclass(frozen=True)
class DriverAdapter:
    """A code that a driver script runs in a separate Python: see `vv.codes.Adapter`.

    refusal: why it cannot represent an ask although it has every term, else None. plan: the input
    of the driver. frame: the axes (3, 3) in which it answers, in those of the scene. notes: how it
    represents scenes. integrated: the scene whose degrees of freedom it integrates for a given one.
    fault: why a finished run is wrong nevertheless, else None.
    """

    scheme: Scheme
    driver: Driver
    notes: tuple[str, ...]
    refusal: Callable[[Ask], str | None]
    plan: Callable[[Ask], Plan]
    frame: Callable[[Ask], Vector]
    integrated: Callable[[Scene], Scene] = as_it_is
    fault: Callable[[Ask, Run], str | None] = no_fault

    @property
    def name(self) -> str:
        """The code's name, that of its environment."""
        return self.driver.home.name

    @property
    def schemes(self) -> tuple[Scheme, ...]:
        """Its one scheme."""
        return (self.scheme,)

    def found(self) -> Found:
        """Look for the environment of the code."""
        return self.driver.home.find()

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """Why the code cannot represent an ask although it has every term; else None."""
        return self.refusal(ask)

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The model: the integrated degrees of freedom, and how it represents the scene."""
        scene = self.integrated(ask.scene)
        terms = ask.scene.terms() | scene.terms()
        return Model(scene.unknowns(), terms, "; ".join(self.notes))

    def native(self, ask: Ask, scheme: str) -> str:
        """A script for the Python of its environment: the driver with the ask filled in."""
        return self.driver.script(self.plan(ask), "; ".join(self.notes))

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Run all asks in one process."""
        built = [(self.plan(ask), self.describe(ask, scheme), self.frame(ask)) for ask in asks]
        for ask, run in zip(asks, self.driver.run(asks, built, scratch, repeat), strict=True):
            fault = self.fault(ask, run)
            yield dataclasses.replace(run, status=Status.ERROR, reason=fault) if fault else run
