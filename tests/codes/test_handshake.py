"""Claims about the tiny scenes of `vv check`: right answers pass, and mistakes are named."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

from vv.ask import Ask, Displacement, Method, Observable, Run, Status, Velocity
from vv.codes import Scheme
from vv.codes.greetings import Greeting, greetings, unasked
from vv.codes.handshake import Grip, Handshake, judged
from vv.plan.project import find
from vv.scene import Term, Vector

BOTH = frozenset({Displacement, Velocity})
ALL = Scheme("default", "", Method.SECOND_ORDER, frozenset(Term), observables=BOTH)
SCENES = {one.name: one for one in greetings(ALL)}
# How a body moves does not show strain; and no motion with micro-slip is known by heart.
UNSHOWN = {Term.STRAIN, Term.STRAINED_START, Term.MICRO_SLIP}
EXACT = (
    "free flight", "dead load", "bounce", "collision", "lock", "oblique lock", "drag", "dashpot",
    "skid", "bond", "shear of a bond", "slide of a block",
)  # fmt: skip
Wrong = Callable[[Ask, Greeting], tuple[Vector, Vector]]


def shaken(greeting: Greeting, wrong: Wrong, scheme: Scheme = ALL) -> Handshake:
    """What is said of a code that reports what `wrong` gives: displacement and velocity."""
    runs = []
    for ask in greeting.asks(scheme):
        moved, speed = wrong(ask, greeting)
        seen: tuple[Observable, ...] = (Displacement(greeting.body), Velocity(greeting.body))
        values = dict(zip(seen, (moved, speed), strict=True))
        runs.append(Run(Status.RAN, times=ask.goal.times(ask.dt), values=values))
    return judged(scheme, greeting, runs)


def right(ask: Ask, greeting: Greeting) -> tuple[Vector, Vector]:
    return greeting.motion(ask.goal.times(ask.dt))


def test_all_effects_that_a_scheme_declares_are_asked_of_it_and_no_other() -> None:
    assert set().union(*(one.scene.terms() for one in SCENES.values())) == frozenset(Term) - UNSHOWN
    assert unasked(ALL) == UNSHOWN
    bare = dataclasses.replace(ALL, terms=frozenset({Term.SPHERE, Term.WALL_CONTACT}))
    assert [one.name for one in greetings(bare)] == ["free flight", "bounce", "lock"]
    assert not any(one.scene.gravity.any() for one in greetings(bare))
    assert greetings(dataclasses.replace(ALL, observables=frozenset())) == []


@pytest.mark.parametrize("name", EXACT)
def test_the_answers_known_by_heart_are_those_of_the_exact_engine(name: str) -> None:
    exact = find().load_adapter("exact")
    greeting = SCENES[name]
    scheme = dataclasses.replace(exact.schemes[name == "shear of a bond"], knobs=())
    (ask,) = greeting.asks(scheme)
    runs = list(exact.run([ask], scheme.name, None, 0.0))  # type: ignore[arg-type]  # it needs none
    found = judged(scheme, greeting, runs)
    assert found.grip is Grip.FIRM
    assert float(found.words.rpartition(" ")[2]) < 1e-13


@pytest.mark.parametrize("name", SCENES)
def test_what_a_mistake_looks_like_is_said(name: str) -> None:
    greeting = SCENES[name]
    assert shaken(greeting, right).grip is Grip.FIRM
    for words, mistaken in greeting.mistakes.items():
        motion = dataclasses.replace(greeting, motion=mistaken)
        found = shaken(greeting, lambda ask, _, motion=motion: right(ask, motion))  # type: ignore[misc]
        assert found.grip is Grip.WRONG
        assert f"it looks as if {words}" in found.words


def late(ask: Ask, greeting: Greeting) -> tuple[Vector, Vector]:
    moved, speed = right(ask, greeting)
    return np.concatenate([moved[:1], moved[:-1]]), speed


MISTAKES: dict[str, Wrong] = {
    "nothing moves": lambda ask, g: (0 * right(ask, g)[0], 0 * right(ask, g)[1]),
    "all signs are reversed": lambda ask, g: (-right(ask, g)[0], -right(ask, g)[1]),
    "positions are written": lambda ask, g: (
        right(ask, g)[0] + g.scene.spheres.position[-1],
        right(ask, g)[1],
    ),
    "velocities are written": lambda ask, g: (right(ask, g)[1], right(ask, g)[1]),
    "rows are one output late": late,
    "x, y, z are y, x, z": lambda ask, g: (right(ask, g)[0][:, [1, 0, 2]], right(ask, g)[1]),
}


@pytest.mark.parametrize("words", MISTAKES)
def test_mistakes_of_the_table_are_told_apart(words: str) -> None:
    found = shaken(SCENES["drag"], MISTAKES[words])
    assert found.grip is Grip.WRONG
    assert f"it looks as if {words}" in found.words


@pytest.mark.parametrize("name", SCENES)
def test_a_velocity_known_by_heart_is_that_of_the_displacement(name: str) -> None:
    greeting = SCENES[name]
    t = np.linspace(0.0, greeting.duration, 4001)
    moved, speed = greeting.motion(t)
    assert not moved[0].any()
    seen = np.gradient(moved, t, axis=0)
    rough = np.abs(np.diff(speed, axis=0)).max()  # a force that sets in at once
    assert np.abs(seen - speed)[1:-1].max() <= rough + 1e-6 * np.abs(speed).max()


def off_by(power: float, size: float) -> Wrong:
    """Right but for an error of an order in dt."""
    return lambda ask, g: tuple(part * (1 + size * ask.dt**power) for part in right(ask, g))


def test_an_order_that_falls_short_of_the_claim_is_named() -> None:
    found = shaken(SCENES["drag"], off_by(1, 0.1))
    assert found.grip is Grip.WRONG
    assert "it claims order 2 in dt, and 1.0 was seen" in found.words
    modest = dataclasses.replace(ALL, method=Method.FIRST_ORDER)
    assert "right" in shaken(SCENES["drag"], off_by(1, 0.1), modest).words
    assert "order in dt 2.0" in shaken(SCENES["drag"], off_by(2, 0.1)).words


def test_what_looks_like_nothing_known_is_only_called_wrong() -> None:
    found = shaken(SCENES["bounce"], off_by(0, 0.3))
    assert found.words == "wrong by 0.3 of the largest value"


@pytest.mark.parametrize(
    ("status", "grip"), [(Status.REFUSED, Grip.REFUSED), (Status.DIVERGED, Grip.FAILED)]
)
def test_what_did_not_run_says_why(status: Status, grip: Grip) -> None:
    runs = [Run(status, "for a reason")]
    assert judged(ALL, SCENES["lock"], runs) == Handshake(grip, f"{status.value}: for a reason")
