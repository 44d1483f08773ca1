"""Claims about a block on a shaking foundation: slip that almost stops reverses within a step."""

import numpy as np
import pytest

from cases.blocks.responding_block import CASE
from vv.ask import Knobs, Method
from vv.case import Exact, Level
from vv.engines import dda, dem, rigid
from vv.records.record import measured

LAGS = Method.LAGGING


@pytest.mark.parametrize("dt", [1e-3, 5e-4, 1e-4])
@pytest.mark.parametrize(
    ("variant", "given"),
    [
        ("3d", {"D": 0.15}),
        ("2d", {"f": 20.0, "fy": 15.0}),
        ("2d", {}),
        ("3d-turning", {"f": 0.707, "g": 14.4}),
        ("3d-turning", {"f": 1.11, "Dy": 0.1669, "fz": 0.849}),
        ("3d-turning", {"D": 0.0452, "f": 0.9665, "Dy": 0.0341}),
    ],
    ids=str,
)
def test_rigid_follows_slip_that_all_but_stops(
    variant: str, given: dict[str, float], dt: float
) -> None:
    trial = CASE.declare(variant, {**CASE.defaults(variant), **given})
    run = rigid.solve(trial.study.ask(Knobs(dt)))
    judged = [measured(run, q, Method.SECOND_ORDER, Knobs(dt))[0] for q in trial.quantities]
    assert {one.name: one.verdict.value for one in judged if one.verdict.value != "pass"} == {}


@pytest.mark.parametrize("seed", range(4))
def test_rigid_follows_slip_at_any_parameters(seed: int) -> None:
    """The parameters are those of 3d, each changed by up to a half."""
    rng, p = np.random.default_rng(seed), CASE.defaults("3d")
    for name in ("D", "Dy", "Dz", "f", "fy", "fz", "mu"):
        p = {**p, name: p[name] * float(rng.uniform(0.5, 1.5))}
    p["Dz"] = min(p["Dz"], 0.9 * p["g"] / (2 * np.pi * p["fz"]) ** 2)
    trial = CASE.declare("3d", {**p, "duration": 2.0})
    run = rigid.solve(trial.study.ask(Knobs(1e-3)))
    judged = [measured(run, q, Method.SECOND_ORDER, Knobs(1e-3))[0] for q in trial.quantities]
    assert {one.name: one.verdict.value for one in judged if one.verdict.value != "pass"} == {}


@pytest.mark.parametrize("given", [{"D": 0.15}, {"mu": 0.3}, {"D": 0.1}, {"f": 10.0}], ids=str)
def test_springs_are_judged_at_5_hz_where_steps_do_not_decide(given: dict[str, float]) -> None:
    """At 1e-3 s and 1e8 N/m errors reach 0.4 of the displacement, depending on step and period."""
    trial = CASE.declare("1d-5hz", {**CASE.defaults("1d-5hz"), **given})
    assert all(len(rungs) > 1 for rungs in trial.study.rungs.values())
    for knobs in trial.study.rungs[Level.DEFAULT]:
        for solve, method in ((dem.solve_default, Method.PENALTY), (dda.solve_lagged, LAGS)):
            run = solve(trial.study.ask(knobs))
            (judged,) = (measured(run, q, method, knobs)[0] for q in trial.quantities)
            assert judged.verdict.value == "pass"


@pytest.mark.parametrize(
    ("variant", "given"),
    [
        ("3d", {"mu": 0.0}),
        ("3d", {"mu": 1e-3}),
        ("3d", {"mu": 0.03, "Dz": 0.005, "fz": 5.0}),
        ("2d", {"mu": 0.01}),
        ("2d", {"mu": 0.1}),
    ],
    ids=str,
)
def test_springs_are_within_their_bounds_with_little_friction_or_none(
    variant: str, given: dict[str, float]
) -> None:
    """The base stops along both axes at once, where slip turns within a step; and it lifts."""
    trial = CASE.declare(variant, {**CASE.defaults(variant), **given})
    solved = ((dem.solve_published, Method.PENALTY), (dda.solve_lagged, LAGS))
    for knobs in trial.study.rungs[Level.QUICK]:
        for solve, method in solved:
            run = solve(trial.study.ask(knobs))
            for q in trial.quantities:
                assert isinstance(q.judge, Exact)
                error = measured(run, q, method, knobs)[0].error
                assert error is not None
                assert error <= q.judge.tolerance(method).uncut(knobs), (knobs, method, q.name)


@pytest.mark.parametrize(("variant", "name"), [("2d", "f"), ("2d", "fy"), ("3d", "fy")])
def test_bases_that_shake_along_both_axes_as_fast_as_springs_swing_are_refused(
    variant: str, name: str
) -> None:
    """A cube of 2500 kg on 1e8 N/m swings at 31.83 Hz."""
    given = CASE.defaults(variant)
    CASE.declare(variant, {**given, name: 31.8})
    with pytest.raises(ValueError, match=f"{name} = 31.84 Hz; .* springs swing, at 31.83 Hz"):
        CASE.declare(variant, {**given, name: 31.84})


def test_springs_near_their_frequency_are_not_judged() -> None:
    trial = CASE.declare("3d", {**CASE.defaults("3d"), "fy": 31.0})
    judge = trial.quantities[0].judge
    assert isinstance(judge, Exact)
    assert judge.tolerance(Method.PENALTY).uncut(Knobs(1e-3, 1e8)) >= 1.0
    assert judge.tolerance(Method.PENALTY).uncut(Knobs(2e-5, 1e11)) < 0.1
