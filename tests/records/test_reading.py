"""What is read off a record or a finding, one row a decision."""

import pytest

from tests.support.fabricated import changed, cost, entry, record
from vv.ask import Knobs
from vv.records.finding import Aspect, Bit, Finding, bits, worst_first
from vv.records.job_record import JobCost
from vv.records.outcomes import CostKind
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import fineness, in_words, ran, to_the_last_digit, too_long, tried


@pytest.mark.parametrize(
    ("status", "done", "taken_on", "long"),
    [
        ("ran", True, True, False),
        ("error", False, True, False),
        ("diverged", False, True, False),
        ("timeout", False, True, False),
        ("not-run", False, True, False),
        ("refused", False, False, False),
        ("not-installed", False, False, False),
        ("too-long", False, False, True),
    ],
)
def test_a_status_says_whether_it_ran_and_was_taken_on(
    status: str, done: bool, taken_on: bool, long: bool
) -> None:
    one = record("dem/default", "T1", 1e-3, status=status)
    assert (ran(one), tried(one), too_long(one)) == (done, taken_on, long)


def test_settings_are_sorted_from_soft_to_stiff_and_from_coarse_to_fine() -> None:
    soft, stiff = (Knobs(1e-1), Knobs(1e-2), Knobs()), (Knobs(1e-1, 1e8), Knobs(1e-2, 1e8))
    ordered = [*soft, Knobs(1e-3, 1e6), *stiff]
    assert sorted([*stiff, ordered[3], *soft], key=fineness) == ordered
    assert sorted([*stiff[::-1], ordered[3], *soft[::-1]], key=fineness) == ordered
    assert [in_words(k) for k in ordered[2:4]] == ["", "dt=0.001,kn=1000000"]


def test_the_elapsed_time_is_the_sum_of_its_parts() -> None:
    spent = JobCost(1.0, 2.0, 400.0, 8.0, 16.0, 1, 0.0)
    assert (spent.elapsed, spent.timed, spent.kind) == (27.0, False, CostKind.INDICATIVE)
    assert cost(timed=True).timed


def test_a_quantity_is_found_by_its_name_and_its_error_by_its_norm() -> None:
    quantities = [entry("pass", {"max": 1.0, "final": 2.0}, name=name) for name in ("x", "y")]
    one = record("dem/default", "T1", 1e-3, quantities=quantities)
    assert one.quantities[1].name == "y"
    final: MeasuredQuantity = changed(one.quantities[0], norm="final")
    none: MeasuredQuantity = changed(one.quantities[0], norm=None)
    assert (final.error, none.error) == (2.0, 1.0)


@pytest.mark.parametrize(
    ("bit", "enforced", "red"),
    [(1, True, True), (1, False, False), (0, True, False), (0, False, False)],
)
def test_a_finding_is_red_if_it_has_a_bit_and_is_enforced(
    bit: int, enforced: bool, red: bool
) -> None:
    one = Finding(Aspect.SPEED, "slower", "t", bit=Bit(bit), enforced=enforced)
    assert one.red is red
    assert bits([one]) == (bit if red else 0)


@pytest.mark.parametrize(
    ("check", "kind", "compares", "improves"),
    [
        (Aspect.REGRESSION, "better", True, True),
        (Aspect.SPEED, "faster", True, True),
        (Aspect.REGRESSION, "worse", True, False),
        (Aspect.ACCURACY, "better", False, False),
        (Aspect.RUN, "error", False, False),
    ],
)
def test_only_what_compares_can_be_better(
    check: Aspect, kind: str, compares: bool, improves: bool
) -> None:
    one = Finding(check, kind, "t")
    assert (one.compares, one.improves) == (compares, improves)


def test_findings_are_listed_red_first_then_reported_ones_then_notices_by_size() -> None:
    def one(case: str, bit: int, enforced: bool, size: float) -> Finding:
        return Finding(Aspect.ACCURACY, "k", "t", case, bit=Bit(bit), enforced=enforced, size=size)

    given = [
        one("notice", 0, True, 9.0),
        one("small", 1, True, 2.0),
        one("only told", 1, False, 9.0),
        one("large", 1, True, 3.0),
    ]
    order = [found.case for found in worst_first(given)]
    assert order == ["large", "small", "only told", "notice"]


def test_settings_are_named_by_twelve_digits_and_to_the_last_where_they_are_run_again() -> None:
    third = Knobs(1e-3 / 3, 1e9)
    assert in_words(third) == "dt=0.000333333333333,kn=1000000000"
    assert to_the_last_digit(third) == "dt=0.0003333333333333333,kn=1000000000.0"
