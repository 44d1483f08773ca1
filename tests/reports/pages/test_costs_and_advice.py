"""Claims about costs on the page of a variant: the table, the advice, and the figures."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace
from typing import Any

import pytest

from reports.marks import marks
from reports.variant.advice import advice
from reports.variant.costs import cost_rows
from reports.variant.figures import is_drawn
from tests.support import fabricated
from tests.support.records.priced import manifest, record
from vv.insight.accuracy_cost import TARGETS
from vv.insight.effort import Effort, every_effort
from vv.records.rungs import Floor

LOOKS = marks(["ours/default", "theirs/default"])
STEPS = (4e-3, 2e-3, 1e-3)


def efforts(*rows: Any, code: str = "ours") -> list[Effort]:
    return every_effort(manifest(*(record(code, row) for row in rows)))


def table(*here: Effort, whole: bool = False) -> list[Any]:
    kept = [SimpleNamespace(cost=SimpleNamespace(whole=one)) for one in (False, whole)]
    book: Any = SimpleNamespace(
        efforts={("c", "v"): [*here]}, marks=LOOKS,
        records={("c", "v"): dict.fromkeys(LOOKS, kept)},
    )  # fmt: skip
    return cost_rows(book, ("c", "v"))


def test_a_table_of_costs_is_of_all_schemes_where_any_was_timed() -> None:
    (timed,) = efforts((1e-3, None, 5e-4, 2.0))
    (other,) = efforts((1e-3, None, 5e-4, None), code="theirs")
    assert table(other) == []
    first, second = table(timed, other)
    assert (first.mark, second.mark) == (LOOKS["ours/default"], LOOKS["theirs/default"])
    assert [one.cpu for one in first.reached] == [2.0 if t >= 5e-4 else None for t in TARGETS]
    assert [one.cpu for one in second.reached] == [None] * len(TARGETS)
    assert (first.best, first.notes) == (5e-4, [])
    told = ["costs of whole processes, start and output included"]
    assert [one.notes for one in table(timed, whole=True)] == [told]


def test_the_floor_of_all_knobs_is_told_and_of_each_stiffness_what_its_steps_show() -> None:
    flat = [(dt, kn, 1e-3, 1e-7 / dt) for kn in (1e8, 1e9) for dt in STEPS]
    (one,) = efforts(*flat)
    made = table(one)[0].notes
    assert [note.partition(":")[0] for note in made] == ["kn = 1e8", "kn = 1e9"]
    assert all("floor 1.0e-03" in note for note in made)
    vars(one)["floor"] = Floor(2e-4, "no more is to be had")
    assert table(one)[0].notes[0] == "2.0e-4: no more is to be had"
    (soft,) = efforts(*((dt, None, 1e-3, 1e-7 / dt) for dt in STEPS))
    assert [note.partition(":")[0] for note in table(soft)[0].notes] == ["1.0e-3"]
    (few,) = efforts((1e-3, 1e9, 1e-3, 1.0))
    assert table(few)[0].notes == []  # a single setting gives no advice


def told(*here: Effort) -> list[tuple[str, list[tuple[str, str, str]]]]:
    return [(one.errors, [*one.settings]) for one in advice(here)]


def test_advice_is_the_cheapest_setting_of_each_code_and_errors_with_one_answer_share_it() -> None:
    (ours,) = efforts((1e-2, None, 5e-3, 1.0), (1e-3, None, 5e-5, 9.0))
    (theirs,) = efforts((1e-2, 1e9, 5e-4, 0.5), code="theirs")
    stiff = ("theirs/default", "dt = 0.01 s, kn = 1e9 N/m", "500 ms")
    assert told(ours, theirs) == [
        ("0.01", [stiff, ("ours/default", "dt = 0.01 s", "1 s")]),
        ("1e-3", [stiff, ("ours/default", "dt = 1e-3 s", "9 s")]),
        ("1e-4", [("ours/default", "dt = 1e-3 s", "9 s")]),
    ]
    assert [said for said, _ in told(theirs)] == ["0.01 to 1e-3"]


def test_advice_is_by_indicative_costs_only_where_nothing_was_timed() -> None:
    (free,) = efforts((None, None, 5e-9, None))
    assert told(free) == [("0.01 to 1e-6", [("ours/default", "no knob", "1 ms (indicative)")])]
    (timed,) = efforts((1e-2, None, 5e-3, 1.0), code="theirs")
    assert told(free, timed) == [("0.01", [("theirs/default", "dt = 0.01 s", "1 s")])]
    (worse,) = efforts((1e-2, None, None, 1.0), (1e-3, None, 0.5, 1.0))
    assert told(worse) == []


@pytest.mark.parametrize(
    ("place", "verdict", "drawn"),
    [(0, "pass", True), (1, "pass", True), (2, "pass", False), (2, "fail", True)],
)
def test_the_first_two_quantities_have_figures_and_others_that_are_out_of_bounds(
    place: int, verdict: str, drawn: bool
) -> None:
    facts = fabricated.case().variants["T1"]
    (one,) = facts.quantities
    many = tuple(fabricated.changed(one, name=name) for name in "pqr")
    whole = dataclasses.replace(facts, quantities=many)
    name = "pqr"[place]
    seen = [fabricated.entry(verdict, {"max": 1.0}, name=name)]
    own = [fabricated.record("a/a", "T1", 1e-3, quantities=seen),
           fabricated.record("a/b", "T1", 1e-3)]  # fmt: skip
    assert is_drawn(many[place], whole, own) is drawn


def test_advice_is_given_for_each_power_of_ten_from_a_hundredth_to_a_millionth() -> None:
    for error, said in ((5e-4, "0.01 to 1e-3"), (5e-5, "0.01 to 1e-4"), (5e-6, "0.01 to 1e-5"),
                        (5e-7, "0.01 to 1e-6")):  # fmt: skip
        (one,) = efforts((1e-2, None, error, 1.0))
        assert [errors for errors, _ in told(one)] == [said]
