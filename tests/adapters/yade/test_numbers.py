"""Claims, without YADE, about numbers given to it: walls, materials, clumps and polyhedra."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

from adapters.yade.clumps import _clump
from adapters.yade.inside import _alone
from adapters.yade.polyhedra import _area, polyhedral
from adapters.yade.setup import initial_contacts
from adapters.yade.terms import hertz
from adapters.yade.terms.walls import facet_size, walls
from tests.adapters.liggghts.test_numbers import ROOM
from tests.support.adapters.small_asks import UP, ball, ball_ask
from tests.support.adapters.yade_asks import HALF_STEP, PLAIN, plan_of, sphere_of
from tests.support.fabricated import some
from vv.scene import Contact, Harmonic, Hertz, Pulse, Wall, box_geometry


def test_a_facet_is_a_thousand_times_as_large_as_the_scene_and_its_paths() -> None:
    # 4.08 m between the wall's point and a sphere, 0.3 m of radius; 5.5 m/s, and 10 + 5 m/s2 for
    # half a second, kept up for half a second
    setup = some(springs=some(scene=ROOM), ask=some(goal=some(duration=0.5)))
    assert facet_size(setup) == pytest.approx(1e3 * (4.08 + 0.3 + (5.5 + 7.5) * 0.5))
    still = some(springs=some(scene=dataclasses.replace(ROOM, shaking=None)), ask=setup.ask)
    assert facet_size(still) == pytest.approx(1e3 * (4.08 + 0.3 + (5.5 + 5.0) * 0.5))


def test_each_kind_of_wall_is_noted_once() -> None:
    leaning = Wall(np.zeros(3), np.array([0.0, 0.6, 0.8]))
    noted: Any = some(with_more=lambda *notes: notes)
    for those, kinds in (((UP, UP), ["walls across"]), ((leaning,), ["oblique walls"]),
                         ((UP, leaning), ["walls across", "oblique walls"])):  # fmt: skip
        notes: Any = walls(noted, some(scene=some(walls=those)))
        assert [" ".join(note.split()[:2]) for note in notes] == kinds


@pytest.mark.parametrize(("until", "last"), [(0.0505, 51), (0.05, 50), (0.05 + 1.2e-9, 51)])
def test_a_pulse_ends_at_the_first_step_at_or_behind_its_end(until: float, last: int) -> None:
    pulse = Pulse(Harmonic(np.array([1.0, 0.0, 0.0]), np.ones(3)), until)
    assert plan_of(ball_ask(ball(), shaking=pulse))["ends"] == last


@pytest.mark.shows("MindlinPhys takes the effective radius of a sphere and a wall to be R/2")
def test_walls_and_facets_are_stiffer_so_that_their_contacts_are_those_of_spheres() -> None:
    law = Contact(0.0, mu=0.3, hertz=Hertz(6e9, 1.2e9, 0.25))
    ask = ball_ask(ball(position=[[0.0, 0.2, 0.0]]), UP)
    given = plan_of(dataclasses.replace(ask, scene=dataclasses.replace(ask.scene, contact=law)))
    # G/E = 0.2: Poisson's ratio 1/3, Young's modulus 2 6e9 (1 - 1/9)
    young = 12e9 * 8 / 9
    assert given["hertz"] == pytest.approx({
        "young": young, "poisson": 1 / 3, "walls_young": young * 2.4142136,
        "facets_young": young * 1.5797959, "damping": 0.25,
    })  # fmt: skip
    nothing: Any = some(scene=some(contact=Contact(1.0)))
    for put in (hertz.elastic, hertz.viscous):
        assert put("as it was", nothing) == "as it was"  # type: ignore[arg-type, comparison-overlap]


@pytest.mark.parametrize(
    ("free_spin", "blocked", "moments"),
    [
        ((True, True, True), "y", [1.0, 2.0, 4.0]),
        ((False, False, False), "yXYZ", [1.0, 2.0, 4.0]),
        ((False, True, False), "yXZ", [4.0, 1.5, 1.5]),  # about the axes of the frame
    ],
)
def test_a_clump_has_weightless_feet_eight_points_and_half_of_what_tips_it(
    free_spin: tuple[bool, ...], blocked: str, moments: list[float]
) -> None:
    inertia = np.array([[4.0, 0.0, 0.0], [0.0, 1.5, 0.5], [0.0, 0.5, 1.5]])
    made: Any = some(
        radius=0.01, free_spin=np.array(free_spin), extra=np.array([1.0, 2.0, 3.0]),
        moment=np.array([4.0, 5.0, 6.0]), corners=np.ones((4, 3)), points=np.zeros((8, 3)),
        block=some(inertia=inertia),
    )  # fmt: skip
    sphere = {"mass": 2.0, "push": [9.0] * 3, "twist": [0.0] * 3, "blocked": "yXYZ", "radius": 0.5}
    found = _clump(sphere, made)
    assert (found["kind"], found["blocked"], found["radius"]) == ("clump", blocked, 0.01)
    assert found["push"] == [8.5, 8.0, 7.5]
    assert found["twist"] == [-2.0, -2.5, -3.0]
    assert found["inertia"] == pytest.approx(moments)
    foot, point = found["touching"][0], found["points"][0]
    assert (len(found["touching"]), len(found["points"])) == (4, 8)
    assert foot["radius"] == 0.01
    weightless = foot["density"] * 4 / 3 * math.pi * 1e-6
    assert weightless == pytest.approx(2e-18, rel=1e-9, abs=0.0)
    assert point["radius"] == pytest.approx(1e-5)
    assert point["density"] * 4 / 3 * math.pi * 1e-15 == pytest.approx(0.25)


@pytest.mark.parametrize(
    ("charged", "ks", "slides"),
    [(None, 5.0, 0.0), ([[3.0, 0.0, 0.0]], 0.0, 0.0), ([[3.0, 0.0, 0.0]], 5.0, -6.0)],
)
def test_a_polyhedron_slides_in_its_first_step_as_charges_its_spring(
    charged: Any, ks: float, slides: float
) -> None:
    vertices, faces = box_geometry(np.array([0.0, 0.0, 1.0]), np.array([2.0, 0.5, 1.0]), np.eye(3))
    block = some(vertices=vertices, faces=faces, centroid=lambda: np.array([0.0, 0.0, 1.0]))
    floor = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]))
    sphere = {"kind": "sphere", "push": [1.0] * 3, "mass": 4.0, "velocity": [0.5, 0.0, 0.0]}
    given = {"kn": 8.0, "ks": ks, "dt": 0.1, "bodies": [sphere, {"kind": "wall"}]}
    scene: Any = some(blocks=[block], walls=[floor])
    made = polyhedral(given, scene, None if charged is None else np.array(charged))
    body, wall = made["bodies"]
    assert (body["kind"], wall["kind"], made["volumes"]) == ("polyhedron", "wall", True)
    assert body["velocity"] == pytest.approx([slides, 0.0, 0.0])
    assert body["push"] == pytest.approx([1.0 + 40.0 * (0.5 - slides), 1.0, 1.0])
    assert made["kn"] == pytest.approx(2.0)  # over its face of 4 by 1 m
    assert np.array(body["vertices"])[:, 2].tolist() == pytest.approx(
        (vertices[:, 2] - 1.0).tolist()
    )


def test_loads_add_up_with_the_weight_of_raised_masses() -> None:
    ask = ball_ask(ball(load=[[3.0, 0.0, 0.0]]), gravity=np.array([0.0, -9.81, 0.0]), eta=3.0)
    assert sphere_of(ask, PLAIN)["force"] == [3.0, 0.0, 0.0]
    assert sphere_of(ask, HALF_STEP)["force"] == pytest.approx([3.0, -19.62, 0.0])


def test_only_a_face_on_the_wall_has_an_area() -> None:
    floor = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]))
    for height, area in ((1.0, 4.0), (1.1, 0.0)):
        sides = np.array([2.0, 0.5, 1.0])
        vertices, faces = box_geometry(np.array([0.0, 0.0, height]), sides, np.eye(3))
        block: Any = some(vertices=vertices, faces=faces)
        assert _area(block, floor) == pytest.approx(area)


def test_imports_of_other_parts_go_with_all_their_lines() -> None:
    text = "from adapters.yade.inside.x import (\n    a,\n)\nimport os\nfrom os import path\n"
    assert _alone(text) == "import os\nfrom os import path\n"


def test_a_sphere_touches_a_wall_where_the_wall_is() -> None:
    for height, touches in ((2.0999, True), (2.1001, False), (0.0999, True)):
        sphere = ball(position=[[0.0, height, 0.0]])
        wall = Wall(np.array([0.0, 2.0, 0.0]), np.array([0.0, 1.0, 0.0]))
        found, count = initial_contacts(ball_ask(sphere, wall).scene)
        assert (found.tolist(), count) == ([touches], int(touches))
