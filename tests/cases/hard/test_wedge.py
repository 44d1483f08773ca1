"""Claims about a wedge in a groove: two routes agree, and how narrow a groove codes can solve."""

import math
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.checks.hard import wedge as balanced
from reference_solutions.hard import wedge as closed
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Ask, Run
from vv.case import Level, Series
from vv.engines import dda, rigid
from vv.plan.project import find

CASE = find().load_case("wedge")


@given(st.floats(1e-6, 3.0), st.floats(1.0, 80.0), st.floats(0.0, 0.9))
@settings(max_examples=60)
def test_the_two_routes_agree(xi: float, dip: float, held: float) -> None:
    mu = held * math.tan(math.radians(dip)) * math.sin(xi / 2)
    law = {"dip": dip, "xi": xi, "mu": mu, "g": 9.81}
    (s,) = closed.slid(np.array([1.0]), **law)
    assert balanced.acceleration(**law) == pytest.approx(2 * s, rel=1e-6)


def test_a_groove_as_wide_as_a_plane_is_one_and_rough_ones_hold() -> None:
    assert closed.pressing(math.pi) == 1.0
    assert closed.slid(2.0, dip=30.0, xi=1e-6, mu=1e-3, g=9.81) == 0.0


def farthest(xi: float, solve: object) -> tuple[float, Run]:
    """The largest error of a run in a groove, relative to the displacement."""
    trial = CASE.declare("xi-1", {**CASE.defaults("xi-1"), "xi": xi})
    study, (s,) = trial.study, trial.quantities
    ask = Ask(study.scene, study.goal, study.observables, study.rungs[Level.DEFAULT][0])
    run: Run = solve(ask)  # type: ignore[operator]
    assert isinstance(s, Series)
    assert s.reference is not None
    due = s.reference(run.times)
    return float(np.abs(s.observe(run) - due).max() / due.max()), run


def breach(run: Run) -> float:
    """The largest residual of a law in the run's own audits, over the allowed one."""
    assert run.ledger is not None
    return max(seen / allowed for seen, allowed in run.ledger.audits.values())


def test_rigid_contact_bears_a_hundredth_of_a_radian() -> None:
    errors = [farthest(xi, rigid.solve) for xi in (1.0, 0.1, 0.01)]
    assert all(error < bound for (error, _), bound in zip(errors, (1e-11, 1e-9, 1e-4), strict=True))
    assert max(breach(run) for _, run in errors) < 1


def test_rigid_contact_bears_a_millionth_of_a_radian() -> None:
    """Rounding in sweeps would cause errors of 1.2e-5 to 1; a Newton step leaves less."""
    for xi, bound in ((1e-3, 1e-9), (1e-4, 1e-8), (1e-5, 3e-6), (1e-6, 3e-6)):
        error, run = farthest(xi, rigid.solve)
        assert error < bound
        assert breach(run) < 1


def test_springs_let_a_narrow_wedge_fall_through() -> None:
    errors = [farthest(xi, dda.solve_default)[0] for xi in (1.0, 0.1, 0.01, 1e-3)]
    assert errors == sorted(errors)
    assert errors[0] < 1e-3
    assert errors[-1] > 0.5


def same(route: ModuleType) -> bool:
    """Whether a route has the known sliding of a wedge."""
    law = {"dip": 25.0, "xi": 0.7, "mu": 0.1, "g": 9.81}
    s, c, K = math.sin(math.radians(25)), math.cos(math.radians(25)), 1 / math.sin(0.35)
    due = 9.81 * (s - 0.1 * K * c)
    if hasattr(route, "acceleration"):
        return bool(abs(route.acceleration(**law) - due) < 1e-9)
    return bool(abs(2 * float(route.slid(1.0, **law)) - due) < 1e-9)


@pytest.mark.parametrize("sign", signs(closed))
def test_any_wrong_sign_in_the_formula_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(closed, sign)))


@pytest.mark.parametrize("sign", signs(balanced, (), ("-1.0",)))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(balanced, sign)))


def test_openings_out_of_range_are_refused() -> None:
    with pytest.raises(ValueError, match=r"xi = 4.0 rad; a groove opens by at most pi"):
        closed.pressing(4.0)
    with pytest.raises(ValueError, match=r"xi = 1.6 rad; it must be below pi/2"):
        CASE.declare("xi-1", {**CASE.defaults("xi-1"), "xi": 1.6})
