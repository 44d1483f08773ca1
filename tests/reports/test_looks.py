"""Claims about the looks of schemes: every text and curve is visible on light and dark."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

import reports
from reports.marks import COLOURS, DASHES, ROUND, SHAPES, Mark, mark, marks

DDA = ("default", "published", "lagged", "generalised-alpha", "augmented-lagrangian")
BUILT_IN = [
    *(f"dem/{name}" for name in ("default", "published")),
    *(f"exact/{name}" for name in ("default", "linearised")),
    *(f"dda/{name}" for name in DDA),
    *(f"yade/{name}" for name in ("default", "half-step-mass", "clump", "polyhedra")),
    *(f"liggghts/{name}" for name in ("default", "half-step-mass", "clump", "pre-overlapped")),
    *(f"{code}/default" for code in ("rigid", "lmgc90", "pybullet", "kratos")),
]


def test_built_in_schemes_differ_in_marker_or_colour_and_within_a_code_in_dash() -> None:
    looks = [mark(label) for label in BUILT_IN]
    assert len({(m.colour, m.shape) for m in looks}) == len(looks)
    assert len({(m.colour, m.dash) for m in looks}) == len(looks)


def test_a_look_is_that_of_the_name_whatever_stands_beside_it() -> None:
    assert marks(["zz/new", "dem/default"])["zz/new"] == marks(["zz/new"])["zz/new"]
    assert marks(BUILT_IN)["dem/default"] == marks(["dem/default"])["dem/default"]


def luminance(colour: str) -> float:
    """The relative luminance of #rrggbb (WCAG 2.2)."""
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """The contrast of two colours (WCAG 2.2), 1 to 21."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_curves_and_their_names_are_seen_on_light_and_on_dark_paper() -> None:
    for light, dark in COLOURS:
        assert contrast(light, "#ffffff") >= 3
        assert contrast(dark, "#14181c") >= 4.5


def test_texts_are_read_on_every_background_light_and_dark() -> None:
    sheet = (Path(reports.__file__).parent / "assets" / "report.css").read_text()
    light, dark, system, *_ = re.findall(r"\{([^{}]*--ink:[^{}]*)\}", sheet)
    assert dark.replace(" ", "") == system.replace(" ", "")
    for block in (light, dark):
        named = dict(re.findall(r"--([\w-]+): (#\w{6})", block))
        pairs = [("ink", "paper"), ("soft", "paper"), ("link", "paper"), ("ink", "band")]
        pairs += [(f"{n}-ink", n) for n in ("good", "known", "bad", "odd", "idle", "shown")]
        pairs += [("ink", f"e{i}") for i in range(8)] + [("soft", "band")]
        assert {
            pair: ratio
            for pair in pairs
            if (ratio := contrast(named[pair[0]], named[pair[1]])) < 4.5
        } == {}


def test_words_of_a_drawing_that_is_shown_again_are_styled_by_rules_without_an_ancestor() -> None:
    sheet = (Path(reports.__file__).parent / "assets" / "report.css").read_text()
    for word in ("text", ".mid", ".body", ".rule", ".hatch", ".arrow"):
        assert re.search(rf"^{re.escape(word)} {{", sheet, re.MULTILINE), word


def test_a_look_is_the_colour_of_a_code_the_dash_of_a_scheme_and_the_shape_of_both() -> None:
    assert mark("yade/published").shape == ROUND  # 3 1 + 4 2 = 11 of eleven shapes
    assert mark("liggghts/half-step-mass").shape == SHAPES[10]
    assert (mark("exact/clump").colour, mark("exact/clump").dash) == (3, DASHES[5])
    assert mark("kratos/augmented-lagrangian").shape == SHAPES[(24 + 36) % 11]
    other = mark("zzz/default")
    assert 0 <= other.colour < len(COLOURS)
    assert len({mark(name).colour for name in ("zzz/a", "yyy/a", "xxx/a", "www/a")}) > 1


def test_shapes_are_regular_and_upright_within_about_a_unit() -> None:
    square, triangle, diamond = SHAPES[1:4]
    half = 1.15 * math.sqrt(0.5)
    assert np.array(square) == pytest.approx(
        np.array([(half, half), (half, -half), (-half, -half), (-half, half)])
    )
    side = 1.1 * math.sqrt(0.75)
    assert np.array(triangle) == pytest.approx(np.array([(0, 1.1), (side, -0.55), (-side, -0.55)]))
    assert np.array(diamond) == pytest.approx(
        np.array([(0, 1.15), (1.15, 0), (0, -1.15), (-1.15, 0)]), abs=1e-12
    )
    assert np.array(SHAPES[4]) == pytest.approx(-np.array(triangle), abs=1e-12)  # points down
    assert np.array(SHAPES[7][0]) == pytest.approx([1.1, 0.0], abs=1e-12)  # and right, and left
    assert np.array(SHAPES[9][0]) == pytest.approx([-1.1, 0.0], abs=1e-12)
    cross = np.array(SHAPES[5])
    assert cross[:3].tolist() == [[-0.33, 0.95], [0.33, 0.95], [0.33, 0.33]]
    assert cross[3:6].tolist() == [[0.95, 0.33], [0.95, -0.33], [0.33, -0.33]]
    radii = np.linalg.norm(SHAPES[6], axis=1)
    assert radii == pytest.approx([1.1, 0.5] * 5)
    star = np.unwrap(np.arctan2(*np.array(SHAPES[6]).T))
    assert np.diff(star) == pytest.approx(np.full(9, math.pi / 5))
    assert Mark("a/a", 0, ((0.5, 0.25), (-0.125, -1.0)), "").points == "0.5,-0.25 -0.12,1"
