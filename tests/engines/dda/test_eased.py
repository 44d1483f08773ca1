"""Claims about the start of wedges in `dda`: friction that cannot hold is released before t = 0."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

from tests.scenes.blocks.dda_scenes import DOWN, FLOOR, G, box, run
from vv.ask import Knobs
from vv.case import Series
from vv.engines.dda import DEFAULT, Formulation
from vv.engines.dda.general.model import General
from vv.engines.dda.limits import EASING, FLOAT
from vv.engines.dda.springs import Springs
from vv.plan.project import find
from vv.scene import Contact, Elastic, Scene

SHAKEN_WEDGE, WEDGE = (find().load_case(name) for name in ("shaken-wedge", "wedge"))
HARDLY = {"dip": 33.2, "xi": 1.18, "A": 1.92}  # friction almost holds it: velocities do not decay


def off(given: dict[str, float], way: Formulation, knobs: Knobs) -> float:
    """The largest error of the displacement along the groove, over the largest displacement."""
    trial = SHAKEN_WEDGE.declare("level", {**SHAKEN_WEDGE.defaults("level"), **given})
    (s,) = trial.quantities
    assert isinstance(s, Series)
    assert s.reference is not None
    done = run(trial.study.ask(knobs), way)
    due = s.reference(done.times)
    return float(np.abs(s.observe(done) - due).max() / np.abs(due).max())


@pytest.mark.shows(
    "In `dda` the shear springs carry part of a wedge's weight while it is pressed in at the start"
)
def test_a_wedge_that_starts_to_slide_is_as_right_as_the_step_and_not_as_the_springs() -> None:
    """A sine of 1 Hz is sampled half a step late: a relative error of 2 pi dt/2 in displacement."""
    thrown = dataclasses.replace(DEFAULT, eased=0)
    for kn in (1e9, 1e10):
        assert off({}, DEFAULT, Knobs(1e-3, kn)) <= 2e-4
        assert off({}, DEFAULT, Knobs(1e-4, kn)) <= 2e-5
        assert off({}, thrown, Knobs(1e-4, kn)) >= 4e-4
    assert off(HARDLY, DEFAULT, Knobs(1e-4, 1e10)) <= 2e-4
    assert off(HARDLY, thrown, Knobs(1e-4, 1e10)) >= 1.5e-3


def test_what_friction_holds_stays() -> None:
    """It moves by the compression of its springs only; a third of the friction releases it."""
    ask = WEDGE.declare("xi-1", {**WEDGE.defaults("xi-1"), "held": 0.5}).study.ask(Knobs(1e-3, 1e9))
    (block,), mu = ask.scene.blocks, 3.0 * ask.scene.contact.mu
    pressed = 9.81 * block.mass / (8 * 1e9)
    held = dataclasses.replace(
        ask, scene=dataclasses.replace(ask.scene, contact=Contact(math.inf, mu=mu))
    )
    for asked, stays in ((ask, False), (held, True)):
        way = run(asked, DEFAULT).values[ask.observables[0]] @ ask.scene.axes[0]
        assert (np.abs(way).max() <= 0.1 * pressed) == stays


def test_rounds_end_as_soon_as_a_wedge_slides_evenly(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each round takes three runs, after the two in which loads are taken up."""
    calls, settled = list[float](), General.settled

    def counted(self: General, start: Any, law: Any, over: float, *given: Any) -> Any:
        calls.append(over)
        return settled(self, start, law, over, *given)

    monkeypatch.setattr(General, "settled", counted)
    study = SHAKEN_WEDGE.declare("level", SHAKEN_WEDGE.defaults("level")).study
    run(study.ask(Knobs(1e-3, 1e9)), DEFAULT)
    assert calls[2:] == 3 * [EASING]


@pytest.mark.shows("In `dda` a block at rest sinks by its load over the stiffness of the springs")
def test_a_block_on_its_contacts_sinks_by_no_more_than_its_loads_over_their_stiffness() -> None:
    """By orders of magnitude more, and by what an elastic block is compressed besides."""
    stiff = Springs(1e9, 4e8, 0.5)
    cube = box((0.4, 0.4, 0.4), 2000.0)
    body = dataclasses.replace(cube, load=np.array([3e3, 0.0, cube.mass * G]))
    floats = General(Scene((FLOOR, body), Contact(math.inf), gravity=DOWN), DEFAULT)
    assert floats.sinks(stiff) == pytest.approx(FLOAT * 3e3 / 1e9)
    soft = dataclasses.replace(body, elastic=Elastic(1e8, 0.25))
    gives = General(Scene((FLOOR, soft), Contact(math.inf), gravity=DOWN), DEFAULT)
    assert gives.sinks(stiff) == pytest.approx(FLOAT * 3e3 * (1 / 1e9 + 1 / (1e8 * 0.8)))
