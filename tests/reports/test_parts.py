"""Claims about the parts of the report: what is drawn where, how numbers and looks come out."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports import charts, tables, text
from reports.collect import ladders
from reports.findings import findings
from reports.marks import COLOURS, SHAPES, marks
from reports.outcomes import counted
from tests.support.fabricated import STEPS, cost, entry, manifest_of_all, ran, record
from vv.output import result_lines
from vv.output.wording import in_words
from vv.store.store import Store


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


def test_looks_repeat_only_after_every_pair_of_colour_and_shape() -> None:
    labels = [f"code/{i:03}" for i in range(len(COLOURS) * len(SHAPES))]
    assert len({(m.colour, m.shape) for m in marks(labels).values()}) == len(labels)
    assert marks(labels) == marks(reversed(labels))


def test_the_terminal_and_the_report_count_alike(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    records = manifest_of_all(Store(tmp_path)).records
    shown = {in_words(found.key, n): n for found, n in counted(records)}
    result_lines.print_counts(records, "report.html")
    told = capsys.readouterr().out.partition(";")[0].split(", ")
    pairs = [text.split(" ", 1) for text in told]
    assert {word: int(n) for n, word in pairs} == shown
    assert shown["not conserved"] == 1


def test_findings_that_differ_in_a_number_are_one_with_its_range() -> None:
    failed = [
        record("a/a", "T1", dt, status="error", reason=f"exit after {dt:.4f} s") for dt in STEPS
    ]
    found = findings(failed, marks(["a/a"]), ["bad"])
    assert [finding.text for finding in found] == ["exit after 1.00e-3 to 4.00e-3 s"]


def test_observed_order_is_fitted_and_shown_per_rung(tmp_path: Path) -> None:
    store = Store(tmp_path)
    runs = [ran(store, "a/a", "T1", dt, "pass") for dt in STEPS]
    (group,) = tables.groups(runs, marks(["a/a"]))
    assert group.order is not None
    assert abs(group.order.order - 2) < 1e-6
    orders = [rung.order for rung in group.rungs]
    assert orders[0] is None
    assert orders[1:] == pytest.approx([2, 2])


@given(st.floats(-1e300, 1e300).filter(lambda x: x == 0 or abs(x) > 1e-300))
def test_written_numbers_read_back(value: float) -> None:
    assert float(text.sci(value)) == pytest.approx(value, rel=6e-3)
    assert float(text.short(value)) == pytest.approx(value, rel=6e-3)
    assert float(text.brief(value)) == pytest.approx(value, rel=6e-6)


def test_the_order_of_a_table_leaves_out_rungs_at_a_floor() -> None:
    errors = (1e-2, 2.5e-3, 1e-4, 1e-4, 1.1e-4)
    rungs = [
        record("a/a", "T1", 4e-3 / 2**i, quantities=[entry("pass", {"max": error})])
        for i, error in enumerate(errors)
    ]
    (group,) = tables.groups(rungs, marks(["a/a"]))
    assert group.order
    assert (round(group.order.order, 6), group.order.points) == (2.0, 2)


def test_a_table_has_columns_only_for_what_some_row_tells() -> None:
    rows: list[dict[str, float | None]] = [{"dem": 1.0, "yade": None}, {"exact": 2.0}]
    assert text.known_columns(["yade", "exact", "rigid", "dem"], rows) == ["exact", "dem"]
