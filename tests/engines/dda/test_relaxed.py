"""Claims about elastic blocks that are strained by their loads at t = 0: they are balanced."""

import dataclasses

import numpy as np
import pytest

from reference_solutions.blocks import elastic_block as exact
from vv.ask import Ask, Displacement, History, Knobs, Run, Strain
from vv.engines import dda
from vv.plan.project import find
from vv.scene import Block, Elastic, Scene, Term

CASE = find().load_case("elastic-block")
P = CASE.defaults("pressed")


def seen(relaxed: bool) -> Run:
    """The results for the block of `elastic-block:pressed` over 50 steps."""
    scene = CASE.declare("pressed", P).study.scene
    bodies = [
        dataclasses.replace(body, elastic=Elastic(P["E"], P["nu"], relaxed))
        if isinstance(body, Block)
        else body
        for body in scene.bodies
    ]
    whole = dataclasses.replace(scene, bodies=tuple(bodies))
    asked = (Strain(0), Displacement(0))
    return dda.solve(Ask(whole, History(5e-4, 1e-5), asked, Knobs(1e-5, 1e13)), dda.DEFAULT)


def test_a_relaxed_block_keeps_the_strain_of_its_weight_and_stays() -> None:
    run = seen(True)
    sides = (P["a"], P["b"], P["L"])
    due = exact.resting(sides=sides, rho=P["rho"], young=P["E"], poisson=P["nu"], g=P["g"])
    assert np.abs(run.values[Strain(0)] - due).max() < 1e-5 * abs(due[2])
    assert np.abs(run.values[Displacement(0)]).max() < 1e-5 * abs(due[2])


def test_a_block_that_is_not_relaxed_swings() -> None:
    strain = seen(False).values[Strain(0)][:, 2]
    assert strain[0] == 0.0
    assert np.ptp(strain) > 1e-7


@pytest.mark.parametrize("relaxed", [True, False])
def test_a_scene_says_whether_its_blocks_start_strained(relaxed: bool) -> None:
    scene: Scene = CASE.declare("pressed", P).study.scene
    bodies = [
        dataclasses.replace(b, elastic=Elastic(1e9, 0.2, relaxed)) if isinstance(b, Block) else b
        for b in scene.bodies
    ]
    found = dataclasses.replace(scene, bodies=tuple(bodies)).terms()
    assert (Term.STRAINED_START in found) == relaxed
