"""Claims about terms of the general model: forces, powers and works of one step, by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.dem.contact.dashpots import FORCE
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.ledger import column
from vv.engines.dem.space.placed import placed
from vv.engines.dem.terms import carried, dashpots, dead_loads, drag, fluid, moving_walls, shaking
from vv.engines.kernels.drive import drive, drives
from vv.scene import Contact, Fluid, Form, Harmonic, Scene, Spheres, Vector, Wall

DT, ETA = 0.02, 7.0
MASS = np.array([2.0, 0.7, 5.0])
NONE: Any = None
LOCK = np.array([0.6, 0.0, 0.8])
HOLD = np.array([np.eye(3), np.eye(3) - np.outer(LOCK, LOCK), np.eye(3)])
WAVE = Harmonic(np.array([0.3, 0.0, -2.0]), np.array([2.0, 9.0, 0.7]), np.array([0.4, 9.0, 1.3]))


def motion(walls: int = 0) -> Motion:
    rows = np.random.default_rng(2).normal(size=(4, 4 + walls, 3))
    return Motion(rows[0], rows[1], rows[2], rows[3], None, None, None)


def bodies(hold: Vector = np.zeros((0, 3, 3))) -> Bodies:  # noqa: B008 - never changed
    start = np.random.default_rng(5).normal(size=(3, 3))
    return Bodies(start, None, MASS, np.zeros(0), hold, hold, 0)


def sines(t: float) -> Vector:
    return np.asarray(WAVE.amplitude * np.sin(2.0 * np.pi * WAVE.frequency * t + WAVE.phase))


def test_weights_and_loads_act_and_work_apart() -> None:
    weight, load = np.random.default_rng(1).normal(size=(2, 3, 3))
    term, told, energy = (
        dead_loads.DeadLoads(weight, load, weight + load),
        motion(),
        np.zeros((2, 7)),
    )
    pushed = [plain(dead_loads.field)(term, (1.0, 2.0, 3.0), 9.0, i) for i in range(3)]
    assert pushed == pytest.approx(weight + load + [1.0, 2.0, 3.0])
    works = [float((force * told.u[:3]).sum()) for force in (weight, load)]
    assert plain(dead_loads.book)(term, NONE, told, energy, 1) == pytest.approx((sum(works),))
    seen = energy[1, column(Form.GRAVITY)], energy[1, column(Form.LOAD)]
    assert seen == pytest.approx(works)
    none = dead_loads.DeadLoads(weight[:0], load[:0], load[:0])
    assert plain(dead_loads.field)(none, (1.0, 2.0, 3.0), 9.0, 0) == (1.0, 2.0, 3.0)


def test_shaking_pushes_in_proportion_to_mass_and_works_by_the_mean_of_two_steps() -> None:
    term = shaking.Shaking(drive(WAVE), np.full((1, 3), 9.0), np.full(1, 9.0))
    told, energy = motion(), np.zeros((2, 12))
    plain(shaking.begin)(term, NONE, told)
    assert term.now[0] == pytest.approx(sines(0.0))
    assert term.work[0] == 0.0
    plain(shaking.move)(term, bodies(), told, DT, DT)
    plain(shaking.move)(term, bodies(), told, 2 * DT, DT)
    assert plain(shaking.field)(term, (1.0, 2.0, 3.0), 5.0, 0) == pytest.approx(
        [1.0, 2.0, 3.0] + 5.0 * sines(2 * DT)
    )
    momentum = MASS @ told.v[:3]
    due = 0.5 * DT * (sines(0.0) + 2.0 * sines(DT) + sines(2 * DT)) @ momentum
    assert plain(shaking.book)(term, NONE, told, energy, 1) == pytest.approx((due,))
    assert energy[1, column(Form.SHAKING)] == pytest.approx(due)
    assert np.count_nonzero(energy) == 1


def test_walls_move_by_their_sines_at_mean_velocities_as_if_they_had_moved_before() -> None:
    """Rows 4 and 5 are walls, of which the second rests."""
    term, told = moving_walls.MovingWalls(*drives((WAVE, None))), motion(2)
    told.u[4:], told.v[4:], told.before[4:] = 0.0, 0.0, 0.0
    rest = [array[:4].copy() for array in told[:3]]
    plain(moving_walls.start)(term, bodies(), told, DT)

    def mean(t: float) -> Vector:
        return np.asarray((sines(t) - sines(t - DT)) / DT)

    assert told.v[4] == pytest.approx(mean(0.0))
    assert not told.u[4:].any()
    for n in (1, 2):
        plain(moving_walls.move)(term, bodies(), told, n * DT, DT)
        assert told.u[4] == pytest.approx(sines(n * DT) - sines(0.0))
        assert told.v[4] == pytest.approx(mean(n * DT))
        assert told.before[4] == pytest.approx(mean((n - 1) * DT))
    assert not any(array[5].any() for array in told[:3])
    assert all((a == b[:4]).all() for a, b in zip(rest, told[:3], strict=True))


def test_what_is_carried_takes_the_work_against_all_forces_and_the_drag_on_it() -> None:
    steady = np.random.default_rng(3).normal(size=(3, 3))
    term, told, energy = carried.Carried(steady, ETA, np.full(2, 9.0)), motion(), np.zeros((2, 12))
    plain(carried.begin)(term, NONE, told)
    plain(carried.after)(term, NONE, told, 0.0)
    first = ETA * (steady**2).sum() - (steady * told.push[:3]).sum()
    told.push[:] *= 0.3
    plain(carried.after)(term, NONE, told, DT)
    second = ETA * (steady**2).sum() - (steady * told.push[:3]).sum()
    due = 0.5 * DT * (first + second)
    assert plain(carried.book)(term, NONE, told, energy, 1) == pytest.approx((due,))
    assert energy[1, column(Form.CARRYING)] == pytest.approx(due)


@pytest.mark.parametrize("lag", [0.5, 1.0, 0.2])
@pytest.mark.parametrize("hold", [HOLD, HOLD[:0]])
def test_the_drag_of_a_fluid_is_that_at_the_mean_of_the_velocities_it_leads_to(
    hold: Vector, lag: float
) -> None:
    """Schiller and Naumann: eta (1 + 0.15 Re^0.687) times the velocity."""
    eta, reynolds = np.array([3.0, 1.0, 9.0]), np.array([20.0, 300.0, 0.0])
    term, some, told = fluid.FluidDrag(eta, reynolds, np.zeros((3, 3))), bodies(hold), motion()
    told.push[:] *= 40.0
    push = told.push.copy()
    if len(hold):
        told.v[1] = HOLD[1] @ told.v[1]
    behind, ahead = plain(fluid.viscous)(term, some, told, DT, NONE, NONE, None, lag)
    force, lost = told.push[:3] - push[:3], np.zeros(2)
    for i in range(3):
        free = np.eye(3) if not len(hold) else hold[i]
        new = told.v[i] + DT / MASS[i] * free @ told.push[i]
        mean = lag * told.v[i] + (1.0 - lag) * new
        drags = eta[i] * (1.0 + 0.15 * (reynolds[i] * np.linalg.norm(mean)) ** 0.687)
        assert force[i] == pytest.approx(-drags * mean)
        lost -= [force[i] @ told.v[i], force[i] @ new]
    assert (behind, ahead) == pytest.approx(tuple(lost))
    assert (told.push[3] == push[3]).all()
    plain(fluid.withdraw)(term, some, told, NONE, NONE)
    assert told.push == pytest.approx(push)
    plain(fluid.start)(term, some, told, DT)
    assert (told.v[:3] == some.velocity).all()


@pytest.mark.parametrize("size", [1e-6, 1e6])
def test_the_drag_of_a_fluid_is_as_accurate_at_any_speed_and_ends_its_rounds(
    size: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It has converged long before it may no longer go on."""
    names: Any = plain(fluid.viscous).__globals__
    original, rounds = names["resistance_at"], []

    def counted(*given: Any) -> Any:
        rounds.append(given)
        return original(*given)

    monkeypatch.setitem(names, "resistance_at", counted)
    term = fluid.FluidDrag(np.full(3, 3.0), np.full(3, 20.0 / size), np.zeros((3, 3)))
    told = motion()
    told.v[:] *= size
    told.push[:] *= 40.0 * size
    push = told.push.copy()
    plain(fluid.viscous)(term, bodies(), told, DT, NONE, NONE, None, 0.5)
    force = told.push[:3] - push[:3]
    mean = told.v[:3] + 0.5 * DT / MASS[:, None] * told.push[:3]
    reynolds = 20.0 / size * np.linalg.norm(mean, axis=1)
    due = -3.0 * (1.0 + 0.15 * reynolds**0.687)[:, None] * mean
    assert force == pytest.approx(due, rel=1e-12, abs=0.0)
    assert len(rounds) < 3 * fluid.ROUNDS - 9


def scene(**changes: Any) -> Scene:
    """Two unlike spheres above a wall."""
    spheres = Spheres(
        np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]]), np.zeros((2, 3)), np.array([0.04, 0.09]),
        np.array([0.3, 2.0]), np.ones((2, 3), bool), load=np.array([[1.0, 2.0, 3.0], [0, 0, 5.0]]),
    )  # fmt: skip
    given = {"contact": Contact(1e4), "gravity": np.array([0.0, 1.0, -9.0]), **changes}
    return Scene((Wall(np.zeros(3), np.array([0.0, 0.0, 1.0])), spheres), **given)


def test_a_fluid_resists_by_stokes_and_by_the_reynolds_number_of_a_diameter() -> None:
    """3 pi viscosity d, and density d/viscosity for each m/s."""
    term = fluid.build(placed(scene(fluid=Fluid(density=800.0, viscosity=0.2))))
    assert term is not None
    across = np.array([0.08, 0.18])
    assert term.eta == pytest.approx(3.0 * math.pi * 0.2 * across)
    assert term.reynolds == pytest.approx(800.0 * across / 0.2)
    assert fluid.build(placed(scene(fluid=None))) is None


def test_weights_are_masses_times_gravity() -> None:
    term = dead_loads.build(placed(scene()))
    assert term.weight == pytest.approx(np.outer([0.3, 2.0], [0.0, 1.0, -9.0]))
    load = np.array([[1.0, 2.0, 3.0], [0.0, 0.0, 5.0]])
    assert term.both == pytest.approx(term.weight + load)


@pytest.mark.parametrize(
    ("changes", "there"),
    [
        ({}, False),
        ({"eta": 2.0}, True),
        ({"contact": Contact(1e4, eta_n=3.0)}, True),
        ({"contact": Contact(1e4, 1e4, 0.3)}, True),
    ],
)
def test_a_drag_of_zero_is_kept_where_it_saves_a_kernel(changes: Any, there: bool) -> None:
    """That is beside dashpots, and where friction rubs spheres that cannot rotate."""
    found = drag.build(placed(scene(**changes)))
    assert (found is not None) == there
    if found is not None:
        assert found.eta == changes.get("eta", 0.0)


def viscous_walls() -> tuple[Any, Motion]:
    """Contacts of dashpots with their forces: a pair, a wall at rest, and two that move."""
    random = np.random.default_rng(7)
    ends = np.array([[0, 1], [3, 2], [4, 0], [5, 1]])
    kept = random.normal(size=(4, 7))
    moving = np.array([4, 5]), np.zeros((2, 3))
    term = dashpots.Dashpots(
        NONE, NONE, NONE, (ends, kept), None, random.normal(size=(6, 3)), moving,
        np.array([3.0, 4.0, 5.0, 6.0]),
    )  # fmt: skip
    return term, motion(2)


def test_moving_walls_work_on_dashpots_by_the_mean_of_two_steps() -> None:
    """Only rows behind the ground's count, by their velocities before and after the kick."""
    term, told = viscous_walls()
    ends, kept = term.contacts
    plain(dashpots.note_wall_powers)(term, term.moving, told.v, 3)
    force = kept[:, FORCE, None] * kept[:, :3]
    powers = [sum(force[k] @ v[ends[k, 0]] for k in (2, 3)) for v in (told.v, term.new)]
    assert term.done == pytest.approx([5.0, *powers, 6.0])
    plain(dashpots.after)(term, NONE, told, DT)
    work = 6.0 + 0.5 * DT * (5.0 + powers[0])
    assert term.done[3] == pytest.approx(work)
    energy = np.full((2, 12), 0.5)
    assert plain(dashpots.book)(term, NONE, told, energy, 1) == pytest.approx((work,))
    assert energy[1, column(Form.WALLS)] == pytest.approx(0.5 + work)
    assert plain(dashpots.book)(term, NONE, told, energy[:, :7], 1) == pytest.approx((work,))
    resting = term._replace(moving=None)
    plain(dashpots.note_wall_powers)(resting, None, told.v, 3)
    plain(dashpots.after)(resting, NONE, told, DT)
    assert term.done[3] == pytest.approx(work)


def test_walls_are_expected_to_go_on_as_in_the_last_two_steps() -> None:
    new, told = np.zeros((6, 3)), motion(2)
    plain(dashpots.extrapolate_walls)(new, told, 4)
    assert new[4:] == pytest.approx(2.0 * told.v[4:] - told.before[4:])
    assert not new[:4].any()
