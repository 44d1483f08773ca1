"""Claims about the sheet at rest: two routes agree, codes stay at rest, and gains are detected."""

from __future__ import annotations

import dataclasses
import functools
from types import ModuleType

import numpy as np
import pytest

from cases.hard.parts._knocked_sheet import observed_energy
from reference_solutions.checks.contact import resting_lattice as lowest
from reference_solutions.contact import resting_lattice as balanced
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Knobs, Method, Run, Status, Velocity
from vv.case import Level, Scalar, evaluated
from vv.engines import dem
from vv.plan.project import find
from vv.records.checking import checked
from vv.records.record import measured
from vv.scene import Form, Vector

CASE = find().load_case("resting")
LAW = {"r": 0.05, "m": 1.3, "kn": 1e6, "g": 9.81}
WEIGHT = LAW["m"] * LAW["g"]
SMALL, SQUEEZE = {"n": 3, "rows": 3}, 2e-4


def rest(route: ModuleType, n: int = 3, rows: int = 3) -> tuple[Vector, float]:
    place, width = route.at_rest(n=n, rows=rows, squeeze=SQUEEZE, **LAW)
    return place, width


def start(n: int, rows: int) -> Vector:
    return (1 - SQUEEZE) * np.asarray(balanced.packed(n, rows, LAW["r"]))


@pytest.mark.parametrize(("n", "rows"), [(3, 3), (6, 6)])
def test_the_two_routes_agree(n: int, rows: int) -> None:
    place, width = rest(balanced, n, rows)
    other = lowest.moved(start(n, rows), width=width, **LAW)
    assert np.abs(place - other).max() < 1e-5 * WEIGHT / LAW["kn"]


def test_the_floor_bears_the_weight_and_every_contact_is_closed() -> None:
    place, width = rest(balanced, 6, 6)
    r = LAW["r"]
    floor = LAW["kn"] * np.maximum(r - place[:, 1], 0.0).sum()
    assert floor == pytest.approx(33 * WEIGHT, rel=1e-11)
    sides = [np.maximum(r - place[:, 0], 0.0).sum(), np.maximum(place[:, 0] + r - width, 0.0).sum()]
    assert sides[0] == pytest.approx(sides[1], rel=1e-9)
    apart = np.linalg.norm(place[:, None] - place, axis=2)[np.triu_indices(33, 1)]
    assert (apart < 2 * r).sum() == (apart < 2.1 * r).sum() == 77


def same(route: ModuleType) -> bool:
    """Whether a route has the small sheet on which both agree."""
    place, width = rest(balanced)
    if hasattr(route, "at_rest"):
        other, wide = rest(route)
        return bool(wide == width and np.abs(other - place).max() < 1e-12)
    other = route.moved(start(3, 3), width=width, **LAW)
    return bool(np.abs(other - place).max() < 1e-5 * WEIGHT / LAW["kn"])


# signs that only affect the path of Newton's method: rotation of normals, initial guess
@pytest.mark.parametrize("sign", signs(balanced, ("packed", "at_rest", "_forces"), (
    "np.eye(2) - np.outer(along, along)", "turning - kn * np.outer(along, along)",
    "rows, long and short", "1.0 - squeeze",
)))  # fmt: skip
def test_any_wrong_sign_is_caught(sign: int) -> None:
    with np.errstate(all="ignore"):
        assert caught(lambda: same(turned(balanced, sign)))


@pytest.mark.parametrize("sign", signs(lowest))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    with np.errstate(all="ignore"):
        assert caught(lambda: same(turned(lowest, sign)))


def test_what_catches_wrong_signs_lets_unchanged_copies_pass() -> None:
    assert same(turned(balanced, None))
    assert same(turned(lowest, None))


def test_a_sheet_of_nothing_is_refused() -> None:
    with pytest.raises(ValueError, match=r"n = 1, rows = 3; at least 2 spheres and 1 row"):
        balanced.packed(1, 3, 0.05)


def test_a_sheet_too_large_for_a_full_matrix_is_refused() -> None:
    assert len(balanced.packed(40, 50, 1.0)) == 1975
    with pytest.raises(ValueError, match="2040 spheres; at most 2000 are solved"):
        balanced.packed(40, 51, 1.0)


def test_smooth_spheres_that_may_turn_are_run() -> None:
    for smooth in ({"ks": 0.0}, {"mu": 0.0}):
        trial = CASE.declare("still", {**CASE.defaults("still"), **smooth})
        ask = trial.study.ask(trial.study.rungs[Level.DEFAULT][0])
        assert checked(dem.solve_default(ask), ask).status is Status.RAN


def ran(variant: str) -> tuple[Run, dict[str, Scalar]]:
    """A run of the engine at the finest step, and the quantities measured in it."""
    trial = CASE.declare(variant, CASE.defaults(variant))
    numbers = {q.name: q for q in trial.quantities if isinstance(q, Scalar)}
    study = trial.study
    return dem.solve_default(study.ask(study.rungs[Level.DEFAULT][-1])), numbers


def judged(quantity: Scalar, run: Run) -> object:
    return measured(run, quantity, Method.SECOND_ORDER, Knobs(5e-5))[0].verdict.value


def test_a_gain_is_seen_after_a_loss_that_would_hide_it() -> None:
    """All velocities grow again at the end, to energies far below the initial one."""
    run, numbers = ran("knocked")
    assert judged(numbers["gained"], run) == "pass"
    grown = {
        what: np.concatenate([values, 5 * values[-1:]]) if isinstance(what, Velocity)
        else np.concatenate([values, values[-1:]])
        for what, values in run.values.items()
    }  # fmt: skip
    late = dataclasses.replace(run, values=grown)
    held = functools.partial(
        observed_energy, CASE.declare("knocked", CASE.defaults("knocked")).study.scene
    )
    assert held(late)[-1] < held(late)[0]
    assert judged(numbers["gained"], late) == "fail"


@pytest.mark.parametrize("name", ["gained", "returned"])
def test_friction_that_gives_back_a_thousandth_for_once_is_seen_in_the_books(name: str) -> None:
    run, numbers = ran("booked")
    assert judged(numbers[name], run) == "pass"
    given = 1e-3 * evaluated(numbers[name].scale) * (run.times > 0.08)
    energies = dict(run.energies)
    energies[Form.FRICTION] = energies[Form.FRICTION] - given
    energies[Form.KINETIC] = energies[Form.KINETIC] + given
    late = dataclasses.replace(run, energies=energies)
    assert judged(numbers[name], late) == "fail"


def test_friction_takes_nearly_all_of_a_knock() -> None:
    run, numbers = ran("knocked")
    scale = evaluated(numbers["gained"].scale)
    assert run.ledger is not None
    assert 0.95 < run.ledger.terms["friction dissipation"] / scale < 1.0
    assert run.ledger.unaccounted < 1e-3 * scale


def test_a_sheet_a_thousandth_of_a_weight_off_its_rest_is_seen_to_move() -> None:
    trial = CASE.declare("still", CASE.defaults("still"))
    (moved,) = trial.quantities
    assert isinstance(moved, Scalar)
    ask = trial.study.ask(trial.study.rungs[Level.QUICK][0])
    heavier = dataclasses.replace(ask.scene, gravity=1.001 * ask.scene.gravity)
    for scene, low, high in ((ask.scene, 0.0, 1e-10), (heavier, 1e-4, 1e-1)):
        run = dem.solve_default(dataclasses.replace(ask, scene=scene))
        assert low <= moved.observe(run) / evaluated(moved.scale) <= high
