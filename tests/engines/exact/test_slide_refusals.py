"""Claims about rigid contact that the exact engine refuses, and runs that it cannot finish."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from adapters.exact import ADAPTER
from tests.scenes.blocks.exact_slides import BOX, DOWN, LEVEL
from tests.scenes.blocks.sliding_blocks import FREE, Frame, G, block, incline, responding, wall
from vv.ask import Ask, History, Status
from vv.engines.exact import solve
from vv.scene import Contact, Harmonic, Mask, Scene, Vector, Wall


def shaken(along: Vector, scene: Scene, amplitude: float = 1.0) -> Scene:
    axes = np.array([along, np.roll(along, 1), np.roll(along, 2)])
    return dataclasses.replace(
        scene,
        shaking=Harmonic((amplitude, 0, 0), (1.0,) * 3, axes=axes),  # type: ignore[arg-type]
    )


def on_floor(free: Mask = FREE, motion: Harmonic | None = None, **changed: object) -> Scene:
    box = block(LEVEL, np.array([1.0, 0.0, 0.0]) * free, free, **changed)
    return Scene((wall(LEVEL, motion), box), Contact(np.inf, mu=0.5), gravity=DOWN)


X, Y, Z = np.eye(3)
SIDE = Harmonic((0.1, 0, 0), (1.0,) * 3, (np.pi / 2,) * 3)  # type: ignore[arg-type]
LIFT = Harmonic((0, 0, 0.1), (1.0,) * 3)  # type: ignore[arg-type]
BOXED = dataclasses.replace(incline(LEVEL, 20.0), bodies=(wall(LEVEL), block(LEVEL, X), *(
    Wall(np.array([9.0, 0, 0]), -X),)))  # fmt: skip
REFUSED = {
    "nothing in the scene moves": incline(LEVEL, 20.0),
    "free rotation is not modelled": on_floor(free_spin=FREE),
    "block 'box' spins at a prescribed rate; a sphere would not": on_floor(spin=X),
    "block 'box' stands between 2 walls; a sphere has one": BOXED,
    "bodies 0 and 1 leave each other at 0.5 m/s at t = 0": dataclasses.replace(
        on_floor(), bodies=(wall(LEVEL), block(LEVEL, X + 0.5 * Z))
    ),
    "bodies 0 and 1 meet at 0.628319 m/s at t = 0": on_floor(motion=LIFT),
    "bodies 0 and 1 are 0.1 m apart at t = 0; they must touch": dataclasses.replace(
        on_floor(), bodies=(Wall(-0.1 * Z, Z), block(LEVEL, X))
    ),
    "body 1 is not pressed on body 0 at t = 0": dataclasses.replace(
        on_floor(), gravity=np.zeros(3)
    ),
    "body 1 is locked normal to body 0; the normal force is not determined": on_floor(X > 0),
    "body 1 is locked along the slip of body 0; the friction force is not determined": on_floor(
        Z > 0, SIDE
    ),
    "viscous drag -eta v is not modelled on rigid contact": dataclasses.replace(
        on_floor(), eta=1.0
    ),
    "convex blocks is not modelled on springs": dataclasses.replace(
        on_floor(), contact=Contact(1e6, 1e6, 0.5)
    ),
}


@pytest.mark.parametrize("reason", REFUSED)
def test_scenes_outside_the_class_are_refused_with_the_reason(reason: str, tmp_path: Path) -> None:
    ask = Ask(REFUSED[reason], History(1.0, 0.1), (BOX,))
    assert ADAPTER.refuses(ask, "default") == reason
    (run,) = ADAPTER.run([ask], "default", tmp_path, 0.0)
    assert (run.status, run.reason) == (Status.REFUSED, reason)


def test_a_block_that_would_fly_is_refused_unless_the_run_ends_before() -> None:
    """It lifts off at A sin 2 pi t = g; a normal force that only touches zero holds it down."""
    scene = shaken(Z, on_floor(), 2 * G)
    late, early = (Ask(scene, History(end, 0.01), (BOX,)) for end in (0.1, 0.08))
    reason = "body 1 lifts off body 0 at t = 0.0833333 s; flight is not followed"
    assert ADAPTER.refuses(late, "default") == reason
    assert ADAPTER.refuses(early, "default") is None
    touching = Ask(shaken(Z, on_floor(), G), History(3.0, 0.01), (BOX,))
    assert ADAPTER.refuses(touching, "default") is None


def test_events_that_accumulate_are_an_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vv.engines.exact.slide.flow.MOST_EVENTS", 0)
    run = solve(Ask(incline(Frame(20), 22.0, 5.0), History(1.0, 0.1), (BOX,)))
    assert run.status is Status.DIVERGED
    assert "events accumulate" in run.reason
    assert run.model is not None


def test_too_many_steps_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vv.engines.exact.slide.flow.MOST_STEPS", 10)
    run = solve(Ask(responding(0.2, 2.0, 0.6), History(5.0, 0.1), (BOX,)))
    assert run.status is Status.REFUSED
    assert "more than 10 steps" in run.reason
