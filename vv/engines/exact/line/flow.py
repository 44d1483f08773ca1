"""Runs the kernel of a line: prepares its arguments and makes a path of its output."""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np

from vv.engines.exact.flow import FEW, MOST_EVENTS, Outcome, SystemFlow, most_steps
from vv.engines.exact.line.kernel import follow_one
from vv.engines.exact.line.model import Line
from vv.engines.exact.line.path import parts_of, path_of
from vv.engines.exact.path import Path
from vv.engines.exact.system import System
from vv.engines.kernels.compiled import entry


class LineFlow:
    """A line whose motion over a duration [s] can be computed as often as wanted.

    If it ends early, because centres meet for example, the general kernel computes it instead and
    gives the reason.
    """

    def __init__(self, system: System, line: Line, duration: float) -> None:
        self.system, self.line, self.duration = system, line, duration
        self.pieces = np.empty((FEW, 5))

    def warm(self) -> None:
        """Load or compile the kernel."""
        self._run  # noqa: B018 - a cached property

    def follow(self) -> int | Outcome:
        """Run the kernel, which is what is timed; raises as `Flow.follow`."""
        count = self._run()
        return count if count > 0 else self._general.follow()

    def path(self, outcome: int | Outcome) -> Path:
        """The motion, made from the outcome of `follow`; raises RefusedError if it is too long."""
        if not isinstance(outcome, int):
            return self._general.path(outcome)
        pieces = self.pieces[:outcome]
        if parts_of(self.line, pieces, self.duration).sum() <= most_steps(self.system):
            path = path_of(self.system, self.line, pieces, self.duration)
            if np.isfinite(path.series).all():
                return path
        return self._general.path(self._general.follow())

    @functools.cached_property
    def _run(self) -> Callable[[], int]:
        """The machine code of the kernel with its arguments."""
        given = np.array([*self.line, self.duration, MOST_EVENTS], float)
        arguments = self.pieces, given
        return functools.partial(entry(follow_one, arguments), *arguments)

    @functools.cached_property
    def _general(self) -> SystemFlow:
        return SystemFlow(self.system, self.duration)
