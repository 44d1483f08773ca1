"""Claims about generalised alpha: two routes to its roots agree with each other and the engine."""

import dataclasses
import math
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.blocks import generalised_alpha as theory
from reference_solutions.checks.blocks import generalised_alpha as taken
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Method
from vv.case import Level
from vv.engines import dda
from vv.engines.dda.stepping import Stepping, generalised_alpha
from vv.plan.project import find
from vv.records.record import measured

CASE = find().load_case("damped-swing")


@given(st.floats(1e-2, 1e2), st.floats(0.0, 1.0))
@settings(max_examples=100)
def test_the_two_routes_agree(angle: float, radius: float) -> None:
    assert theory.polynomial(angle, radius) == pytest.approx(
        np.poly(taken.amplification(angle, radius)), rel=1e-10, abs=1e-12
    )
    root = theory.swinging_root(angle, radius)
    assert abs(taken.roots(angle, radius) - root).min() < 1e-7


def test_small_steps_damp_by_the_cube_of_their_angle_and_large_ones_leave_the_radius() -> None:
    lost = [1.0 - theory.spectral_radius(angle, 0.5) for angle in (0.1, 0.2)]
    assert lost[1] / lost[0] == pytest.approx(2.0**4, rel=0.05)  # a step is itself an angle
    late = [theory.slowing(angle, 0.5) - 1.0 for angle in (0.1, 0.2)]
    assert late[1] / late[0] == pytest.approx(4.0, rel=0.01)
    assert theory.spectral_radius(1e4, 0.5) == pytest.approx(0.5, abs=4e-3)
    assert theory.spectral_radius(3.0, 1.0) == pytest.approx(1.0, abs=1e-14)


def judged(variant: str, stepping: Stepping, level: Level = Level.DEFAULT) -> list[str]:
    trial = CASE.declare(variant, CASE.defaults(variant))
    way = dataclasses.replace(dda.DAMPED, stepping=stepping)
    found = []
    for rung in trial.study.rungs[level]:
        run = dda.solve(trial.study.ask(rung), way)
        assert run.ledger is not None
        assert run.ledger.bound is not None
        assert run.ledger.unaccounted <= run.ledger.bound
        for quantity in trial.quantities:
            found.append(measured(run, quantity, Method.DAMPED, rung)[0].verdict.value)
    return found


@pytest.mark.parametrize("variant", ["resolved", "unresolved"])
@pytest.mark.parametrize("name", Stepping._fields)
def test_any_number_of_the_step_a_billionth_off_fails(variant: str, name: str) -> None:
    right = generalised_alpha(0.5)
    assert set(judged(variant, right)) == {"pass"}
    off = right._replace(**{name: getattr(right, name) + 1e-9})
    assert "fail" in judged(variant, off)


def test_a_radius_that_no_step_has_is_refused() -> None:
    with pytest.raises(ValueError, match=r"radius = 1.1; .*between 0 and 1"):
        generalised_alpha(1.1)
    with pytest.raises(ValueError, match=r"radius = 1.1; .*between 0 and 1"):
        theory.polynomial(1.0, 1.1)
    with pytest.raises(ValueError, match=r"angle = 0.0 rad; .*positive"):
        theory.polynomial(0.0, 0.5)


def same(route: ModuleType) -> bool:
    """Whether a route has the polynomial, spectral radius and slowing of the other route."""
    for angle, radius in ((0.3, 0.5), (3.0, 0.2), (30.0, 0.8)):
        matrix = taken.amplification(angle, radius)
        due, roots = np.poly(matrix), np.linalg.eigvals(matrix)
        root = roots[np.argmax(roots.imag)]
        if hasattr(route, "roots"):
            found = np.poly(route.amplification(angle, radius))
            swung = route.roots(angle, radius)
            other = [abs(swung[np.argmax(swung.imag)])]
            told = [abs(root)]
        else:
            found = np.array(route.polynomial(angle, radius))
            other = [route.spectral_radius(angle, radius), route.slowing(angle, radius)]
            told = [abs(root), angle / math.atan2(root.imag, root.real)]
        if not np.allclose([*found, *other], [*due, *told], rtol=1e-9):
            return False
    return True


@pytest.mark.parametrize("sign", signs(theory, without=("1.0 - a * a / 2.0",)))
def test_any_wrong_sign_in_the_theory_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(theory, sign)))


@pytest.mark.parametrize("sign", signs(taken))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(taken, sign)))
