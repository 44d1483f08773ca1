"""Claims about the data of figures: which settings, series and points they have, by hand."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from reports.drawing.collect import History, Point, histories, ladders, same_curve
from reports.marks import Mark, marks
from tests.support.fabricated import changed, cost, entry, record
from vv.base.metrics import Vector
from vv.records.job_record import Record

LOOKS = marks(["a/a", "b/b"])
T, Y = np.array([0.0, 1.0]), np.array([2.0, -3.0])


def ran(label: str, dt: float | None, kn: float | None = None, **changes: object) -> Record:
    known = [entry("pass", {"max": 0.01 if dt is None else dt})]
    rung = {"dt": dt, "kn": kn}
    return record(
        label,
        "T1",
        dt,
        quantities=known,
        rung=rung,
        key=f"{label}{dt}{kn}".encode().hex(),
        **changes,
    )


def history(reference: Sequence[float] | None) -> History:
    known = None if reference is None else np.array(reference)
    return History(Mark("a/a", 0, (), ""), None, T, Y, known)


def kept(**arrays: Vector) -> Mapping[str, Vector]:
    return {name.replace("_", "."): one for name, one in arrays.items()}


def test_the_series_of_a_scheme_is_that_of_its_finest_setting_that_ran() -> None:
    refused = record("a/a", "T1", 1e-4, status="refused", reason="no")
    every = [ran("b/b", 1e-3), ran("a/a", 1e-3), ran("a/a", 4e-3), refused]
    asked: list[str] = []

    def arrays(key: str) -> Mapping[str, Vector]:
        asked.append(key)
        return kept(t=T, y_value=Y, y_reference=2 * Y)

    first, second = histories(every, "y", LOOKS, arrays)
    assert asked == [every[1].key, every[0].key]
    assert (first.mark, first.dt) == (LOOKS["a/a"], 1e-3)
    assert second.mark is LOOKS["b/b"]
    assert first.t is T
    assert first.value is Y
    assert first.reference is not None
    assert first.reference.tolist() == [4.0, -6.0]


@pytest.mark.parametrize(
    ("left", "found"),
    [
        (kept(t=T, y_value=Y), 1),
        (kept(t=T), 0),
        (kept(y_value=Y), 0),
        (kept(t=T, z_value=Y), 0),
        ({}, 0),
    ],
)
def test_a_series_is_shown_where_the_store_has_its_values_and_its_times(
    left: Mapping[str, Vector], found: int
) -> None:
    assert len(histories([ran("a/a", 1e-3)], "y", LOOKS, lambda _: left)) == found


def test_a_scheme_without_a_result_has_no_series_and_is_not_looked_for() -> None:
    none = record("a/a", "T1", 1e-3, status="refused", reason="no")
    kept: dict[str, Mapping[str, Vector]] = {}
    assert histories([none], "y", LOOKS, kept.__getitem__) == []


def test_a_ladder_is_of_one_stiffness_from_large_steps_to_small() -> None:
    every = [ran("a/a", h, kn) for kn in (1e9, 1e8) for h in (1e-3, 2e-3)]
    found = ladders([*every, ran("b/b", None)], "y", LOOKS)
    assert [(one.mark.label, one.kn) for one in found] == [
        ("a/a", 1e8), ("a/a", 1e9), ("b/b", None)
    ]  # fmt: skip
    assert [[p.dt for p in one.points] for one in found] == [[2e-3, 1e-3], [2e-3, 1e-3], [None]]


def test_a_point_tells_error_and_cost_and_what_is_the_matter_with_it() -> None:
    fine = ran("a/a", 1e-3, cost=cost(timed=True, cpu=0.5))
    whole = dataclasses.replace(fine.cost, whole=True)
    bad = changed(fine, quantities=[entry("fail", {"max": 0.5})], cost=whole)
    refused = record("a/a", "T1", 1e-3, status="refused", reason="no", cost=cost(cpu=0.0))
    long = record("a/a", "T1", 1e-3, status="too-long", reason="long", cost=cost(cpu=0.0))
    (row,) = ladders([fine, bad, refused, long], "y", LOOKS)
    assert row.points == (
        Point(1e-3, 1e-3, 0.5, True, False),
        Point(1e-3, 0.5, 0.5, True, True, whole=True),
        Point(1e-3, None, 0.0, False, False, refused=True),
        Point(1e-3, None, 0.0, False, False, refused=True, too_long=True),
    )


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ([1.0, -2.0], [1.0, -2.0], True),
        ([1.0, -2.0], [-1.0, 2.0], True),
        ([1.0, -2.0], [1.0, -2.0 * (1 + 1e-10)], True),
        ([1e-12, -2.0], [0.0, -2.0], True),  # of the largest, a rounding
        ([1e-8, -2.0], [0.0, -2.0], False),
        ([1e-12, 2e-12], [0.0, 2e-12], False),
        ([1.0, -2.0], [1.0, -2.1], False),
        ([1.0, -2.0], [1.0, -2.0 * (1 + 1e-6)], False),
        ([1.0, -2.0], [1.0, -2.0, 0.0], False),
        ([1.0, 1.0], [1.0], False),  # which would be spread over both
        ([1.0, -2.0], None, False),
        (None, [1.0, -2.0], False),
        (None, None, False),
    ],
)
def test_two_variants_share_a_picture_if_their_references_differ_by_sign_and_rounding_alone(
    one: Sequence[float] | None, other: Sequence[float] | None, same: bool
) -> None:
    assert same_curve([history(one)], [history(other)]) is same


def test_variants_of_which_nothing_ran_share_no_picture() -> None:
    assert not same_curve([], [history([1.0])])
    assert not same_curve([history([1.0])], [])
