"""Figures that the last digits of a scene decide: the largest over some changes of these digits."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator

from bench.bounds.sensitivity import answer
from tests.findings.figures import PROJECT, Answer, Figure
from vv.plan.nudged import LAST, Nudge, nudged_scene

NUDGED = ((8, 8, 0), (1, -1, 0), (-3, 2, 0), (1, -1, 2), (5, -7, 1), (0, 0, 1))
LACKS = -math.inf


def most(code: str, figure: Figure) -> Figure:
    """The largest figure over the scene and what its last digits make of it, of runs that have it.

    For what rounding decides: another machine gives another one of these answers.
    """

    def largest(answer: Answer) -> float:
        return max(
            found for one in _nudged(code, answer) if (found := _if_any(figure, one)) > LACKS
        )

    return largest


def _nudged(code: str, own: Answer) -> Iterator[Answer]:
    """An answer, and those to the same scene with other last digits."""
    yield own
    for mass, gravity, position in NUDGED:
        nudge = Nudge(mass * LAST, gravity * LAST, position * LAST)
        ask = dataclasses.replace(own.ask, scene=nudged_scene(own.ask.scene, nudge))
        run = answer(PROJECT.load_adapter(code), own.scheme, ask)
        yield dataclasses.replace(own, ask=ask, run=run)


def _if_any(figure: Figure, of: Answer) -> float:
    """The figure; LACKS of a run that did not reach its end and so does not have it."""
    try:
        return figure(of)
    except AssertionError:
        return LACKS
