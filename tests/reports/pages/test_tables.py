"""Claims about the tables of a variant: groups of settings, costs, and reasons of colours."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace
from typing import Any

import pytest

from reports.marks import marks
from reports.outcomes import OUTCOMES
from reports.variant.ranking import Ranked, cheapest, ranked, why_colours_differ
from reports.variant.settings import Group, groups
from tests.support.fabricated import changed, cost, entry, record
from vv.records.job_record import Record
from vv.records.outcomes import Outcome

LOOKS = marks(["a/a", "b/b", "c/c"])


def ran(label: str, dt: float, kn: float | None = None, error: float = 1e-4, **said: Any) -> Record:
    known = [entry(said.pop("verdict", "pass"), {"max": error}, note=said.pop("note", ""))]
    rung = {"dt": dt, "kn": kn}
    return record(
        label, "T1", dt, quantities=known, rung=rung, key=f"{label}{dt}{kn}".encode().hex(), **said
    )


def table(*pile: Record) -> Group:
    (made,) = groups({"a/a": pile}, LOOKS)
    return made


@pytest.mark.parametrize(
    ("notes", "shared", "own"),
    [
        (("drag is late", "drag is late"), ["drag is late"], ["", ""]),
        (("drag is late", "of the step"), [], ["drag is late", "of the step"]),
        (("drag is late", ""), [], ["drag is late", ""]),
        (("", "drag is late"), [], ["", "drag is late"]),
        (("", ""), [], ["", ""]),
    ],
)
def test_a_note_stands_above_where_all_settings_have_it_and_else_at_its_own(
    notes: tuple[str, str], shared: list[str], own: list[str]
) -> None:
    made = table(*(ran("a/a", dt, note=one) for dt, one in zip((2e-3, 1e-3), notes, strict=True)))
    assert made.notes == shared
    assert [row.note for row in made.rows] == own


def test_a_reason_and_a_note_stand_both() -> None:
    made = table(ran("a/a", 2e-3, reason="odd", note="late"), ran("a/a", 1e-3))
    assert [row.note for row in made.rows] == ["odd; late", ""]


def test_a_table_is_of_one_scheme_quantity_and_stiffness_softest_first() -> None:
    soft, stiff = (ran("b/b", 1e-3, kn) for kn in (1e8, 1e9))
    both = changed(ran("a/a", 1e-3), quantities=[
        entry("pass", {"max": 1e-4}, name=name) for name in ("z", "y")
    ])  # fmt: skip
    made = groups({"b/b": [stiff, soft], "a/a": [both]}, LOOKS)
    told = [(g.mark.label, g.quantity, [r.record.rung.kn for r in g.rows]) for g in made]
    assert told == [("a/a", "y", [None]), ("a/a", "z", [None]),
                    ("b/b", "y", [1e8]), ("b/b", "y", [1e9])]  # fmt: skip
    assert [one.first for one in made] == [True, False, True, True]
    assert [one.titled for one in made] == [True, True, True, False]


def test_each_step_has_the_order_from_the_one_before_and_the_table_that_of_all() -> None:
    errors = {4e-3: 16e-4, 2e-3: 4e-4, 1e-3: 0.5e-4}
    made = table(*(ran("a/a", dt, error=error) for dt, error in errors.items()))
    assert made.rows[0].local is None
    assert [row.local for row in made.rows[1:]] == pytest.approx([2.0, 3.0])
    assert made.order is not None
    assert made.order.order == pytest.approx(2.5)
    assert not made.is_number
    number = changed(ran("a/a", 1e-3), quantities=[entry("pass", {}, kind="count", value=2)])
    assert table(number).is_number


def test_costs_are_over_the_cheapest_and_what_has_none_is_left_out() -> None:
    rows: Any = [
        SimpleNamespace(mark=LOOKS[name], cpu=cpu, timed=True, whole=False, error=0.1, setting="")
        for name, cpu in (("b/b", 4.0), ("a/a", None), ("c/c", 2.0))
    ]
    assert [(one.mark.label, one.cpu, one.dearer) for one in cheapest(rows)] == [
        ("c/c", 2.0, 1.0), ("b/b", 4.0, 2.0)
    ]  # fmt: skip
    assert cheapest(rows[1:2]) == []


def row(label: str, outcome: Outcome, error: float | None, **changes: Any) -> Ranked:
    (made,) = ranked({label: [ran(label, 1e-3, cost=cost(cpu=1.0))]}, LOOKS)
    told = [(OUTCOMES[outcome], 1)]
    return dataclasses.replace(made, outcomes=told, error=error, **changes)


@pytest.mark.parametrize(
    ("green", "other", "said"),
    [
        ((Outcome.PASS, 2e-3), (Outcome.FAIL, 1e-3), True),
        ((Outcome.PASS, 2e-3), (Outcome.XFAIL, 1e-3), True),
        ((Outcome.PASS, 1e-3), (Outcome.FAIL, 2e-3), False),
        ((Outcome.FAIL, 2e-3), (Outcome.FAIL, 1e-3), False),
        ((Outcome.PASS, 2e-3), (Outcome.PASS, 1e-3), False),
        ((Outcome.PASS, None), (Outcome.FAIL, 1e-3), False),
        ((Outcome.PASS, 2e-3), (Outcome.FAIL, None), False),
        ((Outcome.XFAIL, 2e-3), (Outcome.FAIL, 1e-3), False),
    ],
)
def test_a_larger_error_that_passes_beside_a_smaller_one_that_does_not_is_explained(
    green: tuple[Outcome, float | None], other: tuple[Outcome, float | None], said: bool
) -> None:
    rows = [row("a/a", *green), row("b/b", *other, why="late")]
    for order in (rows, rows[::-1]):
        assert bool(why_colours_differ(order)) is said


def test_an_explanation_has_both_errors_both_tolerances_and_the_reason() -> None:
    rows = [row("a/a", Outcome.PASS, 2e-3, tolerance=5e-3),
            row("b/b", Outcome.FAIL, 1e-3, tolerance=5e-4, why="late")]  # fmt: skip
    told = why_colours_differ(rows)
    assert "a/a (second order) has 2.0e-3 of 5.0e-3 and passes; b/b (second order) has " in told
    assert told.endswith(f"1.0e-3 of 5.0e-4 and is '{OUTCOMES[Outcome.FAIL].word}': late")
    for without in (rows[0], rows[1]):
        free = dataclasses.replace(without, tolerance=None)
        assert why_colours_differ([free if one is without else one for one in rows]) == ""


@pytest.mark.parametrize(
    ("bound", "said"), [(None, "off 0.12 J nothing promised"), (2e-3, "off 0.12 J of 2e-3 J")]
)
def test_an_energy_off_is_told_beside_what_is_promised(bound: float | None, said: str) -> None:
    ledger = {"terms": {}, "unaccounted": 0.1234, "peak": 9.0, "bound": bound, "audits": {}}
    (one,) = ranked({"a/a": [changed(ran("a/a", 1e-3), ledger=ledger)]}, LOOKS)
    assert one.balance == said
    (none,) = ranked({"a/a": [ran("a/a", 1e-3)]}, LOOKS)
    assert none.balance == ""


def test_a_scheme_is_ranked_by_its_finest_result_and_explained_by_its_worst() -> None:
    none = record("a/a", "T1", 5e-4, status="diverged", reason="it blew up")
    bad = ran("a/a", 4e-3, error=0.5, verdict="fail")
    pile = [bad, ran("a/a", 1e-3, error=1e-5, cost=cost(cpu=0.0)), none]
    (one,) = ranked({"a/a": pile}, LOOKS)
    assert (one.error, one.cpu, one.setting) == (1e-5, None, "dt = 0.001 s")
    assert one.worst_setting in ("dt = 0.004 s", "dt = 0.0005 s")
    (lost,) = ranked({"a/a": [none]}, LOOKS)
    assert (lost.error, lost.tolerance, lost.order, lost.quantity) == (None, None, None, "")


def test_a_row_has_the_model_the_balance_and_the_cost_of_its_finest_setting() -> None:
    def run(dt: float, k: int, verdict: str) -> Record:
        ledger = {"terms": {}, "unaccounted": 2.0 * k, "peak": 9.0, "bound": 7.0 * k, "audits": {}}
        spent = dataclasses.replace(cost(cpu=3.0 * k), solve_wall=5.0 * k, whole=k == 1)
        model = {"unknowns": 11 * k, "terms": [], "note": f"note {k}"}
        return changed(ran("a/a", dt, error=0.1 * k, verdict=verdict, note=f"why {k}", cost=spent),
                       ledger=ledger, model=model)  # fmt: skip

    (one,) = ranked({"a/a": [run(4e-3, 3, "fail"), run(2e-3, 2, "xfail"), run(1e-3, 1, "pass")]},
                    LOOKS)  # fmt: skip
    assert (one.unknowns, one.model and one.model.note) == (11, "note 1")
    assert (one.balance, one.cpu, one.whole) == ("off 2 J of 7 J", 3.0, True)
    assert (one.setting, one.worst_setting) == ("dt = 0.001 s", "dt = 0.004 s")
    assert one.command == "vv run bounce:T1 --codes a/a --rung dt=0.004"
    assert one.why.endswith("why 3")
    assert [(came.word, count) for came, count in one.outcomes] == [
        ("fail", 1), ("known disagreement", 1), ("pass", 1)
    ]  # fmt: skip
