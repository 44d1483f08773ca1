"""Claims about rows of a report: settings, stability, and figures of measurements."""

from __future__ import annotations

import dataclasses
import re
from types import SimpleNamespace
from typing import Any

import pytest

from reports import text
from reports.marks import marks
from reports.pages import measured
from reports.pages.steadiness import sections
from reports.settings_table import setting_rows
from reports.variant.settings import Group, groups
from tests.support.fabricated import case, changed, cost, entry, record
from vv.insight.stability_summary import Kind

LOOKS = marks(["a/a", "b/b"])


def made(*rows: tuple[float, float], value: float | None = None, **changes: Any) -> Group:
    """The group of records of settings (dt, error)."""
    records = [
        record("a/a", "T1", dt, key=f"{dt}".encode().hex(), quantities=[
            entry("pass" if error < 1e-3 else "fail", {"max": error}, value=value,
                  reference=value and value + 1)
        ], **changes)
        for dt, error in rows
    ]  # fmt: skip
    (group,) = groups({"a/a": records}, LOOKS)
    return group


def cells(table: object) -> list[list[str]]:
    """The texts of the cells of each row, without its heading."""
    rows = str(table).split("<tr>")
    return [
        re.sub(r"<(?!td)[^>]*>", "", row).strip().split("<td")[1:] for row in rows if "<td" in row
    ]


def texts(table: object) -> list[list[str]]:
    return [[cell.partition(">")[2].strip() for cell in row] for row in cells(table)]


def test_a_setting_has_its_step_numbers_order_verdict_cost_and_steps() -> None:
    group = made((2e-3, 4e-3), (1e-3, 5e-4), cost=cost(timed=True, cpu=0.25))
    first, second = texts(setting_rows(group, stiffness=False, valued=False, columns=9))
    assert first == ["2e-3", "4.00e-3", "1.0e-3", text.NONE, "✗ fail", "250 ms", "100"]
    assert second == ["1e-3", "5.00e-4", "1.0e-3", "3.00", "✓ pass", "250 ms", "100"]
    ill, fine = (row[4] for row in cells(setting_rows(group, False, False, 9)))
    assert ill.startswith(' class="bad"')
    assert fine.startswith(">")


def test_columns_of_stiffness_and_value_stand_where_asked_for() -> None:
    group = made((2e-3, 4e-3), value=2.5)
    (row,) = texts(setting_rows(group, stiffness=True, valued=True, columns=9))
    assert row[:5] == ["2e-3", text.NONE, "2.5", "3.5", "4.00e-3"]


@pytest.mark.parametrize(
    ("timed", "whole", "said"),
    [
        (True, False, "1 s"),
        (False, False, "1 s ○"),
        (True, True, "1 s ◻"),
        (False, True, "1 s ○ ◻"),
    ],
)
def test_a_cost_is_marked_if_it_is_indicative_or_of_a_whole_process(
    timed: bool, whole: bool, said: str
) -> None:
    spent = dataclasses.replace(cost(timed=timed, cpu=1.0), whole=whole)
    (row,) = texts(setting_rows(made((1e-3, 5e-4), cost=spent), False, False, 9))
    assert row[-2:] == [said, "100"]
    (free,) = texts(setting_rows(made((1e-3, 5e-4), cost=cost(cpu=0.0)), False, False, 9))
    assert free[-2] == f"{text.NONE} ○"


def test_of_further_quantities_steps_at_which_the_same_came_out_share_a_row() -> None:
    group = dataclasses.replace(made((4e-3, 4e-3), (4e-3, 4e-3), (1e-3, 5e-4)), first=False)
    alike = [dataclasses.replace(row, local=None) for row in group.rows]
    rows = texts(setting_rows(dataclasses.replace(group, rows=alike), False, False, 9))
    assert [row[0] for row in rows] == ["4e-3, 4e-3", "1e-3"]
    assert [len(row) for row in rows] == [5, 5]


def test_a_heading_has_scheme_quantity_unit_order_and_notes() -> None:
    group = made((4e-3, 16e-4), (2e-3, 4e-4), reason="drag is late")
    head = str(setting_rows(group, False, False, 9))
    assert "a/a · y [m] · order 2.00 ± 0.00 over 2 steps<small>drag is late</small>" in head
    bare = dataclasses.replace(group, titled=False)
    assert "a/a" not in str(setting_rows(bare, False, False, 9))
    one = dataclasses.replace(made((4e-3, 16e-4)), unit="")
    assert ">a/a · y<" in str(setting_rows(one, False, False, 9)).replace("\n", "<")


def test_schemes_that_say_the_same_of_stability_share_a_line_in_the_section_of_its_kind() -> None:
    told = [(Kind.DRIFT, "T1", "a/a", "none"), (Kind.STEP, "T1", "a/a", "0.9"),
            (Kind.STEP, "T1", "b/b", "0.9"), (Kind.STEP, "T2", "b/b", "1.0"),
            (Kind.STEP, "T1", "b/b", "0.8")]  # fmt: skip
    statements = [
        SimpleNamespace(kind=kind, case="c", variant=variant, label=label, text=said)
        for kind, variant, label, said in told
    ]
    book: Any = SimpleNamespace(
        stability=statements, marks=LOOKS, to_case=lambda *names: "-".join(names)
    )
    steps, drift = sections(book)
    assert (steps.title, drift.title) == ("Largest stable step", "Drift")
    assert [(link, name, [([m.label for m in who], said) for who, said in own])
            for link, name, own in steps.lines] == [
        ("c-T1", "c: T1", [(["a/a", "b/b"], "0.9"), (["b/b"], "0.8")]),
        ("c-T2", "c: T2", [(["b/b"], "1.0")]),
    ]  # fmt: skip
    assert len(drift.lines) == 1


def test_values_over_a_condition_are_a_figure_for_each_kind_and_a_curve_for_each_scheme(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    drawn: list[tuple[int, str, str]] = []
    monkeypatch.setattr(measured, "draw_sweep", lambda curves, y, x: drawn.append(
        (sum(len(points) for _, _, points in curves), y, x)))  # fmt: skip
    (quantity,) = case().variants["T1"].quantities
    other = changed(quantity, name="z", symbol="z", unit="")
    point = SimpleNamespace(quantity="y", at=1.0, over="speed")
    points = [point, SimpleNamespace(quantity="y", at=2.0, over="speed"),
              SimpleNamespace(quantity="z", at=1.0, over="angle"),
              SimpleNamespace(quantity="y", at=None, over="")]  # fmt: skip
    group = [SimpleNamespace(label=label, points=points) for label in LOOKS]
    whole = SimpleNamespace(variants={"v": SimpleNamespace(quantities=(quantity, other))})
    book: Any = SimpleNamespace(
        agreements={("c", "v"): group}, marks=LOOKS, manifest=SimpleNamespace(cases={"c": whole})
    )
    assert [one.title for one in measured._sweeps(book)] == [
        "c: y over the speed", "c: z over the angle"
    ]  # fmt: skip
    assert drawn == [(4, "y [m]", "speed"), (2, "z", "angle")]
    kinds = measured._kinds(book)
    assert [(one.name, one.symbol) for one in kinds] == [("c: v", "y"), ("c: v", "z")]
    assert [len(own) for own in kinds[0].points.values()] == [3, 3]
