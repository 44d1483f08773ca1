"""Claims about the looks of schemes: every text and curve is visible on light and dark."""

from __future__ import annotations

import re
from pathlib import Path

import reports
from reports.marks import COLOURS, mark, marks

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
