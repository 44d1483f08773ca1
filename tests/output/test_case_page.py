"""Claims about the page of a case: schemes that run a variant, why others do not, numbers."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from vv.output.gallery.case_page import CasePage, _judged
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
