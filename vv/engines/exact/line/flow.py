"""The motion of a line: what its kernel is given, and what became of it."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from vv.engines.exact.flow import FEW, MOST_EVENTS, MOST_STEPS, Outcome, SystemFlow
from vv.engines.exact.line.kernel import follow_one
from vv.engines.exact.line.model import Line
from vv.engines.exact.line.path import parts_of, path_of
from vv.engines.exact.path import Path
from vv.engines.exact.system import System
from vv.engines.kernels.compiled import entry


class LineFlow:
    """A line ready to be followed over a duration [s], as often as wanted.

    What ends it early, as centres that meet, is told by the general kernel, which it is left to.
    """

    def __init__(self, system: System, line: Line, duration: float) -> None:
        self.system, self.line, self.duration = system, line, duration
        self.pieces = np.empty((FEW, 5))

    def warm(self) -> None:
        """Load the kernel, or compile it."""
        self._kernel  # noqa: B018 - looked up, and kept

    def follow(self) -> int | Outcome:
        """Do what is timed; raises StoppedError if the motion cannot be followed."""
        count = self._kernel(*self._arguments)
        return count if count > 0 else self._general.follow()

    def path(self, told: int | Outcome) -> Path:
        """The motion of which `follow` told; raises StoppedError if it has too many parts."""
        if not isinstance(told, int):
            return self._general.path(told)
        pieces = self.pieces[:told]
        if parts_of(self.line, pieces, self.duration).sum() <= MOST_STEPS:
            path = path_of(self.system, self.line, pieces, self.duration)
            if np.isfinite(path.series).all():
                return path
        return self._general.path(self._general.follow())

    @functools.cached_property
    def _arguments(self) -> tuple[Any, ...]:
        return self.pieces, *self.line, self.duration, MOST_EVENTS

    @functools.cached_property
    def _kernel(self) -> Callable[..., int]:
        return entry(follow_one, self._arguments)

    @functools.cached_property
    def _general(self) -> SystemFlow:
        return SystemFlow(self.system, self.duration)
