"""Claims that scenes made from scenes keep whatever is stated of a body, a contact or a bond."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
import pytest

from adapters.liggghts.clumps import as_atoms
from adapters.liggghts.overlaps import overlapped
from adapters.liggghts.setup import heavier
from tests.scenes.blocks.sliding_blocks import Frame, incline
from tests.scenes.spheres.bonded_scenes import tied, unit
from tests.support.adapters.small_asks import block_ask
from vv.ask import Ask
from vv.scene import (
    Block,
    Bonds,
    Contact,
    Scene,
    Spheres,
    Vector,
    Wall,
    initial_normal_forces,
    rotated,
    rotation_about_z,
    with_bodies_reversed,
    with_loads_for_locks,
)
from vv.scene.arrays import freeze
from vv.standins.clump import clumps
from vv.standins.penalty_springs import softened
from vv.standins.stand_in import spring_scene, without_rotations

MORE = 7.25  # of the field that each class has got besides


@dataclass(frozen=True)
class MoreContact(Contact):
    more: float = MORE


@dataclass(frozen=True, eq=False)
class MoreWall(Wall):
    more: float = MORE


@dataclass(frozen=True, eq=False)
class MoreBlock(Block):
    more: float = MORE


@dataclass(frozen=True, eq=False)
class MoreBonds(Bonds):
    more: float = MORE


@dataclass(frozen=True, eq=False)
class MoreScene(Scene):
    more: float = MORE


@dataclass(frozen=True, eq=False)
class MoreSpheres(Spheres):
    more: Vector = None  # type: ignore[assignment]  # filled at birth

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.more is None:
            object.__setattr__(self, "more", np.full(len(self), MORE))
        freeze(self, "more", (len(self),), "")


@dataclass(frozen=True, eq=False)
class MoreAsk(Ask):
    more: float = MORE


MORE_OF = {
    Contact: MoreContact,
    Wall: MoreWall,
    Block: MoreBlock,
    Bonds: MoreBonds,
    Scene: MoreScene,
    Spheres: MoreSpheres,
    Ask: MoreAsk,
}


def with_more(value: object) -> object:
    """The value with a further field, and all that it holds likewise."""
    if isinstance(value, tuple):
        return tuple(with_more(part) for part in value)
    kind = {**MORE_OF, **{more: more for more in MORE_OF.values()}}.get(type(value))
    if kind is None or not dataclasses.is_dataclass(value):
        return value
    fields = {f.name: with_more(getattr(value, f.name)) for f in dataclasses.fields(value)}
    return kind(**fields)


def lost(value: object, kept: tuple[type, ...] = tuple(MORE_OF)) -> list[str]:
    """The classes of parts that have lost the further field, or its value."""
    if isinstance(value, tuple):
        return [name for part in value for name in lost(part, kept)]
    if not dataclasses.is_dataclass(value):
        return []
    parts = [name for f in dataclasses.fields(value) for name in lost(getattr(value, f.name), kept)]
    here = isinstance(value, kept) and not np.all(getattr(value, "more", 0.0) == MORE)
    return [*parts, type(value).__name__] if here else parts


def given(scene: Scene) -> Scene:
    made = with_more(scene)
    assert isinstance(made, Scene)
    assert not lost(made)
    return made


TIED = given(unit(bonds=tied()))
SLOPE = given(incline(Frame(28.0, turn=0.4), 15.0, A=2.0))


@pytest.mark.parametrize("scene", [TIED, SLOPE], ids=["bonded", "block"])
def test_a_turn_and_a_swap_drop_nothing(scene: Scene) -> None:
    assert not lost(rotated(scene, rotation_about_z(0.3)))
    assert not lost(with_bodies_reversed(scene))


def test_softening_release_overlaps_and_raised_masses_drop_nothing() -> None:
    assert not lost(softened(SLOPE, 1e9))
    assert not lost(with_loads_for_locks(TIED))
    assert not lost(overlapped(TIED))
    assert not lost(heavier(TIED, 1.0))


def test_a_lock_along_an_axis_of_the_frame_stays_one_beside_an_oblique_one() -> None:
    """Loads stand for a lock at 37 degrees in the plane; across the plane it is held as it was."""
    free = np.array([[True, False, False]])
    one = Spheres(np.zeros((1, 3)), np.zeros((1, 3)), np.ones(1), np.array([2.0]), free)
    axes = np.array([[0.8, 0.6, 0.0], [-0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])
    field = np.array([0.0, -10.0, -10.0])
    made = with_loads_for_locks(Scene((one,), Contact(1e4), gravity=field, axes=axes))
    assert np.array(made.spheres.free).tolist() == [[True, True, False]]
    assert made.spheres.load[0] == pytest.approx([-9.6, 12.8, 0.0])  # 16 N along it


def test_what_stands_for_a_block_keeps_what_is_stated_of_all_else() -> None:
    """Of the block itself a sphere is made, which has what a sphere has by default."""
    others = (Scene, Contact, Wall, Ask)
    turning = dataclasses.replace(SLOPE.blocks[0], free_spin=np.ones(3, bool))
    loose = dataclasses.replace(SLOPE, bodies=(*SLOPE.walls, turning))
    ask = with_more(block_ask(loose))
    assert isinstance(ask, Ask)
    still = without_rotations(ask)
    assert not lost(still)
    springs = spring_scene(still)
    assert not lost(springs.scene, others)
    spheres = given(springs.scene)
    assert not lost(as_atoms(spheres, clumps(ask, springs)), (*others, Spheres))


def test_forces_at_the_start_are_those_of_every_pair() -> None:
    """Of spheres of all sizes, some of which a bond joins, which then do not touch."""
    rng, n = np.random.default_rng(3), 80
    place, radius = rng.uniform(0.0, 3.0, (n, 3)), rng.uniform(0.05, 0.6, n)
    balls = Spheres(place, np.zeros((n, 3)), radius, np.ones(n), np.ones((n, 3), bool))
    bonds = Bonds(np.array([[0, 1], [5, 3], [40, 7]]), *np.repeat([[1.0], [2.0], [1.0]], 3, axis=1))
    force = np.zeros((n, 3))
    for i in range(n):
        for j in range(i):
            way = place[i] - place[j]
            apart = float(np.linalg.norm(way))
            push = 3.0 * max(radius[i] + radius[j] - apart, 0.0)
            if (i, j) in {(1, 0), (5, 3), (40, 7)}:
                push = -2.0 * (apart - 1.0)
            force[i] += push * way / apart
            force[j] -= push * way / apart
    scene = Scene((balls,), Contact(3.0), bonds=bonds)
    assert initial_normal_forces(scene) == pytest.approx(force, abs=1e-12)
