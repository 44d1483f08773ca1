"""Claims about the blocks that are pulled or pressed to failure."""

import numpy as np
import pytest

from cases.bonds.close_packed_strength import CASE
from cases.bonds.parts._specimens import block_of, on_springs, on_tops, specimen, yielding
from vv.ask import Ask, History, Knobs, Method, Reaction
from vv.case import Exact, Ladder, Level, Scalar
from vv.engines import dem
from vv.scene import Scene

PRESSED = dict(CASE.defaults("pressed-82"))
BLOCK = block_of(82, PRESSED["d"])
STIFF = 20.0 * PRESSED["kn"]
SHORT = History(2e-5, 1e-5)  # s: up to strains of 1.6e-4 and 3.2e-4, long before a bond opens


def moduli(scene: Scene, tops: list[list[Reaction]]) -> list[float]:
    """The moduli of the blocks at both rates [Pa], from increments of the platen forces."""
    run = dem.solve_default(Ask(scene, SHORT, sum(map(tuple, tops), ()), Knobs(dt=1e-8)))
    force = [sum(np.diff(run.values[what][-2:, 2])[0] for what in top) for top in tops]
    strain = np.array([2.0, 1.0]) * PRESSED["rate"] * SHORT.interval
    return [float(one) for one in np.array(force) / BLOCK.area / strain]


def test_platens_that_yield_add_the_length_of_their_springs() -> None:
    """They add less if the ends stay plane, which elements with few bonds do not."""
    rigid = moduli(specimen(PRESSED, BLOCK), on_tops(BLOCK))
    sunk = 2.0 * BLOCK.area / (BLOCK.at(2, 1).sum() * STIFF * BLOCK.height)
    p = {**PRESSED, "platen": STIFF}
    for one, other in zip(rigid, moduli(yielding(p, BLOCK), on_springs(BLOCK)), strict=True):
        plane = one / (1.0 + one * sunk)
        assert 0.99 * plane < other < plane < 0.97 * one


def test_errors_of_strengths_are_parts_of_the_exact_ones() -> None:
    quantities = CASE.declare("pressed-82", PRESSED).quantities
    exact = [q for q in quantities if isinstance(q, Scalar) and q.reference]
    assert len(exact) >= 1
    assert all(one.scale == one.reference for one in exact)


def test_springs_to_platens_stay_upright() -> None:
    """They stay upright for any displacement of a face of the block, here 1 % of its height."""
    scene = yielding(PRESSED, BLOCK)
    assert scene.bonds is not None
    springs = scene.bonds.pairs[np.isinf(scene.bonds.tension)]
    apart = np.diff(scene.spheres.position[springs], axis=1)[:, 0]
    assert np.abs(apart[:, :2]).max() == 0.0
    assert 0.01 * BLOCK.height / np.abs(apart[:, 2]).min() < 1e-4
    assert scene.spheres.free[springs[:, 0]].all()
    assert not scene.spheres.free[springs[:, 1]].any()


PULLED = CASE.defaults("pulled-82")


@pytest.mark.parametrize(
    "given", [{"xb": 0.1}, {"rate": 16.0}, {"rate": 100.0}, {"m": 0.1}, {"ks": 8.0}], ids=str
)
def test_strength_and_balance_are_within_their_bounds_far_from_the_usual_parameters(
    given: dict[str, float],
) -> None:
    trial = CASE.declare("pulled-82", {n: v * given.get(n, 1.0) for n, v in PULLED.items()})
    assert isinstance(trial.study, Ladder)
    knobs = trial.study.rungs[Level.QUICK][0]
    run = dem.solve_default(trial.study.ask(knobs))
    for one in (q for q in trial.quantities if isinstance(q.judge, Exact)):
        assert isinstance(one, Scalar)
        assert isinstance(one.judge, Exact)
        assert isinstance(one.scale, float)
        assert isinstance(one.reference, float)
        error = abs(one.observe(run) - one.reference) / one.scale
        assert error < one.judge.tolerance(Method.SECOND_ORDER).at(knobs), one.name


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ({"xb": 8.0}, r"xb = 1.363e-06 m: bonds slide before the first one opens"),
        ({"fs0": 0.1}, r"that must be below fs0 = 1.845 N"),
        ({"mu_p": 8.0}, r"bonds slide before the first one opens"),
        ({"rate": -1.0}, r"rate = -0.6 1/s; it must be positive where units are pulled"),
    ],
)
def test_what_does_not_open_first_is_refused(given: dict[str, float], why: str) -> None:
    with pytest.raises(ValueError, match=why):
        CASE.declare("pulled-82", {n: v * given.get(n, 1.0) for n, v in PULLED.items()})
