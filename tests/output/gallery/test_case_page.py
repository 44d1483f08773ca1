"""Claims about the page of a case: schemes that run a variant, why others do not, numbers."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from tests.support.fabricated import case as case_facts
from tests.support.fabricated import changed
from vv.case import Level
from vv.output.gallery.case_page import CasePage, _judged, alike
from vv.output.gallery.numbers_page import numbers_page
from vv.records.case_facts import QuantityFacts, ToleranceFacts
from vv.records.outcomes import JudgeKind

RUNS = "[dem](../codes/dem.md) (default)"


def said(**answers: int | str) -> list[str]:
    """The lines on schemes of variant T1; names: CODE__SCHEME."""
    nothing: Any = None
    rows = {name.replace("__", "/"): {"T1": answer, "T2": 1} for name, answer in answers.items()}
    page = CasePage(nothing, "family", nothing, {}, {**rows, "late/default": {"T2": 1}}, "")
    return [line for line in page._schemes(["T1", "T2"]) if line]


@pytest.mark.parametrize(
    ("answers", "lines"),
    [
        ({"dem__default": 3}, [f"Run by: {RUNS}."]),
        (
            {"dem__default": 3, "dda__default": "it cannot", "dda__lagged": "it cannot"},
            [f"Run by: {RUNS}.", "Not supported:",
             "- [dda](../codes/dda.md) (default, lagged): it cannot"],
        ),
        (
            {"dda__default": "it cannot", "dem__default": "nor it"},
            ["Run by: no scheme.", "Not supported:",
             "- [dda](../codes/dda.md) (default): it cannot",
             "- [dem](../codes/dem.md) (default): nor it"],
        ),
        ({}, []),
    ],
)  # fmt: skip
def test_schemes_that_run_a_variant_stand_before_those_that_do_not_with_the_reason(
    answers: dict[str, int | str], lines: list[str]
) -> None:
    assert said(**answers) == lines


def test_variants_after_the_first_show_the_numbers_in_which_they_differ_from_it() -> None:
    own = {"T1": {"g": "9.81", "mu": "0.5"}, "T2": {"g": "9.81", "m": "2"}}
    case: Any = SimpleNamespace(name="fall")
    blocks = numbers_page(case, own).split("```\n")
    assert blocks[0].startswith("# Numbers of fall\n")
    assert "`T1`:" in blocks[0]
    assert blocks[1] == "g: 9.81\nmu: 0.5\n"
    assert "`T2`:" in blocks[2]
    assert blocks[3].splitlines() == ["m: 2", "mu: none"]


def test_a_quantity_is_told_with_its_error_and_a_tolerance_for_each_class_of_method() -> None:
    told = {
        "first order": ToleranceFacts(2e-3, "lags", dt=1e-3, order=1, floor=1e-6),
        "penalty": ToleranceFacts(0.01, "sinks", kn=1e8, softness=0.5),
        "rounded": ToleranceFacts(0.1, "waits", late=5.0),
        "exact": ToleranceFacts(1e-9, "rounding"),
    }
    one = QuantityFacts(
        "x", "x", "m", "way | along", JudgeKind.EXACT, "largest", told, {"lagging": "it sinks"}
    )
    assert [line for line in _judged(one) if line] == [
        "**x** [m]: way \\| along.",
        "Error: largest.",
        "| class of method | tolerance | why |",
        "|---|---|---|",
        "| first order | 0.002 at dt = 0.001 s, as dt^1, at least 1e-06 | lags |",
        "| penalty | 0.01 at kn = 1e+08 N/m, as kn^-0.5 | sinks |",
        "| rounded | 0.1, plus 5 1/s times dt | waits |",
        "| exact | 1e-09 | rounding |",
        "| lagging | shown only | it sinks |",
    ]
    free = QuantityFacts("n", "n", "", "turns", JudgeKind.SHOWN, reason="nothing is known")
    assert [*_judged(free)] == ["", "**n**: turns.", "Shown: nothing is known."]


def page_of(doi: str = "10.1/2", note: str = "a misprint") -> list[str]:
    """The lines of a page on a case of three variants, of which the first two are alike."""
    facts = case_facts()
    one = changed(facts.variants["T1"], inert=["g"], unknowns=3, terms=["gravity", "drag"])
    last = changed(one, formula="y = 0", inert=[], unknowns=6, terms=["gravity"])
    levels = {"T1": Level.QUICK, "T2": Level.DEFAULT, "T3": Level.PAPER}
    values = {"T1": {"m": 1.0, "g": 2.0}, "T2": {"m": 3.0, "g": 4.0}, "T3": {"m": 5.0, "g": 6.0}}
    parameters = [SimpleNamespace(name=name, unit=unit, meaning=meaning)
                  for name, unit, meaning in (("m", "kg", "mass"), ("g", "", "pull"))]  # fmt: skip
    case: Any = SimpleNamespace(
        name="bounce",
        title="Bounces",
        source=SimpleNamespace(citation="Someone (2001)", doi=doi, note=note),
        published={"Fig. 4": "grows"},
        variants=[SimpleNamespace(name=n, level=level, summary=f"{n} falls")
                  for n, level in levels.items()],
        parameters=parameters,
        defaults=values.__getitem__,
    )  # fmt: skip
    whole = changed(facts, variants={"T1": one, "T2": one, "T3": last})
    answers: dict[str, dict[str, int | str]] = {"dem/default": {"T1": 3, "T2": "no", "T3": "no"}}
    drawings = {"T2": "second.svg", "T3": "third.svg"}
    return CasePage(case, "impact", whole, drawings, answers, "numbers.md").text().splitlines()


def test_a_page_has_each_part_of_its_case_and_of_its_variants_in_its_place() -> None:
    """Variants that are alike share a part, with the first drawing that one of them has."""
    lines = [line for line in page_of() if line]
    told = lines.index("**y** [m]: height.")
    again = lines.index("**y** [m]: height.", told + 1)
    assert lines[:told] == [
        "# bounce",
        "Bounces. Family `impact`.",
        "Source: Someone (2001). [doi:10.1/2](https://doi.org/10.1/2)",
        "a misprint",
        "Published, Fig. 4: grows",
        "## 3 variants",
        "| variant | from level | what it is |",
        "|---|---|---|",
        "| `T1` | quick | T1 falls |",
        "| `T2` | default | T2 falls |",
        "| `T3` | paper | T3 falls |",
        "Run one of them, or all:",
        "```",
        "vv run bounce:T1",
        "vv run bounce",
        "```",
        "[All numbers](numbers.md) that the variants declare are on a page of their own.",
        "## T1, T2",
        "![the scene of T1](second.svg)",
        "```",
        "y = sin 3t",
        "```",
        "| parameter | value | meaning |",
        "|---|---|---|",
        "| `m` | 1 kg | mass |",
        "| `g` | 2 | pull (inert) |",
        "In the scene: gravity, drag. Unknowns: 3.",
    ]
    assert lines[again - 11 : again] == [
        f"Run by: {RUNS}.",
        "## T3",
        "![the scene of T3](third.svg)",
        "```",
        "y = 0",
        "```",
        "| parameter | value | meaning |",
        "|---|---|---|",
        "| `m` | 5 kg | mass |",
        "| `g` | 6 | pull |",
        "In the scene: gravity. Unknowns: 6.",
    ]
    assert lines[-3:] == [
        "Run by: no scheme.", "Not supported:", "- [dem](../codes/dem.md) (default): no"
    ]  # fmt: skip
    bare = page_of("", "")
    assert "Source: Someone (2001)." in bare
    assert "a misprint" not in bare


@pytest.mark.parametrize(
    ("changes", "same"),
    [
        ({"summary": "another"}, True),
        ({"formula": "y = 0"}, False),
        ({"inert": ["m"]}, False),
        ({"unknowns": 6}, False),
        ({"quantities": []}, False),
    ],
)
def test_variants_are_told_together_that_differ_in_their_summary_alone(
    changes: dict[str, Any], same: bool
) -> None:
    one = case_facts().variants["T1"]
    piles = [*alike({"a": one, "b": changed(one, **changes), "c": one})]
    assert piles == ([["a", "b", "c"]] if same else [["a", "c"], ["b"]])


def test_a_quantity_that_is_judged_by_no_method_is_told_with_its_error_and_no_bound() -> None:
    one = QuantityFacts("x", "x", "m", "way", JudgeKind.EXACT, "largest", {}, {"penalty": "soft"})
    assert [line for line in _judged(one) if line][1:] == [
        "Error: largest.",
        "| class of method | tolerance | why |",
        "|---|---|---|",
        "| penalty | shown only | soft |",
    ]
