"""What accuracy costs: interpolation, floors, fronts and comparisons on records made up for it."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Sequence
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support import fabricated
from vv.base.metrics import count_before_floor
from vv.insight.accuracy_cost import (
    FACTORS,
    cheapest,
    comparisons,
    error_cost,
    front,
    profile,
    shares,
)
from vv.insight.effort import Effort, efforts, untimed, untimed_costs
from vv.records.job_record import Record
from vv.records.manifest import CodeFound, Manifest
from vv.records.rungs import describe, row_of

Row = tuple[float | None, float | None, float | None, float | None]  # dt, kn, error, cpu


def record(code: str, row: Row, variant: str = "a", final: float = 1.0, **changes: Any) -> Record:
    dt, kn, error, cpu = row
    figures = {"final": final + (error or 0.0)}
    seen = fabricated.entry("pass", {"max": error}, figures=figures, end=1.0)
    spent = fabricated.cost(timed=cpu is not None, cpu=1e-3 if cpu is None else cpu)
    session = changes.pop("session", "one")
    return fabricated.record(
        f"{code}/default",
        variant,
        dt,
        case="made-up",
        rung={"dt": dt, "kn": kn},
        quantities=[seen],
        cost=dataclasses.replace(spent, session=session),
        **changes,
    )


def manifest(*records: Record) -> Manifest:
    files = {"theirs": {"/usr/bin/theirs": "digest"}}
    codes = {r.code: CodeFound("1", True, files.get(r.code, {})) for r in records}
    return fabricated.manifest(*records, codes=codes)


def one(rows: Sequence[Row], code: str = "ours") -> Effort:
    (found,) = efforts(manifest(*(record(code, row) for row in rows)))
    return found


SECOND = [(h, None, 100 * h * h, 1e-7 / h) for h in (1e-2, 1e-3, 1e-4)]


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


def test_the_order_is_fitted_at_each_stiffness() -> None:
    rows: list[Row] = [(h, kn, kn * h, 1.0) for kn in (1e3, 1e4) for h in (1e-5, 1e-6)]
    orders = {row.kn: row.order and round(row.order.order, 9) for row in one(rows).rows}
    assert orders == {1e3: 1.0, 1e4: 1.0}


def test_rungs_at_a_floor_have_no_say_in_the_order() -> None:
    errors = (1e-2, 2.5e-3, 6.25e-4, 2e-4, 1.9e-4, 2.1e-4)
    rows: list[Row] = [(2.0**-i, None, error, 1.0) for i, error in enumerate(errors)]
    (row,) = one(rows).rows
    assert row.order
    assert (round(row.order.order, 9), row.order.points) == (2.0, 3)


def test_a_ladder_that_is_at_its_floor_from_the_start_has_no_order() -> None:
    (row,) = one([(2.0**-i, None, 1e-3, 1.0) for i in range(3)]).rows
    assert row.order is None
    assert row.floor


@given(st.lists(st.floats(1e-9, 1.0), min_size=1, max_size=8))
def test_what_lies_before_a_floor_is_all_or_leaves_three_that_gain_nothing(
    errors: list[float],
) -> None:
    free = count_before_floor(errors)
    assert free == len(errors) or len(errors) - free >= 3
    tail = errors[free:]
    assert all(a < 1.5 * b for a, b in itertools.pairwise(tail))


@pytest.mark.parametrize(
    ("errors", "floored"),
    [
        ((4e-3, 3e-3, 2.9e-3), True),
        ((4e-3, 1e-3, 0.9e-3), False),
        ((4e-3, 3.9e-3), False),
        ((2e-3, 1.9e-3, 4e-3), True),
    ],
)
def test_a_floor_takes_two_refinements_that_gain_nothing(
    errors: tuple[float, ...], floored: bool
) -> None:
    rows: list[Row] = [(10.0**-i, None, error, 1.0) for i, error in enumerate(errors)]
    assert (one(rows).floor is not None) is floored


STEPS = (1e-3, 5e-4, 2.5e-4)
DEFAULT = [(h, 1e8) for h in STEPS] + [(1e-4, 1e9), (5e-5, 1e10)]  # the rungs of rigid contact


def penalty(*errors: float) -> list[Row]:
    return [(*rung, error, 1.0) for rung, error in zip(DEFAULT, errors, strict=True)]


def test_a_penalty_scheme_has_a_floor_only_when_stiffness_gained_nothing_either() -> None:
    softer: list[Row] = [(h, kn, 1e4 / kn, 1.0) for kn in (1e5, 1e6, 1e7) for h in STEPS]
    alike: list[Row] = [(h, kn, 1e-2, 1.0) for kn in (1e5, 1e6, 1e7) for h in STEPS]
    assert one(softer).floor is None
    assert one(alike).floor is not None


def test_a_floor_is_seen_at_the_rungs_of_the_default_level() -> None:
    stuck = one(penalty(1.1e-2, 1.1e-2, 1.05e-2, 1e-2, 1.1e-2))
    assert stuck.floor
    assert stuck.floor.error == 1e-2
    assert "dt, at kn = 1e+08, and of kn" in stuck.floor.why


@pytest.mark.parametrize(
    "errors",
    [
        (1.1e-2, 1.1e-2, 1.05e-2, 3e-3, 1e-3),  # stiffness gains
        (1.1e-2, 1.1e-2, 1.05e-2, 1e-2, 5e-3),  # at last
        (4e-2, 2e-2, 1e-2, 1e-2, 1e-2),  # the step gains
    ],
)
def test_no_floor_is_claimed_while_one_knob_gains(errors: tuple[float, ...]) -> None:
    assert one(penalty(*errors)).floor is None


def test_a_stiffer_row_of_two_steps_that_gains_forbids_a_floor() -> None:
    rows = penalty(1e-2, 1e-2, 1e-2, 1e-2, 2e-2)
    assert one([*rows, (2.5e-5, 1e10, 1.5e-2, 1.0)]).floor is not None
    assert one([*rows, (2.5e-5, 1e10, 1e-2, 1.0)]).floor is None


def test_the_floor_of_dt_at_a_stiffness_is_the_model_s_and_told_from_the_step_s() -> None:
    """Errors 1e-3 + h^2: the limit is 1e-3 off, and h^2 is what the finest step adds."""
    rows: list[Row] = [(h, 1e8, 1e-3 + h * h, 1.0) for h in (4e-3, 2e-3, 1e-3)]
    (row,) = one(rows).rows
    assert row.floor
    assert row.limit
    assert row.limit.model == pytest.approx(1e-3)
    assert row.limit.step == pytest.approx(1e-6)
    assert "floor 1.0e-03" in describe(row)
    assert "limit of small steps 1.0e-03 off the exact" in describe(row)
    assert "the step's part 1.0e-06 at dt = 0.001, of order 2.00" in describe(row)


def test_the_step_s_part_is_not_made_small_by_an_order_that_no_scheme_has() -> None:
    rows: list[Row] = [(h, 1e8, 1e-3 + 1e12 * h**7, 1.0) for h in (4e-3, 2e-3, 1e-3)]
    (row,) = one(rows).rows
    assert row.limit
    assert row.limit.step == pytest.approx(1e12 * (2e-3**7 - 1e-3**7) / 3)


def test_the_limit_is_that_of_the_three_finest_of_many_steps() -> None:
    """Coarse steps are off by another law, and by one that has a limit of its own."""
    coarse = [(h, None, 0.5 + h, None) for h in (0.4, 0.2, 0.1)]
    fine = [(h, None, 1e-3 + h * h, None) for h in (4e-3, 2e-3, 1e-3)]
    row = row_of(None, [record("ours", one) for one in coarse + fine])
    assert row.limit
    assert row.limit.dt == 1e-3
    assert row.limit.model == pytest.approx(1e-3)


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


def test_orders_and_floors_are_of_rungs_with_a_step_and_an_error() -> None:
    rows = [(4e-3, None, 4e-2, 1.0), (None, None, 1e-2, 1.0), (2e-3, None, None, 1.0),
            (1e-3, None, 1e-2, 1.0)]  # fmt: skip
    row = row_of(None, [record("ours", one) for one in rows])
    assert row._known == [(4e-3, 4e-2), (1e-3, 1e-2)]
    flat = [(dt, None, error, 1.0) for dt, error in ((4e-3, 3e-3), (2e-3, 1e-3), (1e-3, 1.1e-3))]
    floor = row_of(None, [record("ours", one) for one in flat]).floor
    assert floor is None or floor.error == 1e-3


def test_the_parts_of_model_and_step_are_over_the_scale_of_a_quantity() -> None:
    """Finals 1 + 4e-2, 1 + 1e-2, 1 + 2.5e-3: of order 2, to 1, where 0.9 is due."""
    pile = []
    for dt, error in ((4e-3, 4e-2), (2e-3, 1e-2), (1e-3, 2.5e-3)):
        whole = record("ours", (dt, 1e6, error, 1.0))
        seen = dataclasses.replace(whole.quantities[0], scale=4.0, end=0.9)
        pile.append(dataclasses.replace(whole, quantities=(seen,)))
    limit = row_of(1e6, pile).limit
    assert limit is not None
    assert limit.model == pytest.approx(0.1 / 4)
    assert limit.step == pytest.approx(2.5e-3 / 4)
    unscaled = [
        dataclasses.replace(r, quantities=(dataclasses.replace(r.quantities[0], scale=None),))
        for r in pile
    ]
    bare = row_of(1e6, unscaled).limit
    assert bare is not None
    assert (bare.model, bare.step) == (None, None)


def test_a_limit_is_described_where_there_is_a_stiffness_and_by_what_is_known_of_it() -> None:
    def told(kn: float | None, end: float | None) -> str:
        pile = []
        for dt, error in ((4e-3, 4e-2), (2e-3, 1e-2), (1e-3, 2.5e-3)):
            whole = record("ours", (dt, kn, error, 1.0))
            seen = dataclasses.replace(whole.quantities[0], end=end)
            pile.append(dataclasses.replace(whole, quantities=(seen,)))
        return describe(row_of(kn, pile))

    assert told(None, 1.0) == ""
    assert told(1e6, None) == "final value: the step's part 2.5e-03 at dt = 0.001, of order 2.00"
    assert "limit of small steps 1.0e-01 off the exact" in told(1e6, 0.9)
    assert "the model's part below" in told(1e6, 1.0)


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
