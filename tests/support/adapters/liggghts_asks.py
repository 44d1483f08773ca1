"""The schemes of the LIGGGHTS adapter by name, asks about one sphere, and the words of a deck."""

from __future__ import annotations

import dataclasses
from typing import Any

from adapters.liggghts import ADAPTER
from adapters.liggghts.deck import deck
from adapters.liggghts.setup import set_up
from tests.support.adapters import small_asks
from tests.support.adapters.small_asks import DT
from vv.ask import Ask, Displacement, Knobs, Velocity
from vv.scene import Spheres, Wall

PLAIN, HALF_STEP, CLUMP, _ = (scheme.name for scheme in ADAPTER.schemes)


def ball(**changes: Any) -> Spheres:
    """One free sphere of 2 kg and 0.1 m at rest, which touches the plane y = 0 from above."""
    return small_asks.ball(**{"position": [[0, 0.1, 0]], **changes})


def ball_ask(*bodies: Spheres | Wall, body: int = 0, dt: float | None = DT, **scene: Any) -> Ask:
    ask = small_asks.ball_ask(*bodies, body=body, **scene)
    seen = (Displacement(body), Velocity(body))
    return dataclasses.replace(ask, observables=seen, knobs=Knobs(dt=dt))


def deck_of(ask: Ask, scheme: str) -> str:
    """The deck of an ask, which writes rows.txt."""
    return deck(set_up(ask, scheme), "rows.txt")


def words(text: str, *start: str) -> list[list[str]]:
    """The rest of the commands that begin with these words, split into words."""
    split = [line.split() for line in text.splitlines()]
    return [line[len(start) :] for line in split if tuple(line[: len(start)]) == start]
