"""What accuracy costs: interpolation, floors, fronts and comparisons on records made up for it."""

from __future__ import annotations

import dataclasses
import math

import pytest

from tests.support import fabricated
from tests.support.records.priced import SECOND, Row, manifest, one, record
from vv.insight.accuracy_cost import (
    FACTORS,
    cheapest,
    comparisons,
    error_cost,
    front,
    profile,
    shares,
)
from vv.insight.effort import efforts, untimed, untimed_costs
from vv.records.rungs import describe, row_of


def test_the_cost_of_an_error_lies_on_the_line_between_rungs() -> None:
    assert error_cost(one(SECOND), 1e-5).cpu == pytest.approx(1e-7 / math.sqrt(1e-7))


def test_an_error_above_the_coarsest_costs_at_most_that_and_one_below_all_has_no_cost() -> None:
    found = error_cost(one(SECOND), 0.5)
    assert found.cpu == pytest.approx(1e-5)
    assert found.bound
    assert error_cost(one(SECOND), 1e-7).cpu is None


def test_of_each_code_the_cheapest_setting_of_any_scheme_is_taken() -> None:
    rows = {
        "ours/plain": [(1e-2, 1e-3, 4.0), (1e-3, 1e-5, 40.0)],
        "ours/sharp": [(1e-2, 1e-4, 3.0), (1e-3, 1e-6, 90.0)],
        "theirs/plain": [(1e-2, 1e-3, 5.0), (1e-3, 1e-5, 2.0)],
    }
    every = efforts(
        manifest(
            *(
                dataclasses.replace(record(code, (dt, None, error, cpu)), scheme=scheme)
                for label, settings in rows.items()
                for code, scheme in [label.split("/")]
                for dt, error, cpu in settings
            )
        )
    )
    found = [(label, point.dt, point.cpu) for label, point in cheapest(every, 2e-3)]
    assert found == [("theirs/plain", 1e-3, 2.0), ("ours/sharp", 1e-2, 3.0)]
    found = [(label, point.dt, point.cpu) for label, point in cheapest(every, 2e-5)]
    assert found == [("theirs/plain", 1e-3, 2.0), ("ours/plain", 1e-3, 40.0)]


def test_a_rung_without_timing_or_without_error_has_no_say_in_costs() -> None:
    rows: list[Row] = [*SECOND, (1e-5, None, 1e-8, None), (1e-6, None, None, 1.0)]
    assert error_cost(one(rows), 1e-7).cpu is None
    assert one(rows).best == 1e-8


def test_a_rung_of_which_one_error_is_missing_has_none() -> None:
    parts = [
        fabricated.entry("pass", {"max": 1e-4}),
        fabricated.entry("fail", {"max": None}, name="z"),
    ]
    for quantities, error in ((parts, None), (parts[:1], 1e-4)):
        whole = fabricated.record("ours/default", "a", 1e-3, quantities=quantities)
        assert [point.error for point in row_of(None, [whole]).points] == [error]


def test_no_model_error_is_claimed_below_what_the_limit_is_known_to() -> None:
    rows: list[Row] = [(h, 1e8, h * h, 1.0) for h in (4e-3, 2e-3, 1e-3)]
    assert "the model's part below 1.2e-06" in describe(one(rows).rows[0])


def test_costs_of_two_sessions_are_never_in_one_table() -> None:
    sessions = ("one", "two", "one")
    rows = [record("ours", row, session=s) for row, s in zip(SECOND, sessions, strict=True)]
    with pytest.raises(ValueError, match=r"2 timing sessions \(one, two\)"):
        efforts(manifest(*rows))


def test_what_is_not_timed_has_errors_and_indicative_costs() -> None:
    rows = [record("ours", (h, None, h, None), "b") for h in (1e-2, 1e-3)]
    (rest,) = untimed(manifest(*rows, *(record("ours", row) for row in SECOND)))
    assert [(p.error, p.cpu, p.indicative) for p in rest.points] == [
        (1e-2, None, 1e-3),
        (1e-3, None, 1e-3),
    ]


def test_patience_ends_after_a_minute() -> None:
    floor = one([(1e-3, None, 1e-2, 1.0), (1e-4, None, 1e-3, 61.0)]).floor
    assert floor is not None
    assert "61 s" in floor.why


def test_nothing_on_the_front_is_beaten_in_both() -> None:
    slow = one([(None, None, 1e-15, 1.0), (None, None, 1e-3, 2.0)], "slow")
    kept = front([one(SECOND), slow])
    assert [name for name, _ in kept] == ["ours/default"] * 3 + ["slow/default"]
    assert [p.error for _, p in kept] == sorted((p.error or 0.0 for _, p in kept), reverse=True)


def test_a_duel_is_between_the_best_of_both_sides_and_tells_steppers_apart() -> None:
    every = efforts(
        manifest(
            *(record("ours", row) for row in SECOND),
            record("exact", (None, None, 1e-15, 1e-6)),
            *(record("theirs", (h, None, 100 * h * h, 1e-5 / h)) for h in (1e-2, 1e-3, 1e-4)),
        )
    )
    free, stepping = comparisons(every, (1e-5,))
    assert (free.ours, stepping.ours, free.theirs) == (
        "exact/default",
        "ours/default",
        "theirs/default",
    )
    assert stepping.ratio == pytest.approx(1e-2)
    lost = comparisons(every, (1e-9,))[0]
    assert lost.ratio is None
    assert lost.least == pytest.approx(1e-6)
    assert not lost.floored


def test_an_external_code_that_cannot_get_there_is_told_from_one_that_was_not_let() -> None:
    ours = [record("ours", row) for row in SECOND]
    stuck = [record("theirs", (2.0**-i, None, 1e-3, 1.0)) for i in range(3)]
    going = [record("theirs", row, scheme="other") for row in SECOND[:2]]
    for theirs, floored in ((stuck, True), (stuck + going, False)):
        found = comparisons(efforts(manifest(*ours, *theirs)), (1e-5,))
        assert [(duel.ratio, duel.floored) for duel in found] == [(None, floored)] * 2


def test_a_duel_says_that_theirs_may_be_cheaper_or_how_near_the_nearest_of_them_gets() -> None:
    runs = [record("ours", row) for row in ((1e-2, None, 1e-2, 4.0), (1e-3, None, 1e-5, 40.0))]
    runs += [record("theirs", row) for row in ((1e-2, None, 5e-3, 3.0), (1e-3, None, 7e-4, 30.0))]
    runs += [record("theirs", (1e-2, None, 2e-3, 70.0), scheme="other")]
    found = comparisons(efforts(manifest(*runs)), (6e-3, 3e-3, 1e-4))
    free = [duel for duel in found if not duel.stepping]
    assert [(duel.theirs, duel.loose, duel.least) for duel in free] == [
        ("theirs/default", True, None),  # its coarsest is as accurate; ours lies between settings
        ("theirs/default", False, None),
        ("", False, 7e-4),
    ]
    # 4 (40/4)^s, s = ln(1e-2/6e-3)/ln(1e-2/1e-5), over 3
    assert free[0].ratio == pytest.approx(4 / 3 * 10 ** (math.log(5 / 3) / math.log(1e3)))


def test_a_profile_is_sorted_whatever_the_order_of_the_variants() -> None:
    costs = {"a": (1.0, 5.0), "b": (1.0, 2.0), "c": (1.0, 3.0)}
    rows = [record(code, (1e-3, None, 1e-4, cpu), variant)
            for variant, own in costs.items()
            for code, cpu in zip(("ours", "theirs"), own, strict=True)]  # fmt: skip
    assert profile(efforts(manifest(*rows)), 1e-3)["theirs/default"] == [2.0, 3.0, 5.0]


def test_a_share_is_of_the_variants_solved_within_each_factor() -> None:
    rows = [1.0, 1.0, FACTORS[-1], math.inf]
    assert shares(rows)[0] == 0.5
    assert shares(rows)[-1] == 0.75
    assert shares([]) == []


def test_a_profile_counts_failures_as_infinitely_dear() -> None:
    rows = [record("ours", row, v) for row in SECOND for v in "ab"]
    rows += [record("theirs", (h, None, 100 * h * h, 1e-6 / h), "a") for h in (1e-2, 1e-3, 1e-4)]
    found = profile(efforts(manifest(*rows)), 1e-5)
    assert found["ours/default"] == [1.0, 1.0]
    assert found["theirs/default"] == [pytest.approx(10.0), math.inf]


def test_a_rung_counts_for_the_front_if_it_has_both_cost_and_error() -> None:
    rows = [(1e-2, None, 1e-1, None), (1e-3, None, None, 1.0), (1e-4, None, 1e-3, 2.0)]
    assert [point.dt for _, point in front([one(rows)])] == [1e-4]


def test_the_largest_of_several_errors_that_are_judged_is_a_rung_s() -> None:
    both = tuple(
        fabricated.entry("pass", {"max": error}, name=name)
        for name, error in (("a", 2e-4), ("b", 3e-2))
    )
    whole = dataclasses.replace(record("ours", (1e-3, None, 1e-3, 1.0)), quantities=both)
    assert row_of(None, [whole]).errors == [3e-2]


def test_costs_that_are_not_timed_stand_in_where_there_are_some() -> None:
    rows = [(2e-3, None, 1e-2, None), (1e-3, None, 1e-3, None)]
    (found,) = untimed(manifest(*(record("ours", row) for row in rows)))
    assert [p.cpu for row in untimed_costs(found).rows for p in row.points] == [1e-3, 1e-3]
    free = dataclasses.replace(record("ours", rows[0]), cost=fabricated.cost(cpu=0.0))
    (none,) = untimed(manifest(free))
    assert [p.cpu for row in untimed_costs(none).rows for p in row.points] == [None]


def test_a_rung_that_is_worse_than_one_before_does_not_move_the_line_of_costs() -> None:
    rows = [(4e-3, None, 1e-1, 1.0), (2e-3, None, 5e-1, 2.0), (1e-3, None, 1e-3, 4.0)]
    assert error_cost(one(rows), 1e-2).cpu == pytest.approx(2.0)  # half way from 1 to 4
