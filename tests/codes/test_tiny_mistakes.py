"""A known mistake of a tiny scene looks as what a right code makes of a scene with the mistake."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tests.codes.test_tiny_scene_check import SCENES
from tests.support.wrong_scenes import WRONG
from vv.ask import Ask, Displacement, History, Knobs, Status, Velocity
from vv.codes.tiny_scenes import friction
from vv.codes.tiny_scenes.blocks import DOWN, PRESSED, ROUGH
from vv.codes.tiny_scenes.tiny_scene import MASS, OUTPUTS, TinyScene
from vv.plan.project import find
from vv.scene import Block, Scene, Vector

STEPS = 4000  # of dem, whose error is then below a thousandth where a force ends within a step
EACH = [(name, words) for name, changes in WRONG.items() for words in changes]


def moved(scene: Scene, tiny: TinyScene) -> tuple[Vector, Vector, Vector]:
    """Times, displacements and velocities of the last body: `rigid` for a block, else `dem`."""
    block = isinstance(scene.bodies[-1], Block)
    adapter = find().load_adapter("rigid" if block else "dem")
    number = sum(len(group) for group in scene.bodies) - 1
    goal = History(tiny.duration, tiny.duration / OUTPUTS)
    seen = Displacement(number), Velocity(number)
    ask = Ask(scene, goal, seen, Knobs(dt=tiny.duration / STEPS))
    (run,) = adapter.run([ask], adapter.schemes[0].name, None, 0.0)  # type: ignore[arg-type]
    assert run.status is Status.RAN, run.reason
    way, speed = (run.values[one] for one in seen)
    return run.times, way, speed


@pytest.mark.parametrize(("name", "words"), EACH)
def test_a_mistake_looks_like_a_right_answer_to_a_scene_with_it(name: str, words: str) -> None:
    tiny = SCENES[name]
    times, *found = moved(WRONG[name][words](tiny.scene), tiny)
    for mistaken, due in zip(tiny.mistakes[words](times), found, strict=True):
        np.testing.assert_allclose(mistaken, due, rtol=0, atol=2e-3 * np.abs(due).max())


def slip(push: Callable[[float], float], times: Vector) -> tuple[Vector, Vector]:
    """Way [m] and speed of what slips at 1 m/s at first, accelerated as its way decides."""
    way, speed, step = 0.0, 1.0, times[-1] / STEPS
    found = [(way, speed)]
    for _ in range(STEPS):
        speed += 0.5 * step * push(way)
        way += step * speed
        speed += 0.5 * step * push(way)
        found.append((way, speed))
    ways, speeds = np.asarray(found)[:: STEPS // OUTPUTS].T
    return ways, speeds


@pytest.mark.parametrize(
    ("name", "turns", "words", "sign"),
    [
        ("skid", 0.0, friction.REVERSED, 1.0),
        ("roll", 2.5, friction.REVERSED, 1.0),
        ("roll", -2.5, "friction turns it the other way", -1.0),
    ],
)
def test_friction_with_a_wrong_sign_drives_what_it_should_hold(
    name: str, turns: float, words: str, sign: float
) -> None:
    """Slip feels the force once as what moves, and 5/2 times, one way or the other, as it turns."""
    tiny = SCENES[name]
    law, times = tiny.scene.contact, np.linspace(0.0, tiny.duration, OUTPUTS + 1)

    def pull(way: float) -> float:
        return sign * min(law.ks * way, law.mu * friction.PRESSED) / MASS

    slipped = slip(lambda way: (1.0 + turns) * pull(way), times)
    free = times, np.ones_like(times)
    for mistaken, found, began in zip(tiny.mistakes[words](times), slipped, free, strict=True):
        due = began + (found - began) / (1.0 + turns)
        along = mistaken @ friction.ACROSS
        np.testing.assert_allclose(along, due, rtol=0, atol=2e-3 * np.abs(due).max())


def test_friction_that_pulls_along_adds_to_what_drives_a_block() -> None:
    times = np.linspace(0.0, 1.0, OUTPUTS + 1)
    way = SCENES["slide of a block"].mistakes["friction pulls along"](times)[0]
    found = times + (DOWN + ROUGH * PRESSED) * times**2 / 2
    np.testing.assert_allclose(way @ friction.ACROSS, found, rtol=1e-12)


def test_every_mistake_is_made_here() -> None:
    apart = {
        ("skid", friction.REVERSED),
        ("roll", friction.REVERSED),
        ("roll", "friction turns it the other way"),
        ("slide of a block", "friction pulls along"),
    }
    assert {*EACH} | apart == {
        (name, words) for name, one in SCENES.items() for words in one.mistakes
    }
