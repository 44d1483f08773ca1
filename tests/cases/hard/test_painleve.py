"""Claims about a rod in Painleve's paradox: two routes agree, and impulses solve where it jams."""

import math
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.checks.hard import painleve_rod as stepped
from reference_solutions.hard import painleve_rod as closed
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Run
from vv.case import Level, Scalar, error_scale
from vv.engines import rigid
from vv.plan.project import find

CASE = find().load_case("painleve")
ROD = {"half": 0.8, "V": 2.0, "g": 9.81}
THETA = math.atan(2.0)


def test_the_paradox_begins_at_four_thirds_where_the_force_has_no_bound() -> None:
    assert closed.critical(2.0) == pytest.approx(4 / 3, rel=1e-15)
    push = [stepped.forces(THETA, 0.0, mu, 1.0, 9.81)[3] / 9.81 for mu in (1.0, 1.3, 1.34)]
    assert push[:2] == pytest.approx([2.5, 25.0], rel=1e-12)
    assert push[2] < 0


@given(st.floats(0.55, 1.2), st.floats(1.6, 2.5))
@settings(max_examples=20)
def test_the_two_routes_agree_while_it_slides(mu: float, slope: float) -> None:
    theta = math.atan(slope)
    if mu > 0.9 * closed.critical(slope):
        return
    x, z, slip = stepped.slide(5e-3, 100, mu=mu, theta=theta, **ROD)
    assert slip < 0
    found = closed.middle(np.array([0.0, 5e-3]), mu=mu, slope=slope, **ROD)[-1]
    assert found == pytest.approx(np.array([x, z]), abs=1e-11)


@pytest.mark.parametrize("mu", [1.34, 2.0])
def test_the_two_routes_agree_once_it_has_jammed(mu: float) -> None:
    x, z = closed.middle(np.array([0.0, 0.02, 0.04]), mu=mu, slope=2.0, **ROD)[-1]
    spin, up = stepped.jam(mu=mu, theta=THETA, half=0.8, V=2.0)
    across, high = x + 0.8 * math.cos(THETA), z + 0.8 * math.sin(THETA)
    assert up > 0
    assert math.hypot(across, high) == pytest.approx(0.8, rel=1e-12)
    swing = math.atan2(high, across) - THETA
    assert stepped.turning_time(THETA, swing, spin, 0.8, 9.81) == pytest.approx(0.04)


def test_the_motion_changes_little_at_the_edge_of_the_paradox() -> None:
    t = np.linspace(0.0, 0.04, 5)
    below, beyond = (closed.middle(t, mu=4 / 3 + d, slope=2.0, **ROD) for d in (-1e-4, 1e-4))
    assert np.abs(below - beyond).max() < 2e-4


def shown(variant: str, mu: float) -> tuple[float, Run]:
    """The relative distance of a run of the rigid engine at mu from the path of a variant."""
    trial = CASE.declare(variant, CASE.defaults(variant))
    other = CASE.declare(variant, {**CASE.defaults(variant), "mu": mu}).study
    run = rigid.solve(other.ask(trial.study.rungs[Level.DEFAULT][-1]))
    (distance,) = (q for q in trial.quantities if isinstance(q, Scalar))
    return distance.observe(run) / error_scale(distance.name, distance.scale), run


def test_rigid_contact_by_impulses_has_the_solution_and_says_it_converged() -> None:
    for variant, mu in (("mu-0.8", 0.8), ("mu-1.3", 1.3), ("mu-1.34", 1.34), ("mu-2", 2.0)):
        error, run = shown(variant, mu)
        assert error < (5e-3 if mu > 4 / 3 else 1e-4)
        assert run.ledger is not None
        assert all(seen <= allowed for seen, allowed in run.ledger.audits.values())


def test_a_percent_less_friction_is_seen_before_the_paradox() -> None:
    assert shown("mu-0.8", 0.792)[0] > 1e-3


def test_an_end_that_friction_cannot_hold_is_refused() -> None:
    with pytest.raises(ValueError, match=r"mu = 2.0; the end slides again"):
        closed.middle(np.array([0.0, 0.1]), mu=2.0, slope=2.0, **{**ROD, "V": 6.0})


def same(route: ModuleType) -> bool:
    """Whether a route has the known motion of a rod at a general slope."""
    law = {"half": 0.7, "V": 1.5, "g": 9.81}
    theta, jam = math.atan(1.7), {"mu": 2.0, "theta": math.atan(1.7), "half": 0.7, "V": 1.5}
    if hasattr(route, "jam"):
        slid = route.slide(0.01, 50, mu=1.1, theta=theta, **law)
        spin, up = route.jam(**jam)
        time = route.turning_time(theta, 0.02, spin, 0.7, 9.81)
        return bool(np.allclose([*slid, spin, up, time], KNOWN, rtol=1e-9))
    t = np.array([0.0, 0.01, KNOWN[-1]])
    slid = route.middle(t[:2], mu=1.1, slope=1.7, **law)[-1]
    late = route.middle(np.array([0.0, 0.03, 0.05]), mu=1.1, slope=1.7, **law)[-1]
    turned_to = 0.7 * np.array([math.cos(theta + 0.02), math.sin(theta + 0.02)])
    jammed = route.middle(t, mu=2.0, slope=1.7, **law)[-1]
    due = turned_to - 0.7 * np.array([math.cos(theta), math.sin(theta)])
    edge = route.critical(1.7) - stepped_edge()
    good = np.allclose([*slid, *jammed], [*KNOWN[:2], *due], rtol=1e-8) and abs(edge) < 1e-9
    return bool(good and np.allclose(late, LATE, rtol=1e-8))


def stepped_edge() -> float:
    """The friction at which the normal force diverges and changes sign, by the second route."""
    low, high = 0.5, 3.0
    for _ in range(60):
        mu = (low + high) / 2
        push = stepped.forces(math.atan(1.7), 0.0, mu, 0.7, 9.81)[3]
        low, high = (mu, high) if push > 0 else (low, mu)
    return low


def _known() -> tuple[list[float], list[float]]:
    theta = math.atan(1.7)
    law = {"half": 0.7, "V": 1.5, "g": 9.81}
    slid = stepped.slide(0.01, 50, mu=1.1, theta=theta, **law)
    spin, up = stepped.jam(mu=2.0, theta=theta, half=0.7, V=1.5)
    time = stepped.turning_time(theta, 0.02, spin, 0.7, 9.81)
    late = closed.middle(np.array([0.0, 0.03, 0.05]), mu=1.1, slope=1.7, **law)[-1]
    return [*slid.tolist(), spin, up, time], late.tolist()


KNOWN, LATE = _known()


@pytest.mark.parametrize("sign", signs(closed, ("critical", "middle", "_slide", "_turn")))
def test_any_wrong_sign_in_the_closed_forms_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(closed, sign)))


@pytest.mark.parametrize("sign", signs(stepped))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(stepped, sign)))


def test_a_rod_that_lies_down_is_refused() -> None:
    usual = CASE.defaults("mu-0.8")
    CASE.declare("mu-0.8", {**usual, "half": 0.01})
    with pytest.raises(ValueError, match="or the rod lies down"):
        CASE.declare("mu-0.8", {**usual, "half": 0.002})
