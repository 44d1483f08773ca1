"""Dead loads in place of oblique locks: what they are, when they will not do, and other frames."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests.scene.test_scene import ALL, PARTLY, SPRINGS, TURNED, WAVE, X, Y, Z, balls, block, bonds
from tests.scene.test_scene import scene as made
from vv.scene import (
    Harmonic,
    Pulse,
    Scene,
    Spheres,
    Wall,
    in_frame,
    rotated,
    rotation_about_z,
    spheres_held_by_loads,
    why_load_is_no_lock,
    why_locks_need_more_than_loads,
    with_loads_for_locks,
    with_shaking_times,
)
from vv.scene.initial_forces import unbonded

LOCKED = TURNED[1]  # the direction that PARTLY locks in the turned axes
FREE = TURNED[0]
G = np.array([0.0, -10.0, 0.0])


def turned(*bodies: Any, **given: Any) -> Scene:
    return made(*(bodies or (balls(free=PARTLY),)), **{"axes": TURNED, **given})


def test_a_lock_s_reaction_to_weight_load_and_contacts_becomes_a_dead_load() -> None:
    wall = Wall(-0.4 * Y, Y)  # overlapped by 0.1 m
    one = turned(balls(free=PARTLY, load=3.0 * X), wall, gravity=G)
    loose = with_loads_for_locks(one)
    applied = 2.0 * G + 3.0 * X + 1e3 * 0.1 * Y
    assert loose.spheres.load[0] == pytest.approx(3.0 * X - (applied @ LOCKED) * LOCKED)
    assert loose.spheres.free.all()
    assert (loose.axes == np.eye(3)).all()
    assert (loose.walls[0].point == wall.point).all()


def test_a_lock_along_the_frame_stays_and_what_is_free_or_held_is_left_alone() -> None:
    """z of the turned axes is z of the frame."""
    some = (balls(free=np.array([True, False, False])), balls(), balls(free=~ALL))
    apart = (replace(one, position=9.0 * i * Z[None]) for i, one in enumerate(some))
    loose = with_loads_for_locks(turned(*apart, gravity=G - Z)).spheres
    assert loose.free.tolist() == [[True, True, False], [True] * 3, [False] * 3]
    assert loose.load[0] == pytest.approx(-2.0 * (G @ LOCKED) * LOCKED)
    assert (loose.load[1:] == 0.0).all()


def test_nothing_is_done_to_locks_along_the_frame() -> None:
    one = made(balls(free=PARTLY), Wall(-0.4 * Y, Y), gravity=G)
    loose = with_loads_for_locks(one)
    assert loose.spheres.free.tolist() == [[True, False, True]]
    assert (loose.spheres.load == 0.0).all()


def test_a_sphere_that_moves_along_an_oblique_lock_has_no_such_load() -> None:
    with pytest.raises(ValueError, match=r"Spheres\.velocity\[0\] has a part along an oblique"):
        with_loads_for_locks(turned(balls(free=PARTLY, velocity=LOCKED)))
    lifted = turned(balls(free=np.array([True, False, False]), velocity=Z))
    assert with_loads_for_locks(lifted).spheres.free.tolist() == [[True, True, False]]


def test_spheres_held_by_loads_are_those_locked_in_part_and_obliquely() -> None:
    bodies = (Wall(-9 * Z, Z), balls(), balls(2, free=PARTLY), balls(free=~ALL))
    assert spheres_held_by_loads(turned(*bodies)) == [2, 3]
    assert spheres_held_by_loads(made(*bodies)) == []


@pytest.mark.parametrize(
    ("free", "moved", "told"),
    [
        (PARTLY, 5.0 * FREE, False),
        (PARTLY, 5.0 * FREE + 4e-9 * LOCKED, False),  # rounding: 1e-9 of how far it moved
        (PARTLY, 5.0 * FREE + 6e-9 * LOCKED, True),
        (PARTLY, 4e-13 * LOCKED, False),  # at rest: 1e-12 of the radius, 0.5 m
        (PARTLY, 6e-13 * LOCKED, True),
        (~ALL, 5.0 * LOCKED, False),
        (ALL, 5.0 * LOCKED, False),
    ],
)
def test_a_sphere_that_left_its_lock_is_told(free: Any, moved: Any, told: bool) -> None:
    path = np.array([0.0 * X, 0.5 * moved, -moved])
    why = why_load_is_no_lock(turned(balls(free=free)), 0, path)
    assert (why is not None) is told
    assert why is None or why.startswith(f"moved {abs(moved @ LOCKED):.3g} m along a locked")


def driven(along: Any, off: float = 0.0) -> Harmonic:
    """A drive in axes that are turned by an angle off those of the locks."""
    return Harmonic(along, X + Y + Z, axes=rotation_about_z(0.3 + off))


LIFTED = balls(free=np.array([True, False, False]), velocity=Z)


@pytest.mark.parametrize(
    ("one", "words"),
    [
        (turned(), None),
        (turned(shaking=driven(3.0 * X)), None),
        (turned(shaking=driven(1e6 * X, 0.8e-12)), None),  # rounding
        (turned(shaking=driven(1e-3 * X, 0.8e-12)), None),
        (turned(shaking=driven(3.0 * X, 1.2e-12)), "and driven along it"),
        (turned(shaking=driven(3.0 * Z)), None),
        (turned(shaking=driven(3.0 * Y)), "and driven along it"),
        (turned(shaking=Pulse(driven(1e-9 * Y), 1.0)), "and driven along it"),
        (turned(balls(free=PARTLY), Wall(-9 * Z, Z, driven(3.0 * Y))), "and driven along it"),
        (turned(balls(), Wall(-9 * Z, Z, driven(3.0 * Y))), None),
        (turned(balls(free=~ALL), shaking=driven(3.0 * Y)), None),
        (turned(LIFTED), "moves along directions it is locked in"),
        (made(balls(free=PARTLY, velocity=Y)), None),
        (turned(balls(2, free=PARTLY), bonds=bonds((0, 1))), "its pull varies"),
        (made(balls(2, free=PARTLY), bonds=bonds((0, 1))), None),
        (turned(balls(free=np.array([True, False, False])), shaking=driven(Z)), None),
        (made(balls(free=PARTLY), shaking=driven(3.0 * Y)), None),  # a lock along the frame
    ],
)
def test_what_varies_along_an_oblique_lock_needs_more_than_a_load(
    one: Scene, words: str | None
) -> None:
    why = why_locks_need_more_than_loads(one)
    assert (why is None) is (words is None)
    assert words is None or words in (why or "")


@pytest.mark.parametrize(
    ("axes", "free", "among"),
    [
        (np.eye(3), PARTLY, PARTLY),
        (np.eye(3)[[1, 2, 0]], PARTLY, [True, True, False]),  # y and x
        (TURNED, [False, False, True], [False, False, True]),
        (TURNED, [True, True, False], [True, True, False]),
        (TURNED, PARTLY, None),
        (TURNED, ~ALL, ~ALL),
        (TURNED, ALL, ALL),
    ],
)
def test_what_is_free_in_other_axes_is_told_in_the_frame(axes: Any, free: Any, among: Any) -> None:
    found = in_frame(axes, np.array(free))
    assert (found is None) is (among is None)
    assert among is None or (found is not None and found.tolist() == [*among])


def test_shaking_is_multiplied_and_ends_when_it_did() -> None:
    wave = replace(WAVE, amplitude=np.array([1.0, 2.0, 3.0]))
    for shaking in (wave, Pulse(wave, 0.7)):
        more = with_shaking_times(made(shaking=shaking), 4.0)
        assert more.wave is not None
        assert more.wave.amplitude.tolist() == [4.0, 8.0, 12.0]
        assert type(more.shaking) is type(shaking)
    assert isinstance(more.shaking, Pulse)
    assert more.shaking.until == 0.7
    with pytest.raises(ValueError, match="there is none to be multiplied"):
        with_shaking_times(made(), 4.0)


def test_the_inertia_of_a_block_turns_with_it_and_stays_symmetric() -> None:
    slab = replace(block(), inertia=np.diag([1.0, 2.0, 3.0]))
    (found,) = rotated(made(slab), TURNED).blocks
    assert found.inertia == pytest.approx(TURNED @ slab.inertia @ TURNED.T)
    assert (found.inertia == found.inertia.T).all()


def test_pairs_without_a_bond_are_all_others() -> None:
    every = np.array([[i, j] for i in range(7) for j in range(i + 1, 7)])
    tied = [(0, 1), (5, 2), (3, 4), (6, 0)]
    one = Scene((balls(7),), SPRINGS, bonds=bonds(*tied))
    assert isinstance(one.bodies[0], Spheres)
    left = {tuple(pair) for pair in unbonded(one, every).tolist()}
    assert left == {tuple(pair) for pair in every.tolist()} - {(0, 1), (2, 5), (3, 4), (0, 6)}
