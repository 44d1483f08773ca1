"""Claims about a silo that empties: it starts loose and closed, and wrong rates are detected."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from vv.ask import Displacement, Knobs, Method, Run, Status
from vv.case import Trial
from vv.plan.project import find
from vv.records.record import measured
from vv.scene import Vector
from vv.scene.neighbours import overlapping

CASE = find().load_case("hopper")
TRIAL: Trial = CASE.declare("wide-1", CASE.defaults("wide-1"))
SPHERES = TRIAL.study.scene.spheres
COUNT = int(SPHERES.free[:, 0].sum())
TIMES = TRIAL.study.goal.times(None)
D, LAW = 0.01, 1397.0  # m, grains per second
BELOW = np.array([0.0, 0.0, -5.0 * D])


def _run(left: Callable[[float], float], to: Vector = BELOW) -> Run:
    """A run in which left(t) grains have left the silo at time t, those near the axis first."""
    order = np.argsort(np.hypot(*SPHERES.position[:COUNT, :2].T), kind="stable")
    places = np.repeat(SPHERES.position[None, :COUNT], len(TIMES), axis=0)
    for k, t in enumerate(TIMES):
        places[k, order[: round(left(t))]] = to
    moved = places - SPHERES.position[:COUNT]
    return Run(Status.RAN, times=TIMES, values={Displacement(i): moved[:, i] for i in range(COUNT)})


def _verdicts(run: Run) -> dict[str, str]:
    return {
        one.name: measured(run, one, Method.SECOND_ORDER, Knobs(dt=1e-5))[0].verdict.value
        for one in TRIAL.quantities
    }


def test_grains_start_loose_between_the_walls_and_the_floor() -> None:
    falls = SPHERES.part(slice(0, COUNT))
    assert len(overlapping(falls)) == 0
    pairs = overlapping(SPHERES)
    assert (pairs >= COUNT).all(), "only grains of the floor, which are held, overlap each other"
    for wall in TRIAL.study.scene.walls:
        assert ((falls.position - wall.point) @ wall.normal >= falls.radius * (1 - 1e-9)).all()


def test_what_is_poured_is_looser_than_grains_lie_by_less_than_a_quarter() -> None:
    z, radius = SPHERES.position[:COUNT, 2], SPHERES.radius[:COUNT]
    height = (z + radius).max() - (z - radius).min()
    filled = (4 / 3 * np.pi * radius**3).sum() / (height * (10 * D) ** 2)
    assert 0.46 < filled < 0.59


def test_a_silo_that_empties_by_the_law_passes() -> None:
    assert set(_verdicts(_run(lambda t: LAW * t)).values()) == {"pass"}


@pytest.mark.parametrize("times", [0.5, 1.8])
def test_another_rate_is_seen(times: float) -> None:
    assert _verdicts(_run(lambda t: min(times * LAW * t, COUNT)))["rate"] == "fail"


def test_a_rate_that_falls_with_the_height_is_seen() -> None:
    found = _verdicts(_run(lambda t: COUNT * 1.2 * t / (1.0 + 1.2 * t)))
    assert found["steady"] == "fail"


def test_a_silo_that_jams_is_seen() -> None:
    assert _verdicts(_run(lambda t: min(LAW * t, 0.25 * COUNT)))["rate"] == "fail"


@pytest.mark.parametrize("to", [[9.0 * D, 0.0, 5.0 * D], [0.0, -5.1 * D, -5.0 * D]])
def test_a_grain_outside_the_silo_is_seen(to: list[float]) -> None:
    assert _verdicts(_run(lambda t: float(t > 0.1), np.array(to)))["astray"] == "fail"


def test_a_grain_that_falls_through_the_floor_is_seen() -> None:
    x = SPHERES.position[:COUNT]
    corner = int(np.argmax(np.hypot(x[:, 0], x[:, 1]) - 100.0 * (x[:, 2] > 1.2 * D)))
    still = _run(lambda t: 0.0)
    fallen = dict(still.values)
    fallen[Displacement(corner)] = np.outer(TIMES > 0.1, BELOW)
    assert _verdicts(Run(Status.RAN, times=TIMES, values=fallen))["astray"] == "fail"
