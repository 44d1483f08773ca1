"""Claims about the blocks that are pulled or pressed to failure."""

import numpy as np

from cases.bonds.close_packed_strength import CASE
from cases.bonds.parts._specimens import block_of, on_springs, on_tops, specimen, yielding
from vv.ask import Ask, History, Knobs, Reaction
from vv.case import Scalar
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
