"""Claims about one unknown on one contact: closed forms against the general Taylor kernel."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from cases.contact.single_contact import CASE
from tests.scenes.small_scenes import ALONG, UP
from vv.ask import Ask, History
from vv.engines import exact
from vv.engines.exact.flow import SystemFlow
from vv.engines.exact.ledger import ledger as ledger_of
from vv.engines.exact.line.flow import LineFlow
from vv.engines.exact.modes import State
from vv.engines.exact.system import System
from vv.scene import Contact, Scene, Spheres, Wall

DURATION = 3.0  # s; some ten events
SEEDS = range(120)


def thrown(seed: int) -> Scene:
    """A ball above a floor, on it or pressed into it, which moves vertically or along it."""
    r = np.random.default_rng(seed)
    slides, drags, falls, pulls = (bool(b) for b in r.integers(0, 2, 4))
    gap = -r.uniform(0.005, 0.05) if slides else r.uniform(-0.02, 0.05) * r.integers(0, 2)
    mass, way = r.uniform(0.5, 2.0), ALONG if slides else UP
    ball = Spheres(
        position=((0.3 + gap) * UP)[None],
        velocity=(r.uniform(-1, 1) * way)[None],
        radius=np.array([0.3]),
        mass=np.array([mass]),
        free=np.array([way > 0]),
        load=np.outer(pulls * r.uniform(-4, 4), way),
    )
    kn = 10 ** r.uniform(2, 3.5)
    law = Contact(kn, kn * r.uniform(0.3, 1.2), r.uniform(0.1, 0.8)) if slides else Contact(kn)
    gravity = falls * np.array([r.uniform(-3, 3), -9.81, 0.0])
    drag = drags * 10 ** r.uniform(-6, np.log10(np.sqrt(law.ks or kn * mass)))
    return Scene((Wall(np.zeros(3), UP), ball), law, drag, gravity)


def both(scene: Scene) -> tuple[exact.Path, exact.Path]:
    """The motion by closed forms, and by Taylor series."""
    system = exact.prepare(Ask(scene, History(DURATION, DURATION), ()))
    assert isinstance(system, System)
    flow = exact.ready(system, DURATION)
    assert isinstance(flow, LineFlow)
    return flow.path(flow.follow()), exact.follow(system, DURATION)


@pytest.mark.parametrize("seed", SEEDS)
def test_closed_forms_and_series_agree_on_the_motion_and_its_events(seed: int) -> None:
    line, series = both(thrown(seed))
    times = np.linspace(0, DURATION, 301)
    size = np.abs(series.at(times)[0]).max() + 1e-12
    assert np.abs(line.at(times)[0] - series.at(times)[0]).max() <= 1e-10 * size
    assert [e.after for e in line.events] == [e.after for e in series.events]
    found, expected = ([e.time for e in path.events] for path in (line, series))
    assert np.abs(np.subtract(found, expected)).max(initial=0.0) <= 1e-10 * DURATION


@pytest.mark.parametrize("seed", SEEDS[::4])
def test_energy_is_conserved_piece_by_piece(seed: int) -> None:
    ledger = ledger_of(both(thrown(seed))[0])
    assert ledger.bound is not None
    assert ledger.unaccounted <= ledger.bound


def test_the_random_scenes_open_stick_slip_and_turn() -> None:
    """Otherwise the comparison would leave out a branch."""
    seen = {event.after for seed in SEEDS for event in both(thrown(seed))[0].events}
    assert seen == {State.OPEN, State.STUCK, State.SLIP_FORWARD, State.SLIP_BACKWARD}


def test_a_spring_that_swings_back_to_its_limit_does_not_slip() -> None:
    """T3 touches the friction limit at every return."""
    study = CASE.declare("T3", CASE.defaults("T3")).study
    path = exact.move(exact.prepare(Ask(study.scene, History(60.0, 1.0), ())), 60.0)
    assert [event.after for event in path.events] == [State.SLIP_FORWARD, State.STUCK]  # type: ignore[union-attr]


def test_a_drag_that_is_almost_nil_changes_nothing() -> None:
    """Closed forms would lose all digits; series are used instead."""
    scene = dataclasses.replace(thrown(3), eta=0.0)
    dragged = dataclasses.replace(scene, eta=1e-15)
    times = np.linspace(0, DURATION, 31)
    free, slowed = (both(one)[0].at(times)[0] for one in (scene, dragged))
    assert np.abs(free - slowed).max() <= 1e-12 * np.abs(free).max()


@pytest.mark.parametrize("change", [{"eta": 1e4}, {"contact": Contact(300.0, eta_n=1.0)}])
def test_other_motions_are_left_to_series(change: dict[str, Any]) -> None:
    """These have drag above critical damping, or dashpots."""
    scene = dataclasses.replace(thrown(1), **{"eta": 0.0, **change})
    flow = exact.ready(exact.prepare(Ask(scene, History(0.1, 0.1), ())), 0.1)
    assert isinstance(flow, SystemFlow)
