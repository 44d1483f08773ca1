"""Claims about elastic blocks in DDA: law, unknowns, energy, and strains that rotate with them."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numba
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from adapters.dda import ADAPTER, FORMULATIONS
from tests.scenes.blocks.dda_scenes import ALL, DOWN, FLOOR, NONE, G, asked, box, slope
from tests.scenes.other_worlds import rescaled
from vv.ask import Ask, Displacement, History, Knobs, Run, Status, Strain, Velocity
from vv.codes import known_beforehand
from vv.engines import dem, rigid
from vv.engines.dda import DEFAULT, PUBLISHED, Formulation, prepare, solve
from vv.engines.dda.general.bodies import Bodies, Motion, rotate_strains
from vv.engines.dda.general.model import General
from vv.plan.project import find
from vv.scene import Block, Contact, Elastic, Scene, Term, Vector, rotated, rotation_about_z
from vv.standins.penalty_springs import as_spheres
from vv.standins.stand_in import why_no_spring_scene
from vv.standins.why_no_clump import why_no_clump

RHO, HALF, E, NU, KN = 2000.0, (0.3, 0.2, 0.5), 1e9, 0.2, 1e11
SEEN = (Displacement(1), Strain(1))
STATIC = Formulation(1e-12, 40, 12, dd=0.0)  # a step passes on no velocity


def soft(block: Block, young: float = E, poisson: float = NU) -> Block:
    return dataclasses.replace(block, elastic=Elastic(young, poisson))


def standing(**given: Any) -> Scene:
    return Scene((FLOOR, soft(box(HALF, RHO, **given))), Contact(math.inf), gravity=DOWN)


def solved(scene: Scene, way: Formulation, dt: float, duration: float) -> Run:
    seen = (Displacement(len(scene.walls)), Velocity(len(scene.walls)), Strain(len(scene.walls)))
    done = solve(Ask(scene, History(duration, duration / 20), seen, Knobs(dt, KN)), way)
    assert done.status is Status.RAN, done.reason
    return done


def strains(done: Run) -> Vector:
    return next(v for what, v in done.values.items() if isinstance(what, Strain))


def test_a_block_under_its_own_weight_shows_e_and_nu() -> None:
    """Its mean stress is rho g h/2, also if the whole scene is rotated obliquely."""
    turn = rotation_about_z(0.4) @ np.array([[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]])
    stress = RHO * G * HALF[2]
    for scene in (standing(), rotated(standing(), turn)):
        done = solved(scene, STATIC, 1e-3, 0.2)
        assert strains(done)[0] == pytest.approx(0.0, abs=1e-30)
        assert strains(done)[-1] == pytest.approx(stress / E * np.array([NU, NU, -1]), rel=2e-5)
        sunk = stress * HALF[2] / E  # from a start with compressed springs
        assert done.values[Displacement(1)][-1] @ scene.axes[2] == pytest.approx(-sunk, rel=2e-5)


def test_strain_does_not_know_the_units() -> None:
    length, time, mass = 1e3, 10.0, 1e-2
    seen, step = (Strain(1),), 1e-3
    ask = Ask(standing(free_spin=ALL), History(0.05, 0.01), seen, Knobs(step, KN))
    other = Ask(
        rescaled(ask.scene, length, time, mass),
        History(0.05 * time, 0.01 * time), seen, Knobs(step * time, KN * mass / time**2),
    )  # fmt: skip
    one, two = (solve(each, DEFAULT).values[Strain(1)] for each in (ask, other))
    assert two == pytest.approx(one, abs=1e-9 * np.abs(one).max())


@pytest.mark.shows("In all schemes of `dda` the strain of a block is uniform")
@pytest.mark.parametrize(
    ("free", "spin", "count"),
    [
        ((1, 1, 1), (1, 1, 1), 12),
        ((1, 1, 1), (0, 0, 0), 9),
        ((1, 0, 1), (0, 1, 0), 6),
        ((0, 0, 1), (0, 0, 1), 3),
        ((0, 0, 0), (0, 0, 1), 1),
    ],
)
def test_strains_are_unknowns_along_free_directions_of_elastic_blocks_alone(
    free: tuple[int, ...], spin: tuple[int, ...], count: int
) -> None:
    masks = {"free": np.array(free, bool), "free_spin": np.array(spin, bool)}
    scene = standing(**masks)
    rigid = dataclasses.replace(scene, bodies=(FLOOR, box(HALF, RHO, **masks)))
    both = dataclasses.replace(scene, bodies=(*scene.bodies, box(HALF, RHO, np.full(3, 9.0))))
    for one, unknowns, words in (
        (scene, count, "1 block that deforms" if sum(free) else "1 block"),
        (both, count + 3, "2 blocks, 1 of which deform" if sum(free) else "2 blocks"),
    ):
        model = prepare(asked(one, 1e-3, KN, 0.1), DEFAULT).model
        assert model.unknowns == one.unknowns() == unknowns
        assert words in model.note
        assert one.terms() <= model.terms
    assert rigid.unknowns() == sum(free) + sum(spin)
    assert "deform" not in prepare(asked(rigid, 1e-3, KN, 0.1), DEFAULT).model.note


def test_blocks_of_different_stiffness_each_have_their_own() -> None:
    """Of two blocks, the lower one carries half of its own weight and all of the upper one."""
    low, top = (box((0.5, 0.5, 0.25), RHO, np.array([0, 0, z])) for z in (0.25, 0.75))
    stack = (FLOOR, soft(low, 1e9, 0.0), soft(top, 3e9, 0.0))
    scene = Scene(stack, Contact(math.inf), gravity=DOWN)
    ask = Ask(scene, History(0.2, 0.1), (Strain(1), Strain(2)), Knobs(1e-3, KN))
    done = solve(ask, STATIC)
    weight = RHO * G * 0.5
    assert done.values[Strain(1)][-1, 2] == pytest.approx(-1.5 * weight / 1e9, rel=2e-5)
    assert done.values[Strain(2)][-1, 2] == pytest.approx(-0.5 * weight / 3e9, rel=2e-5)


@pytest.mark.parametrize("way", FORMULATIONS.values(), ids=FORMULATIONS)
@pytest.mark.parametrize("free_spin", [NONE, ALL], ids=["held", "turning"])
def test_energy_of_strains_is_accounted_for(way: Formulation, free_spin: Any) -> None:
    scene = slope(20, 15)
    body = soft(dataclasses.replace(scene.blocks[0], free_spin=free_spin), 1e8)
    done = solved(dataclasses.replace(scene, bodies=(scene.walls[0], body)), way, 1e-4, 0.1)
    ledger = done.ledger
    assert ledger is not None
    assert ledger.bound is not None
    assert ledger.unaccounted <= ledger.bound < 1e-6 * ledger.peak
    assert ledger.terms["strain elastic"] > 0.01 * ledger.peak
    assert all(seen <= allowed for seen, allowed in ledger.audits.values())


def test_a_stiff_block_moves_as_a_rigid_one() -> None:
    scene = slope(28, 20)
    stiff = dataclasses.replace(scene, bodies=(scene.walls[0], soft(scene.blocks[0], 1e16)))
    one, other = (solved(each, DEFAULT, 1e-3, 0.1) for each in (scene, stiff))
    path = one.values[Displacement(1)]
    assert other.values[Displacement(1)] == pytest.approx(path, abs=1e-6 * np.abs(path).max())
    assert not strains(one).any()


SPIN, ROD = 10.0, (0.5, 0.1, 0.2)
ALONG = RHO * SPIN**2 * np.array(ROD) ** 2 / 3 * [1, 1, 0]  # Pa: stress in a rod that spins about z


def spun(way: Formulation, turns: float) -> tuple[Vector, Vector, float]:
    """Strains and angular momentum of a free rod at the end.

    Strains (3,) along the scene's axes, strain of its shape (3, 3) in its own, and the part of its
    angular momentum that is conserved.
    """
    rod = soft(box(ROD, RHO, np.zeros(3), free_spin=ALL, spin=np.array([0, 0, SPIN])))
    duration = turns * 2 * math.pi / SPIN
    scene, goal = Scene((rod,), Contact(math.inf)), History(duration, duration)
    program = prepare(Ask(scene, goal, (Strain(0),), Knobs(duration / turns / 800, KN)), way)
    done = program.run(program.solve())
    end = [part for part in program.arguments if isinstance(part, Motion)][-1]
    whole = np.linalg.lstsq(rod.vertices, end.vertex, rcond=None)[0].T
    kept = (end.second[0, 0, 0] + end.second[0, 1, 1]) * end.velocity[5] / SPIN / rod.inertia[2, 2]
    return strains(done)[-1], 0.5 * (whole.T @ whole - np.eye(3)), kept


@pytest.mark.parametrize("turns", [1.0, 1.25])
def test_a_spinning_rod_keeps_its_stress_and_its_shape(turns: float) -> None:
    """Stress rho w^2 a^2/3 along each half length a, in the rod's axes, which rotate.

    Its principal axes lag by half a step, 0.004 rad.
    """
    due = (1 + NU) / E * ALONG - NU / E * ALONG.sum()
    seen, shape, kept = spun(DEFAULT, turns)
    assert shape == pytest.approx(np.diag(due), abs=5e-3 * due[0])
    assert seen == pytest.approx(due if turns == 1.0 else due[[1, 0, 2]], abs=1e-4 * due[0])
    assert kept == pytest.approx(1.0, abs=1e-10)


@pytest.mark.shows("`dda/published` does not rotate strains with a block")
def test_strains_that_stay_behind_shear_what_turns_and_published_says_so() -> None:
    _, shape, _ = spun(dataclasses.replace(DEFAULT, follow=0), 1.25)
    due = (1 + NU) / E * (ALONG[0] - ALONG[1])
    assert abs(shape[0, 1]) == pytest.approx(1.25 * 2 * math.pi * due, rel=0.02)
    rod = soft(box(ROD, RHO, np.zeros(3), free_spin=ALL))
    words = "strains that do not rotate"
    ask = Ask(Scene((rod,), Contact(math.inf)), History(1, 1), (), Knobs(1e-3, KN))
    assert words in prepare(ask, PUBLISHED).model.note
    assert words not in prepare(ask, DEFAULT).model.note


def _turned(motion: Motion, bodies: Bodies, i: int, d: Vector, terms: int) -> None:
    """A kernel of a function that only kernels can call."""
    rotate_strains(motion, bodies, i, d, terms)


turned: Any = numba.njit(
    _turned
)  # not cached on disk, where it would outlive the functions it calls


@pytest.mark.parametrize("axis", range(3))
def test_strain_turns_with_a_step_as_a_tensor_does(axis: int) -> None:
    turn = rotation_about_z(0.4) @ np.array([[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]])
    rod = soft(box(ROD, RHO, np.zeros(3), free_spin=ALL))
    system = General(Scene((rod,), Contact(math.inf), axes=turn), DEFAULT)
    bodies, motion = system.bodies(), system.motion()
    motion.strain[6:] = [1e-3, 3e-4, -2e-4, -5e-4, 7e-4, 2e-4]
    before = np.einsum("a,arc->rc", motion.strain[6:], bodies.slope[6:])
    d, spin = np.zeros(12), np.eye(3)[axis] * 0.1
    d[3:6] = turn @ spin
    turned(motion, bodies, 0, d, DEFAULT.follow)
    after = np.einsum("a,arc->rc", motion.strain[6:], bodies.slope[6:])
    by = Rotation.from_rotvec(spin).as_matrix()
    assert after == pytest.approx(by @ before @ by.T, abs=1e-17)


def test_what_would_turn_its_strains_into_locked_directions_is_refused() -> None:
    scene = standing(free=np.array([True, False, True]), free_spin=np.array([True, False, False]))
    words = "block 'box' deforms and can rotate about axis 0, but is free in only one direction"
    for scheme in ADAPTER.schemes:
        assert words in (ADAPTER.refuses(asked(scene, 1e-3, KN, 0.1), scheme.name) or "")
    hard = dataclasses.replace(scene.blocks[0], elastic=None)
    other = dataclasses.replace(scene, bodies=(FLOOR, hard))
    assert ADAPTER.refuses(asked(other, 1e-3, KN, 0.1), "default") is None


CODES = [name for name in find().adapter_names() if name != "dda"]


@pytest.mark.parametrize("code", CODES)
def test_every_other_code_refuses_a_block_that_strains_by_its_terms(code: str) -> None:
    adapter, scene = find().load_adapter(code), standing(free_spin=NONE)
    hard = dataclasses.replace(scene, bodies=(FLOOR, box(HALF, RHO)))
    for scheme in adapter.schemes:
        told = known_beforehand(adapter, scheme, asked(scene, 1e-4, KN, 0.1), adapter.found())
        assert told is not None
        assert told.status is Status.REFUSED
        assert Term.STRAIN.value in told.reason
        known = known_beforehand(adapter, scheme, asked(hard, 1e-4, KN, 0.1), adapter.found())
        assert known is None or Term.STRAIN.value not in known.reason


def test_nothing_stands_in_for_a_block_that_strains_even_where_terms_are_not_looked_at() -> None:
    ask = asked(standing(), 1e-4, KN, 0.1)
    words = "block 'box' is elastic"
    for why in (why_no_spring_scene, why_no_clump, rigid.refuses, dem.refuses):
        assert words in (why(ask) or "")
    with pytest.raises(ValueError, match=words):
        as_spheres(ask.scene)
