"""What accuracy costs: interpolation, floors, fronts and duels on records made up for it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vv import effort
from vv.effort import Effort, efforts, front, reach
from vv.metrics import convergence

Row = tuple[float | None, float | None, float | None, float | None]  # dt, kn, error, cpu


def record(code: str, row: Row, variant: str = "a", final: float = 1.0) -> dict[str, Any]:
    dt, kn, error, cpu = row
    entry = {
        "name": "y",
        "judge": "exact",
        "norm": "max",
        "errors": {"max": error},
        "figures": {"final": final + (error or 0.0)},
    }
    return {
        "case": "made-up",
        "variant": variant,
        "code": code,
        "scheme": "default",
        "status": "ran",
        "rung": {"dt": dt, "kn": kn},
        "quantities": [entry],
        "cost": {
            "kind": "timed" if cpu is not None else "indicative",
            "solve_cpu": 1e-3 if cpu is None else cpu,
            "spread": 0.1,
        },
    }


def manifest(*records: Mapping[str, Any]) -> dict[str, Any]:
    files = {"theirs": {"/usr/bin/theirs": "digest"}}
    codes = {r["code"]: {"files": files.get(r["code"], {})} for r in records}
    return {"records": list(records), "codes": codes}


def one(rows: Sequence[Row], code: str = "ours") -> Effort:
    (found,) = efforts(manifest(*(record(code, row) for row in rows)))
    return found


SECOND = [(h, None, 100 * h * h, 1e-7 / h) for h in (1e-2, 1e-3, 1e-4)]


def test_the_cost_of_an_error_lies_on_the_line_between_rungs() -> None:
    assert reach(one(SECOND), 1e-5).cpu == pytest.approx(1e-7 / math.sqrt(1e-7))


def test_an_error_above_the_coarsest_costs_at_most_that_and_one_below_all_has_no_cost() -> None:
    found = reach(one(SECOND), 0.5)
    assert found.cpu == pytest.approx(1e-5)
    assert found.bound
    assert reach(one(SECOND), 1e-7).cpu is None


def test_a_rung_without_timing_or_without_error_has_no_say_in_costs() -> None:
    rows: list[Row] = [*SECOND, (1e-5, None, 1e-8, None), (1e-6, None, None, 1.0)]
    assert reach(one(rows), 1e-7).cpu is None
    assert one(rows).best == 1e-8


def test_the_order_is_fitted_at_each_stiffness() -> None:
    rows: list[Row] = [(h, kn, kn * h, 1.0) for kn in (1e3, 1e4) for h in (1e-5, 1e-6)]
    assert {kn: round(order.order, 9) for kn, order in one(rows).orders} == {1e3: 1.0, 1e4: 1.0}


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


def test_a_penalty_scheme_has_a_floor_only_when_stiffness_gained_nothing_either() -> None:
    steps = (1e-3, 5e-4, 2.5e-4)
    softer: list[Row] = [(h, kn, 1e4 / kn, 1.0) for kn in (1e5, 1e6, 1e7) for h in steps]
    alike: list[Row] = [(h, kn, 1e-2, 1.0) for kn in (1e5, 1e6, 1e7) for h in steps]
    assert one(softer).floor is None
    assert one(alike).floor is not None


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
    free, stepping = effort.duels(every, (1e-5,))
    assert (free.ours, stepping.ours, free.theirs) == (
        "exact/default",
        "ours/default",
        "theirs/default",
    )
    assert stepping.ratio == pytest.approx(1e-2)
    lost = effort.duels(every, (1e-9,))[0]
    assert lost.ratio is None
    assert lost.least == pytest.approx(1e-6)


def test_a_profile_counts_failures_as_infinitely_dear() -> None:
    rows = [record("ours", row, v) for row in SECOND for v in "ab"]
    rows += [record("theirs", (h, None, 100 * h * h, 1e-6 / h), "a") for h in (1e-2, 1e-3, 1e-4)]
    found = effort.profile(efforts(manifest(*rows)), 1e-5)
    assert found["ours/default"] == [1.0, 1.0]
    assert found["theirs/default"] == [pytest.approx(10.0), math.inf]


@given(st.floats(0.5, 4.0), st.floats(-3.0, 3.0), st.floats(0.01, 1.0), st.floats(1.2, 4.0))
def test_richardson_finds_the_limit_and_the_order_of_a_power_law(
    order: float, limit: float, size: float, ratio: float
) -> None:
    sizes = (size, ratio * size, ratio * ratio * size * 1.1)
    values = tuple(limit + 0.3 * h**order for h in sizes)
    found = convergence(sizes, values)
    assert found is not None
    assert found.order == pytest.approx(order, abs=1e-4)
    assert found.limit == pytest.approx(limit, abs=1e-5)


def test_the_grid_convergence_index_is_that_of_the_published_example() -> None:
    """Celik et al. (2008), Table 1: 18000, 8000 and 4500 cells in the plane."""
    sizes = tuple(cells**-0.5 for cells in (18000, 8000, 4500))
    found = convergence(sizes, (6.063, 5.972, 5.863))
    assert found is not None
    assert (round(100 * found.fine, 2), round(100 * found.coarse, 2)) == (2.17, 4.11)
    assert found.order == pytest.approx(1.53, abs=0.005)
    assert found.limit == pytest.approx(6.1685, abs=5e-5)


def test_values_that_swing_have_no_limit() -> None:
    assert convergence((1.0, 2.0, 4.0), (1.0, 1.1, 1.0)) is None
    assert convergence((1.0, 2.0, 4.0), (1.0, 1.0, 1.0)) is None
