"""Claims about dda/generalised-alpha: second order, an exact ledger, Coulomb's law obeyed."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from tests.scenes.blocks.dda_scenes import asked, moved, run, shaken, slope
from vv.ask import History, Knobs, Run
from vv.base.metrics import observed_order
from vv.engines.dda import DAMPED, LAGGED, Formulation
from vv.engines.dda.solve import SIGNED
from vv.plan.project import find
from vv.scene import Scene, Vector

STEPS = (4e-3, 2e-3, 1e-3)
SLIDES = slope(20, 15, 2.0, velocity=1.0)  # while gravity and a sine drive it on


def slid(scene: Scene, dt: float, way: Formulation) -> Run:
    return run(asked(scene, dt, 1e7, 0.4, 0.02), way)


def error(dt: float, way: Formulation, right: Vector) -> float:
    return float(np.abs(moved(slid(SLIDES, dt, way)) - right).max())


@pytest.mark.parametrize(("way", "order"), [(DAMPED, 2.0), (LAGGED, 1.0)])
def test_a_slide_on_springs_is_of_the_order_that_the_step_is_of(
    way: Formulation, order: float
) -> None:
    right = moved(slid(SLIDES, 1e-4, DAMPED))
    errors = [error(dt, way, right) for dt in STEPS]
    found = observed_order(list(STEPS), errors)
    assert found is not None
    assert found.order == pytest.approx(order, abs=0.1)


@pytest.mark.parametrize(
    "scene", [SLIDES, slope(20, 25, 5.0), shaken((0.3, 0.2, 0.0), (1.0, 1.3, 1.0), 0.3)]
)
def test_every_joule_has_a_term_and_no_friction_is_beyond_mu_n(scene: Scene) -> None:
    done = slid(scene, 2e-3, DAMPED)
    assert done.ledger is not None
    assert done.ledger.bound is not None
    assert done.ledger.unaccounted <= done.ledger.bound
    assert done.ledger.terms["friction dissipation"] > 0.0
    for seen, allowed in done.ledger.audits.values():
        assert seen <= allowed


def test_a_swing_that_has_died_away_has_left_all_of_its_energy_to_the_steps() -> None:
    case = find().load_case("damped-swing")
    p = case.defaults("resolved")
    ask = case.declare("resolved", p).study.ask(Knobs(1e-2, p["kn"]))  # an angle of 1 rad
    done = run(dataclasses.replace(ask, goal=History(10.0, 1.0)), DAMPED)
    assert done.ledger is not None
    assert done.ledger.terms[SIGNED] == pytest.approx(0.5 * p["m"] * p["v"] ** 2, rel=1e-6)
