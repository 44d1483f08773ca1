"""Claims about changes of one parameter at a time: each is made once, others stay the same."""

from __future__ import annotations

from pathlib import Path

from bench.chance.extremes import changed, everything
from vv.case import Level
from vv.plan.project import find
from vv.plan.selection import select

PROJECT = find(Path(__file__))


def test_each_parameter_is_changed_alone_and_by_every_factor() -> None:
    case = PROJECT.load_case("dashpot")
    variant = case.variants[0].name
    usual = {name: value for name, value in case.defaults(variant).items() if value}
    made = [one.settings for one in changed(case, variant, [0.1, 8.0])]
    assert made == [
        (f"{name}={factor * value:.8g}",) for name, value in usual.items() for factor in (0.1, 8.0)
    ]


def test_counts_stay_whole_and_a_change_that_changes_nothing_is_not_made() -> None:
    case = PROJECT.load_case("masonry")
    made = [one.settings[0] for one in changed(case, "slides", [1.4])]
    counts = {parameter.name for parameter in case.parameters if parameter.whole}
    assert [one for one in made if one.split("=")[0] in counts]
    assert all(one.split("=")[1].isdigit() for one in made if one.split("=")[0] in counts)
    assert not list(changed(case, "slides", [1.0]))


def test_every_case_that_runs_at_level_quick_is_swept() -> None:
    quick = {
        case.name
        for case, variant in select(PROJECT, ["*"])
        if case.parameters and case.variant(variant).runs_at(Level.QUICK)
    }
    assert {one.case for one in everything(PROJECT, "*", [1.5])} == quick
