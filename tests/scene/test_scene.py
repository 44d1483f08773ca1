"""What a scene says of itself, by hand: its terms, its numbers, and what it refuses."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import FLOOR, HELD, box
from vv.scene import (
    Block,
    Bonds,
    Contact,
    Elastic,
    Fluid,
    Harmonic,
    Hertz,
    Mask,
    Pulse,
    Scene,
    Spheres,
    Term,
    Vector,
    Wall,
    rotation_about_z,
)

X, Y, Z = np.eye(3)
ALL, PARTLY = np.ones(3, bool), np.array([True, False, True])
SPRINGS = Contact(1e3)
WAVE = Harmonic(X, X)
TURNED = rotation_about_z(0.3)
ELASTIC = Hertz(1e9, 4e8)


def balls(n: int = 1, free: Mask = ALL, **given: Any) -> Spheres:
    """Spheres of radius 0.5 m and 2 kg in a row along x, a metre apart."""
    rows = {name: np.tile(row, (n, 1)) for name, row in given.items()}
    place, velocity = np.outer(np.arange(n), X), rows.pop("velocity", np.zeros((n, 3)))
    return Spheres(place, velocity, np.full(n, 0.5), np.full(n, 2.0), np.tile(free, (n, 1)), **rows)


def block(**given: Any) -> Block:
    return box("one", [0.0, 0.0, 9.0], [0.5] * 3, **{"free_spin": HELD, **given})


def bonds(*pairs: tuple[int, int], **given: Any) -> Bonds:
    return Bonds(np.array(pairs), np.array(1.0), np.array(1e3), **{"ks": np.array(0.0), **given})


def scene(*bodies: Spheres | Wall | Block, contact: Contact = SPRINGS, **given: Any) -> Scene:
    return Scene(bodies or (balls(),), contact, **given)


ONE, TWO = {Term.SPHERE}, {Term.SPHERE, Term.SPHERE_CONTACT}
TERMS: list[tuple[Scene, set[Term]]] = [
    (scene(), ONE),
    (scene(balls(2)), TWO),
    (scene(balls(2), bonds=bonds((0, 1))), {Term.SPHERE, Term.BOND}),
    (scene(balls(3), bonds=bonds((0, 1), (1, 2))), {*TWO, Term.BOND}),
    (scene(balls(3), bonds=bonds((0, 1), (1, 2), (0, 2))), {Term.SPHERE, Term.BOND}),
    (scene(balls(2), bonds=bonds((0, 1), tension=np.array(5.0))), {*TWO, Term.BOND, Term.BREAKAGE}),
    (scene(balls(2), bonds=bonds((0, 1), ks=np.array(1.0))),
     {Term.SPHERE, Term.BOND, Term.BOND_SHEAR}),
    (scene(balls(), FLOOR), {*ONE, Term.WALL_CONTACT}),
    (scene(balls(), Wall(-9 * Z, Z, WAVE)), {*ONE, Term.WALL_CONTACT, Term.BASE_MOTION}),
    (scene(contact=Contact(1e3, 1e2, 0.5)), {*ONE, Term.FRICTION}),
    (scene(contact=Contact(1e3, 1e2)), ONE),
    (scene(contact=Contact(1e3, 0.0, 0.5)), ONE),
    (scene(contact=Contact(1e3, eta_n=1.0)), {*ONE, Term.CONTACT_VISCOSITY}),
    (scene(contact=Contact(1e3, 1e2, 0.5, 1.0)),
     {*ONE, Term.FRICTION, Term.CONTACT_VISCOSITY, Term.VISCOUS_FRICTION}),
    (scene(contact=Contact(np.inf)), {*ONE, Term.RIGID_CONTACT}),
    (scene(contact=Contact(np.inf, mu=0.5)), {*ONE, Term.RIGID_CONTACT, Term.FRICTION}),
    (scene(contact=Contact(0.0, hertz=ELASTIC)), {*ONE, Term.HERTZ}),
    (scene(contact=Contact(0.0, mu=0.5, hertz=ELASTIC)), {*ONE, Term.HERTZ, Term.FRICTION}),
    (scene(contact=Contact(0.0, hertz=Hertz(1e9, damping=0.1))),
     {*ONE, Term.HERTZ, Term.HERTZ_VISCOSITY}),
    (scene(contact=Contact(0.0, mu=0.5, hertz=Hertz(1e9, 4e8, damping=0.1))),
     {*ONE, Term.HERTZ, Term.HERTZ_VISCOSITY, Term.FRICTION, Term.VISCOUS_FRICTION}),
    (scene(contact=Contact(0.0, mu=0.5, hertz=Hertz(1e9, 4e8, micro_slip=True))),
     {*ONE, Term.HERTZ, Term.FRICTION, Term.MICRO_SLIP}),
    (scene(contact=Contact(0.0, hertz=Hertz(1e9, 4e8, micro_slip=True))), {*ONE, Term.HERTZ}),
    (scene(eta=0.1), {*ONE, Term.DRAG}),
    (scene(fluid=Fluid(1.0, 1.0)), {*ONE, Term.FLUID}),
    (scene(block(), fluid=Fluid(1.0, 1.0)), {Term.BLOCK}),
    (scene(gravity=-Z), {*ONE, Term.GRAVITY}),
    (scene(balls(load=X)), {*ONE, Term.LOAD}),
    (scene(balls(), block(load=X)), {*ONE, Term.BLOCK, Term.LOAD}),
    (scene(balls(free_spin=PARTLY)), {*ONE, Term.ROTATION}),
    (scene(balls(), block(free_spin=PARTLY)), {*ONE, Term.BLOCK, Term.ROTATION}),
    (scene(block(elastic=Elastic(1e9, 0.2))), {Term.BLOCK, Term.STRAIN}),
    (scene(block(elastic=Elastic(1e9, 0.2, relaxed=True))),
     {Term.BLOCK, Term.STRAIN, Term.STRAINED_START}),
    (scene(shaking=WAVE), {*ONE, Term.SHAKING}),
    (scene(shaking=Pulse(WAVE, 1.0)), {*ONE, Term.SHAKING, Term.PULSE}),
    (scene(balls(free=PARTLY)), ONE),
    (scene(balls(free=PARTLY), axes=TURNED), {*ONE, Term.OBLIQUE_LOCK}),
    (scene(balls(free=PARTLY), axes=np.eye(3)[[1, 0, 2]]), ONE),
    (scene(balls(), axes=TURNED), ONE),
    (scene(balls(free=HELD), axes=TURNED), ONE),
    (scene(balls(), block(free=PARTLY), axes=TURNED), {*ONE, Term.BLOCK, Term.OBLIQUE_LOCK}),
    (scene(balls(free=PARTLY, velocity=Y)), {*ONE, Term.CARRIED}),
    (scene(balls(free=PARTLY, velocity=X)), ONE),
    (scene(balls(free=PARTLY, velocity=X + 0.8e-12 * Y)), ONE),  # rounding
    (scene(balls(free=PARTLY, velocity=X + 1.2e-12 * Y)), {*ONE, Term.CARRIED}),
]  # fmt: skip


@pytest.mark.parametrize(("one", "terms"), TERMS, ids=range(len(TERMS)))
def test_a_scene_has_these_effects_and_no_others(one: Scene, terms: set[Term]) -> None:
    assert one.terms() == terms


def test_every_effect_is_in_the_table() -> None:
    assert {term for _, terms in TERMS for term in terms} == {*Term}


MIXED = scene(FLOOR, balls(2), block(), balls(3, free=PARTLY, free_spin=PARTLY))


def test_bodies_are_numbered_through_all_groups() -> None:
    assert [MIXED.body_numbers(kind) for kind in (Wall, Spheres, Block)] == [
        [0], [1, 2, 4, 5, 6], [3],
    ]  # fmt: skip
    assert [MIXED.sphere_index(body) for body in (1, 2, 4, 5, 6)] == [0, 1, 2, 3, 4]
    for body in (-1, 0, 3, 7):
        with pytest.raises(ValueError, match=f"body {body} is not a sphere .* which has 7 bodies"):
            MIXED.sphere_index(body)


def test_a_bond_names_bodies_and_its_spheres_are_found_by_that() -> None:
    tied = dataclasses.replace(MIXED, bonds=bonds((1, 2), (6, 4)))
    assert tied.bonded_pairs.tolist() == [[0, 1], [4, 2]]


def test_unknowns_are_what_is_free_and_the_strains() -> None:
    assert MIXED.unknowns() == 2 * 3 + 3 + 3 * (2 + 2)
    assert scene(block(free=PARTLY, elastic=Elastic(1e9, 0.2))).unknowns() == 2 + 3


@pytest.mark.parametrize("off", [0.4e-12, 0.6e-12])
def test_axes_are_orthonormal_but_for_rounding(off: float) -> None:
    if 2 * off < 1e-12:
        assert scene(axes=(1 + off) * np.eye(3)).bodies
    else:
        with pytest.raises(ValueError, match="not orthonormal"):
            scene(axes=(1 + off) * np.eye(3))


BREAKABLE: dict[str, Any] = {"tension": np.array(5.0), "ks": np.array(0.0)}


@pytest.mark.parametrize(
    ("pairs", "said"),
    [
        ([(1, 2), (0, 2)], r"Bonds.pairs\[1\] = \[0, 2\]; bonds join spheres"),
        ([(1, 3)], r"Bonds.pairs\[0\] = \[1, 3\]; bonds join spheres"),
        ([(1, 7)], r"Bonds.pairs\[0\] = \[1, 7\]; bonds join spheres"),
        ([(1, 4)], r"Bonds.pairs\[0\] = \[1, 4\] have one centre"),
    ],
)
def test_a_bond_on_no_two_spheres_apart_is_refused(pairs: list[tuple[int, int]], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        dataclasses.replace(MIXED, bonds=bonds(*pairs))


@pytest.mark.parametrize("name", ["kn", "length", "ks"])
@pytest.mark.parametrize("off", [-1.2e-9, -0.8e-9, 0.8e-9, 1.2e-9])
def test_a_bond_that_can_break_is_like_the_contact_but_for_rounding(name: str, off: float) -> None:
    right = {"kn": 1e3, "length": 1.0, "ks": 2e2}
    given = {**right, name: right[name] * (1 + off)}

    def made(tension: float) -> Scene:
        of = {key: np.array(value) for key, value in given.items()}
        tied = Bonds(np.array([[0, 1]]), tension=np.array(tension), **of)
        return scene(balls(2), contact=Contact(1e3, 2e2), bonds=tied)

    assert made(np.inf).bonds
    if abs(off) < 1e-9:
        assert made(5.0).bonds
    else:
        with pytest.raises(ValueError, match=rf"Bonds\.{name}\[0\].*once it is broken"):
            made(5.0)


@pytest.mark.parametrize(
    ("name", "said"),
    [("radius", "radii"), ("mass", "masses"), ("inertia", "moments of inertia")],
)
@pytest.mark.parametrize("value", [0.0, -1.0])
def test_a_sphere_has_a_size_and_a_mass(name: str, said: str, value: float) -> None:
    two = {"radius": np.ones(2), "mass": np.ones(2), "inertia": np.ones(2)}
    wrong = {**two, name: np.array([1.0, value])}
    still = np.zeros((2, 3))
    with pytest.raises(
        ValueError, match=rf"Spheres\.{name}\[1\] = {value} .*; {said} must be positive"
    ):
        Spheres(still, still, free=np.ones((2, 3), bool), **wrong)


def test_a_sphere_has_the_inertia_of_a_ball_unless_it_is_given() -> None:
    assert balls().inertia == pytest.approx(0.4 * 2.0 * 0.5**2)


@pytest.mark.parametrize("until", [0.0, -1.0, np.inf, np.nan])
def test_a_pulse_ends_after_it_begins(until: float) -> None:
    with pytest.raises(ValueError, match=r"Pulse\.until"):
        Pulse(WAVE, until)
    assert Pulse(WAVE, 0.1).until == 0.1


@pytest.mark.parametrize("scale", [1 - 0.9e-12, 1 + 0.9e-12, 1 - 1.2e-12, 1 + 1.2e-12])
def test_a_wall_s_normal_is_a_unit_but_for_rounding(scale: float) -> None:
    if abs(scale - 1.0) < 1e-12:
        assert Wall(np.zeros(3), scale * Z).normal[2] == scale
    else:
        with pytest.raises(ValueError, match=r"Wall\.normal has length"):
            Wall(np.zeros(3), scale * Z)


def test_only_a_wave_of_no_negative_frequency_is_one() -> None:
    with pytest.raises(ValueError, match="must not be negative"):
        Harmonic(X, -X)
    sines = list(Harmonic(np.array([0.0, 2.0, 3.0]), Y, Z, TURNED).sines())
    assert [(f, phase) for _, f, phase in sines] == [(1.0, 0.0), (0.0, 1.0)]
    expected: list[Vector] = [2.0 * TURNED[1], 3.0 * TURNED[2]]
    assert np.array([along for along, _, _ in sines]) == pytest.approx(np.array(expected))
