"""Claims about what a run of `dem` reports beside its motion: laws, by hand, and divergence."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from tests.scenes.small_scenes import ball
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines.dem.leapfrog import CENTRED
from vv.engines.dem.solve import COULOMB, DEPTH, SOFT, PreparedSpheres, _audits, prepare
from vv.scene import Contact, Hertz, Scene, Wall

UP, ALONG = np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])
LAW = Contact(800.0, 200.0, 0.5)
FRICTION = "Coulomb: friction beyond mu N [N]"


def pressed(law: Contact = LAW) -> Scene:
    """A ball of 2 m that is 1 mm deep in a floor."""
    body = ball(1.999 * UP, 0.1 * ALONG, radius=np.array([2.0]))
    return Scene((Wall(np.zeros(3), UP), body), law)


def prepared() -> PreparedSpheres:
    goal = History(0.1, 0.02)
    return prepare(Ask(pressed(), goal, (Displacement(1),), Knobs(1e-3)), CENTRED)


def test_overlap_and_friction_are_told_by_the_energies_of_springs() -> None:
    """4 J in 800 N/m is 0.1 m and 80 N; 0.64 J in 200 N/m is 16 N, where nothing presses."""
    terms = np.zeros((3, 4))
    terms[:, 1], terms[:, 2] = [4.0, 1.0, 0.0], [4.0, 1.0, 0.64]
    found = dict(_audits(pressed(), terms))
    assert found[DEPTH] == pytest.approx((0.1, SOFT * 2.0))
    assert found[FRICTION] == pytest.approx((16.0, COULOMB * 80.0))
    within = terms * [1.0, 1.0, 0.0, 1.0]
    assert dict(_audits(pressed(), within))[FRICTION][0] == 0.0


@pytest.mark.parametrize(
    ("scene", "laws"),
    [
        (pressed(), {DEPTH, FRICTION}),
        (pressed(dataclasses.replace(LAW, eta_n=1.0)), {DEPTH}),
        (pressed(Contact(0.0, mu=0.5, hertz=Hertz(1e6, 1e6))), set()),
        (Scene((*pressed().bodies, Wall(9.0 * UP, -UP)), LAW), {DEPTH}),
    ],
)
def test_a_law_is_checked_where_energies_tell_of_it(scene: Scene, laws: set[str]) -> None:
    assert {name for name, _ in _audits(scene, np.zeros((2, 4)))} == laws


def test_a_divergence_is_told_by_its_step_its_time_and_its_energies() -> None:
    program = prepared()
    energy = np.zeros_like(program.arguments[1])
    energy[2, :3] = 1.0, 2.0, 4.0
    why = program._why(energy, 2)
    assert why.startswith("by step 40, t = 0.04 s: energy 7 J, kinetic and elastic, from 0.005 J")
    energy[2, 1] = np.nan
    assert program._why(energy, 2) == "by step 40, t = 0.04 s: the state is not finite"
    assert program.run(2).steps == 40
