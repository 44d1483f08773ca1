"""Claims about the parts of the report: positions of drawings, formats of numbers and looks."""

from __future__ import annotations

import math
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.book import Book
from reports.drawing import charts
from reports.drawing.collect import ladders
from reports.drawing.curves import draw
from reports.drawing.svg import SLACK, path, straightened, thinned
from reports.looks import defined
from reports.marks import marks
from reports.outcomes import OUTCOMES, counted
from reports.pages.findings import findings
from reports.variant import ranking, settings
from tests.support.fabricated import STEPS, cost, entry, manifest, ran, record
from vv.gate.judgement import counted as counted_by_gate
from vv.store.store import Store


@pytest.mark.parametrize(("drawn", "there", "absent"), [("dots", "f", "o"), ("holes", "o", "f")])
def test_a_page_defines_the_markers_that_its_curves_have(
    drawn: str, there: str, absent: str
) -> None:
    (mark,) = marks(["a/a"]).values()
    told = defined(f'<g class="k{mark.number}"><path class="{drawn}" d=""/></g>', [mark])
    assert f'<marker id="{there}{mark.number}"' in told
    assert f'<marker id="{absent}{mark.number}"' not in told


def test_points_without_a_result_go_to_the_rim_and_refusals_nowhere() -> None:
    failed = record("a/a", "T1", 4e-3, status="diverged", cost=cost(cpu=0.0))
    fine = record("a/a", "T1", 1e-3, quantities=[entry("pass", {"max": 1e-4})])
    exact = record("b/b", "T1", None, quantities=[entry("pass", {"max": 0.0})])
    refused = record("c/c", "T1", 1e-3, status="refused")
    made = ladders([failed, fine, exact, refused], "y", marks(["a/a", "b/b", "c/c"]))
    for chart in (charts.error_against_step(made, "e"), charts.error_against_cost(made, "e")):
        assert chart is not None
        assert [(rim.mark.label, rim.above) for rim in chart.rims] == [
            ("a/a", True),
            ("b/b", False),
        ]
        assert [list(curve.y) for curve in chart.curves] == [[1e-4]]
        assert "a/a: no result" in draw(chart)


def test_what_has_no_error_has_no_chart_of_errors() -> None:
    shown = record("a/a", "T1", 1e-3, quantities=[entry("no-reference", {})])
    assert charts.error_against_step(ladders([shown], "y", marks(["a/a"])), "e") is None


def test_indicative_costs_are_hollow_and_failures_ringed() -> None:
    first = record("a/a", "T1", 4e-3, quantities=[entry("fail", {"max": 1e-2})])
    second = record(
        "a/a", "T1", 1e-3, quantities=[entry("pass", {"max": 1e-4})], cost=cost(timed=True)
    )
    chart = charts.error_against_cost(ladders([second, first], "y", marks(["a/a"])), "e")
    assert chart.curves[0].hollow.tolist() == [True, False]
    assert chart.curves[0].ringed.tolist() == [True, False]
    svg = draw(chart)
    assert all(svg.count(f'class="{kind}"') == 1 for kind in ("holes", "dots", "ring"))
    assert "4e-3;1.00e-2;100 µs ○" in svg


def test_a_drawing_is_well_formed_names_its_curves_and_is_the_same_each_time() -> None:
    labels = ["a/<&>", "b/b"]
    runs = [
        record(label, "T1", dt, quantities=[entry("pass", {"max": dt**2})])
        for label in labels
        for dt in STEPS
    ]
    chart = charts.error_against_step(ladders(runs, "y", marks(labels)), 'e "of" <y>')
    assert chart is not None
    svg = draw(chart)
    assert draw(chart) == svg
    said = [part.text for part in ElementTree.fromstring(svg).iter("text")]
    assert {*labels, 'e "of" <y>', "slope 1"} <= set(said)


NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")


@given(st.lists(st.floats(-500, 500), min_size=2, max_size=30))
def test_a_path_leads_through_its_points_to_a_tenth(values: list[float]) -> None:
    x, y = np.array(values), np.array(values[::-1])
    whole = NUMBER.findall(path(x, y))
    steps = np.array(whole, float).reshape(-1, 2).cumsum(axis=0)
    seen = [np.round(p, 1) + 0.0 for p in np.column_stack((x, y))]
    kept = [p for i, p in enumerate(seen) if i == 0 or not np.array_equal(p, seen[i - 1])]
    assert np.allclose(steps, kept, atol=0.051)


def test_a_long_curve_keeps_its_extremes() -> None:
    x = np.linspace(0, 1, 10_000)
    y = np.where(np.arange(10_000) == 4321, 9.0, np.sin(x))
    tx, ty = thinned(x, y)
    assert len(tx) < 250
    assert ty.max() == 9.0
    assert (tx[0], tx[-1]) == (0.0, 1.0)


@given(st.lists(st.one_of(st.floats(-300, 300), st.just(math.nan)), min_size=2, max_size=60))
def test_a_straightened_curve_passes_all_points_it_leaves_out(values: list[float]) -> None:
    x, y = np.linspace(0.0, 300.0, len(values)), np.array(values)
    kept_x, kept_y = straightened(x, y)
    known, there = np.isfinite(y), np.isfinite(kept_y)
    assert set(zip(kept_x[there], kept_y[there], strict=True)) <= set(zip(x, y, strict=True))
    if known.any():
        seen = np.interp(x[known], kept_x[there], kept_y[there])
        assert np.abs(seen - y[known]).max() <= SLACK + 1e-9
    assert len(straightened(x, 2.0 * x)[0]) == 2


def test_the_terminal_and_the_report_count_alike(tmp_path: Path) -> None:
    runs = [ran(Store(tmp_path), "a/a", "T1", dt, "pass") for dt in STEPS]
    assert {one.key: n for one, n in counted(runs)} == counted_by_gate(runs)
    assert all(OUTCOMES[one.key] is one for one, _ in counted(runs))


def test_findings_that_differ_in_a_number_are_one_with_its_range() -> None:
    failed = [
        record("a/a", "T1", dt, status="error", reason=f"exit after {dt:.4f} s") for dt in STEPS
    ]
    found = findings(Book(manifest(*failed), lambda key: {}, {}), ["bad"])
    assert [finding.text for finding in found] == ["exit after 1.00e-3 to 4.00e-3 s"]


def test_observed_order_is_fitted_and_shown_per_setting(tmp_path: Path) -> None:
    runs = [ran(Store(tmp_path), "a/a", "T1", dt, "pass") for dt in STEPS]
    (group,) = settings.groups({"a/a": runs}, marks(["a/a"]))
    assert group.order is not None
    assert abs(group.order.order - 2) < 1e-6
    orders = [row.local for row in group.rows]
    assert orders[0] is None
    assert orders[1:] == pytest.approx([2, 2])


def test_the_order_of_a_table_leaves_out_settings_at_a_floor() -> None:
    errors = (1e-2, 2.5e-3, 1e-4, 1e-4, 1.1e-4)
    runs = [
        record("a/a", "T1", 4e-3 / 2**i, quantities=[entry("pass", {"max": error})])
        for i, error in enumerate(errors)
    ]
    (group,) = settings.groups({"a/a": runs}, marks(["a/a"]))
    assert group.order
    assert (round(group.order.order, 6), group.order.points) == (2.0, 2)


def test_schemes_are_ranked_by_error_whatever_their_class() -> None:
    rows = [("a/a", 1e-3), ("b/b", 1e-5), ("c/c", None), ("d/d", 0.0)]
    piles = {name: [record(name, "T1", 1e-3, quantities=_with(error))] for name, error in rows}
    ranked = ranking.ranked(piles, marks(piles))
    assert [row.mark.label for row in ranked] == ["d/d", "b/b", "a/a", "c/c"]


def _with(error: float | None) -> list[object]:
    return [] if error is None else [entry("pass", {"max": error})]
