"""Claims about a block of uniform strain: two routes agree on it, and the engine follows."""

from __future__ import annotations

import dataclasses
import math
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from reference_solutions.blocks import elastic_block as closed
from reference_solutions.checks.blocks import elastic_block as integrated
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Method, Run, Status
from vv.case import Exact, Level, Scalar, Trial
from vv.engines import dda
from vv.plan.project import find
from vv.records.record import measured
from vv.scene import Block, Elastic, Scene, Vector

CASE = find().load_case("elastic-block")
LAW: dict[str, Any] = {"sides": (1.3, 0.7, 1.0), "rho": 2000.0, "young": 3e9, "poisson": 0.3}
W = closed.first(side=1.0, rho=2000.0, young=3e9)
T = np.linspace(0.0, 10.0, 101) / W
UPWARDS = "at * q[1:] + q[0] * UP"  # the sign of the centroid's unknown is arbitrary


def agree(one: ModuleType, other: ModuleType) -> bool:
    """Whether the routes agree on blocks that stand freely or constrained, and that spin slowly."""
    for along in ((0, 1, 2), (2,)):
        here, there = (route.standing(T, **LAW, g=9.81, along=along) for route in (one, other))
        if not np.abs(here - there).max() <= 1e-9 * np.abs(here).max() > 0:
            return False
    return bool(apart(one, other, 5.0) <= 1e-4 and apart(one, other, 20.0) <= 1.6e-3)


def apart(one: ModuleType, other: ModuleType, spin: float) -> float:
    """The relative difference of spinning blocks, of the order of (spin/w)^2 and of the strain."""
    here, there = (route.spinning(T, **LAW, spin=spin) for route in (one, other))
    return float(np.abs(here - there).max() / np.abs(here).max())


def test_the_two_routes_agree() -> None:
    assert agree(closed, integrated)
    assert agree(turned(closed, None), turned(integrated, None))


def test_what_they_differ_by_as_they_spin_goes_with_the_square_of_the_spin() -> None:
    slow, fast = (apart(closed, integrated, spin) for spin in (20.0, 40.0))
    assert fast / slow == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize("sign", signs(closed, ("law", "standing", "spinning", "_swings")))
def test_any_wrong_sign_in_the_formulas_is_caught(sign: int) -> None:
    assert caught(lambda: agree(turned(closed, sign), integrated))


@pytest.mark.parametrize("sign", signs(integrated, without=("-1.0", UPWARDS)))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: agree(closed, turned(integrated, sign)))


def test_what_swings_does_so_about_what_rests() -> None:
    held = closed.standing(T, **LAW, g=9.81, along=(2,))
    rest = closed.resting(**LAW, g=9.81)
    assert held[:, 2] == pytest.approx(rest[2] * (1 - np.cos(W * T)), rel=1e-12)
    long = closed.standing(np.linspace(0.0, 1e4 / W, 100_001), **LAW, g=9.81)
    assert long.mean(axis=0) == pytest.approx(rest, rel=1e-2)


@pytest.mark.parametrize("along", [(2,), (0, 1, 2)])
def test_the_base_always_presses(along: tuple[int, ...]) -> None:
    """The base of a constrained block bears a quarter of its weight at least: no contact ends."""
    t = np.linspace(0.0, 60.0, 60_001) / W
    rise = closed.standing(t, **LAW, g=9.81, along=along)[:, 2] * LAW["sides"][2] / 2
    pressed = 1 + np.diff(rise, 2) / t[1] ** 2 / 9.81
    assert pressed.min() > 0.05
    assert len(along) > 1 or pressed.min() == pytest.approx(0.25, abs=1e-3)


@pytest.mark.shows("A bar that is held to a uniform strain is stiffer than one that is not")
def test_a_bar_cut_into_many_swings_slower_than_one_of_uniform_strain() -> None:
    """A bar of unit E, rho and length in linear elements, free or fixed at its foot."""
    n = 200
    stiff = n * (2 * np.eye(n + 1) - np.eye(n + 1, k=1) - np.eye(n + 1, k=-1))
    mass = (4 * np.eye(n + 1) + np.eye(n + 1, k=1) + np.eye(n + 1, k=-1)) / (6 * n)
    for matrix, end in ((stiff, n), (mass, 1 / (3 * n))):
        matrix[0, 0] = matrix[-1, -1] = end
    for first, one_strain in ((0, math.sqrt(12.0)), (1, math.sqrt(3.0))):
        squares = np.linalg.eigvals(np.linalg.solve(mass[first:, first:], stiff[first:, first:]))
        lowest = np.sqrt(np.sort(squares.real)[1 - first])
        assert one_strain / lowest == pytest.approx(closed.STIFFER, rel=1e-4)
    assert closed.first(side=1.0, rho=1.0, young=1.0) == pytest.approx(math.sqrt(3.0))


def test_strain_seen_from_rest_turns_as_a_tensor() -> None:
    strains, angle = np.array([[3.0, 1.0, 0.5]] * 4), np.array([0.0, 0.3, math.pi / 2, 4.0])
    for e, seen, a in zip(strains, closed.seen_from_rest(strains, angle), angle, strict=True):
        c, s = math.cos(a), math.sin(a)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        assert seen == pytest.approx(np.diag(turn @ np.diag(e) @ turn.T))


def solved(variant: str, scene: Scene | None = None, way: Any = dda.DEFAULT) -> tuple[Trial, Run]:
    trial = CASE.declare(variant, CASE.defaults(variant))
    ask = trial.study.ask(trial.study.rungs[Level.DEFAULT][1])
    run = dda.solve(dataclasses.replace(ask, scene=scene or ask.scene), way)
    assert run.status is Status.RAN, run.reason
    return trial, run


def verdicts(trial: Trial, run: Run, method: Method = Method.PENALTY) -> set[str]:
    rung = trial.study.rungs[Level.DEFAULT][1]
    judged = [q for q in trial.quantities if isinstance(q.judge, Exact)]
    return {measured(run, q, method, rung)[0].verdict.value for q in judged}


VARIANTS = [variant.name for variant in CASE.variants]


@pytest.mark.parametrize("variant", VARIANTS)
def test_the_engine_answers_and_a_block_a_tenth_stiffer_does_not(variant: str) -> None:
    trial, run = solved(variant)
    assert verdicts(trial, run) == {"pass"}
    scene = trial.study.scene
    p = CASE.defaults(variant)
    stiff = tuple(
        dataclasses.replace(body, elastic=Elastic(1.1 * p["E"], p["nu"]))
        if isinstance(body, Block) else body
        for body in scene.bodies
    )  # fmt: skip
    assert "fail" in verdicts(*solved(variant, dataclasses.replace(scene, bodies=stiff)))


@pytest.mark.parametrize(
    ("variant", "name", "due"),
    [("pressed", "sunk-continuum", 0.75), ("ringing", "frequency-continuum", closed.STIFFER)],
)
def test_what_a_continuum_does_otherwise_is_shown(variant: str, name: str, due: float) -> None:
    trial, run = solved(variant)
    (shown,) = (q for q in trial.quantities if q.name == name)
    assert isinstance(shown, Scalar)
    assert shown.observe(run) == pytest.approx(due, rel=1e-3)


def test_without_inertia_that_turns_a_block_that_spins_does_not_strain() -> None:
    """As published. Where only friction lags, the block does strain, but is not judged."""
    trial, run = solved("spun", way=dda.PUBLISHED)
    series: Vector = run.values[trial.study.observables[0]]
    assert np.abs(series).max() < 1e-12
    assert verdicts(trial, run, Method.LAGGING) == {"shown only"}
    assert verdicts(trial, solved("spun", way=dda.LAGGED)[1]) == {"pass"}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"poisson": 0.5}, r"poisson = 0.5; it must lie between -1 and 0.5"),
        ({"young": 0.0}, r"young = 0.0 Pa; .*positive"),
        ({"sides": (1.0, 1.0, -1.0)}, r"s_z = -1.0 in SI units; .*positive"),
        ({"g": math.inf}, r"g = inf m/s2; it must be finite"),
    ],
)
def test_what_the_formulas_do_not_cover_is_refused(change: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        closed.standing(T, **{**LAW, "g": 9.81, **change})


def test_the_strain_of_a_spun_block_swings_in_its_modes_by_their_shares() -> None:
    shares, squares = closed.spun_modes(**LAW, spin=5.0)
    seen = closed.spinning(T, **LAW, spin=5.0)
    assert np.abs(seen).max() <= 2.0 * shares.sum(axis=1).max()
    swung = 1.0 - np.cos(np.outer(T, np.sqrt(squares)))
    signs_of_z = np.linalg.lstsq(swung, seen[:, 2], rcond=None)[0]
    np.testing.assert_allclose(np.abs(signs_of_z), shares[2], rtol=1e-9)
