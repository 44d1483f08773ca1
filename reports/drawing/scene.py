"""Draws the sketch of a scene as SVG: bodies, walls, locks, loads, what is driven, bonds."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from markupsafe import Markup

from reports.drawing.svg import drawing, number, path, text, title
from reports.text import brief
from vv.scene.sketch import Arrow, Sketch, Spot

WIDTH, HEIGHT = 300.0, 220.0
SCALE = 150.0  # of a picture, for the larger extent of the bodies
MIDDLE = (140.0, 104.0)
ARROW = 30.0
CORNERS = {"gravity": (272.0, 40.0), "shaking": (272.0, 96.0), "driven wall": (272.0, 150.0)}


def draw_scene(sketch: Sketch) -> Markup:
    """The picture of a scene."""
    wall = "".join(_wall(spot, normal) for spot, normal in sketch.walls)
    bonds = "".join(path(*np.array([_at(a), _at(b)]).T) for a, b in sketch.bonds)
    parts = [
        f'<path class="hatch" d="{wall}"/>' if wall else "",
        *(_polygon(corners) for corners in sketch.polygons),
        *_circles(sketch),
        f'<path class="bond" d="{bonds}"/>' if bonds else "",
        *_arrows(sketch.arrows),
        *_legend(sketch),
    ]
    return drawing(WIDTH, HEIGHT, parts, "scene")


def _at(spot: Spot) -> Spot:
    """A place in the picture."""
    return MIDDLE[0] + SCALE * spot[0], MIDDLE[1] - SCALE * spot[1]


def _polygon(corners: tuple[Spot, ...]) -> str:
    x, y = np.array([_at(corner) for corner in corners]).T
    return f'<path class="body" d="{path(x, y)}z"/>'


def _circles(sketch: Sketch) -> Iterator[str]:
    for (x, y, radius), held in zip(sketch.circles, sketch.held, strict=False):
        px, py = _at((x, y))
        kind = "body held" if held else "body"
        r = max(0.8, SCALE * radius)
        yield f'<circle class="{kind}" cx="{number(px)}" cy="{number(py)}" r="{number(r)}"/>'


def _wall(spot: Spot, normal: Spot) -> str:
    """A line across the normal, and short strokes behind it."""
    x, y = _at(spot)
    size = math.hypot(*normal)
    nx, ny = normal[0] / size, -normal[1] / size
    tx, ty = -ny, nx
    half = 0.62 * SCALE
    line = path(x + half * tx * np.array([-1, 1]), y + half * ty * np.array([-1, 1]))
    strokes = []
    for k in range(-8, 9):
        px, py = x + k / 8 * half * tx, y + k / 8 * half * ty
        dx, dy = 6 * (-nx - 0.7 * tx), 6 * (-ny - 0.7 * ty)
        strokes.append(f"M{number(px)} {number(py)}l{number(dx)} {number(dy)}")
    return line + "".join(strokes)


def _arrows(arrows: tuple[Arrow, ...]) -> Iterator[str]:
    """Arrows at bodies; what acts on all of them stands beside, with its name, once."""
    named = set()
    for arrow in arrows:
        corner = CORNERS.get(arrow.what)
        if corner is not None:
            yield _arrow(corner, arrow, centred=True)
            if arrow.what not in named:
                yield text(corner[0], corner[1] + ARROW / 2 + 12, arrow.what, "mid")
            named.add(arrow.what)
        else:
            yield _arrow(_at(arrow.tail), arrow, centred=False)


def _arrow(tail: Spot, arrow: Arrow, centred: bool) -> str:
    dx, dy = ARROW * arrow.along[0], -ARROW * arrow.along[1]
    if math.hypot(dx, dy) < 2:  # seen end on
        return ""
    x, y = (tail[0] - dx / 2, tail[1] - dy / 2) if centred else tail
    tip = x + dx, y + dy
    ux, uy = dx / math.hypot(dx, dy), dy / math.hypot(dx, dy)
    ends = [(tip[0] - 6 * ux - s * 3 * uy, tip[1] - 6 * uy + s * 3 * ux) for s in (-1, 1)]
    line = path(*np.array([(x, y), tip, (np.nan, np.nan), ends[0], tip, ends[1]]).T)
    kind = "load" if arrow.what == "load" else "moves"
    return f'<path class="arrow {kind}" d="{line}">{title(arrow.what)}</path>'


def _legend(sketch: Sketch) -> Iterator[str]:
    """The length of the picture, the axes, and how many bodies are not drawn."""
    y = HEIGHT - 8
    x = MIDDLE[0] - SCALE / 2
    yield f'<path class="rule" d="M{x:g} {y - 12:g}v6m0-3h{SCALE:g}m0-3v6"/>'
    yield text(MIDDLE[0], y + 4, f"{brief(float(f'{sketch.size:.3g}'))} m", "mid")
    if sketch.axes:
        yield f'<path class="rule" d="M262 {y:g}h22m-4-3l4 3l-4 3m-18-3v-22m-3 4l3-4l3 4"/>'
        yield text(290, y + 3, sketch.axes[0])
        yield text(259, y - 25, sketch.axes[1])
    rest = sketch.bodies - len(sketch.circles)
    if sketch.circles and rest > len(sketch.walls) and not sketch.polygons:
        yield text(6, 12, f"{len(sketch.circles)} of {sketch.bodies} bodies")
