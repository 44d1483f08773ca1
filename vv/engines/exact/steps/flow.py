"""Solves an ask about one body on a rigid wall by steps: a prepared ask, and its run."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.ask import Ask, Displacement, Model, Run, Status
from vv.engines.exact.slide.system import TurningSlider
from vv.engines.exact.steps.kernel import follow_steps
from vv.engines.exact.turn.path import with_wall
from vv.engines.kernels.compiled import entry
from vv.scene import Vector

EVEN = 2.0  # far^3 w h: with it the error of series falls as h^2 does, and is below that of means


@dataclass(frozen=True, eq=False)
class Steps:
    """An ask that is prepared to be solved as often as wanted: a `vv.codes.timing.Prepared`."""

    ask: Ask
    slider: TurningSlider
    model: Model

    def warm(self) -> None:
        """Load or compile the kernel."""
        self._solve  # noqa: B018 - a cached property

    def solve(self) -> int:
        """Take all steps; only this is timed."""
        return self._solve()

    def run(self, rows: int) -> Run:
        """The run, without its cost and without energies: these steps conserve none."""
        times, out, axes = self.ask.goal.times(self.ask.dt), self._out, self.slider.axes
        slip, speed = out[:, :2] @ axes, out[:, 2:] @ axes
        displacement, velocity = with_wall(self.slider, slip, speed, times)
        values = {
            what: displacement if isinstance(what, Displacement) else velocity
            for what in self.ask.observables
        }
        if not np.isfinite(out).all():
            return Run(Status.DIVERGED, "the state is not finite", model=self.model)
        steps = self.ask.goal.steps(self.ask.dt)
        return Run(Status.RAN, times=times, values=values, steps=steps, model=self.model)

    @functools.cached_property
    def _out(self) -> Vector:
        return np.empty((len(self.ask.goal.times(self.ask.dt)), 4))

    @functools.cached_property
    def _solve(self) -> Callable[[], int]:
        """The machine code of the kernel with its arguments."""
        slider, h, stride = self.slider, self.ask.dt, self.ask.goal.stride(self.ask.dt)
        rows = np.vstack((slider.relative_drive, slider.mu * slider.pressing))
        turn = 2 * np.pi * slider.frequency * h
        sines = phases(slider.phase, turn)
        quickest = float(turn.max(initial=0.0))
        far = max(1.0, np.cbrt(EVEN / quickest)) if quickest > 0 else np.inf
        pull = rows @ np.array([1.0, *np.sin(slider.phase)])
        speed = float(np.hypot(*slider.slip))
        first = pull[:2] - pull[2] * slider.slip / speed if speed else np.zeros(2)
        start = np.array([*slider.slip, h, far, *first])
        work = np.empty((len(turn), 2))
        arguments: tuple[Any, ...] = (rows, sines, work, start, stride, self._out)
        return functools.partial(entry(follow_steps, arguments), *arguments)


def phases(phase: Vector, turn: Vector) -> Vector:
    """`sines` (k, 9) of `follow_steps`, of the phases (k,) at the start and those of a step."""
    middle = phase + turn / 2
    columns = (
        np.sin(middle), np.cos(middle), np.cos(turn), np.sin(turn), np.sinc(turn / (2 * np.pi)),
        np.cos(turn / 2), np.sin(turn / 2), np.cos(1.5 * turn), np.sin(1.5 * turn),
    )  # fmt: skip
    return np.stack(columns, axis=1)
