"""Claims, without LIGGGHTS, that a deck holds what a scene says of its spheres and walls."""

from __future__ import annotations

import dataclasses
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from adapters.liggghts.deck import silent_deck
from adapters.liggghts.setup import set_up
from adapters.liggghts.space import triangle
from tests.support.adapters.liggghts_asks import HALF_STEP, PLAIN, ball, ball_ask, deck_of, words
from tests.support.adapters.small_asks import DT, UP, case_ask
from vv.ask import Ask
from vv.scene import Contact, Harmonic, Wall, rotated, rotation_about_z
from vv.standins.penalty_springs import acceleration_of

NUMBER = st.floats(-1e3, 1e3)


@given(st.tuples(NUMBER, NUMBER, NUMBER), st.floats(1e-3, 1e3), st.floats(1e-6, 1e9))
def test_a_deck_holds_the_scene_to_the_last_bit(
    place: tuple[float, ...], radius: float, mass: float
) -> None:
    sphere = ball(position=[place], radius=[radius], mass=[mass], velocity=[place])
    ask = ball_ask(sphere)
    scene = dataclasses.replace(ask.scene, contact=Contact(mass))
    text = deck_of(dataclasses.replace(ask, scene=scene), PLAIN)
    assert float(words(text, "fix", "kn")[0][-1]) == mass
    ((created,), (sizes, *_)) = words(text, "create_atoms"), words(text, "set", "atom")
    assert [float(word) for word in created[2:5]] == list(place)
    assert (float(sizes[2]) / 2, float(sizes[4])) == (radius, mass)
    speeds = [dict(zip(w[1::2], w[2::2], strict=True)) for w in words(text, "set", "atom")][1:]
    assert [float(s[f"v{a}"]) for s in speeds for a in "xyz"] == [*place] * any(place)


def test_a_sphere_has_its_own_velocity_and_spin_behind_spheres_at_rest() -> None:
    places = [[0.0, 0.1, 0.0]], [[1.0, 0.1, 0.0]], [[2.0, 0.1, 0.0]]
    moving = ball(position=places[1], velocity=[[0.5, 0.0, -2.0]])
    spinning = ball(position=places[2], spin=[[3.0, 4.0, 5.0]])
    text = deck_of(ball_ask(ball(position=places[0]), moving, spinning), PLAIN)
    started = [line for line in words(text, "set", "atom") if "diameter" not in line]
    assert started == [
        ["2", "vx", "0.5", "vy", "0.0", "vz", "-2.0"],
        ["3", "omegax", "3.0", "omegay", "4.0", "omegaz", "5.0"],
    ]


def test_kn_and_ks_are_the_springs_and_nothing_is_damped() -> None:
    text = deck_of(case_ask("T3"), PLAIN)
    given = {line[0]: float(line[-1]) for line in words(text, "fix") if "property/global" in line}
    assert given == {"kn": 5.5e9, "kt": 5.5e9, "gamman": 0, "gammat": 0, "coefficientFriction": 0.1}
    assert text.count("tangential history") == 2
    assert text.count("tangential_damping off") == 2
    assert "history" not in silent_deck(set_up(case_ask("T1"), PLAIN))


def test_neighbours_are_sought_in_every_step_only_where_spheres_that_rub_may_meet_again() -> None:
    def sought(ask: Ask) -> list[str]:
        return words(deck_of(ask, PLAIN), "neigh_modify")[0]

    pair = ball_ask(ball(), ball(position=[[0.1, 0.2, 0.1]]))
    smooth = dataclasses.replace(pair, scene=dataclasses.replace(pair.scene, contact=Contact(1e6)))
    assert sought(pair)[:6] == ["delay", "0", "every", "1", "check", "no"]
    for other in (smooth, ball_ask(ball()), case_ask("T3-rotated"), case_ask("T4")):
        assert "every" not in sought(other)


@pytest.mark.parametrize(("aside", "sought"), [(2.5e-13, True), (1e-13, False)])
def test_a_pair_locked_along_its_line_meets_again_if_it_is_out_of_line_by_more_than_rounding(
    aside: float, sought: bool
) -> None:
    """A millionth of a millionth of 0.199 m."""
    across = np.array([[False, True, False]])
    pair = ball(free=across), ball(position=[[0.199, 0.1 + aside, 0.0]], free=across)
    first = dataclasses.replace(pair[0], position=np.array([[0.0, 0.1, 0.0]]))
    (line,) = words(deck_of(ball_ask(first, pair[1]), PLAIN), "neigh_modify")
    assert ("every" in line) is sought


def test_ids_follow_the_order_of_spheres_and_locks_come_last() -> None:
    fixed_last = deck_of(case_ask("T1-swapped"), PLAIN)
    assert words(fixed_last, "group", "shifted") == [["id", "1"]]
    wall_first = deck_of(case_ask("T4"), PLAIN)
    assert words(wall_first, "variable", "o0y") == [["equal", "y[1]-(0.0)"]]
    fixes = [line[2] for line in words(wall_first, "fix")]
    assert fixes[-5:] == ["wall/gran", "nve", "viscous", "setforce", "print"]
    assert words(wall_first, "fix", "lock_xz")[0][-3:] == ["0", "NULL", "0"]


def test_a_raised_mass_leaves_the_weight_as_it_was() -> None:
    ask = ball_ask(ball(load=[[3, 0, 0]]), eta=40.0, gravity=np.array([0, -10.0, 0]))
    plain, raised = deck_of(ask, PLAIN), deck_of(ask, HALF_STEP)
    assert float(words(plain, "set", "atom", "1")[0][-1]) == 2.0
    assert words(plain, "fix", "weight", "all", "gravity")[0] == [
        "10.0",
        "vector",
        "0.0",
        "-1.0",
        "0.0",
    ]
    assert float(words(raised, "set", "atom", "1")[0][-1]) == 2.0 + 40.0 * DT / 2
    assert not words(raised, "fix", "weight")
    assert words(raised, "fix", "load0", "load0", "addforce") == [["3.0", "-20.0", "0.0"]]
    assert silent_deck(set_up(case_ask("T3"), PLAIN)) == silent_deck(
        set_up(case_ask("T3"), HALF_STEP)
    )


def test_a_wall_across_an_axis_is_a_plane_and_an_oblique_one_a_mesh_the_deck_writes() -> None:
    quarter = ball_ask(ball(), UP)
    quarter = dataclasses.replace(
        quarter, scene=rotated(quarter.scene, rotation_about_z(np.pi / 2))
    )
    assert "primitive type 1 xplane" in deck_of(quarter, PLAIN)
    ask = case_ask("T3-rotated")
    text = deck_of(ask, PLAIN)
    corners = np.array([v.split() for v in re.findall(r'print "vertex (.*?)"', text)], float)
    across = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    normal = ask.scene.walls[0].normal
    assert across / np.linalg.norm(across) == pytest.approx(normal, abs=1e-15)
    assert text.index("endsolid wall") < text.index("mesh/surface file wall0.stl")
    assert words(text, "fix", "load0")  # the load that stands for the lock


def test_all_meshes_share_a_command_as_liggghts_wants() -> None:
    ask = case_ask("T3-rotated")
    further = Wall(np.full(3, -99.0), np.array([0.6, 0.0, 0.8]))
    scene = dataclasses.replace(ask.scene, bodies=(*ask.scene.bodies, further))
    text = deck_of(dataclasses.replace(ask, scene=scene), PLAIN)
    (meshes,) = words(text, "fix", "meshes")
    assert meshes[-6:-2] == ["2", "meshes", "wall0_mesh", "wall1_mesh"]


@given(st.tuples(NUMBER, NUMBER, NUMBER), st.tuples(NUMBER, NUMBER, NUMBER), st.floats(0.1, 100))
def test_a_triangle_is_larger_than_its_plane_s_cut_with_a_box(
    point: tuple[float, ...], along: tuple[float, ...], reach: float
) -> None:
    normal = np.array(along) + np.array([0, 0, 2e3])
    wall = Wall(np.array(point), normal / np.linalg.norm(normal))
    a, b, c = triangle(wall, np.full(3, -reach), np.full(3, reach))
    ends = reach * np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, 8).T
    for start, end in ((a, b), (b, c), (c, a)):
        assert (np.cross(end - start, ends - start) @ wall.normal > 0).all()
    assert np.abs((np.array([a, b, c]) - point) @ wall.normal).max() < 1e-9


def valued(text: str, name: str, step: int) -> float:
    """A variable of a deck at a step."""
    (formula,) = (line[2] for line in words(text, "variable") if line[0] == name)
    known = {"PI": np.pi, "step": step, "sin": np.sin, "cos": np.cos}
    return float(eval(formula, {"__builtins__": {}}, known))


@given(st.floats(0.1, 50.0), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
@settings(max_examples=30)
def test_a_mesh_is_where_it_must_be_after_every_step(f: float, phase: float, turn: float) -> None:
    motion = Harmonic(
        np.array([0.2, 0.0, 0.1]), np.full(3, f), np.full(3, phase), rotation_about_z(turn)
    )
    wall = Wall(np.zeros(3), np.array([0.0, 1.0, 0.0]), motion)
    text = deck_of(ball_ask(wall, ball(), body=1), PLAIN)
    speeds = [[valued(text, f"wall0_v_{a}", n) for a in "xyz"] for n in range(1, 51)]
    moved = np.sin(2 * np.pi * f * DT * 50 + phase) - np.sin(phase)
    place = DT * np.sum(speeds, axis=0)
    assert place == pytest.approx(moved * (motion.amplitude @ motion.axes), abs=1e-12)


def test_a_body_acceleration_is_a_force_on_the_scene_s_masses() -> None:
    shaking = Harmonic(
        np.array([5.0, 0.0, 2.0]), np.full(3, 3.0), np.full(3, 0.4), rotation_about_z(0.7)
    )
    ask = ball_ask(ball(), shaking=shaking, eta=40.0)
    for scheme in (PLAIN, HALF_STEP):
        text = deck_of(ask, scheme)
        force = [valued(text, f"shake0_{a}", 70) for a in "xyz"]
        assert force == pytest.approx(2.0 * acceleration_of(shaking, 70 * DT), rel=1e-12)


def test_the_box_holds_the_longest_free_path() -> None:
    ask = ball_ask(ball(velocity=[[0, 300, 0]]), gravity=np.array([0, 0, -1e3]))
    room = set_up(ask, PLAIN).room
    assert room.high[1] > 0.1 + 30.0
    assert (room.outer[0] < room.low).all()
    assert (room.high < room.outer[1]).all()
