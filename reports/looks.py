"""Writes the glyphs, markers and colours of code/schemes on a page; each is defined once."""

from __future__ import annotations

import re
from collections.abc import Iterable

from markupsafe import Markup, escape

from reports.marks import COLOURS, Mark

USED = re.compile(r'href="#k(\d+)"')
DRAWN = re.compile(r'class="k(\d+)[ "]')
KINDS = (("dots", "f", "full"), ("holes", "o", "open"))  # of markers: path, name, shape


def glyph(mark: Mark) -> Markup:
    """The legend symbol of a code/scheme: a line with its marker on it."""
    return Markup(f'<svg class="glyph" aria-hidden="true"><use href="#k{mark.number}"/></svg>')


def defined(page: str, marks: Iterable[Mark]) -> str:
    """The definitions that the glyphs and drawings of a page refer to."""
    used, drawn = (set(map(int, name.findall(page))) for name in (USED, DRAWN))
    here = [mark for mark in marks if mark.number in used | drawn]
    kinds = [kind for kind in KINDS if f'class="{kind[0]}"' in page]
    shapes = "".join(map(_glyph, here))
    shapes += "".join(_marker(m, *kind) for kind in kinds for m in here if m.number in drawn)
    styles = "".join(map(_style, here))
    return (
        f'<svg class="unseen" aria-hidden="true"><defs>{shapes}</defs></svg><style>{styles}</style>'
    )


def _glyph(mark: Mark) -> str:
    n = mark.number
    return (
        f'<symbol id="k{n}" class="k{n}" data-k="{escape(mark.label)}" viewBox="-13 -7 26 14">'
        f'<path class="line" d="M-13 0H13"/>'
        f'<polygon class="full" transform="scale(5)" points="{mark.points}"/></symbol>'
    )


def _marker(mark: Mark, kind: str, name: str, shape: str) -> str:
    n = mark.number
    box = 'viewBox="-2 -2 4 4" markerWidth="4" markerHeight="4"'
    return (
        f'<marker id="{name}{n}" class="k{n}" {box}>'
        f'<polygon class="{shape}" points="{mark.points}"/></marker>'
        f"<style>.k{n} .{kind}{{marker:url(#{name}{n})}}</style>"
    )


def _style(mark: Mark) -> str:
    n = mark.number
    dash = f".k{n} .line{{stroke-dasharray:{mark.dash}}}" if mark.dash else ""
    return f".k{n}{{--c:var(--c{mark.colour})}}{dash}"


def palette() -> str:
    """The colours of codes, for light and dark: part of the style that all pages share."""
    light, dark = ("".join(f"--c{i}:{pair[k]};" for i, pair in enumerate(COLOURS)) for k in (0, 1))
    classes = "".join(f".c{i}{{--c:var(--c{i})}}" for i in range(len(COLOURS)))
    system = (
        f"@media screen and (prefers-color-scheme:dark){{:root:not([data-theme=light]){{{dark}}}}}"
    )
    own = f"@media screen{{[data-theme=dark]{{{dark}}}}}"
    return f":root{{{light}}}{own}{system}{classes}\n"
