"""Claims, without YADE, that it is given what a scene says of spheres, walls and their motions."""

from __future__ import annotations

import ast
import dataclasses
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from adapters.yade import ADAPTER
from adapters.yade.terms.walls import wall_body
from tests.support.adapters.small_asks import DT, FREE, UP, ball, ball_ask, case_ask
from tests.support.adapters.yade_asks import HALF_STEP, PLAIN, plan_of, sphere_of
from vv.ask import Displacement, Observable, Reaction
from vv.scene import Contact, Harmonic, Spheres, Wall, rotation_about_z


def test_velocities_start_half_a_step_early() -> None:
    ask = case_ask("T2")
    spheres, eta = ask.scene.spheres, ask.scene.eta
    v0, m = spheres.velocity[1, 1], spheres.mass[1]
    assert sphere_of(ask)["velocity"][1] == pytest.approx(v0 * (1 + eta / m * DT / 2), rel=1e-15)


@pytest.mark.parametrize("scheme", [PLAIN, HALF_STEP])
def test_a_push_gives_a_touching_sphere_the_speed_it_would_have_after_a_step(scheme: str) -> None:
    ask = case_ask("T4")
    eta, m, v0 = ask.scene.eta, ask.scene.spheres.mass[0], ask.scene.spheres.velocity[0, 1]
    given = sphere_of(ask, scheme)
    early = v0 + eta * v0 / m * DT / 2
    assert given["velocity"] == [0.0, 0.0, 0.0]
    after = early - eta * early / given["mass"] * DT
    assert given["push"][1] / given["mass"] * DT == pytest.approx(after, rel=1e-14)


def early_on_dashpots(*bodies: Spheres | Wall) -> list[float]:
    ask = ball_ask(*bodies, body=1)
    viscous = dataclasses.replace(ask.scene, contact=Contact(1e6, eta_n=40.0))
    return list(sphere_of(dataclasses.replace(ask, scene=viscous))["velocity"])


def test_velocities_half_a_step_early_know_the_dashpots_of_what_touches() -> None:
    falling = ball(position=[[0, 0.1, 0]], velocity=[[0, -3.0, 0]])
    assert early_on_dashpots(UP, falling)[1] == pytest.approx(-3.0 - 40.0 * 3.0 / 2.0 * DT / 2)
    meeting = ball(position=[[0.1999, 0, 0]], velocity=[[-3.0, 0, 0]])
    push = 1e6 * 1e-4 + 40.0 * 3.0
    assert early_on_dashpots(ball(), meeting)[0] == pytest.approx(-3.0 - push / 2.0 * DT / 2)


def test_no_dashpot_pulls_at_the_start() -> None:
    leaving = ball(position=[[0.1999, 0, 0]], velocity=[[30.0, 0, 0]])
    assert early_on_dashpots(ball(), leaving)[0] == pytest.approx(30.0)


def test_without_friction_or_overlap_nothing_is_pushed() -> None:
    assert sphere_of(case_ask("T1"))["push"] == [0.0, 0.0, 0.0]
    apart = ball_ask(UP, ball(position=[[0, 0.2, 0]], velocity=[[1, 0, 0]]))
    assert sphere_of(apart)["push"] == [0.0, 0.0, 0.0]


@pytest.mark.shows("with a dashpot there is a force, and the slip would stay")
def test_what_only_touches_is_pushed_where_a_dashpot_would_let_it_keep_a_slip() -> None:
    """Its own push by the dashpot at t = 0, which YADE finds at rest, is part of the impulse."""
    falling = ball(position=[[0, 0.1, 0]], velocity=[[1.0, -3.0, 0]])
    ask = ball_ask(UP, falling, body=1)
    law = Contact(1e6, 1e6, 0.5, 40.0)
    given = sphere_of(dataclasses.replace(ask, scene=dataclasses.replace(ask.scene, contact=law)))
    assert given["velocity"] == [0.0, 0.0, 0.0]
    gained = np.array(given["push"]) / given["mass"] * DT
    slowed = 40.0 * 3.0 / 2.0 * DT / 2
    assert gained == pytest.approx(np.array([1.0, -3.0 + slowed, 0.0]), rel=1e-12)


def test_spin_of_a_touching_sphere_becomes_a_twist() -> None:
    spinning = ball(position=[[0, 0.09, 0]], spin=[[0, 0, 3]], free_spin=FREE)
    given = sphere_of(ball_ask(UP, spinning))
    assert given["spin"] == [0.0, 0.0, 0.0]
    assert given["twist"][2] * DT / given["inertia"] == pytest.approx(3.0, rel=1e-15)


def test_only_half_step_mass_changes_the_mass_and_then_not_the_weight() -> None:
    ask = ball_ask(ball(), gravity=np.array([0.0, -9.81, 0.0]), eta=3.0)
    plain, half = plan_of(ask, PLAIN), plan_of(ask, HALF_STEP)
    assert (plain["bodies"][0]["mass"], plain["gravity"][1]) == (2.0, -9.81)
    assert half["bodies"][0]["mass"] == 2.0 + 3.0 * DT / 2
    assert half["gravity"] == [0.0, 0.0, 0.0]
    assert half["bodies"][0]["force"][1] == -9.81 * 2.0


def test_schemes_agree_on_a_scene_without_drag() -> None:
    assert plan_of(case_ask("T3"), PLAIN) == plan_of(case_ask("T3"), HALF_STEP)


def test_locks_become_blocked_freedoms() -> None:
    given = sphere_of(ball_ask(ball(free=[[True, False, True]], free_spin=[[False, True, False]])))
    assert given["blocked"] == "yXZ"


def test_bodies_keep_the_order_of_the_scene() -> None:
    kinds = [body["kind"] for body in plan_of(case_ask("T3-swapped"), PLAIN)["bodies"]]
    assert kinds == ["sphere", "wall"]


def test_the_frame_given_reaches_yade() -> None:
    bodies = plan_of(case_ask("T3-rotated"), PLAIN)["bodies"]
    scene = case_ask("T3-rotated").scene
    assert bodies[0]["kind"] == "facet"
    assert bodies[0]["normal"] == scene.walls[0].normal.tolist()
    assert bodies[1]["initial"] == scene.spheres.velocity[0].tolist()
    assert bodies[1]["blocked"] == "zXYZ"


@given(st.floats(0.01, 3.1), st.floats(0.01, 3.1))
def test_a_facet_lies_in_the_plane_of_its_wall_about_its_point(tilt: float, turn: float) -> None:
    normal = np.array([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)])
    corners = np.array(wall_body(Wall(np.array([1.0, 2.0, 3.0]), normal), 10.0)["corners"])
    assert np.abs(corners @ normal).max() < 1e-14
    assert np.abs(corners.sum(axis=0)).max() < 1e-14
    assert np.linalg.norm(corners, axis=1) == pytest.approx([10.0] * 3)


@pytest.mark.parametrize("scheme", [PLAIN, HALF_STEP])
def test_a_file_carries_every_number_exactly(scheme: str) -> None:
    given = plan_of(case_ask("T4-rotated"), scheme)
    assert json.loads(json.dumps(given)) == given


def test_contacts_expected_at_the_start_are_counted() -> None:
    assert plan_of(case_ask("T1"), PLAIN)["contacts"] == 0
    assert plan_of(case_ask("T3"), PLAIN)["contacts"] == 1
    assert plan_of(ball_ask(ball(), ball(position=[[0, 0.15, 0]])), PLAIN)["contacts"] == 1
    held = ball(free=~FREE)
    assert (
        plan_of(ball_ask(held, ball(position=[[0, 0.15, 0]], free=~FREE)), PLAIN)["contacts"] == 0
    )


@given(st.floats(0.1, 50.0), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_a_driven_wall_is_where_it_must_be_after_every_step(
    f: float, phase: float, turn: float
) -> None:
    motion = Harmonic(
        np.array([0.2, 0.0, 0.1]), np.full(3, f), np.full(3, phase), rotation_about_z(turn)
    )
    wall = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]), motion)
    above = ball(position=[[0, 0, 0.5]])
    given = plan_of(ball_ask(wall, above, body=1), PLAIN)["bodies"][0]["motion"]
    steps, place = np.arange(50), np.zeros(3)
    for sine in given:  # YADE: v = -A w sin(wt + fi) for a whole step
        rate = 2 * np.pi * sine["f"]
        place = (
            place - np.array(sine["A"]) * rate * DT * np.sin(rate * DT * steps + sine["fi"]).sum()
        )
    rate = 2 * np.pi * f
    moved = np.sin(rate * DT * 50 + phase) - np.sin(phase)
    assert place == pytest.approx(moved * (motion.amplitude @ motion.axes), abs=1e-12)


def test_a_shaken_sphere_starts_half_a_step_of_its_acceleration_early() -> None:
    shaking = Harmonic(np.array([4.0, 0.0, 0.0]), np.full(3, 2.0), np.full(3, 0.5))
    given = sphere_of(ball_ask(ball(), shaking=shaking))
    assert given["velocity"] == pytest.approx([-4.0 * np.sin(0.5) * DT / 2, 0.0, 0.0])


def test_what_carries_a_locked_freedom_is_part_of_its_speed_and_not_of_what_acts() -> None:
    locks = np.array([[True, False, True]])
    one = ball(velocity=[[3.0, 5.0, 0.0]], free=locks)
    given = sphere_of(ball_ask(one, gravity=np.array([2.0, 7.0, 0.0])))
    assert given["velocity"] == pytest.approx([3.0 - 2.0 * DT / 2, 5.0, 0.0])
    assert given["carried"] == given["held"] == [0.0, 5.0, 0.0]
    assert given["push"] == [0.0, 0.0, 0.0]
    touching = ball(position=[[0, 0.1 - 1e-6, 0]], velocity=[[3.0, 0.0, 5.0]],
                    free=np.array([[True, True, False]]))  # fmt: skip
    pushed = plan_of(ball_ask(UP, touching, body=1), PLAIN)["bodies"][1]
    assert (pushed["velocity"], pushed["held"]) == ([0.0] * 3, [0.0] * 3)
    assert pushed["carried"] == [0.0, 0.0, 5.0]


@pytest.mark.parametrize(
    ("seen", "told"),
    [
        ((Displacement(0),), False),
        ((Reaction(0),), True),
        ((Displacement(0), Reaction(0)), True),
        ((Reaction(0), Displacement(0)), True),
    ],
)
def test_reactions_cost_one_step_more_and_are_said_to(
    seen: tuple[Observable, ...], told: bool
) -> None:
    held = ball_ask(ball(free=np.array([[True, False, True]])))
    note = ADAPTER.describe(dataclasses.replace(held, observables=seen), PLAIN).note
    assert ("reactions from the forces of one step more" in note) is told


def test_an_exported_script_is_the_driver_with_the_ask_filled_in() -> None:
    ask = case_ask("T4-rotated")
    tree = ast.parse(ADAPTER.native(ask, HALF_STEP))
    written = next(n for n in tree.body if isinstance(n, ast.AnnAssign))
    assert written.value is not None
    assert ast.literal_eval(written.value) == plan_of(ask, HALF_STEP)
