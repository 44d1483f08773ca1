"""Claims about clumps that represent blocks: their mass, and the shares of corners in the load."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.scenes.blocks.block_scenes import DOWN, FLOOR, box, incline, responding
from vv.ask import Ask, Displacement, History, Knobs
from vv.scene import (
    Contact,
    Harmonic,
    Pulse,
    Scene,
    Term,
    initial_normal_forces,
    rotated,
    rotation_about_z,
)
from vv.standins.clump import Clump, clumps
from vv.standins.clump import words as told
from vv.standins.stand_in import SHEAR, SpringScene, spring_scene, without_rotations
from vv.standins.why_no_clump import _unlike, why_no_clump

KN = 1e9
HELD, FREE = np.zeros(3, bool), np.ones(3, bool)
SIDES = st.tuples(*[st.floats(0.2, 2.0)] * 3)


def asked(scene: Scene, kn: float | None = KN) -> Ask:
    return Ask(scene, History(1.0, 0.1), (Displacement(1),), Knobs(1e-4, kn))


def springs_of(ask: Ask) -> SpringScene:
    return spring_scene(without_rotations(ask))


def clumped(ask: Ask) -> Clump:
    (made,) = clumps(ask, springs_of(ask))
    return made


def turned(scene: Scene, angle: float) -> Scene:
    return rotated(
        scene, rotation_about_z(angle) @ np.array([[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]])
    )


@given(SIDES, st.floats(0, 6.3))
def test_points_have_the_mass_centre_and_inertia_of_the_block(
    half: tuple[float, ...], angle: float
) -> None:
    scene = turned(incline(20.0, 30.0, half=half, free_spin=HELD), angle)
    made, block = clumped(asked(scene)), scene.blocks[0]
    arms = made.points - made.points.mean(axis=0)
    inertia = block.mass / 8 * ((arms**2).sum() * np.eye(3) - arms.T @ arms)
    assert inertia == pytest.approx(block.inertia, rel=1e-9, abs=1e-12 * block.mass)
    place = springs_of(asked(scene)).scene.spheres.position[0]
    assert made.points.mean(axis=0) == pytest.approx(place, abs=1e-12)


@given(SIDES, st.floats(0, 6.3), st.sampled_from([(15.0, 0.0), (30.0, 0.0), (15.0, -0.3)]))
def test_corners_press_and_rub_as_much_as_the_block_and_turn_it_nowhere(
    half: tuple[float, ...], angle: float, law: tuple[float, float]
) -> None:
    phi, v0 = law
    half = (2 * half[0] + half[2], *half[1:])  # low enough not to tip
    ask = asked(turned(incline(20.0, phi, v0=v0, half=half), angle))
    made, (wall,), block = clumped(ask), ask.scene.walls, ask.scene.blocks[0]
    overlap = made.radius - (made.corners - wall.point) @ wall.normal
    pressed = KN / 4 * np.outer(overlap, wall.normal)
    springs = springs_of(ask)
    (normal,), charged = initial_normal_forces(springs.scene), springs.charged
    assert charged is not None
    assert pressed.sum(axis=0) == pytest.approx(normal, rel=1e-6, abs=1e-6 * block.mass)
    assert made.friction.sum(axis=0) == pytest.approx(charged[0], abs=1e-9 * block.mass)
    touched = made.corners - (made.radius - overlap)[:, None] * wall.normal
    moment = np.cross(touched - block.centroid(), pressed + made.friction).sum(axis=0)
    assert np.abs(moment).max() < 1e-4 * block.mass  # overlaps are no part of the arms
    assert why_no_clump(ask) is None


def test_a_block_that_cannot_turn_presses_alike_on_all_corners() -> None:
    made = clumped(asked(incline(20.0, 30.0, half=(0.2, 0.3, 0.9), free_spin=HELD)))
    pressed = made.forces @ made.normal
    assert pressed / pressed.sum() == pytest.approx([0.25] * 4, rel=1e-15)


def leaning(angle: float) -> Scene:
    """A block with sides of 0.4, 0.6 and 1.2 m that rests on an edge, raised by an angle [rad]."""
    flat = incline(0.0, 60.0, half=(0.2, 0.3, 0.6))
    c, s = np.cos(angle), np.sin(angle)
    block = rotated(flat, np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])).blocks[0]
    low = (block.vertices @ flat.walls[0].normal).min()
    down = low - flat.walls[0].point @ flat.walls[0].normal
    lowered = dataclasses.replace(block, vertices=block.vertices - down * flat.walls[0].normal)
    return dataclasses.replace(flat, bodies=(*flat.walls, lowered))


@given(st.floats(0.02, 0.25), st.sampled_from([-1.0, 1.0]))
def test_a_block_that_leans_stands_on_its_edge_and_falls_back_on_its_sole(
    angle: float, side: float
) -> None:
    scene = leaning(side * angle)
    ask = dataclasses.replace(asked(scene), knobs=Knobs(1e-5, KN))
    assert why_no_clump(ask) is None
    made, wall, block = clumped(ask), scene.walls[0], scene.blocks[0]
    gap = (made.corners - wall.point) @ wall.normal - made.radius
    (force,) = initial_normal_forces(springs_of(ask).scene)
    assert made.touching.sum() == 2
    pressed = -KN / 4 * gap[made.touching].sum()
    assert pressed == pytest.approx(force @ wall.normal, rel=1e-4)
    assert (gap[~made.touching] > 0.3 * np.sin(angle)).all()
    # the four lie about the corners of the sole, and not about those of a side
    places = np.sort(np.linalg.norm(made.corners - block.centroid(), axis=1))
    assert places == pytest.approx([np.sqrt(0.2**2 + 0.3**2 + 0.6**2)] * 4, rel=3e-3)
    across = made.corners - made.corners.mean(axis=0)
    assert np.linalg.norm(across, axis=1) == pytest.approx([np.hypot(0.2, 0.3)] * 4, rel=3e-3)


def test_what_no_clump_stands_for_is_refused_with_the_reason() -> None:
    flat = responding((0.2, 0, 0), (2.0, 2.0, 2.0), 0.6)
    beside = dataclasses.replace(
        flat.blocks[0], vertices=flat.blocks[0].vertices + 1.5 * np.eye(3)[0]
    )
    two = dataclasses.replace(flat, bodies=(*flat.bodies, beside))
    soft = dataclasses.replace(flat, contact=Contact(1e8, 1e8, 0.6))
    tilt = np.array([[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]])
    block = rotated(flat, tilt).blocks[0]
    low = (block.vertices @ np.array([0, 0, 1])).min()
    edge = dataclasses.replace(block, vertices=block.vertices - [0, 0, low], free_spin=HELD)
    spinning = dataclasses.replace(flat.blocks[0], spin=np.array([0.0, 0.0, 1.0]))
    scenes = {
        "begins to tip as it slides": incline(28.0, 40.0, v0=0.1, half=(0.1, 0.1, 0.5)),
        "may touch each other": two,
        "a block on one wall": dataclasses.replace(flat, bodies=(*flat.bodies, flat.walls[0])),
        "share the stiffness": soft,
        "stands on no face, but on 2 corners": dataclasses.replace(
            flat, bodies=(*flat.walls, edge)
        ),
        "moves on an edge": dataclasses.replace(
            leaning(0.1),
            bodies=(
                *leaning(0.1).walls,
                dataclasses.replace(leaning(0.1).blocks[0], velocity=np.array([0.1, 0, 0])),
            ),
        ),
        "spins": dataclasses.replace(flat, bodies=(*flat.walls, spinning)),
    }
    for words, scene in scenes.items():
        assert words in (why_no_clump(asked(scene)) or ""), words
    assert "these settings give no kn" in (why_no_clump(asked(flat, None)) or "")
    assert "lets a corner sink by" in (why_no_clump(asked(flat, 1e5)) or "")
    assert Term.ROTATION in flat.terms()
    assert why_no_clump(asked(flat)) is None


def on_floor(mu: float, **given_block: object) -> Scene:
    """A cube of 1 m and 1000 kg on a floor; it may move vertically, turn about y, and is shaken."""
    up, about = np.array([False, False, True]), np.array([False, True, False])
    one = box("one", [0.0, 0.0, 0.5], [0.5] * 3, **{"free": up, "free_spin": about, **given_block})
    wave = Harmonic(np.array([1.0, 0.0, 0.0]), np.ones(3))
    return Scene((FLOOR, one), Contact(np.inf, mu=mu), gravity=DOWN, shaking=Pulse(wave, 0.5))


@pytest.mark.parametrize(("mu", "stiff"), [(0.0, 0.25), (0.6, 0.25 + SHEAR * 0.49**2)])
def test_a_step_too_long_for_the_springs_of_corners_is_refused(mu: float, stiff: float) -> None:
    """Turning by a on arms of half a metre, with springs kn and SHEAR kn; spheres are 1 cm high.

    The inertia is m/6; the step is at most 2 over the largest angular frequency.
    """
    longest = 2.0 / np.sqrt(max(1.0, 6 * stiff) * KN / 1000.0)
    for part, words in ((0.99, ""), (1.01, "stable up to")):
        ask = dataclasses.replace(asked(on_floor(mu)), knobs=Knobs(part * longest, KN))
        assert words in (why_no_clump(ask) or "none")
        assert bool(words) is (why_no_clump(ask) is not None)


def test_only_what_rocks_is_bound_to_that_step() -> None:
    long = Knobs(1.0, KN)
    one = on_floor(0.6)
    alone = dataclasses.replace(one, shaking=None)
    assert why_no_clump(dataclasses.replace(asked(alone), knobs=long)) is None
    held = on_floor(0.6, free_spin=HELD)
    assert why_no_clump(dataclasses.replace(asked(held), knobs=long)) is None
    beside = box("two", [99.0, 0.0, 0.5], [0.5] * 3, free=one.blocks[0].free,
                 free_spin=one.blocks[0].free_spin)  # fmt: skip
    two = dataclasses.replace(alone, bodies=(*alone.bodies, beside))
    why = why_no_clump(Ask(two, History(1e-3, 1e-3), (Displacement(1),), long))
    assert "stable up to" in (why or "")


def test_a_spring_so_soft_that_a_corner_sinks_is_refused_with_how_far() -> None:
    why = why_no_clump(asked(on_floor(0.6), 1e5))
    assert why == (
        "kn = 100000 N/m lets a corner sink by 0.0981 m at t = 0, through its sphere of 0.01 m"
    )


def test_blocks_that_stand_on_unlike_numbers_of_corners_are_refused() -> None:
    one, other = (clumped(asked(on_floor(0.6))) for _ in range(2))
    assert _unlike((one, other)) is None
    fewer = dataclasses.replace(other, corners=other.corners[:3])
    assert "stand on 4 and 3 corners" in (_unlike((one, fewer)) or "")


def test_a_clump_says_what_it_is_made_of_and_of_how_many_it_is_the_first() -> None:
    made = clumped(asked(on_floor(0.6)))
    assert made.words.startswith("4 spheres of 0.01 m on its corners")
    assert told([made], "a clump") == f"a clump stands for the block: {made.words}"
    assert told([made, made], "a clump").startswith("a clump stands for each of 2 blocks: of the")


def slow(phi: float, v0: float, dt: float) -> Ask:
    """A plate with free rotation on a slope of 20 degrees, thrown down the slope."""
    scene = incline(20.0, phi, v0=v0, half=(0.5, 0.5, 0.1))
    return Ask(scene, History(1.0, 0.1), (Displacement(1),), Knobs(dt, KN))


@pytest.mark.parametrize(
    ("phi", "v0", "dt", "refused"),
    [
        (30.0, 0.1, 1e-3, True),  # it stops
        (30.0, 0.1, 1e-5, False),
        (30.0, 0.0, 1e-3, False),  # it rests, on springs that are charged
        (15.0, 0.1, 1e-3, False),  # it slides on
    ],
)
def test_a_block_that_friction_stops_needs_a_step_that_its_springs_bear(
    phi: float, v0: float, dt: float, refused: bool
) -> None:
    reason = why_no_clump(slow(phi, v0, dt))
    assert (reason is not None and "its corners are stable up to" in reason) == refused


def test_a_slide_must_be_long_beside_what_the_shared_springs_give() -> None:
    """Friction stops it within V^2/(2 a); the four corners together stretch by mu N/(25 kn)."""
    scene = incline(5.0, 30.0, v0=0.1, half=(0.5, 0.5, 0.1))
    (block,), tilt = scene.blocks, np.radians(5.0)
    weight, mu = block.mass * np.linalg.norm(scene.gravity), scene.contact.mu
    rubs = mu * weight * np.cos(tilt)
    way = 0.5 * block.mass * 0.1**2 / (rubs - weight * np.sin(tilt))
    for part, refused in ((0.99, True), (1.01, False)):
        kn = part * rubs / (SHEAR * 0.02 * way)
        step = Knobs(1e-2 * np.sqrt(block.mass / (SHEAR * kn)), float(kn))
        why = why_no_clump(Ask(scene, History(1.0, 0.1), (Displacement(1),), step))
        assert (
            why is not None and "2 % of the distance in which friction stops it" in why
        ) == refused
