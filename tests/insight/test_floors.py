"""Orders, floors in the step and in the stiffness, and the limits of refinement, by hand."""

from __future__ import annotations

import dataclasses
import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support.records.priced import Row, one, record
from vv.base.metrics import count_before_floor
from vv.records.outcomes import JudgeKind
from vv.records.rungs import describe, row_of


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


def test_a_softer_row_of_two_steps_that_gains_forbids_no_floor() -> None:
    softer: list[Row] = [(1e-3, 1e7, 4e-2, 1.0), (5e-4, 1e7, 1.1e-2, 1.0)]
    assert one([*softer, *penalty(1e-2, 1e-2, 1e-2, 1e-2, 1e-2)]).floor is not None


def test_a_stiffer_row_of_two_steps_that_gains_forbids_a_floor() -> None:
    rows = penalty(1e-2, 1e-2, 1e-2, 1e-2, 2e-2)
    assert one([*rows, (2.5e-5, 1e10, 1.5e-2, 1.0)]).floor is not None
    assert one([*rows, (2.5e-5, 1e10, 1e-2, 1.0)]).floor is None


def test_the_row_that_is_stiffer_by_one_forbids_a_floor_too() -> None:
    for coarse, forbidden in ((1.2e-2, False), (2e-2, True)):
        rows = penalty(1e-2, 1e-2, 1e-2, coarse, 1e-2)
        assert (one([*rows, (2.5e-5, 1e9, 1e-2, 1.0)]).floor is None) is forbidden


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


def test_a_floor_is_the_least_of_all_errors_and_named_at_the_stiffest_row_of_steps() -> None:
    softest = [(h, 1e7, e, 1.0) for h, e in zip(STEPS, (1.3e-2, 1.25e-2, 1.24e-2), strict=True)]
    soft = [(h, 1e8, e, 1.0) for h, e in zip(STEPS, (1.1e-2, 1.0e-2, 1.05e-2), strict=True)]
    stiff: list[Row] = [(1e-4, 1e9, 1.02e-2, 1.0), (5e-5, 1e10, 1.03e-2, 1.0)]
    floor = one([*softest, *soft, *stiff]).floor
    assert floor
    assert floor.error == 1.0e-2
    assert floor.why.startswith("two refinements each of dt, at kn = 1e+08, and of kn")


def test_the_least_error_of_all_that_was_spent_is_a_floor() -> None:
    rows: list[Row] = [(1e-3, 1e7, 5e-3, 70.0), (1e-3, 1e8, 2e-3, 1.0), (1e-3, 1e9, 4e-3, 3.0)]
    floor = one(rows).floor
    assert floor
    assert (floor.error, floor.why) == (2e-3, "70 s were spent")


def test_the_floor_of_a_row_is_its_least_error_and_only_errors_that_judge_count() -> None:
    flat = [(dt, None, e, 1.0) for dt, e in zip(STEPS, (2e-3, 1.9e-3, 1.95e-3), strict=True)]
    floor = row_of(None, [record("ours", one) for one in flat]).floor
    assert floor
    assert floor.error == 1.9e-3
    whole = record("ours", flat[0])
    kept = dataclasses.replace(whole.quantities[0], judge=JudgeKind.INVARIANT, errors={})
    both = dataclasses.replace(whole, quantities=(*whole.quantities, kept))
    assert [point.error for point in row_of(None, [both]).points] == [2e-3]
