"""Claims about the drawing of a scene."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from vv.output.gallery.scene_drawing import HEIGHT, WIDTH, drawing, picture
from vv.plan.project import find
from vv.scene import Contact, Scene, Spheres, Wall
from vv.scene.picture.sketch import MOST, sketch
from vv.scene.picture.view import plane

SVG = "{http://www.w3.org/2000/svg}"


def scene_of(case: str, variant: str) -> Scene:
    declared = find().load_case(case)
    return declared.declare(variant, declared.defaults(variant)).study.scene


def shapes(scene: Scene, tag: str, kind: str) -> int:
    """How many elements of a class a drawing has."""
    root = ElementTree.fromstring(drawing(scene))
    return sum(kind in (e.get("class") or "").split() for e in root.iter(f"{SVG}{tag}"))


def spheres(count: int, **changes: object) -> Spheres:
    place = np.column_stack([np.arange(count), np.zeros((count, 2))])
    given = {
        "position": place,
        "velocity": np.zeros((count, 3)),
        "radius": np.full(count, 0.5),
        "mass": np.ones(count),
        "free": np.ones((count, 3), bool),
    }
    return Spheres(**{**given, **changes})  # type: ignore[arg-type]


def test_every_body_bond_contact_and_held_body_is_there() -> None:
    unit = scene_of("tetrahedral-unit", "pulled")
    assert shapes(unit, "circle", "body") == 4
    bonds = re.search('class="bond" d="(.*?)"', drawing(unit))
    assert bonds is not None
    assert bonds[1].count("M") == len(unit.bonded_pairs)
    assert shapes(scene_of("single-contact", "T1"), "circle", "held") == 1
    assert shapes(Scene((spheres(3),), Contact(1e6)), "circle", "touch") == 2


@pytest.mark.parametrize("case", ["single-contact:T3-rotated", "incline:newmark-22", "skid:wall"])
def test_a_wall_is_seen_edge_on_and_up_is_up(case: str) -> None:
    scene = scene_of(*case.split(":"))
    right, up = plane(scene)
    sight = np.cross(right, up)
    assert scene.walls[0].normal @ sight == pytest.approx(0.0, abs=1e-6)
    assert shapes(scene, "path", "hatch") == 1
    if scene.gravity.any():
        assert scene.gravity @ up < 0


def test_what_moves_is_pressed_shaken_or_railed_shows() -> None:
    contact = Contact(1e6)
    ball = spheres(1, velocity=[[1.0, 0, 0]], load=[[0, 0, -2.0]])
    assert shapes(Scene((ball,), contact), "path", "moves") == 1
    assert shapes(Scene((ball,), contact), "path", "load") == 1
    assert shapes(scene_of("incline", "newmark-22"), "path", "moves") == 2
    railed = spheres(1, free=[[True, False, False]])
    assert shapes(Scene((railed,), contact), "path", "rail") == 1


def test_a_drawing_holds_all_of_every_body() -> None:
    for scene in (scene_of("skid", "wall"), scene_of("knife-edge", "topples")):
        root = ElementTree.fromstring(drawing(scene))
        for circle in root.iter(f"{SVG}circle"):
            x, y, r = (float(circle.get(name) or 0) for name in ("cx", "cy", "r"))
            assert r <= min(x, WIDTH - x)
            assert r <= min(y, HEIGHT - y)
        for body in (e for e in root.iter(f"{SVG}path") if "body" in (e.get("class") or "")):
            for x, y in re.findall(r"(-?[\d.]+) (-?[\d.]+)", body.get("d") or ""):
                assert 0 <= float(x) <= WIDTH
                assert 0 <= float(y) <= HEIGHT


def test_report_and_gallery_draw_the_same_shapes() -> None:
    scene = scene_of("single-contact", "T3")
    inner = re.sub(r"^<svg[^>]*>|</svg>$", "", picture(sketch(scene)))
    assert (
        inner == re.sub(r"\n", "", drawing(scene).partition('fill="#fff"/>')[2])[: -len("</svg>")]
    )


def test_a_crowd_that_nobody_could_tell_apart_is_not_drawn() -> None:
    contact = Contact(1e6)
    assert drawing(Scene((spheres(MOST),), contact))
    assert drawing(Scene((spheres(MOST + 1),), contact)) == ""


def test_a_scene_of_walls_and_one_point_is_drawn_all_the_same() -> None:
    tiny = spheres(1, radius=[1e-12])
    floor = Wall((0.0, 0.0, 0.0), (0.0, 1.0, 0.0))  # type: ignore[arg-type]
    assert drawing(Scene((floor, tiny), Contact(1e6))).startswith("<svg")
