"""Draws the sketch of a scene as SVG, for reports and for the gallery.

Grey: locked in all directions; dashes beside a body: the directions in which it may move, where
some are locked; dots: where bodies touch; red: a load; orange: motion and driven motion.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from html import escape

from vv.scene import Scene
from vv.scene.picture.sketch import MOST, Arrow, Sketch, Spot, sketch

WIDTH, HEIGHT = 300.0, 220.0
SCALE = 150.0  # of a picture, for the larger extent of the bodies
MIDDLE = (140.0, 104.0)
ARROW = 30.0
LEAST = 2.0  # of an arrow: one seen end on is left out
CORNERS = {"gravity": (272.0, 40.0), "shaking": (272.0, 96.0), "driven wall": (272.0, 150.0)}
STYLE = (  # of a picture that stands alone; the report has its own, for light and dark
    "<style>.body{fill:#dbe7f0;stroke:#1d2329}.held{fill:#c9ced4}"
    ".hatch{fill:none;stroke:#1d2329;stroke-width:1.1}"
    ".bond{fill:none;stroke:#1d2329;stroke-width:1.4;stroke-opacity:.45}"
    ".rail{fill:none;stroke:#566069;stroke-width:1.2;stroke-dasharray:4 3}.touch{fill:#1d2329}"
    ".arrow{fill:none;stroke-width:1.8}.moves{stroke:#c2570c}.load{stroke:#b3200c}"
    ".rule{fill:none;stroke:#566069;stroke-width:.9}.mid{text-anchor:middle}"
    "text{font:9.5px sans-serif;fill:#1d2329}</style>"
)


def drawing(scene: Scene) -> str:
    """The SVG of a scene, on its own; '' where it has too many bodies to draw."""
    if sum(map(len, scene.bodies)) > MOST:
        return ""
    size = f'width="{WIDTH:g}" height="{HEIGHT:g}" viewBox="0 0 {WIDTH:g} {HEIGHT:g}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size}>'
    paper = '<rect width="100%" height="100%" fill="#fff"/>'
    return "\n".join([head, STYLE, paper, *shapes(sketch(scene)), "</svg>", ""])


def picture(seen: Sketch, name: str = "") -> str:
    """The SVG of a sketch, for a page that defines the styles of its shapes and has a text for it.

    name: by which `again` shows it elsewhere on the page.
    """
    drawn = "".join(shapes(seen))
    return _framed(f'<g id="{escape(name)}">{drawn}</g>' if name else drawn)


def again(name: str) -> str:
    """The SVG that repeats a picture from elsewhere on the page."""
    return _framed(f'<use href="#{escape(name)}"/>')


def _framed(inner: str) -> str:
    box = f'viewBox="0 0 {WIDTH:g} {HEIGHT:g}"'
    return f'<svg class="scene" {box} aria-hidden="true">{inner}</svg>'


def shapes(seen: Sketch) -> Iterator[str]:
    """All shapes of a sketch: walls, bodies, bonds, locks, contacts, arrows, and the legend."""
    wall = "".join(_wall(spot, normal) for spot, normal in seen.walls)
    bonds = "".join(_line(_at(a), _at(b)) for a, b in seen.bonds)
    rails = "".join(map(_rail, seen.rails))
    fixed = seen.fixed or (False,) * len(seen.polygons)
    yield from _path("hatch", wall)
    for corners, held in zip(seen.polygons, fixed, strict=True):
        yield from _path(_body(held), f"{_line(*map(_at, corners))}z")
    yield from _circles(seen)
    yield from _path("bond", bonds)
    yield from _path("rail", rails)
    for x, y in map(_at, seen.touching):
        yield f'<circle class="touch" cx="{_number(x)}" cy="{_number(y)}" r="1.8"/>'
    yield from _arrows(seen.arrows)
    yield from _legend(seen)


def _number(value: float) -> str:
    """A coordinate with one digit, alike on all machines where rounding made or broke a tie."""
    text = f"{round(value, 6):.1f}"
    return text.removesuffix(".0") if text != "-0.0" else "0"


def _line(*spots: Spot) -> str:
    return "M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in spots)


def _path(kind: str, line: str) -> Iterator[str]:
    if line:
        yield f'<path class="{kind}" d="{line}"/>'


def _at(spot: Spot) -> Spot:
    """A place in the picture."""
    return MIDDLE[0] + SCALE * spot[0], MIDDLE[1] - SCALE * spot[1]


def _body(held: bool) -> str:
    return "body held" if held else "body"


def _circles(seen: Sketch) -> Iterator[str]:
    for (x, y, radius), held in zip(seen.circles, seen.held, strict=True):
        px, py = _at((x, y))
        place = f'cx="{_number(px)}" cy="{_number(py)}" r="{_number(max(0.8, SCALE * radius))}"'
        yield f'<circle class="{_body(held)}" {place}/>'


def _wall(spot: Spot, normal: Spot) -> str:
    """A line across the normal, and short strokes behind it."""
    x, y = _at(spot)
    size = math.hypot(*normal)
    nx, ny = normal[0] / size, -normal[1] / size
    tx, ty = -ny, nx
    half = 0.62 * SCALE
    strokes = [_line((x - half * tx, y - half * ty), (x + half * tx, y + half * ty))]
    for k in range(-8, 9):
        start = x + k / 8 * half * tx, y + k / 8 * half * ty
        dx, dy = 6 * (-nx - 0.7 * tx), 6 * (-ny - 0.7 * ty)
        strokes.append(f"{_line(start)}l{_number(dx)} {_number(dy)}")
    return "".join(strokes)


def _rail(rail: tuple[Spot, Spot]) -> str:
    """A dashed line through a body."""
    (x, y), (dx, dy) = _at(rail[0]), rail[1]
    far = 1.5 * ARROW
    return _line((x - far * dx, y + far * dy), (x + far * dx, y - far * dy))


def _arrows(arrows: Sequence[Arrow]) -> Iterator[str]:
    """Arrows at bodies; those that apply to all bodies are drawn once beside them, with a name."""
    named = set()
    for arrow in arrows:
        corner = CORNERS.get(arrow.what)
        if corner is None:
            yield from _arrow(_at(arrow.tail), arrow)
            continue
        dx, dy = 0.5 * ARROW * arrow.along[0], -0.5 * ARROW * arrow.along[1]
        yield from _arrow((corner[0] - dx, corner[1] - dy), arrow)
        if arrow.what not in named:
            yield _text(corner[0], corner[1] + ARROW / 2 + 12, arrow.what, "mid")
        named.add(arrow.what)


def _arrow(tail: Spot, arrow: Arrow) -> Iterator[str]:
    dx, dy = ARROW * arrow.along[0], -ARROW * arrow.along[1]
    length = math.hypot(dx, dy)
    if length < LEAST:
        return
    tip, ux, uy = (tail[0] + dx, tail[1] + dy), dx / length, dy / length
    ends = [(tip[0] - 6 * ux - s * 3 * uy, tip[1] - 6 * uy + s * 3 * ux) for s in (-1, 1)]
    kind = "load" if arrow.what == "load" else "moves"
    line = _line(tail, tip) + _line(ends[0], tip, ends[1])
    yield f'<path class="arrow {kind}" d="{line}"><title>{escape(arrow.what)}</title></path>'


def _legend(seen: Sketch) -> Iterator[str]:
    """The length of the picture, the axes, and how many bodies are not drawn."""
    x, y = MIDDLE[0] - SCALE / 2, HEIGHT - 8
    yield from _path("rule", f"M{x:g} {y - 12:g}v6m0-3h{SCALE:g}m0-3v6")
    yield _text(MIDDLE[0], y + 4, f"{seen.size:.3g} m", "mid")
    if seen.axes:
        yield from _path("rule", f"M262 {y:g}h22m-4-3l4 3l-4 3m-18-3v-22m-3 4l3-4l3 4")
        yield _text(290, y + 3, seen.axes[0])
        yield _text(259, y - 25, seen.axes[1])
    rest = seen.bodies - len(seen.circles)
    if seen.circles and rest > len(seen.walls) and not seen.polygons:
        yield _text(6, 12, f"{len(seen.circles)} of {seen.bodies} bodies")


def _text(x: float, y: float, said: str, kind: str = "") -> str:
    shown = f' class="{kind}"' if kind else ""
    return f'<text x="{_number(x)}" y="{_number(y)}"{shown}>{escape(said)}</text>'
