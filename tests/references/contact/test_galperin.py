"""Claims about the balls that count pi: two routes agree, and springs change no count."""

from fractions import Fraction
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.checks.contact import galperin as followed
from reference_solutions.contact import galperin as unfolded
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Ask, History, Knobs, Velocity
from vv.case import Level
from vv.engines import dem, exact
from vv.engines.exact.modes import State
from vv.plan.project import find
from vv.scene import Scene

CASE = find().load_case("galperin")
START = {"x": 1.0, "X": 1.1, "v": 1.0}
RATIOS = [2.0, 7.7, 100.0, 3e4]
KNOWN = [(1e2, 31), (1e4, 314), (1e6, 3141), (1e8, 31415)]
# a sign that matters only within rounding
EFFORT = ("fits - round(fits)",)


@pytest.mark.parametrize(("ratio", "digits"), KNOWN)
def test_the_collisions_spell_pi(ratio: float, digits: int) -> None:
    assert unfolded.collisions(1.0, ratio) == digits
    assert followed.collide(1.0, ratio, x=1.0, X=1.1, v=1.0)[0] == digits


def test_equal_balls_collide_three_times() -> None:
    """Where the wedge fits a whole number of times, one collision fewer occurs."""
    found, last = followed.collide(1.0, 1.0, x=1.0, X=1.1, v=1.0)
    assert found == 3
    assert last == pytest.approx(2.1)


def test_they_collide_31_times_without_any_rounding() -> None:
    x, X, v = Fraction(1), Fraction(11, 10), Fraction(1)
    assert followed.collide(Fraction(1), Fraction(100), x=x, X=X, v=v)[0] == 31


@given(st.floats(1.1, 1e4), st.floats(0.1, 10.0), st.floats(1.05, 3.0), st.floats(0.1, 10.0))
@settings(max_examples=60)
def test_the_two_routes_agree(ratio: float, x: float, far: float, v: float) -> None:
    try:
        due = unfolded.collisions(2.0, 2.0 * ratio)
    except ValueError:
        return  # on the border to one more collision
    found, last = followed.collide(2.0, 2.0 * ratio, x=x, X=far * x, v=v)
    assert found == due
    # near the border the last collision is late, and its time is as inaccurate
    assert last == pytest.approx(unfolded.last(2.0, 2.0 * ratio, x, far * x, v), rel=1e-6)


def _ask(variant: str) -> Ask:
    study = CASE.declare(variant, CASE.defaults(variant)).study
    return study.ask(study.rungs[Level.DEFAULT][0])


def _closed(scene: Scene, duration: float) -> int:
    """The number of times a contact closes, from the events of the exact engine."""
    ask = Ask(scene, History(duration, duration), (Velocity(1),))
    path = exact.move(exact.prepare(ask), duration)
    assert isinstance(path, exact.Path)
    return sum(event.before is State.OPEN for event in path.events)


def test_springs_collide_as_often_as_hard_bodies_even_3141_times() -> None:
    for ratio, kn, due in ((1e2, 1.6e6, 31), (1e4, 1.6e10, 314), (1e6, 1.6e14, 3141)):
        p = {**CASE.defaults("31"), "ratio": ratio, "kn": kn}
        hard = unfolded.last(1.0, ratio, **START)
        assert _closed(_at("31", p), 1.1 * hard) == due


def _at(variant: str, p: dict[str, float]) -> Scene:
    return CASE.declare(variant, p).study.scene


def test_what_the_outputs_show_is_what_the_contacts_did() -> None:
    ask = _ask("314")
    (count,) = CASE.declare("314", CASE.defaults("314")).quantities
    assert count.observe(exact.solve(ask)) == _closed(ask.scene, ask.goal.duration) == 314


def test_a_leapfrog_miscounts_at_five_steps_a_contact_but_not_at_forty() -> None:
    """So few steps change the speed by some per cent in each collision, which the case detects."""
    trial = CASE.declare("31", CASE.defaults("31"))
    study, (count,) = trial.study, trial.quantities
    fine, touch = study.rungs[Level.DEFAULT][1], np.pi / np.sqrt(1.6e6)
    assert fine.dt == pytest.approx(touch / 40)
    wrong = Ask(study.scene, study.goal, study.observables, Knobs(dt=touch / 5))
    assert count.observe(dem.solve_default(study.ask(fine))) == 31
    assert count.observe(dem.solve_default(wrong)) == 30


def _same(route: ModuleType) -> bool:
    """Whether a route has the known number of collisions and the known time of the last."""
    x, X, v = 0.8, 1.1, 1.7
    for masses in ((0.6, 0.6 * ratio) for ratio in RATIOS):
        due = followed.collide(*masses, x=x, X=X, v=v)
        if hasattr(route, "collide"):
            found = route.collide(*masses, x=x, X=X, v=v)
        else:
            found = route.collisions(*masses), route.last(*masses, x, X, v)
        if not (found[0] == due[0] and np.isclose(found[1], due[1], rtol=1e-9)):
            return False
    return True


@pytest.mark.parametrize("sign", signs(unfolded, (), EFFORT))
def test_any_wrong_sign_in_the_formula_is_caught(sign: int) -> None:
    assert caught(lambda: _same(turned(unfolded, sign)))


@pytest.mark.parametrize("sign", signs(followed, (), EFFORT))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: _same(turned(followed, sign)))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"m": 0.0}, r"m = 0.0 kg; .*positive"),
        ({"M": float("inf")}, r"M = inf kg; .*positive"),
        ({"X": 1.0}, r"X = 1.0 m, x = 1.0 m; .*behind"),
        ({"v": -1.0}, r"v = -1.0 .*positive"),
        ({"m": 2.0, "M": 2.0}, r"M/m = 1.0; .*wedge 4.0 times.*rounding"),
        ({"m": 2.0, "M": 6.0}, r"M/m = 3.0\d*; .*rounding"),
    ],
)
def test_parameters_beyond_the_solution_are_refused(
    changes: dict[str, float], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        unfolded.last(**({"m": 1.0, "M": 100.0, **START} | changes))


def test_springs_so_soft_that_two_would_act_at_once_are_refused() -> None:
    with pytest.raises(ValueError, match=r"kn = 10000.0 N/m; a contact would last .* shorter"):
        CASE.declare("31", {**CASE.defaults("31"), "kn": 1e4})
