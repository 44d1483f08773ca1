"""Claims about how DEM makes a run from the output of a kernel: models and ledgers, by hand."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from tests.engines.dem.test_reports import falling, in_a_plane
from vv.ask import Ask, Displacement, History, Knobs, Reaction
from vv.engines import dem
from vv.engines.dem.line.model import Line
from vv.engines.dem.pressed.model import Pressed
from vv.engines.dem.solve import DEPTH, EPS, GAINED, ROUNDINGS, PreparedSpheres
from vv.engines.dem.space.model import Space
from vv.scene import Bonds, Contact, Form, Harmonic, Scene, Spheres, Wall

GOAL, DT = History(0.1, 0.02), 1e-3


def prepared(scene: Scene, leapfrog: Any = dem.CENTRED, **changes: Any) -> PreparedSpheres:
    body = len(scene.bodies) - 1
    asked = Ask(scene, GOAL, (Displacement(body),), Knobs(DT))
    return dem.prepare(dataclasses.replace(asked, **changes), leapfrog)


def bonded() -> Scene:
    """Two spheres with a bond, at rest."""
    place = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    ones = np.ones(2)
    spheres = Spheres(place, 0.0 * place, 0.3 * ones, 4.0 * ones, np.ones((2, 3), bool))
    tie = Bonds(np.array([[0, 1]]), np.array([1.0]), np.array([900.0]), np.zeros(1))
    return Scene((spheres,), Contact(900.0), bonds=tie)


def test_a_scene_is_given_the_smallest_model_that_has_what_is_asked() -> None:
    assert isinstance(prepared(falling()).system, Line)
    assert isinstance(prepared(in_a_plane()).system, Pressed)
    for changes in ({"energies": (Form.DRAG,)}, {"observables": (Reaction(1),)}):
        for scene in (falling(), in_a_plane()):
            assert isinstance(prepared(scene, **changes).system, Space)


@pytest.mark.parametrize("leapfrog", [dem.CENTRED, dem.LAGGED])
def test_a_ledger_tells_what_is_unaccounted_and_allows_what_the_start_and_rounding_cause(
    leapfrog: Any,
) -> None:
    """Kinetic and elastic energy at the start are 6 J; the forms then add up to 6.5 and 5 J.

    Rounding of larger energies is more than what the start causes.
    """
    program = prepared(falling(), leapfrog)
    path, energy = (np.zeros_like(array) for array in program.arguments[:2])
    energy[:, 0] = 6.0
    energy[2, :5] = 4.0, 1.0, 0.5, 0.25, 0.75
    energy[3, :5] = 2.0, 1.0, 0.5, 0.5, 1.0
    energy[-1, :2], energy[-1, 5] = [1.0, 5.0], 0.125
    told = program._ledger(path, energy)
    assert told.peak == 6.0
    assert told.unaccounted == 1.0
    assert told.terms[Form.KINETIC.value] == 1.0
    start = program.system.bound(energy, leapfrog, DT)
    assert start is not None
    rounded = (ROUNDINGS * 6.0 + 6.0) * EPS * 101
    assert told.bound == pytest.approx(start + rounded, rel=1e-14)
    large = program._ledger(path, 1e12 * energy * [1, 1, 1, 1, 1, 0])
    start = program.system.bound(0.0 * energy, leapfrog, DT)
    assert start is not None
    assert large.bound == pytest.approx(start + 1e12 * rounded, rel=1e-9)
    assert 1e12 * rounded > start
    energy[-1, 5] = 1e3
    assert program._ledger(path, energy).bound == told.peak
    energy[3, 1] = 30.0
    assert program._ledger(path, energy).peak == 32.5


def test_where_few_spheres_move_the_depth_is_that_of_one_contact_with_all_energy() -> None:
    program = prepared(in_a_plane())
    path, energy = (np.zeros_like(array) for array in program.arguments[:2])
    energy[1, 1] = 40.0
    seen, allowed = program._ledger(path, energy).audits[DEPTH]
    assert seen == pytest.approx(np.sqrt(2.0 * 40.0 / 800.0))
    assert seen > allowed


@pytest.mark.parametrize("fixed", [True, False])
def test_the_depth_of_several_contacts_is_the_actual_one_if_walls_are_fixed(fixed: bool) -> None:
    """Two spheres overlap the wall by 0.06 m each, one contact with all energy by 0.085 m."""
    place = np.array([[0.0, 0.0, 1.0], [5.0, 0.0, 1.0]])
    ones = np.ones(2)
    spheres = Spheres(place, 0.0 * place, 0.8 * ones, 4.0 * ones, np.ones((2, 3), bool))
    along = Harmonic(np.array([0.1, 0.0, 0.0]), np.full(3, 1.0), np.zeros(3))
    floor = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]), None if fixed else along)
    scene = Scene((spheres, floor), Contact(900.0))
    program = prepared(scene, observables=(Displacement(0), Displacement(1)))
    assert isinstance(program.system, Space)
    path, energy = (np.zeros_like(array) for array in program.arguments[:2])
    path[1, :, 2] = -0.26
    energy[1, 1] = 900.0 * 0.06**2
    seen, allowed = program._ledger(path, energy).audits[DEPTH]
    assert seen == pytest.approx(0.06 if fixed else 0.06 * np.sqrt(2.0))
    assert allowed == pytest.approx(0.08)


@pytest.mark.parametrize(("leapfrog", "order"), [(dem.CENTRED, 2), (dem.LAGGED, 1)])
def test_bonds_may_create_energy_as_the_square_of_the_step_or_as_the_step(
    leapfrog: Any, order: int
) -> None:
    """Relative to the largest stable step, and to the peak; what is lost does not count."""
    program = prepared(bonded(), leapfrog, observables=(Displacement(0),))
    path, energy = (np.zeros_like(array) for array in program.arguments[:2])
    energy[2, :5] = 4.0, 1.0, 0.5, 0.25, 0.75
    energy[3, 0] = 3.0
    seen, allowed = program._ledger(path, energy).audits[GAINED]
    assert seen == 6.5
    assert allowed == pytest.approx(5.5 * (DT / program.limit) ** order)
    energy[:, 0] = -1.0
    energy[:, 1:] = 0.0
    assert program._ledger(path, energy).audits[GAINED][0] == 0.0


@pytest.mark.parametrize("rows", [6, 3])
def test_a_run_counts_its_steps_to_its_last_output_or_to_where_it_ended(rows: int) -> None:
    run = _run(prepared(falling()), rows)
    assert run.steps == (100 if rows == 6 else 60)
    assert len(run.times) == rows
    assert (run.ledger is None) == (rows < 6)


def _run(program: PreparedSpheres, rows: int) -> Any:
    path, energy = program.arguments[:2]
    path[:] = 0.0
    energy[:] = 0.0
    return program.run(rows)


def test_forms_that_a_scene_lacks_are_zero() -> None:
    program = prepared(bonded(), observables=(Displacement(0),), energies=tuple(Form))
    path, energy = program.arguments[:2]
    energy[:] = np.arange(energy.size).reshape(energy.shape)
    told = program._energies(path, energy)
    assert told[Form.KINETIC] == pytest.approx(energy[:, 0])
    assert told[Form.DRAG] == pytest.approx(energy[:, 4])
    assert told[Form.LOAD] == pytest.approx(-energy[:, 6])
    assert not told[Form.SHAKING].any()
    assert len(told[Form.SHAKING]) == len(energy)
