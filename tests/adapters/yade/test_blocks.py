"""Claims, without YADE, about what stands for a block: a sphere, a clump or a polyhedron."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from adapters.yade import ADAPTER
from adapters.yade.polyhedra import _area, _no_face, _too_long
from adapters.yade.setup import set_up
from tests.scenes.blocks.sliding_blocks import Frame, incline, responding
from tests.support.adapters.small_asks import DT, block_ask, case_ask
from tests.support.adapters.yade_asks import CLUMP, PLAIN, POLYHEDRA, plan_of
from vv.ask import History, Knobs
from vv.scene import Wall, box_geometry
from vv.standins.stand_in import spring_scene


def test_a_clump_has_the_sphere_s_springs_and_the_rotations_of_the_block() -> None:
    scene = incline(Frame(28.0), 15.0)
    turning = dataclasses.replace(scene.blocks[0], free_spin=np.array([False, True, False]))
    for block, blocked in ((scene.blocks[0], "XYZ"), (turning, "XZ")):
        ask = block_ask(dataclasses.replace(scene, bodies=(*scene.walls, block)))
        assert ADAPTER.refuses(ask, CLUMP) is None
        given, alone = plan_of(ask, CLUMP), plan_of(block_ask(scene), PLAIN)
        assert (4 * given["kn"], 4 * given["ks"]) == (alone["kn"], alone["ks"])
        forces = np.array(given["charged"][0]["forces"])
        assert forces.sum(axis=0) == pytest.approx(alone["charged"][0]["forces"][0])
        clump, sphere = given["bodies"][1], alone["bodies"][1]
        assert clump["blocked"] == blocked
        assert [clump[name] for name in ("mass", "push", "force")] == [
            sphere[name] for name in ("mass", "push", "force")
        ]
        assert ADAPTER.describe(ask, CLUMP).unknowns == 6 - len(blocked)


@given(st.floats(0.0, 40.0), st.floats(0.0, 6.3), st.floats(10.0, 40.0))
def test_a_polyhedron_lies_level_and_is_charged_by_its_first_step(
    alpha: float, turn: float, phi: float
) -> None:
    ask = block_ask(incline(Frame(alpha, turn), phi, A=2.0, v0=0.1))
    setup = set_up(ask, POLYHEDRA)
    flat, frame = setup.ask, setup.frame
    given, alone = plan_of(ask, POLYHEDRA), plan_of(flat, PLAIN)
    (wall, made), (_, sphere) = given["bodies"], alone["bodies"]
    assert (wall["kind"], wall["normal"]) == ("wall", [0.0, 0.0, 1.0])
    assert frame @ frame.T == pytest.approx(np.eye(3), abs=1e-12)
    assert flat.scene.gravity @ frame == pytest.approx(ask.scene.gravity, abs=1e-12)
    slid = np.array(made["velocity"]) * DT
    assert -given["ks"] * slid == pytest.approx(alone["charged"][0]["forces"][0], abs=1e-9)
    after = np.array(made["velocity"]) + np.array(made["push"]) / made["mass"] * DT
    assert after == pytest.approx(np.array(sphere["push"]) / sphere["mass"] * DT, abs=1e-12)
    assert given["kn"] * 1.0 * 0.6 == pytest.approx(alone["kn"], rel=1e-9)  # its face: 1 m by 0.6 m
    corners = np.array(made["vertices"]) + made["position"]
    assert corners[:, 2].min() * given["kn"] * 0.6 == pytest.approx(
        -2500.0 * 0.48 * 9.81 * np.cos(np.radians(alpha)), rel=1e-5
    )


@pytest.mark.parametrize("size", [2.0, 200.0])
@pytest.mark.parametrize(
    ("gap", "stands"), [(0.0, True), (0.9, True), (-0.9, True), (1.1, False), (-1.1, False)]
)
def test_a_face_is_on_a_wall_to_a_billionth_of_its_block(
    size: float, gap: float, stands: bool
) -> None:
    vertices, faces = box_geometry(np.zeros(3), size * np.array([0.5, 0.4, 0.25]), np.eye(3))
    low = Wall(np.array([7.0, 8.0, -size * (0.25 + gap * 1e-9)]), np.array([0.0, 0.0, 1.0]))
    block: Any = SimpleNamespace(vertices=vertices, faces=faces)
    assert _area(block, low) == pytest.approx(0.8 * size**2 if stands else 0.0)
    tilted = Wall(low.point, np.array([0.6, 0.0, 0.8]))
    assert _area(block, tilted) == 0.0


@pytest.mark.parametrize(("part", "thin"), [(0.099, True), (0.101, False)])
def test_a_block_thinner_than_a_tenth_of_its_size_may_pass_unnoticed(
    part: float, thin: bool
) -> None:
    vertices, faces = box_geometry(np.zeros(3), np.array([3.0, 2.0, 3.0 * part]), np.eye(3))
    floor = Wall(np.array([0.0, 0.0, -3.0 * part]), np.array([0.0, 0.0, 1.0]))
    block: Any = SimpleNamespace(name="thin", vertices=vertices, faces=faces)
    assert ("is thinner than" in (_no_face(block, floor) or "")) is thin
    raised = Wall(np.array([0.0, 0.0, -4.0]), np.array([0.0, 0.0, 1.0]))
    assert ("does not stand on a face" in (_no_face(block, raised) or "")) is not thin


@pytest.mark.parametrize(
    ("duration", "dt", "refused"), [(10.0, 1e-3, False), (10.01, 1e-3, True), (99.0, None, False)]
)
def test_ten_thousand_steps_of_polyhedra_are_run_and_not_more(
    duration: float, dt: float | None, refused: bool
) -> None:
    ask: Any = SimpleNamespace(goal=History(duration, 0.001), knobs=Knobs(dt))
    assert (_too_long(ask) is not None) is refused


def test_the_limits_of_polyhedra_are_refusals() -> None:
    scene = incline(Frame(20.0), 30.0)
    block = scene.blocks[0]
    long = dataclasses.replace(block_ask(scene), goal=History(100.0, 1.0))
    assert "steps with polyhedra" in (ADAPTER.refuses(long, POLYHEDRA) or "")
    turning = dataclasses.replace(block, free_spin=np.ones(3, bool))
    low = scene.walls[0].normal
    flat = block.vertices - np.outer(0.95 * (block.vertices @ low), low)
    changes = {
        "would start to rock": turning,
        "thinner than 0.1": dataclasses.replace(block, vertices=flat),
    }
    for words, changed in changes.items():
        ask = block_ask(dataclasses.replace(scene, bodies=(*scene.walls, changed)))
        assert words in (ADAPTER.refuses(ask, POLYHEDRA) or ""), words
    assert ADAPTER.refuses(block_ask(scene), POLYHEDRA) is None


def test_a_contact_starts_with_the_friction_of_rigid_contact() -> None:
    ask = block_ask(incline(Frame(28.0, turn=0.4), 15.0))
    given, springs = plan_of(ask, PLAIN), spring_scene(ask)
    assert springs.charged is not None
    assert given["charged"] == [{"wall": 0, "body": 1, "forces": springs.charged.tolist()}]
    assert (given["kn"], given["ks"]) == (1e9, springs.scene.contact.ks)
    sphere = given["bodies"][1]
    pull = np.array(ask.scene.gravity) + springs.charged[0] / sphere["mass"]
    down = Frame(28.0, turn=0.4).dip
    early = np.array(sphere["push"]) @ down / sphere["mass"] * DT
    assert early == pytest.approx(-(pull @ down) * DT / 2, rel=1e-12)
    assert plan_of(case_ask("T3"), PLAIN)["charged"] == []


def test_a_body_acceleration_is_told_in_the_frame() -> None:
    given = plan_of(block_ask(incline(Frame(20.0, turn=0.4), 30.0, A=5.0)), PLAIN)
    (sine,) = given["shaking"]
    assert sine["A"] == pytest.approx(5.0 * Frame(0.0, turn=0.4).level)
    assert (sine["f"], sine["fi"]) == (1.0, 0.0)
    assert given["bodies"][1]["shaken"] == given["bodies"][1]["mass"]


def test_blocks_that_no_sphere_stands_for_are_refused_with_the_reason() -> None:
    scene = responding(0.2, 2.0, 0.6, turn=0.3)
    assert "these settings give no kn" in (ADAPTER.refuses(block_ask(scene, None), PLAIN) or "")
    turning = dataclasses.replace(scene.blocks[0], free_spin=np.ones(3, bool))
    loose = dataclasses.replace(scene, bodies=(*scene.walls, turning))
    assert "may turn" in (ADAPTER.refuses(block_ask(loose), PLAIN) or "")


def test_a_lock_across_the_frame_along_which_the_base_shakes_is_refused() -> None:
    scene = responding(0.2, 2.0, 0.6, turn=0.3)  # the base swings along 0.3 rad
    held = dataclasses.replace(scene.blocks[0], free=np.array([True, False, True]))
    for turn, refused in ((0.3, False), (0.7, True)):
        axes = Frame(0.0, turn).axes
        locked = dataclasses.replace(scene, bodies=(*scene.walls, held), axes=axes)
        reason = ADAPTER.refuses(block_ask(locked), PLAIN)
        assert ("a dead load" in (reason or "")) is refused


def test_numpy_scalars_are_written_as_numbers() -> None:
    knobs = Knobs(np.float64(DT), np.float64(1e9))
    ask = dataclasses.replace(block_ask(incline(Frame(28.0), 15.0, A=2.0)), knobs=knobs)
    for scheme in (PLAIN, CLUMP, POLYHEDRA):
        assert "float64" not in ADAPTER.native(ask, scheme)
