"""Claims about a block at the limit of rest: rounding decides if it stops, not how far it goes."""

from math import cos, pi, radians

import numpy as np
import pytest

from reference_solutions.blocks import incline as closed
from reference_solutions.checks.blocks import incline as integrated
from vv.ask import Displacement, Knobs
from vv.engines import exact
from vv.plan.project import find

CASE = find().load_case("at-yield")
T = np.linspace(0.0, 5.0, 401)


def law(variant: str) -> dict[str, float]:
    p = CASE.defaults(variant)
    return {**{name: p[name] for name in ("alpha", "phi", "A", "f", "g")}, "v0": 0.0}


def rests(variant: str) -> int:
    """The number of times at which the block stops and stays for a while."""
    return sum(p.direction == 0 for p in closed.newmark_phases(4.9, **law(variant))[1:])


def test_a_trillionth_more_friction_stops_it_each_cycle_and_less_never() -> None:
    assert rests("above") == 4
    assert rests("below") == 0
    assert all(p.direction >= 0 for p in closed.newmark_phases(4.9, **law("below")))


@pytest.mark.parametrize("variant", ["above", "below"])
def test_the_two_routes_and_the_limit_agree(variant: str) -> None:
    p = law(variant)
    w = 2.0 * pi * p["f"]
    limit = p["A"] / (w * cos(radians(p["alpha"]))) * (T - np.sin(w * T) / w)
    first, second = closed.newmark(T, **p), integrated.newmark(T, **p)
    assert np.abs(first - second).max() < 1e-11 * first.max()
    # a change of phi by 1e-12 is an acceleration of 3e-12 m/s2 for 5 s
    assert np.abs(first - limit).max() < 2e-11 * first.max()


@pytest.mark.parametrize("variant", ["above", "below"])
def test_the_exact_engine_follows(variant: str) -> None:
    trial = CASE.declare(variant, CASE.defaults(variant))
    run = exact.solve(trial.study.ask(Knobs()))
    moved = run.values[Displacement(1)] @ trial.study.scene.axes[0]
    due = closed.newmark(run.times, **law(variant))
    assert np.abs(moved - due).max() < 1e-12 * due.max()
