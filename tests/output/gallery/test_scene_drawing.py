"""Claims about the drawing of a scene."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from vv.output.gallery import scene_drawing
from vv.output.gallery.scene_drawing import HEIGHT, WIDTH, drawing, picture
from vv.plan.project import find
from vv.scene import Contact, Scene, Spheres, Wall
from vv.scene.picture.sketch import MOST, Arrow, Sketch, sketch
from vv.scene.picture.view import OBLIQUE, plane

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


def test_every_shape_of_a_sketch_lies_where_it_is_by_hand() -> None:
    """150 to the larger extent, y upwards, about (140, 104); strokes of a wall go behind it."""
    seen = Sketch(
        size=2.5, axes=("x", "-z"), bodies=5, circles=((0.1, 0.2, 0.1),), held=(True,),
        walls=(((0.0, -0.4), (0.0, 1.0)),), rails=(((0.1, 0.2), (1.0, 0.0)),),
        touching=((0.1, 0.1),), bonds=(((0.0, 0.0), (0.2, 0.2)),),
        arrows=(
            Arrow((0.0, 0.0), (0.0, -1.0), "gravity"), Arrow((0.1, 0.2), (1.0, 0.0), "velocity"),
            Arrow((0.1, 0.2), (0.0, -0.5), "load"), Arrow((0.1, 0.2), (0.0, 0.05), "load"),
        ),
    )  # fmt: skip
    wall, circle, bond, rail, touch, fall, name, moves, load, *legend = scene_drawing.shapes(seen)
    strokes = "".join(f"M{140 + 93 * k / 8:.1f} 164l-4.2 6" for k in range(-8, 9))
    assert wall == f'<path class="hatch" d="M47 164L233 164{strokes}"/>'.replace(".0 ", " ")
    assert circle == '<circle class="body held" cx="155" cy="74" r="15"/>'
    assert bond == '<path class="bond" d="M140 104L170 74"/>'
    assert rail == '<path class="rail" d="M110 74L200 74"/>'
    assert touch == '<circle class="touch" cx="155" cy="89" r="1.8"/>'
    assert 'class="arrow moves" d="M272 25L272 55M275 49L272 55L269 49"' in fall
    assert name == '<text x="272" y="67" class="mid">gravity</text>'
    assert 'class="arrow moves" d="M155 74L185 74M179 71L185 74L179 77"' in moves
    assert 'class="arrow load" d="M155 74L155 89M158 83L155 89L152 83"' in load
    assert legend == [
        '<path class="rule" d="M65 200v6m0-3h150m0-3v6"/>',
        '<text x="140" y="216" class="mid">2.5 m</text>',
        '<path class="rule" d="M262 212h22m-4-3l4 3l-4 3m-18-3v-22m-3 4l3-4l3 4"/>',
        '<text x="290" y="215">x</text>',
        '<text x="259" y="187">-z</text>',
        '<text x="6" y="12">1 of 5 bodies</text>',
    ]


def test_a_wall_aslant_and_a_rail_upwards_lie_where_they_are_by_hand() -> None:
    """A normal (0.6, 0.8): along it (0.8, 0.6) in the picture, where y goes down."""
    line, *strokes = scene_drawing._wall((0.0, 0.0), (1.2, 1.6)).split("M")[1:]
    assert line == "65.6 48.2L214.4 159.8"
    assert strokes[0] == "65.6 48.2l-7 2.3"
    assert strokes[-1].startswith("214.4 159.8l")
    assert len(strokes) == 17
    assert scene_drawing._rail(((0.0, 0.0), (0.6, 0.8))) == "M113 140L167 68"


def test_bodies_that_are_all_drawn_are_not_counted() -> None:
    wall = ((0.0, -0.5), (0.0, 1.0))
    for bodies, circles, walls, counted in ((2, 1, 1, False), (3, 1, 1, True), (1, 1, 0, False)):
        seen = Sketch(1.0, (), bodies, circles * ((0.0, 0.0, 0.5),), circles * (False,),
                      walls=walls * (wall,))  # fmt: skip
        assert any(" bodies" in one for one in scene_drawing.shapes(seen)) is counted


def test_several_shakings_have_one_name_and_a_tiny_sphere_is_seen() -> None:
    twice = (Arrow((0.0, 0.0), (1.0, 0.0), "shaking"), Arrow((0.0, 0.0), (0.0, 1.0), "shaking"))
    seen = Sketch(1.0, (), 1, ((0.0, 0.0, 1e-4),), (False,), arrows=twice)
    made = [*scene_drawing.shapes(seen)]
    assert sum(">shaking</text>" in one for one in made) == 1
    assert sum('class="arrow' in one for one in made) == 2
    assert made[0] == '<circle class="body" cx="140" cy="104" r="0.8"/>'


@pytest.mark.parametrize(
    ("what", "height"), [("gravity", 40), ("shaking", 96), ("driven wall", 150)]
)
def test_what_acts_on_all_bodies_has_a_place_of_its_own_beside_them(what: str, height: int) -> None:
    """The middle of the arrow, which is 30 long, is on a line at x = 272; its name is below it."""
    seen = Sketch(1.0, (), 0, (), (), arrows=(Arrow((0.0, 0.0), (0.0, 1.0), what),))
    arrow, name, *_ = scene_drawing.shapes(seen)
    assert f'd="M272 {height + 15}L272 {height - 15}M' in arrow
    assert name == f'<text x="272" y="{height + 27}" class="mid">{what}</text>'


def test_an_oblique_view_turns_a_scene_and_does_not_distort_it() -> None:
    assert pytest.approx(np.eye(2), abs=0.01) == OBLIQUE @ OBLIQUE.T


@pytest.mark.parametrize("tie", [132.05, 147.95, -0.25, 0.35])
def test_a_coordinate_is_alike_where_rounding_made_or_broke_a_tie(tie: float) -> None:
    assert len({scene_drawing._number(tie + off) for off in (-3e-14, 0.0, 3e-14)}) == 1
