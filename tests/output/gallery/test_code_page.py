"""The page of a code: of each case, how many of its variants the schemes of the code run."""

from __future__ import annotations

from tests.support.fabricated import some
from vv.ask import Method
from vv.output.gallery.case_page import Answers
from vv.output.gallery.code_page import CodePage
from vv.scene import Term


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


def test_each_scheme_is_told_with_its_knobs_what_it_claims_and_what_it_lacks() -> None:
    every = frozenset(Term)
    first = some(name="x", summary="steps", method=Method.SECOND_ORDER, knobs=("dt", "kn"),
                 lowered={Term.DRAG: Method.FIRST_ORDER},
                 terms=every - {Term.DRAG, Term.GRAVITY})  # fmt: skip
    second = some(name="y", summary="solves | it", method=Method.EXACT, knobs=(), lowered={},
                  terms=every)  # fmt: skip
    known = [("bounce", "T1, T2", "drag is late")]
    lines = CodePage(some(name="a", schemes=(first, second)), {}, known).text().splitlines()
    said = [line for line in lines if line]
    lowered = f"{Method.FIRST_ORDER.value} with {Term.DRAG.value}"
    assert said[:5] == ["# a", "```", "vv run single-contact --codes a", "vv list --code a", "```"]
    assert said[8:12] == [
        f"| `x` | steps | {Method.SECOND_ORDER.value}; {lowered} | dt, kn |",
        f"| `y` | solves \\| it | {Method.EXACT.value} | none |",
        f"`x` does not support: {Term.GRAVITY.value}, {Term.DRAG.value}.",
        "`y` does not support: nothing that scenes have.",
    ]
    assert said[-1] == "- [bounce](../cases/bounce.md) T1, T2: drag is late"
    bare = CodePage(some(name="a", schemes=()), {}, ()).text()
    assert "Known disagreements" not in bare
