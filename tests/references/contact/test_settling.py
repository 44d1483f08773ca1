"""Claims about the sphere that bounces to rest: two routes agree, also on the position of rest."""

from math import exp, pi, sqrt
from types import ModuleType

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from reference_solutions.checks.contact import settling as integrated
from reference_solutions.contact import settling as closed
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Knobs
from vv.engines import exact
from vv.engines.exact.modes import State
from vv.plan.project import find

Array = NDArray[np.float64]
CASE = find().load_case("settling")
DROP = {"m": 1.0, "kn": 1e6, "eta": 20.0, "g": 9.81, "height": 2e-3}
OTHER = {"m": 3.0, "kn": 1e6, "eta": 150.0, "g": 7.0, "height": 4e-3}
T = np.linspace(0.0, 0.45, 901)
# signs that only affect the range of a search, or that the direction of an event determines too
EFFORT = ("2.0 * top + sqrt(2.0 * stage.z / g) + stage.z * c / g",
          "2.0 * top + sqrt(2.0 * stage.z / g)", "n * b + sunk * wd", "-1", "-1.0")  # fmt: skip


def apart(a: Array, b: Array) -> float:
    return float(np.max(np.abs(a - b)) / np.max(np.abs(b)))


def bounces(p: dict[str, float]) -> int:
    return sum(stage.flies for stage in closed.stages(**p)) - 1


@pytest.mark.parametrize("p", [DROP, OTHER])
def test_the_two_routes_agree(p: dict[str, float]) -> None:
    moved, left = integrated.settling(T, **p)
    assert apart(closed.settling(T, **p), moved) < 1e-11
    assert left == bounces(p)


@given(st.floats(20.0, 200.0), st.floats(5e-4, 4e-3))
@settings(max_examples=8)
def test_they_agree_over_the_class(eta: float, height: float) -> None:
    p = {**DROP, "eta": eta, "height": height}
    begins = [stage.begin for stage in closed.stages(**p)]
    assume(min(np.diff(begins)) > 3e-4)  # a shorter flight, which the second route may miss
    assert apart(closed.settling(T[::9], **p), integrated.settling(T[::9], **p)[0]) < 1e-10


def test_it_bounces_30_times_and_rests_where_the_spring_carries_it() -> None:
    assert bounces(DROP) == 30
    rest = float(closed.settling(3.0, **DROP))
    assert rest == pytest.approx(-DROP["height"] - 9.81 / 1e6, abs=1e-14)


def test_a_contact_without_gravity_to_speak_of_returns_what_drag_leaves() -> None:
    """v'/v = exp(-n pi/wd), the restitution in T2."""
    p = {**DROP, "eta": 2.0, "height": 10.0}
    _, contact, flight, *_ = closed.stages(**p)
    wd = sqrt(1e6 - 1.0)
    assert flight.v == pytest.approx(-contact.v * exp(-pi / wd), rel=1e-5)


def test_the_exact_engine_leaves_the_floor_as_often() -> None:
    trial = CASE.declare("drop", CASE.defaults("drop"))
    moved, count = trial.quantities
    ask = trial.study.ask(Knobs())
    path = exact.move(exact.prepare(ask), ask.goal.duration)
    assert isinstance(path, exact.Path)
    opened = sum(event.after is State.OPEN for event in path.events)
    assert opened == count.observe(exact.solve(ask)) == 30
    assert moved.name == "z"


def same(route: ModuleType) -> bool:
    """Whether a route has the known motion."""
    for p in (DROP, OTHER):
        found = route.settling(T, **p)
        found = found[0] if isinstance(found, tuple) else found
        if not apart(found, closed.settling(T, **p)) < 1e-10:
            return False
    return True


@pytest.mark.parametrize("sign", signs(closed, (), EFFORT))
def test_any_wrong_sign_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(closed, sign)))


@pytest.mark.parametrize("sign", signs(integrated, (), EFFORT))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(integrated, sign)))


@pytest.mark.parametrize("route", [closed, integrated])
def test_what_catches_wrong_signs_lets_an_unchanged_copy_pass(route: ModuleType) -> None:
    assert same(turned(route, None))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"eta": 0.0}, r"eta = 0.0 .*positive"),
        ({"kn": -1.0}, r"kn = -1.0 .*positive"),
        ({"eta": 3e3}, r"eta = 3000.0 N s/m; it must be below 2 sqrt\(kn m\) = 2000"),
    ],
)
def test_parameters_beyond_the_solution_are_refused(
    changes: dict[str, float], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        closed.settling(T, **(DROP | changes))
