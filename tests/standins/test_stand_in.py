"""Claims about rigid scenes that springs can represent, and about the scenes that do."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from tests.standins.test_penalty_springs import FLOOR, X, Z, ball, cube, rigid
from vv.ask import Ask, Displacement, History, Knobs
from vv.scene import Contact, Harmonic, Scene, Term, Wall, rotation_about_z
from vv.standins.stand_in import SHEAR, spring_scene, why_no_spring_scene, without_rotations

FREE_BUT_UP = np.array([[True, True, False]])
WAVE = Harmonic(0.1 * Z, Z)  # begins at 0.2 pi m/s


def asked(scene: Scene, kn: float | None = 1e6) -> Ask:
    return Ask(scene, History(0.1, 0.01), (Displacement(0),), Knobs(1e-3, kn))


SOFT = dataclasses.replace(rigid(FLOOR, ball(1.0)), contact=Contact(1e3))
SPEED = 0.2 * np.pi
RISEN = Wall(7.0 * Z, Z, WAVE)


@pytest.mark.parametrize(
    ("scene", "kn", "words"),
    [
        (rigid(FLOOR, ball()), 1e6, None),
        (rigid(FLOOR, cube()), 1e6, None),
        (SOFT, None, None),  # springs of its own
        (rigid(FLOOR, ball()), None, "these settings give no kn"),
        (rigid(FLOOR, cube(spin=X)), 1e6, "spins at a prescribed rate"),
        (rigid(FLOOR, ball(), ball(2.0)), 1e6, "between one body and one wall only"),
        (rigid(FLOOR, Wall(-X, X), ball()), 1e6, "between one body and one wall only"),
        (rigid(ball()), 1e6, None),
        (rigid(FLOOR, ball(0.1)), 1e6, "is 0.1 m off its wall"),
        (rigid(FLOOR, ball(0.4e-9)), 1e6, None),
        (rigid(FLOOR, ball(0.6e-9)), 1e6, "off its wall"),
        (rigid(FLOOR, ball(-0.1)), 1e6, "is -0.1 m off its wall"),
        (rigid(FLOOR, ball(velocity=(X - 0.1 * Z)[None])), 1e6, "at -0.1 m/s"),
        (rigid(FLOOR, ball(velocity=(X + 0.8e-9 * Z)[None])), 1e6, None),
        (rigid(FLOOR, ball(velocity=(X + 1.2e-9 * Z)[None])), 1e6, "at 1.2e-09 m/s"),
        (rigid(RISEN, ball(velocity=SPEED * Z[None])), 1e6, None),
        (rigid(RISEN, ball(velocity=(X + (SPEED + 1.5e-9) * Z)[None])), 1e6, None),
        (rigid(RISEN, ball(velocity=(X + (SPEED + 2.5e-9) * Z)[None])), 1e6, "at 2.5e-09 m/s"),
        (rigid(RISEN, ball()), 1e6, f"at {-SPEED:.3g} m/s"),
        (rigid(FLOOR, ball(free=FREE_BUT_UP)), 1e6, "locked along the normal"),
        (rigid(FLOOR, ball(free=~FREE_BUT_UP)), 1e6, None),
        (rigid(FLOOR, ball(free=np.zeros((1, 3), bool))), 1e6, "locked along the normal"),
    ],
)
def test_springs_stand_in_for_what_rests_or_slides_on_one_wall(
    scene: Scene, kn: float | None, words: str | None
) -> None:
    why = why_no_spring_scene(asked(scene, kn))
    assert (why is None) is (words is None), why
    assert words is None or words in (why or "")


def test_blocks_that_may_meet_are_refused_and_blocks_far_apart_are_not() -> None:
    """Each may move by 1 m within the duration of the ask."""
    one = cube(velocity=10.0 * X)
    for gap, meet in ((1.9, True), (2.1, False)):
        beside = dataclasses.replace(one, name="other", vertices=one.vertices + (1.0 + gap) * X)
        why = why_no_spring_scene(asked(rigid(FLOOR, one, beside)))
        assert ("may touch each other" in (why or "")) is meet
        assert meet or why is None


def test_springs_and_spheres_stand_in_with_a_note_of_each() -> None:
    both = spring_scene(asked(rigid(FLOOR, cube(load=5.0 * X), mu=0.5)))
    assert both.terms == {Term.BLOCK, Term.RIGID_CONTACT}
    assert both.notes == (
        "a sphere of its mass stands for a block that cannot turn",
        f"springs kn = 1e+06, ks = {SHEAR * 1e6:g} N/m, charged as rigid contact is at t = 0",
    )
    assert both.charged is not None
    assert both.charged[0] == pytest.approx(-5.0 * X)
    assert (both.scene.contact.kn, both.scene.contact.ks) == (1e6, SHEAR * 1e6)
    assert not both.scene.blocks


def test_what_has_springs_or_no_wall_is_not_charged() -> None:
    soft = spring_scene(asked(SOFT))
    assert (soft.scene, soft.charged, soft.terms, soft.notes) == (SOFT, None, frozenset(), ())
    alone = spring_scene(asked(rigid(ball())))
    assert alone.charged is None
    assert alone.terms == {Term.RIGID_CONTACT}
    assert alone.scene.contact.kn == 1e6
    without = spring_scene(asked(rigid(FLOOR, ball()), None))
    assert without.scene.contact.rigid
    assert without.notes == ()
    of_springs = dataclasses.replace(rigid(FLOOR, cube()), contact=Contact(1e3))
    block = spring_scene(asked(of_springs))
    assert block.charged is None
    assert len(block.notes) == 1
    assert block.terms == {Term.BLOCK}


def test_rotations_are_locked_of_blocks_only() -> None:
    turning = cube(free_spin=np.array([False, True, False]))
    ask = asked(rigid(FLOOR, turning, cube()))
    assert not any(one.free_spin.any() for one in without_rotations(ask).scene.blocks)
    still = asked(rigid(FLOOR, cube()))
    assert without_rotations(still) is still


def test_a_lock_is_told_from_a_wall_s_normal_in_any_axes() -> None:
    axes = rotation_about_z(0.3)[[2, 0, 1]]
    for free, refused in (([True, False, True], False), ([False, True, True], True)):
        one = ball(free=np.array([free]))
        why = why_no_spring_scene(asked(rigid(FLOOR, one, axes=axes)))
        assert (why is not None) is refused


def test_what_stands_in_is_worked_out_once_for_all_codes_and_schemes_that_ask() -> None:
    turning = rigid(FLOOR, cube(free_spin=np.ones(3, bool)))
    coarse, fine = asked(turning), asked(turning, kn=1e7)
    assert without_rotations(coarse).scene is without_rotations(fine).scene
    for ask in (coarse, fine):
        assert spring_scene(without_rotations(ask)) is spring_scene(without_rotations(ask))
