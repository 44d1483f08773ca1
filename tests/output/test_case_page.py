"""Claims about the page of a case: schemes that run a variant, why others do not, numbers."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from vv.output.gallery.case_page import CasePage
from vv.output.gallery.numbers_page import numbers_page

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
