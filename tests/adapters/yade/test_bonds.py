"""Claims about bonds in YADE: what it is given, and that it moves as the in-house code does."""

from __future__ import annotations

import ast
import dataclasses
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from adapters.yade import ADAPTER
from adapters.yade.inside import script
from tests.scenes.spheres.bonded_scenes import CORNERS, EDGES, KN, KS, D, M, elements, tied, unit
from tests.support.adapters.yade_asks import plan_of
from tests.support.installed import only_with
from vv.ask import Ask, Displacement, History, Knobs, Reaction, Run, Status
from vv.engines import dem
from vv.scene import (
    Bonds,
    Contact,
    Scene,
    Vector,
    Wall,
    initial_normal_forces,
    rotated,
    with_bodies_reversed,
)

live = only_with(ADAPTER)
TIME = 4e-6
ODD = tied(kn=KN * np.linspace(0.5, 1.5, 6), ks=KS * np.linspace(0, 2, 6), length=0.998 * D)


def thrown(bonds: Bonds | None = None) -> Scene:
    return unit(elements(velocity=np.random.default_rng(1).normal(size=(4, 3)) * 20.0), bonds)


def ask(scene: Scene, dt: float = 1e-8) -> Ask:
    seen = tuple(Displacement(i) for i in range(len(scene.spheres)))
    return Ask(scene, History(TIME, TIME / 4), seen, Knobs(dt=dt))


def moved(run: Run) -> Vector:
    assert run.status is Status.RAN, run.reason
    return np.array(list(run.values.values()))


def ran(asks: Sequence[Ask], folder: Path) -> list[Vector]:
    return [moved(run) for run in ADAPTER.run(asks, "default", folder, 0.0)]


def test_a_bond_is_told_with_its_springs_and_where_it_does_not_pull() -> None:
    given = plan_of(ask(unit(bonds=ODD)), "default")
    assert [bond["pair"] for bond in given["bonds"]] == EDGES.tolist()
    assert [bond["kn"] for bond in given["bonds"]] == ODD.kn.tolist()
    assert given["bonds"][0]["overlap"] == pytest.approx(0.002 * D, rel=1e-9)
    assert given["bonds"][0]["tension"] == 1e300  # infinite, as a literal can say it
    assert given["contacts"] == 6  # touching pairs are bonds, and no contacts besides


def test_what_is_carried_and_sheared_waits_for_the_end_of_the_first_step() -> None:
    body = plan_of(carried(np.array([0.3, 9.0, 0.0])), "default")["bodies"][1]
    assert (body["carried"], body["held"]) == ([0.3, 9.0, 0.0], [0.0, 0.0, 0.0])
    assert (body["velocity"], body["push"]) == ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0])


def test_the_parts_of_the_program_share_no_names_by_chance() -> None:
    """It is one script: a name that two parts give would be that of the later one in both."""
    names = [
        node.name
        for node in ast.parse(script()).body
        if isinstance(node, ast.FunctionDef | ast.ClassDef)
    ]
    assert len(names) == len(set(names)) > 20


def test_only_spheres_on_a_bond_with_shear_are_pushed() -> None:
    pushed = [any(body["push"]) for body in plan_of(ask(thrown()), "default")["bodies"]]
    free = [any(body["push"]) for body in plan_of(ask(thrown(tied(ks=0.0))), "default")["bodies"]]
    assert (pushed, free) == ([True] * 4, [False] * 4)


def test_a_stretched_bond_pulls_at_the_start_and_none_presses() -> None:
    force = initial_normal_forces(unit(bonds=tied(length=0.99 * D)))
    assert force[0] == pytest.approx([0, 0, -3 * KN * 0.01 * D * np.sqrt(2 / 3)], abs=1e-9)
    assert np.abs(force.sum(axis=0)).max() < 1e-9
    fat = dataclasses.replace(elements(), radius=np.full(4, 0.6 * D))
    assert np.abs(initial_normal_forces(unit(fat))).max() < 1e-9


def test_bonds_beside_walls_and_oblique_locks_are_refused() -> None:
    floor = Wall(-D * np.eye(3)[2], np.eye(3)[2])
    walled = Scene((elements(), floor), Contact(KN), bonds=tied())
    held = unit(elements(free=np.array([[True, True, False]] * 4)))
    turn = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    assert "walls beside bonds" in (ADAPTER.refuses(ask(walled), "default") or "")
    assert "its pull varies" in (ADAPTER.refuses(ask(rotated(held, turn)), "default") or "")
    assert ADAPTER.refuses(ask(held), "default") is None


@live
def test_bonds_that_turn_and_differ_move_as_in_the_in_house_code(tmp_path: Path) -> None:
    """Both are of second order, with errors that are all but the same."""
    for number, scene in enumerate((thrown(), thrown(ODD), with_bodies_reversed(thrown(ODD)))):
        folder = tmp_path / str(number)
        folder.mkdir()
        coarse, fine = ran([ask(scene), ask(scene, 5e-9)], folder)
        truth = moved(dem.solve_default(ask(scene, 6.25e-10)))
        off = [np.abs(u - truth).max() / np.abs(truth).max() for u in (coarse, fine)]
        assert off[0] < 1e-3
        assert off[0] / off[1] == pytest.approx(4, rel=0.15)


def agree(asks: Sequence[Ask], folder: Path, within: float) -> None:
    """Every observable of the in-house code and of YADE, to a part of its largest value."""
    for one, run in zip(asks, ADAPTER.run(asks, "default", folder, 0.0), strict=True):
        ours = dem.solve_default(one)
        assert (ours.status, run.status) == (Status.RAN, Status.RAN), run.reason
        for what, values in run.values.items():
            size = np.abs(ours.values[what]).max()
            assert np.abs(values - ours.values[what]).max() <= within * size, what


def carried(velocity: Vector, **strengths: float) -> Ask:
    """Two spheres on a bond along x, one nearly at rest, one carried on at a velocity."""
    heavy = dataclasses.replace(
        elements(
            np.array([[0, 0, 0], [D, 0, 0]]),
            velocity=np.array([[0, 0, 0], velocity]),
            free=np.array([[True, False, False], [False] * 3]),
        ),
        mass=np.array([1e9 * M, M]),
    )
    bond = tied(pairs=EDGES[:1], **strengths)
    gravity = np.array([0.0, 300.0, 0.0])
    scene = Scene((heavy,), Contact(KN, KS, 0.3964), 0.2, gravity, bonds=bond)
    return Ask(scene, History(1e-6, 1e-8), (Reaction(1), Displacement(1)), Knobs(dt=1e-9))


@live
def test_reactions_to_what_is_carried_are_those_of_the_in_house_code(tmp_path: Path) -> None:
    """With drag, weight and shear, from t = 0 on; YADE shears across where a step ends, which is
    half a step's stretch from the middle.
    """
    agree([carried(np.array([0.3, 9.0, 0.0]))], tmp_path, 2e-7)


@pytest.mark.shows(
    "which makes it first order where a bond stretches and shears at once, 1.5e-6 of the force "
    "at 1e-8 s"
)
@live
def test_a_bond_that_stretches_and_shears_at_once_is_of_first_order(tmp_path: Path) -> None:
    """The in-house code, of second order, is 1.6e-10 off at the second of these steps."""
    base = carried(np.array([0.3, 9.0, 0.0]))
    asks = [dataclasses.replace(base, knobs=Knobs(dt=dt)) for dt in (1e-8, 5e-9, 6.25e-10)]
    due = dem.solve_default(asks[-1]).values[Reaction(1)]
    found = [run.values[Reaction(1)] for run in ADAPTER.run(asks[:2], "default", tmp_path, 0.0)]
    off = [np.abs(one - due).max() / np.abs(due).max() for one in found]
    assert off == pytest.approx([1.5e-6, 7.3e-7], rel=0.05)


@pytest.mark.shows("breaks permanently only with `cohesionBroken` set to False")
@live
@pytest.mark.parametrize("velocity", [[0.3, 0, 0], [0, 30.0, 0], [-2.0, 30.0, 0]])
def test_bonds_break_in_tension_and_in_shear(velocity: list[float], tmp_path: Path) -> None:
    """Pulled apart, sheared, and sheared under pressure, where friction goes on."""
    broken = carried(np.array(velocity), tension=KN * 1.7e-7, shear=18.0)
    agree([broken], tmp_path, 1e-6)
    whole, parted = (
        np.abs(dem.solve_default(one).values[Reaction(1)][-1]).max()
        for one in (carried(np.array(velocity)), broken)
    )
    assert parted < 0.9 * whole


@live
def test_contacts_beside_bonds_are_those_of_scenes_without(tmp_path: Path) -> None:
    """Two unlike spheres that graze each other, alone and with a bonded pair far away."""
    n = np.array([1.0, 0.0, 0.0])
    pair = elements(np.array([[0.0, 0.0, 0.0], 1.4 * D * n]), velocity=[[9.0, 4.0, 0], [0, 0, 0]])
    pair = dataclasses.replace(pair, radius=D * np.array([0.5, 0.95]))
    law = Contact(KN, KS, 0.3)
    far = elements(CORNERS[:2] + 100 * D)
    alone = ask(Scene((pair,), law))
    bond = tied(pairs=[[2, 3]])
    beside = dataclasses.replace(alone, scene=Scene((pair, far), law, bonds=bond))
    one, two = ran([alone, beside], tmp_path)
    assert np.abs(one - two).max() < 1e-9 * np.abs(one).max()
    free = np.array([9.0, 4.0, 0.0]) * TIME
    assert np.abs(one[0, -1] - free).max() > 0.1 * np.abs(free).max()
