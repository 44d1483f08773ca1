"""An ask that had no answer in time says how many steps it takes, or is not begun if hopeless."""

import dataclasses

import numpy as np

from vv.ask import Ask, Bracket, Displacement, History, Knobs, Status
from vv.run.limits import hopeless, late
from vv.scene import Contact, Scene, Spheres

ROW = np.ones((1, 3))
SPHERE = Spheres(0 * ROW, ROW, np.ones(1), np.ones(1), free=ROW > 0)
FREE = Scene((SPHERE,), Contact(1.0))
ASK = Ask(FREE, History(1.0, 0.1), (Displacement(0),), Knobs(dt=1e-3))


def with_step(dt: float | None) -> Ask:
    return dataclasses.replace(ASK, knobs=Knobs(dt=dt))


def test_a_late_answer_is_told_with_its_number_of_steps() -> None:
    assert late(ASK, 2.0) == "no answer in time, --timeout 2 s for 1e+03 steps of 0.001 s"
    assert late(with_step(None), 2.0) == "no answer in time, --timeout 2 s"


def test_more_steps_than_nanoseconds_are_not_begun() -> None:
    run = hopeless(with_step(1e-12), 300.0)
    assert run is not None
    assert run.status is Status.TIMEOUT
    assert run.reason.startswith("no answer in time, --timeout 300 s for 1e+12 steps of 1e-12 s")
    assert run.reason.endswith("not begun, since a step takes over 1 ns")
    assert hopeless(with_step(1e-11), 300.0) is None
    assert hopeless(with_step(1e-12), 3000.0) is None


def test_an_ask_without_a_step_of_its_own_is_always_begun() -> None:
    assert hopeless(with_step(None), 1e-9) is None
    searched = dataclasses.replace(with_step(1e-12), search=Bracket(2.0, 1.0))
    assert hopeless(searched, 1e-9) is None
