"""Claims about bonded spheres in the explicit DEM: the unit of four elements, and free clusters."""

from __future__ import annotations

import dataclasses
from typing import Any

import numba
import numpy as np
import pytest

from reference_solutions.bonds import close_packed_lattice, lattice_material, tetrahedral_unit
from tests.scenes.spheres.bonded_scenes import CORNERS, EDGES, KN, KS, D, M, elements, tied, unit
from vv.ask import Ask, Displacement, History, Knobs, Run, Status, Velocity
from vv.engines import dem
from vv.engines.dem.space.model import space
from vv.engines.dem.terms.bonds import Bonds as Springs
from vv.scene import Contact, Scene, Term, Vector, Wall, rotated, with_bodies_reversed

TYPEOF: Any = numba.typeof
HEIGHT = D * np.sqrt(2 / 3)
BASE = np.array([[1, 1, 1], [1, 1, 0], [1, 1, 0], [1, 1, 0]], bool)
SEEN = tuple(Displacement(i) for i in range(4))
DT = 1e-8
RATE = 2 * np.sqrt(KN / M)  # of the breathing mode [1/s]
OUT = CORNERS - CORNERS.mean(axis=0)
TURN = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]


def moved(scene: Scene, duration: float, dt: float = DT, outputs: int = 1) -> Run:
    run = dem.solve_default(Ask(scene, History(duration, duration / outputs), SEEN, Knobs(dt=dt)))
    assert run.status is Status.RAN, run.reason
    return run


def at_end(run: Run) -> Vector:
    return np.array([run.values[what][-1] for what in SEEN])


def widened(u: Vector) -> float:
    x = CORNERS + u
    return float(np.mean([np.linalg.norm(x[i] - x[j]) / D - 1 for i, j in EDGES[3:]]))


def test_bonds_share_a_kernel_whatever_loads_locks_drags_or_carries_their_ends() -> None:
    """A kernel takes seconds to compile, once for each combination of types of its arguments."""
    pulled = np.array([[0, 0, 1.0]] + [[0, 0, 0]] * 3)
    thrown = elements(velocity=OUT)
    carried = dataclasses.replace(elements(free=BASE), velocity=pulled)
    scenes = unit(thrown), unit(elements(load=pulled)), unit(thrown, eta=3.0), unit(carried)
    assert len({str(TYPEOF(tuple(space(scene).state))) for scene in scenes}) == 1


@pytest.mark.parametrize("strain", [1e-6, -1e-6])
@pytest.mark.parametrize("gamma", [0.0, 0.25, 0.5, 1.0])
def test_the_unit_comes_to_rest_in_its_balance(strain: float, gamma: float) -> None:
    E = lattice_material.youngs_modulus(KN, gamma * KN, D)
    fz = E * np.sqrt(3) / 2 * D * D * strain
    load = np.array([[0, 0, fz]] + [[0, 0, 0]] * 3)
    scene = unit(elements(free=BASE, load=load), tied(ks=gamma * KN), eta=6.0)
    u = at_end(moved(scene, 6e-5))
    state = tetrahedral_unit.equilibrium(u[0, 2] / HEIGHT, kn=KN, ks=gamma * KN, d=D)
    assert fz / state.fz == pytest.approx(1, abs=1e-7)
    assert widened(u) == pytest.approx(state.lateral, rel=1e-7, abs=1e-7 * abs(strain))


@pytest.mark.parametrize("strain", [5e-3, -5e-3])
def test_slow_strain_follows_the_equilibrium_path(strain: float) -> None:
    """A heavy top moves at constant velocity, in which effects of drag and inertia are linear."""
    off = []
    for time in (1e-4, 2e-4):
        velocity = np.array([[0, 0, strain * HEIGHT / time]] + [[0, 0, 0]] * 3)
        heavy = elements(free=BASE, velocity=velocity)
        heavy = dataclasses.replace(heavy, mass=M * np.array([1e9, 1, 1, 1]))
        u = at_end(moved(unit(heavy, eta=3.0), time))
        state = tetrahedral_unit.equilibrium(u[0, 2] / HEIGHT, kn=KN, ks=KS, d=D)
        assert u[0, 2] / HEIGHT == pytest.approx(strain, rel=1e-3)
        off.append(widened(u) / state.lateral - 1)
    assert 2 * off[1] - off[0] == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("ks", [0.0, KS])
def test_breathing_is_exact_but_for_the_phase_of_the_leapfrog(ks: float) -> None:
    """L = d(1 + A sin wt) at any amplitude; the leapfrog oscillates at 2 asin(w dt/2)/dt."""
    A = 0.02
    run = moved(unit(elements(velocity=A * RATE * OUT), tied(ks=ks)), 2e-6, outputs=100)
    shown = 2 * np.arcsin(RATE * DT / 2) / DT
    size = A * RATE / (np.sin(shown * DT) / DT)
    swing = np.einsum("k,ij->ikj", size * np.sin(shown * run.times), OUT)
    told = np.array([run.values[what] for what in SEEN])
    assert np.abs(told - swing).max() < 1e-11 * np.abs(swing).max()
    assert run.ledger is not None
    assert run.ledger.unaccounted < 1e-13 * run.ledger.peak


def thrown() -> Scene:
    return unit(elements(velocity=np.random.default_rng(1).normal(size=(4, 3)) * 20.0))


def test_a_free_cluster_keeps_its_momentum() -> None:
    seen = tuple(Velocity(i) for i in range(4))
    run = dem.solve_default(Ask(thrown(), History(1e-5, 1e-6), seen, Knobs(dt=DT)))
    total = np.sum([run.values[what] for what in seen], axis=0)
    assert np.abs(total - total[0]).max() < 1e-12 * np.abs(run.values[seen[0]]).max()


def test_what_energy_it_loses_is_of_second_order() -> None:
    """There is no bound, since the shear spring turns. Half the step leaves a quarter of it."""
    ledgers = [moved(thrown(), 4e-6, dt, 20).ledger for dt in (2e-8, 1e-8, 5e-9)]
    off = [ledger.unaccounted / ledger.peak for ledger in ledgers if ledger]
    assert off[0] < 1e-3
    assert off[1] / off[2] == pytest.approx(4, rel=0.2)


def test_the_answer_is_of_second_order() -> None:
    finest, *others = [at_end(moved(thrown(), 4e-6, dt)) for dt in (6.25e-10, 1e-8, 5e-9)]
    off = [float(np.abs(u - finest).max()) for u in others]
    assert off[0] / off[1] == pytest.approx(4, rel=0.1)


def test_a_turned_scene_has_the_answer_turned() -> None:
    """Its locks are then oblique to the frame."""
    load = np.array([[0, 3.0, 5.0]] + [[0, 0, 0]] * 3)
    scene = unit(elements(free=BASE, load=load), eta=1.0, gravity=np.array([1e4, 0.0, -1e5]))
    straight, oblique = (at_end(moved(s, 2e-6)) for s in (scene, rotated(scene, TURN)))
    assert np.abs(straight @ TURN.T - oblique).max() < 1e-11 * np.abs(straight).max()


def test_the_order_of_the_elements_does_not_matter() -> None:
    scene = thrown()
    one, two = (at_end(moved(s, 2e-6)) for s in (scene, with_bodies_reversed(scene)))
    assert np.abs(one - two[::-1]).max() < 1e-11 * np.abs(one).max()


def test_a_rigid_turn_charges_the_shear_springs() -> None:
    """An artefact of elements without rotations: 2 ks d^2 angle^2 in a unit."""
    angle, time = 1e-4, 1e-6
    velocity = np.cross([0.0, 0.0, angle / time], OUT)
    heavy = dataclasses.replace(elements(velocity=velocity), mass=np.full(4, 1e12 * M))
    run = moved(unit(heavy), time)
    assert run.ledger is not None
    assert run.ledger.terms["shear elastic"] == pytest.approx(2 * KS * (D * angle) ** 2, rel=1e-6)


def test_a_bond_that_turns_far_gathers_length_times_angle() -> None:
    """Two heavy spheres pass each other on straight lines at a distance d."""
    tilt, time = 1.0, 1e-6
    past = np.array([[0, 0, 0], [0, D * np.tan(tilt) / time, 0]])
    pair = elements(np.array([[0, 0, 0], [D, 0, 0]]), velocity=past)
    pair = dataclasses.replace(pair, mass=np.full(2, 1e12 * M))
    scene = Scene((pair,), Contact(KN), bonds=tied(pairs=EDGES[:1]))
    energy = 0.5 * KS * (D * np.arcsinh(np.tan(tilt))) ** 2
    off = []
    for steps in (50, 100):
        run = dem.solve_default(Ask(scene, History(time, time), SEEN[:2], Knobs(dt=time / steps)))
        assert run.ledger is not None
        off.append(run.ledger.terms["shear elastic"] / energy - 1)
    assert abs(off[0]) < 5e-4
    assert off[0] / off[1] == pytest.approx(4, rel=0.05)


def test_two_spheres_on_a_bond_swing_at_their_rate() -> None:
    pair = elements(CORNERS[:2], velocity=0.1 * np.array([CORNERS[0] - CORNERS[1], [0, 0, 0]]) / D)
    bond = tied(pairs=EDGES[:1], ks=0.0, length=0.999 * D)
    seen = (Displacement(0), Displacement(1))
    ask = Ask(Scene((pair,), Contact(KN), bonds=bond), History(2e-6, 2e-8), seen, Knobs(dt=1e-9))
    run = dem.solve_default(ask)
    w, n = np.sqrt(2 * KN / M), (CORNERS[0] - CORNERS[1]) / D
    apart = (run.values[seen[0]] - run.values[seen[1]]) @ n
    swing = -1e-3 * D * (1 - np.cos(w * run.times)) + 0.1 / w * np.sin(w * run.times)
    assert np.abs(apart - swing).max() < 2e-4 * np.abs(swing).max()


def test_the_model_holds_what_the_scene_has() -> None:
    ask = Ask(unit(), History(1e-6, 1e-6), SEEN, Knobs(dt=DT))
    with_shear = dem.prepare(ask, dem.CENTRED)
    bare = dataclasses.replace(ask, scene=unit(bonds=tied(ks=0.0)))
    without = dem.prepare(bare, dem.CENTRED)
    untouched = {Term.FRICTION}  # nothing is there to touch
    assert with_shear.model.terms == {Term.SPHERE, Term.BOND, Term.BOND_SHEAR} | untouched
    assert without.model.terms == {Term.SPHERE, Term.BOND} | untouched
    assert without.system.state.term(Springs).arrays.ks is None  # type: ignore[union-attr]


def test_the_largest_stable_step_is_the_largest() -> None:
    scene = thrown()
    limit = dem.critical_step(scene, dem.CENTRED)
    assert moved(scene, 2e-4, 0.99 * limit, 100).status is Status.RAN
    ask = Ask(scene, History(2e-4, 2e-6), SEEN, Knobs(dt=1.01 * limit))
    assert dem.solve_default(ask).status is Status.DIVERGED


def test_a_bonded_unit_stands_on_a_wall() -> None:
    """It stands by its weight, which three elements share."""
    floor = Wall(np.array([0, 0, -D / 2]), np.array([0.0, 0.0, 1.0]))
    bonds, weight = tied(pairs=EDGES + 1), 4 * M * 1e5
    scene = Scene((floor, elements()), Contact(KN, KS, 0.3), 6.0, [0, 0, -1e5], bonds=bonds)  # type: ignore[arg-type]
    run = dem.solve_default(Ask(scene, History(1e-4, 1e-4), (Displacement(2),), Knobs(dt=DT)))
    assert run.values[Displacement(2)][-1, 2] == pytest.approx(-weight / 3 / KN, rel=1e-6)


@pytest.mark.parametrize("n", [82, 255])
def test_blocks_come_to_rest_as_the_static_lattice_does(n: int) -> None:
    """The forces of its platens are those of the linear system, at a strain of 1e-6."""
    block = close_packed_lattice.lattice(*close_packed_lattice.SIZES[n], D)
    answer = close_packed_lattice.static(block, KN, KS)
    u = 1e-6 * answer.u
    load = np.zeros_like(u)
    top, base = block.at(2, 1), block.at(2, 0)
    load[top, 2] = _pulled(block, u)[top, 2]
    free = np.ones_like(u, bool)
    free[base, 2] = False
    bonds = tied(pairs=block.bonds)
    scene = Scene((elements(block.position, free=free, load=load),), Contact(KN), 6.0, bonds=bonds)
    system = space(scene)
    path, energy, watched = system.outputs(2, tuple(range(n)))
    rows = system.kernel()(path, energy, watched, 4000, 5e-8, *system.state, 0.5, 0.5)
    assert rows == 2
    rest = path[1, :, :3] - path[1, :, :3].mean(axis=0) + u.mean(axis=0)
    assert np.abs(rest - u)[:, :2].max() < 2e-6 * np.abs(u).max()
    assert path[1, top, 2].mean() == pytest.approx(1e-6 * block.height, rel=2e-6)


def _pulled(block: close_packed_lattice.Lattice, u: Vector) -> Vector:
    """The forces (n, 3) that hold a block at small displacements."""
    i, j = block.bonds.T
    normal = (block.position[j] - block.position[i]) / D
    moved = u[j] - u[i]
    along = np.einsum("bk,bk->b", normal, moved)[:, None] * normal
    force = KN * along + KS * (moved - along)
    held = np.zeros_like(u)
    np.add.at(held, i, -force)
    np.add.at(held, j, force)
    return held
