"""Patterns that select cases and codes; one that is no name is refused before anything is read."""

import time

import pytest

from tests import ROOT
from vv.base.errors import UsageError
from vv.plan import selection
from vv.plan.project import Project

STARS = "*" * 100_000


def test_a_pattern_that_is_too_long_is_refused_at_once_for_cases_and_codes() -> None:
    began = time.process_time()
    with pytest.raises(UsageError, match=r"100000 characters, '\*{20}\.\.\.'; at most 200 are"):
        selection.select(Project(ROOT), [STARS])
    with pytest.raises(UsageError, match="100000 characters"):
        selection.named_adapters(Project(ROOT), [STARS])
    assert time.process_time() - began < 1.0  # fnmatch alone takes some 15 s


def test_the_longest_pattern_is_read() -> None:
    found = selection.select(Project(ROOT), ["single-contact:T1" + "*" * 183])
    assert "T1" in {variant for _, variant in found}


@pytest.mark.parametrize(
    ("patterns", "wanted"),
    [
        (["single-contact:T1", "single-contact:T3"], ["T1", "T3"]),
        (["single-contact:T3", "single-contact:T1"], ["T1", "T3"]),  # in the order of the case
        (["single-contact:T3", "single-contact:T[13]"], ["T1", "T3"]),  # each once
        (["contact:T3", "single-contact:T1"], ["T1", "T3"]),  # by its family and by its name
    ],
)
def test_several_patterns_select_what_any_of_them_selects(
    patterns: list[str], wanted: list[str]
) -> None:
    found = selection.select(Project(ROOT), patterns)
    assert [(case.name, variant) for case, variant in found] == [
        ("single-contact", variant) for variant in wanted
    ]


def test_several_patterns_choose_the_schemes_that_any_of_them_chooses() -> None:
    adapters = selection.named_adapters(Project(ROOT), ["dem/default", "dda/default", "dem/def*"])
    for patterns in (["dem/default", "dda/default"], ["dda/default", "dem/def*", "dem/default"]):
        chosen = selection.choose_schemes(adapters, patterns)
        assert sorted(f"{adapter.name}/{scheme.name}" for adapter, scheme in chosen) == [
            "dda/default",
            "dem/default",
        ]
