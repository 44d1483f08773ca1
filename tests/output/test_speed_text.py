"""Claims about the words of `vv speed`: tables and profiles, cell by cell, of costs made by hand.

A scheme of second order needs 100 h^2 for an error and 1e-7/h s for it.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import pytest

from tests.support.records.priced import manifest, record
from vv.insight.effort import Effort, efforts, untimed
from vv.output import speed_text
from vv.records.job_record import Record

SECOND = [(h, None, 100 * h * h, 1e-7 / h) for h in (1e-2, 1e-3, 5e-5)]
FIRST = [(h, None, 0.5 * h, 1e-6 / h) for h in (1e-2, 1e-3)]


def untouched(rows: list[Any]) -> list[Any]:
    """Settings that were not timed."""
    return [(dt, kn, error, None) for dt, kn, error, _ in rows]


def timed(**codes: list[Any]) -> list[Effort]:
    records = [record(code, row) for code, rows in codes.items() for row in rows]
    return efforts(manifest(*records))


def words(line: str) -> str:
    """A line without its columns."""
    return " ".join(line.split())


def test_a_table_has_each_cost_the_least_error_and_the_order_in_its_cell() -> None:
    _, head, names, first, second, *_ = speed_text.tables(timed(ours=SECOND, theirs=FIRST))
    assert head == "made-up:a: CPU time of the stepping loop to reach an error of"
    assert words(names) == "scheme 1e-02 1e-03 1e-04 1e-06 least order in dt"
    # error e: h = sqrt(e/100), cost 1e-7/h; the coarsest has 1e-2 already
    assert words(first) == "ours/default <10 us* 32 us* 100 us* 1 ms* 2.5e-07 2.00"
    # error e: h = 2 e, cost 1e-6/h
    assert words(second) == "theirs/default <100 us 500 us - - 5.0e-04 1.00"


def test_names_are_as_wide_as_the_longest_but_at_least_eight() -> None:
    long = [*speed_text.tables(timed(a=SECOND, with_a_long_name=FIRST))]
    assert long[2].startswith(f"  {'scheme':<24}      1e-02")
    assert long[3].startswith(f"  {'a/default':<24}    <10 us*")
    short = [dataclasses.replace(one, label="a/b") for one in timed(a=SECOND)]
    assert [*speed_text.tables(short)][3].startswith("  a/b         <10 us*")


def test_the_advice_is_the_cheapest_timed_setting_and_errors_with_one_answer_share_a_line() -> None:
    lines = [*speed_text.tables(timed(ours=SECOND, theirs=FIRST))]
    advice = [line.strip() for line in lines if line.startswith("  for ")]
    assert advice == [
        "for 1e-02 take, of timed settings, ours/default at dt = 0.01 s: error 1.0e-02 in 10 us",
        "for 1e-03, 1e-04 take, of timed settings, ours/default at dt = 0.001 s: "
        "error 1.0e-04 in 100 us",
        "for 1e-06 take, of timed settings, ours/default at dt = 5e-05 s: error 2.5e-07 in 2 ms",
    ]
    assert tuple(lines[-len(speed_text.NOTES) :]) == speed_text.NOTES
    assert [*speed_text.tables([])] == []


def test_a_floor_is_said_beside_the_least_error() -> None:
    flat = [(h, None, 1e-3, 1e-7 / h) for h in (4e-3, 2e-3, 1e-3)]
    (row,) = [line for line in speed_text.tables(timed(flat=flat)) if line.startswith("  flat/")]
    assert row.split()[-3:] == ["1.0e-03", "floor", "-"]


def test_an_order_is_that_of_the_step_where_no_stiffness_limits_the_error_too() -> None:
    stiff = [(h, 1e9, error, cpu) for h, _, error, cpu in SECOND]
    (row,) = [line for line in speed_text.tables(timed(stiff=stiff)) if line.startswith("  stiff/")]
    assert row.split()[-2:] == ["2.5e-07", "-"]
    assert "at dt = 5e-05 s, kn = 1e+09 N/m:" in " ".join(speed_text.tables(timed(stiff=stiff)))


def test_what_was_not_timed_shows_the_most_accurate_setting_with_its_indicative_cost() -> None:
    records = [record("ours", row) for row in untouched(SECOND)]
    records += [record("theirs", row, kn) for kn, row in zip("b", untouched(FIRST), strict=False)]
    records.append(record("long_name", (0.5, None, None, None)))
    head, a, names, ours, second, b, _, theirs = speed_text.indicative(untimed(manifest(*records)))
    assert head == second == ""
    assert a.startswith("made-up:a: not timed;")
    assert b.startswith("made-up:b: not timed;")
    assert names == "  scheme           error      cost  order setting"
    assert ours == "  ours/default   2.5e-07     ~1 ms  2.00  dt = 5e-05 s"
    assert theirs == "  theirs/default   5.0e-03     ~1 ms  -     dt = 0.01 s"


def test_in_a_column_of_what_was_not_timed_short_names_have_eight_places() -> None:
    found = untimed(manifest(*(record("ours", row) for row in untouched(SECOND))))
    (short,) = (dataclasses.replace(one, label="a/b") for one in found)
    *_, row = speed_text.indicative([short])
    assert row.startswith("  a/b        2.5e-07")


def test_a_profile_is_told_of_two_variants_and_more_and_counts_shares_in_percent() -> None:
    every = efforts(
        manifest(
            *(record("ours", row, v) for v in "ab" for row in SECOND),
            *(record("theirs", row, "a") for row in FIRST),
        )
    )
    assert [*speed_text.profiles([one for one in every if one.variant == "a"])] == []
    _, head, factors, first, second = speed_text.profiles(every)
    assert head.startswith("share of the 2 variants that some scheme solves to 0.001,")
    assert factors.split() == ["scheme", "1", "2", "10", "100", "10000"]
    # 500 us beside 32 us: within 100 times, on one of two variants
    assert first.split() == ["ours/default", *["100%"] * 5]
    assert second.split() == ["theirs/default", "0%", "0%", "0%", "50%", "50%"]


def test_in_a_profile_short_names_have_eight_places_and_long_ones_as_many_as_they_need() -> None:
    every = efforts(manifest(*(record("ours", row, v) for v in "ab" for row in SECOND)))
    for label, wide in (("a/b", 8), ("as_long/as_that", 15)):
        named = [dataclasses.replace(one, label=label) for one in every]
        *_, head, row = speed_text.profiles(named)
        assert head.startswith(f"  {'scheme':<{wide}}       1")
        assert row.startswith(f"  {label:<{wide}}    100%")


@pytest.mark.parametrize(("whole", "said"), [(True, 1), (False, 0)])
def test_a_code_whose_costs_are_of_whole_processes_is_named_once(whole: bool, said: int) -> None:
    made = [record("ours", row) for row in SECOND]
    every: list[Record] = [
        dataclasses.replace(one, cost=dataclasses.replace(one.cost, whole=whole)) for one in made
    ]
    lines = [*speed_text.whole(every)]
    assert len(lines) == said
    assert all(line.startswith("ours/default: its costs are those of whole") for line in lines)


def test_the_least_error_and_the_most_accurate_setting_need_not_be_the_last() -> None:
    rises = [(1e-2, None, 4e-3, 1e-5), (1e-3, None, 2e-3, 2e-5), (1e-4, None, 7e-3, 3e-5)]
    (row,) = [line for line in speed_text.tables(timed(a=rises)) if line.startswith("  a/default")]
    assert "2.0e-03" in row
    *_, shown = speed_text.indicative(
        untimed(manifest(*(record("a", one) for one in untouched(rises))))
    )
    assert words(shown).startswith("a/default 2.0e-03 ~1 ms")
    assert shown.endswith("dt = 0.001 s")
    records = [record("a", row) for row in untouched(rises)]
    priced = [dataclasses.replace(one, cost=dataclasses.replace(one.cost, solve_cpu=seconds))
              for one, seconds in zip(records, (1.0, 2.0, 4.0), strict=True)]  # fmt: skip
    *_, shown = speed_text.indicative(untimed(manifest(*priced)))
    assert words(shown).startswith("a/default 2.0e-03 ~2 s")


@pytest.mark.parametrize(
    ("untimed", "said"), [([], []), (["fall"], ["fall"]), (["a", "b"], ["a, b"])]
)
def test_cases_that_are_not_timed_are_named(untimed: list[str], said: list[str]) -> None:
    lines = [*speed_text.beside(untimed)]
    assert [line.partition(", and other variants")[0] for line in lines] == [
        f"\nnot timed: {names}" for names in said
    ]
