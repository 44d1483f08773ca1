"""Claims about bonds in the exact engine: at any amplitude if none turns, else to first order."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from scipy.linalg import expm

from tests.scenes.spheres.bonded_scenes import CORNERS, EDGES, KN, KS, D, M, elements, tied, unit
from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.engines import dem
from vv.engines.exact import assemble_bonded, refusal, solve, solve_linearised
from vv.scene import Contact, Scene, Spheres, Vector, rotated, with_bodies_reversed

OUT = CORNERS - CORNERS.mean(axis=0)
RATE = 2 * np.sqrt(KN / M)  # of the breathing mode [1/s]
TURN = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
BASE = np.array([[1, 1, 1], [1, 1, 0], [0, 1, 1], [1, 1, 0]], bool)


def asked(scene: Scene, time: float = 2e-6) -> Ask:
    seen = tuple(Displacement(i) for i in range(len(scene.spheres)))
    return Ask(scene, History(time, time / 20), seen)


def moved(run: Run) -> Vector:
    """Displacements (times, spheres, 3) [m] of all spheres; the ledger must balance."""
    assert run.status is Status.RAN, run.reason
    assert run.ledger is not None
    assert run.ledger.bound is not None
    assert run.ledger.unaccounted <= run.ledger.bound < 1e-10 * run.ledger.peak
    return _values(run)


def _values(run: Run) -> Vector:
    return np.stack(list(run.values.values()), axis=1)


def linear(scene: Scene, times: Vector) -> Vector:
    """Displacements (times, n, 3) [m] by the exponential of the whole matrix: a second route."""
    s, n = scene.spheres, 3 * len(scene.spheres)
    assert scene.bonds is not None
    K, pull = np.zeros((n, n)), np.zeros(n)
    for (i, j), kn, ks, length in zip(
        scene.bonds.pairs, scene.bonds.kn, scene.bonds.ks, scene.bonds.length, strict=True
    ):
        offset = s.position[j] - s.position[i]
        first = np.linalg.norm(offset)
        spring = (kn - ks) * np.outer(offset, offset) / first**2 + ks * np.eye(3)
        B = np.zeros((3, n))
        B[:, 3 * i : 3 * i + 3], B[:, 3 * j : 3 * j + 3] = -np.eye(3), np.eye(3)
        K += B.T @ spring @ B
        pull -= kn * (first - length) * offset / first @ B
    hold = np.zeros((n, n))
    for i, free in enumerate(s.free):
        part = slice(3 * i, 3 * i + 3)
        hold[part, part] = scene.axes[free].T @ scene.axes[free] / s.mass[i]
    force = pull + (s.mass[:, None] * scene.gravity + s.load).ravel()
    whole = np.zeros((2 * n + 1, 2 * n + 1))
    whole[:n, n : 2 * n] = np.eye(n)
    whole[n : 2 * n, :n], whole[n : 2 * n, n : 2 * n] = -hold @ K, -scene.eta * hold
    whole[n : 2 * n, -1] = hold @ force
    start = np.concatenate([np.zeros(n), s.velocity.ravel(), [1.0]])
    scale = np.concatenate([np.full(n, RATE), np.ones(n + 1)])  # lengths beside velocities
    scaled = whole * scale[:, None] / scale
    states = np.array([expm(scaled * t) @ start for t in times])
    return np.asarray(states[:, :n] / RATE).reshape(len(times), -1, 3)


def unlike() -> Spheres:
    """The unit with different masses of its elements, under a load."""
    load = np.random.default_rng(2).normal(size=(4, 3))
    group = elements(free=BASE, load=load)
    return dataclasses.replace(group, mass=M * np.array([1.0, 2.0, 0.5, 1.5]))


def pair(speed: float, length: float) -> Scene:
    """Two different spheres, one of them heavy, that move only along their oblique bond."""
    n = (CORNERS[1] - CORNERS[0]) / D
    group = dataclasses.replace(
        elements(CORNERS[:2], velocity=np.outer([speed, -0.3 * speed], n)),
        mass=M * np.array([1, 3]),
    )
    return Scene((group,), Contact(KN), 2.0, bonds=tied(pairs=EDGES[:1], length=length))


@pytest.mark.parametrize("eta", [0.0, 2.0])
def test_small_motions_are_those_of_the_matrix(eta: float) -> None:
    springs = tied(kn=KN * np.linspace(0.5, 1.5, 6), ks=KS * np.linspace(0, 2, 6))
    scene = unit(unlike(), springs, eta=eta, gravity=np.array([1e4, 0.0, -1e5]))
    for some in (scene, rotated(scene, TURN), with_bodies_reversed(scene)):
        ask = asked(some)
        run = solve_linearised(ask)
        exact = linear(some, run.times)
        assert np.abs(moved(run) - exact).max() < 1e-12 * np.abs(exact).max()


def test_a_sphere_that_a_bond_alone_sets_going_moves_along_and_across_it() -> None:
    """Along and across, where the bond is half as stiff, forces are in no ratio of their own."""
    group = elements(CORNERS[:2], velocity=np.array([[2.0, -1.0, 0.5], [0.0, 0.0, 0.0]]))
    scene = Scene((group,), Contact(KN), bonds=tied(pairs=EDGES[:1], ks=np.array([KN / 2])))
    run = solve_linearised(asked(scene))
    exact = linear(scene, run.times)
    assert np.abs(moved(run) - exact).max() < 1e-12 * np.abs(exact).max()


def test_a_sphere_between_two_that_swing_against_each_other_stays_at_rest() -> None:
    """Its springs are as 1 to 2, as the ways of both are 2 to 1; what is across them differs."""
    up, stiff = np.array([0.0, 0.0, 1.0]), np.array([1.0, 2.0, 1.0])
    group = dataclasses.replace(
        elements(D * np.outer(range(3), up), velocity=np.outer([2.0, 0.0, -1.0], up)),
        mass=M * np.array([2.5, 7.0, 5.0]),  # (2 + 3)/2 and (2 + 3)/1, by the springs on each
    )
    bonds = tied(
        pairs=np.array([[0, 1], [1, 2], [0, 2]]), length=D * np.array([1.0, 1.0, 2.0]),
        kn=KN * stiff, ks=KN * np.array([0.5, 0.1, 0.2]),
    )  # fmt: skip
    run = solve_linearised(asked(Scene((group,), Contact(KN), bonds=bonds)))
    assert run.model is not None
    assert run.model.unknowns == 2
    swing = np.sin(np.sqrt(KN / M) * run.times) / np.sqrt(KN / M)
    due = np.multiply.outer(swing, group.velocity)
    assert np.abs(moved(run) - due).max() < 1e-13 * np.abs(due).max()


def test_a_pair_whose_pull_is_held_by_loads_drifts_on_and_does_nothing_else() -> None:
    out, aside = (CORNERS[1] - CORNERS[0]) / D, np.array([0.0, 3.0, 0.0])
    pull = 0.125 * KN * D * np.outer([1.0, -1.0], out)
    group = elements(CORNERS[:2], velocity=np.array([aside, aside]), load=-pull)
    bonds = tied(pairs=EDGES[:1], length=0.875 * D)
    run = solve(asked(Scene((group,), Contact(KN), bonds=bonds)))
    assert run.model is not None
    assert run.model.unknowns == 2
    due = np.multiply.outer(run.times, group.velocity)
    assert np.abs(moved(run) - due).max() < 1e-13 * np.abs(due).max()


@pytest.mark.parametrize("amplitude", [1e-6, 0.02, 0.9])
def test_breathing_is_a_sine_at_any_amplitude(amplitude: float) -> None:
    scene = unit(elements(velocity=amplitude * RATE * OUT))
    for some, out in ((scene, OUT), (rotated(scene, TURN), OUT @ TURN.T)):
        run = solve(asked(some))
        swing = amplitude * np.multiply.outer(np.sin(RATE * run.times), out)
        assert np.abs(moved(run) - swing).max() < 1e-13 * np.abs(swing).max()
        assert run.model is not None
        assert run.model.unknowns == 4


@pytest.mark.parametrize("length", [0.9 * D, D, 1.05 * D])
def test_a_pair_swings_along_its_bond_however_far(length: float) -> None:
    scene = pair(400.0, length)
    run = solve(asked(scene))
    exact = linear(scene, run.times)
    assert np.abs(exact).max() > 0.04 * D
    assert np.abs(moved(run) - exact).max() < 1e-12 * np.abs(exact).max()


def test_no_energy_comes_from_bonds_that_start_stretched() -> None:
    run = solve(asked(pair(0.0, 0.9 * D)))
    assert run.ledger is not None
    held = sum(value for name, value in run.ledger.terms.items())
    assert held == pytest.approx(KN * (0.1 * D) ** 2 / 2, rel=1e-12)


def test_centres_that_meet_end_a_motion() -> None:
    run = solve(asked(unit(elements(velocity=1.2 * RATE * OUT))))
    assert run.status is Status.DIVERGED
    meet = (np.pi + np.arcsin(1 / 1.2)) / RATE
    assert f"meet at t = {meet:.6g} s" in run.reason


def test_what_would_happen_after_the_end_of_a_run_is_no_part_of_it() -> None:
    """A run ends within a step that would go on until centres meet."""
    scene = unit(elements(velocity=1.2 * RATE * OUT))
    meet = (np.pi + np.arcsin(1 / 1.2)) / RATE
    run = solve(asked(scene, 0.999 * meet))
    swing = 1.2 * np.multiply.outer(np.sin(RATE * run.times), OUT)
    assert np.abs(moved(run) - swing).max() < 1e-13 * np.abs(swing).max()


def test_bonds_that_turn_are_solved_to_first_order_only() -> None:
    """The remainder is of second order: a tenth of the amplitude leaves a hundredth of it."""
    off = []
    for speed in (1.0, 0.1):
        ask = asked(unit(elements(velocity=speed * np.random.default_rng(1).normal(size=(4, 3)))))
        assert "the bond between bodies 0 and 1 turns" in (refusal(ask) or "")
        stepped = dem.solve_default(dataclasses.replace(ask, knobs=Knobs(dt=1e-10)))
        off.append(float(np.abs(moved(solve_linearised(ask)) - _values(stepped)).max()))
    assert off[0] / off[1] == pytest.approx(100, rel=0.1)
    loaded = asked(unit(elements(load=np.outer([0, 0, 0, 1], [0, 0, 1.0]))))
    assert "turns" in (refusal(loaded) or "")


def test_drag_turns_a_pair_of_unlike_masses_that_drifts_sideways() -> None:
    aside = elements(CORNERS[1:3], velocity=np.array([[1.0, np.sqrt(3), 0]] * 2))
    alike = Scene((aside,), Contact(KN), 2.0, bonds=tied(pairs=EDGES[:1]))
    unlike = dataclasses.replace(aside, mass=M * np.array([1, 3]))
    run = solve(asked(alike))
    way = -np.expm1(-2.0 / M * run.times) * M / 2.0
    assert moved(run)[:, 0, 0] == pytest.approx(way, rel=1e-13)
    assert "turns" in (refusal(asked(dataclasses.replace(alike, bodies=(unlike,)))) or "")


@pytest.mark.parametrize(
    ("scene", "words"),
    [
        (unit(bonds=tied(length=0.99 * D)), "carries a force at t = 0"),
        (unit(bonds=tied(pairs=EDGES[:5])), "contact between spheres is not modelled on bonds"),
        (unit(bonds=tied(tension=8.0)), "bonds that break is not modelled"),
        (Scene((elements(),), Contact(KN)), "without bonds has nothing to linearise"),
        (unit(), "nothing in the scene moves"),
    ],
)
def test_what_is_not_linear_to_first_order_is_refused(scene: Scene, words: str) -> None:
    run = solve_linearised(asked(scene))
    assert run.status is Status.REFUSED
    assert words in run.reason


def test_springs_that_cannot_act_are_left_out() -> None:
    system = assemble_bonded(unit(elements(velocity=RATE * OUT)))
    assert (len(system.mass), len(system.bond_springs.rows)) == (4, 6)
