"""Claims about the collapse of a column: its start is without overlaps, and violated laws show."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from vv.ask import Displacement, Knobs, Method, Observable, Run, Status, Velocity
from vv.case import Level, Measured, Trial
from vv.plan.project import find
from vv.records.record import measured
from vv.scene import Vector
from vv.scene.neighbours import overlapping

CASE = find().load_case("column-collapse")
TRIAL: Trial = CASE.declare("seed-1", CASE.defaults("seed-1"))
SPHERES = TRIAL.study.scene.spheres
FALLS = np.flatnonzero(SPHERES.free[:, 0])
TIMES = TRIAL.study.goal.times(None)
G, D = 9.81, 0.01


def _run(place: Callable[[float], Vector], speed: Callable[[float], Vector]) -> Run:
    """A run with positions place(t) and velocities speed(t) of the falling grains, (n, 3) each."""
    moved = np.stack([place(t) for t in TIMES]) - SPHERES.position[FALLS]
    fast = np.stack([speed(t) for t in TIMES])
    values: dict[Observable, Vector] = {Displacement(int(i)): moved[:, i] for i in FALLS}
    values |= {Velocity(int(i)): fast[:, i] for i in FALLS}
    return Run(Status.RAN, times=TIMES, values=values)


def _verdicts(run: Run) -> dict[str, str]:
    return {
        one.name: measured(run, one, Method.SECOND_ORDER, Knobs(dt=1e-5))[0].verdict.value
        for one in TRIAL.quantities
    }


def _still(t: float) -> Vector:
    return np.asarray(SPHERES.position[FALLS])


def _nil(t: float) -> Vector:
    return np.zeros((len(FALLS), 3))


def test_no_grain_overlaps_another_at_the_start() -> None:
    falls = SPHERES.part(slice(0, len(FALLS)))
    assert len(overlapping(falls)) == 0
    assert FALLS[-1] == len(FALLS) - 1
    assert len(overlapping(SPHERES)) == 0


def test_a_column_is_as_high_over_its_radius_as_the_law_of_its_run_out_is_told() -> None:
    judge, z = TRIAL.quantities[0].judge, SPHERES.position[FALLS, 2]
    assert isinstance(judge, Measured)
    layers = len(set(np.round(z / D / np.sqrt(2 / 3))))  # of spheres in a close packing
    height = (z.max() - z.min()) * layers / (layers - 1)
    assert judge.measurement.value / 1.24 == pytest.approx(height / (5 * D), rel=0.05)


def test_a_column_that_stands_has_not_run_out() -> None:
    assert _verdicts(_run(_still, _nil))["run-out"] == "fail"


def test_the_edge_of_a_close_layer_is_where_its_grains_end() -> None:
    i, j = (axis.ravel() for axis in np.meshgrid(*[np.arange(-30, 31)] * 2))
    sites = D * np.column_stack([i + 0.5 * (j % 2), np.sqrt(0.75) * j, np.ones(len(i))])
    nearest = sites[np.argsort(np.hypot(*sites[:, :2].T), kind="stable")][: len(FALLS)]
    run = _run(lambda t: nearest if t > 0 else _still(t), _nil)
    run_out = TRIAL.quantities[0]
    found = measured(run, run_out, Method.SECOND_ORDER, Knobs(dt=1e-5))[0]
    radius = np.sqrt(len(FALLS) * np.sqrt(0.75) / np.pi)
    assert radius / 5.0 - 1.0 == pytest.approx(1.45, abs=0.01)
    assert found.value == 1.5  # to the nearest quarter
    assert found.verdict.value == "pass"


def test_grains_that_cover_more_than_half_of_a_circle_are_its_edge() -> None:
    far, many = 16 * D, 64
    turn = 2 * np.pi * np.arange(many) / many
    ring = np.column_stack([far * np.cos(turn), far * np.sin(turn), np.full(many, D)])
    assert many * D / (2 * np.pi * far) == pytest.approx(0.64, abs=0.01)
    heap = np.concatenate([0.5 * _still(0.0)[many:], ring])
    run = _run(lambda t: heap if t > 0 else _still(t), _nil)
    found = measured(run, TRIAL.quantities[0], Method.SECOND_ORDER, Knobs(dt=1e-5))[0]
    assert found.value == 2.25  # 16 / 5 - 1, to the nearest quarter


def test_an_edge_of_one_grain_is_its_size_over_the_mean_slope_of_the_heap() -> None:
    judge = TRIAL.quantities[0].judge
    assert isinstance(judge, Measured)
    assert judge.band is not None
    out = judge.measurement.value
    a = out / 1.24  # initial height over radius
    slope = 0.88 * a ** (1 / 6) / (1 + out)
    doubt = np.hypot(0.005 * a, 0.1 * out)
    # five grains in the radius, to half a per cent, since whole grains fill no circle
    assert judge.band == pytest.approx(3 * doubt + 1 / (5 * slope), rel=1e-3)


@pytest.mark.parametrize(
    ("law", "place", "speed"),
    [
        ("gain", _still, lambda t: _nil(t) + 0.1 * (t > 0)),
        ("hurry", lambda t: _still(t) - np.array([0.0, 0.0, 0.51 * G * t**2]), _nil),
        ("through", lambda t: _still(t) - np.array([0.0, 0.0, 1.5 * D * (t > 0.1)]), _nil),
    ],
)  # fmt: skip
def test_what_breaks_a_law_is_seen(
    law: str, place: Callable[[float], Vector], speed: Callable[[float], Vector]
) -> None:
    assert _verdicts(_run(_still, _nil))[law] == "pass"
    assert _verdicts(_run(place, speed))[law] != "pass"


def test_a_velocity_at_the_start_that_is_rounding_is_no_gain_of_energy() -> None:
    gain = next(one for one in TRIAL.quantities if one.name == "gain")
    run = _run(lambda t: _still(t) - np.array([0.0, 0.0, t]), lambda t: _nil(t) + 1e-20 * (t == 0))
    assert measured(run, gain, Method.SECOND_ORDER, Knobs(dt=1e-5))[0].value == 0


def test_a_grain_that_rolled_far_away_does_not_move_the_edge() -> None:
    def strays(t: float) -> Vector:
        place = _still(t).copy()
        place[0] += np.array([0.3, 0.0, 0.0]) * (t > 0)
        return place

    def out(place: Callable[[float], Vector]) -> float | None:
        run = _run(place, _nil)
        run_out = TRIAL.quantities[0]
        return measured(run, run_out, Method.SECOND_ORDER, Knobs(dt=1e-5))[0].value

    assert out(strays) == out(_still)


def test_springs_bear_the_heaviest_grain_20000_times_and_steps_resolve_their_swing() -> None:
    law, heaviest = TRIAL.study.scene.contact, float(SPHERES.mass.max())
    assert law.kn * D == pytest.approx(2e4 * heaviest * G)
    (setting,) = TRIAL.study.rungs[Level.QUICK]
    assert setting.dt is not None
    assert setting.dt * np.sqrt(law.kn / heaviest) == pytest.approx(0.2, rel=0.01)
