"""The page of a code: of each case, how many of its variants the schemes of the code run."""

from __future__ import annotations

from tests.support.fabricated import some
from vv.output.gallery.case_page import Answers
from vv.output.gallery.code_page import CodePage


def test_variants_are_counted_that_a_scheme_of_the_code_runs_among_all() -> None:
    answers: dict[str, Answers] = {
        "bounce": {
            "a/x": {"T1": 1, "T2": "it has no drag", "T3": 1},
            "a/y": {"T1": 1, "T2": "it has no drag", "T5": 1},
            "b/z": {"T1": 1, "T2": 2, "T4": 3, "T5": 4},
        },
        "fall": {"a/x": {"up": "it has no spheres"}, "b/z": {"up": 1}},
        "slide": {"ab/x": {"up": 1}, "a/x": {"down": 2, "flat": 2}},
    }
    page = CodePage(some(name="a", schemes=()), answers, ()).text()
    rows = [line for line in page.splitlines() if "](../cases/" in line]
    assert rows == [
        "| [bounce](../cases/bounce.md) | 3 of 5 |",
        "| [slide](../cases/slide.md) | 2 of 3 |",
    ]
