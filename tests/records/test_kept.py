"""Files that people review, and what is refused of a baseline or told of codes."""

from __future__ import annotations

import dataclasses
import json

import pytest

from tests.support.acceptances import ACCEPTANCE, accepted, ran
from tests.support.fabricated import manifest
from vv.records import sorted_text
from vv.records.manifest import CodeFound


def test_a_file_has_a_result_a_line_sorted() -> None:
    text = sorted_text.render({"b": {"y": 1, "x": {"d": 1, "c": 2}}, "a": {}, "c": [2, 1], "d": 0})
    assert json.loads(text) == {"b": {"y": 1, "x": {"d": 1, "c": 2}}, "a": {}, "c": [2, 1], "d": 0}
    first, a, b, x, y, end, *rest = text.splitlines()
    assert (first, b.strip(), end.strip()) == ("{", '"b": {', "},")
    assert [line.strip().partition(":")[0] for line in (a, x, y)] == ['"a"', '"x"', '"y"']
    assert x.index('"c"') < x.index('"d"')
    assert [line.strip()[:3] for line in rest] == ['"c"', '"d"', "}"]


def test_a_baseline_names_its_acceptances_by_number_and_its_results_in_full() -> None:
    whole = accepted(ran())
    ((name, result),) = whole.results.items()
    (number,) = whole.acceptances
    assert dataclasses.replace(whole) == whole
    with pytest.raises(ValueError, match="an acceptance must have a number"):
        dataclasses.replace(whole, acceptances={"first": ACCEPTANCE})
    with pytest.raises(ValueError, match="expected VARIANT CODE/SCHEME SETTING"):
        dataclasses.replace(whole, results={"T1": result})
    with pytest.raises(ValueError, match="there is no such acceptance"):
        dataclasses.replace(whole, results={name: dataclasses.replace(result, by=number + "1")})


def test_a_code_with_files_of_others_or_that_is_not_here_is_external() -> None:
    codes = {
        "ours": CodeFound("1", True, {}), "theirs": CodeFound("1", True, {"bin/x": "digest"}),
        "absent": CodeFound("", False, {}),
    }  # fmt: skip
    assert manifest(codes=codes).external() == {"theirs", "absent"}
