"""Claims about figures of particular kinds of cases: measured values, and maps of regions."""

from __future__ import annotations

import dataclasses
import re
from pathlib import Path

import numpy as np
import pytest

from reports import html
from reports.drawing.ratios import Kind, draw_biases, draw_ratios
from reports.drawing.scatter import draw_scatter
from reports.drawing.sweeps import draw_sweep
from reports.marks import Mark
from tests.support.fabricated import case, changed, entry, manifest, record
from tests.support.read_back import page
from vv.case import RegionMap
from vv.insight.against_measurements import Compared, Factor
from vv.records.case_facts import VariantFacts
from vv.records.job_record import Record, summary_of
from vv.records.manifest import Manifest
from vv.records.quantity import MeasurementFacts, PrintedFacts
from vv.store.store import Store

BORDER = ((0.0, 0.0), (30.0, 30.0))


def of(facts: VariantFacts, *records: Record) -> Manifest:
    """A manifest of these records, of a case whose first variant has these facts."""
    variants = {**case().variants, "T1": facts}
    return dataclasses.replace(
        manifest(*records), cases={"bounce": dataclasses.replace(case(), variants=variants)}
    )


def test_measured_values_stand_with_their_bars_and_charts_name_the_quantity(
    tmp_path: Path,
) -> None:
    facts = case().variants["T1"]
    (one,) = facts.quantities
    kept = [
        changed(
            one, name=f"et-{angle}", symbol="e_t", unit="", meaning=f"restitution at {angle} deg"
        )
        for angle in (10, 20)
    ]
    seen = MeasurementFacts(0.75, 0.03, 0.04, "dry", "somebody", 0.1)
    entries = [
        entry("pass", {}, name=q.name, unit="", judge="measured", value=0.8125, kind="scalar",
              measurement=seen)
        for q in kept
    ]  # fmt: skip
    whole = of(changed(facts, quantities=kept), record("a/a", "T1", 1e-3, quantities=entries))
    folder = html.build(whole, Store(tmp_path / ".vv"), tmp_path / "r").parent
    for name in ("case-bounce.html", "measured.html"):
        page = (folder / name).read_text()
        assert "<h3>Restitution e_t: computed over measured</h3>" in page
        assert "measured e_t</text>" in page
        assert "a/a, et-10: computed 0.8125, measured 0.75 ± 0.05" in page
    cells = re.sub(r"<[^>]*>", " ", (folder / "case-bounce.html").read_text())
    assert re.search(r"restitution at 20 deg\s+0.75 ± 0.1\s+0.1\s+0.8125", cells)


def test_a_scheme_is_within_as_many_bands_as_hold_its_values(tmp_path: Path) -> None:
    values = {"et-1": (0.80, 0.1), "et-2": (0.81, 0.1), "et-3": (0.90, 0.1), "et-4": (0.76, None)}
    facts = case().variants["T1"]
    (one,) = facts.quantities
    kept = [changed(one, name=name, symbol="e_t", unit="") for name in values]
    entries = [
        entry("no-reference" if band is None else "pass" if value < 0.85 else "fail", {}, name=name,
              unit="", judge="measured", value=value, kind="scalar",
              measurement=MeasurementFacts(0.75, 0.03, 0.04, "dry", "somebody", band))
        for name, (value, band) in values.items()
    ]  # fmt: skip
    whole = of(changed(facts, quantities=kept), record("a/a", "T1", 1e-3, quantities=entries))
    page = html.build(whole, Store(tmp_path / ".vv"), tmp_path / "r").with_name("measured.html")
    cells = re.sub(r"<[^>]*>", " ", page.read_text())
    assert re.search(r"a/a\s+2 of 3\s+1\s", cells)


def test_a_dot_lies_above_the_line_by_as_much_as_the_computed_value_is_too_large() -> None:
    values = {"low": (2.25, 2.0), "high": (5.5, 6.0)}  # computed, measured
    points = [Compared(name, "m", *pair, 0.25, 1.0, True) for name, pair in values.items()]
    drawn = page(str(draw_scatter({Mark("a/a", 0, (), ""): points}, "s")))
    ticks = [(float(one.named["x"]), float(one.text)) for one in drawn.every("text", class_="mid")
             if one.text.replace(".", "").isdigit()]  # fmt: skip
    (low, first), (high, last) = ticks[0], ticks[-1]
    unit = (high - low) / (last - first)  # px per m, the same along both axes
    tall = float(next(drawn.every("svg")).named["viewbox"].split()[3])
    for dot, (computed, measured) in zip(drawn.every("circle"), values.values(), strict=True):
        across, up = float(dot.named["cx"]), tall - float(dot.named["cy"])
        assert first + (across - low) / unit == pytest.approx(measured, abs=0.05)
        assert first + (up - low) / unit == pytest.approx(computed, abs=0.05)


def test_all_measurements_stand_in_one_picture_with_bars_and_every_scheme() -> None:
    held = Compared("low", "m", 2.25, 2.0, 0.25, 1.0, True)
    shown = Compared("high", "m", 3.0, 6.0, 0.3, None, False)
    marks = Mark("a/a", 0, (), ""), Mark("b/b", 1, (), "")
    drawn = page(str(draw_ratios([
        Kind("case: one", "s", {marks[0]: [held, shown], marks[1]: [shown]}),
        Kind("case: two", "t", {marks[1]: [held]}),
    ])))  # fmt: skip
    dots = [*drawn.every("circle")]
    assert [dot.named["class"] for dot in dots] == ["full", "open", "open", "full"]
    assert len([*drawn.every("path", class_="sure")]) == 3
    level = {one.text: float(one.named["y"]) - 4 for one in drawn.every("text", class_="end")
             if one.text.replace(".", "").isdigit()}  # fmt: skip
    assert float(dots[1].named["cy"]) == pytest.approx(level["0.5"], abs=0.2)
    assert level["1.1"] > float(dots[0].named["cy"]) > level["1.25"]
    assert float(dots[0].named["cx"]) < float(dots[1].named["cx"]) < float(dots[3].named["cx"])


def test_what_was_measured_over_an_angle_has_a_line_for_each_law_and_bars() -> None:
    def points(*computed: float) -> list[Compared]:
        return [
            Compared(f"q{k}", "", value, 0.5, 0.05, None, False, "angle [degrees]", 10.0 * k)
            for k, value in enumerate(computed)
        ]

    marks = Mark("a/a", 0, (), ""), Mark("b/b", 1, (), "")
    drawn = page(str(draw_sweep(
        [("soft", marks[0], points(0.25, 0.75)), ("soft", marks[1], points(0.25, 0.5)),
         ("stiff", marks[0], points(1.0, 0.75))], "e", "angle [degrees]",
    )))  # fmt: skip
    assert len([*drawn.every("path", class_="line")]) == 3
    assert [one.text for one in drawn.every("text")].count("soft") == 1
    bars = [re.findall(r"[\d.]+", one.named["d"]) for one in drawn.every("path", class_="seen")]
    dots = [*drawn.every("circle", class_="seen")]
    assert [float(dot.named["cx"]) for dot in dots] == [float(bar[0]) for bar in bars]
    for dot, (_, low, high) in zip(dots, bars, strict=True):
        assert float(low) > float(dot.named["cy"]) > float(high)
    stiff = [*drawn.every("path", class_="line")][2].named["d"]
    first, second = (float(up) for up in re.findall(r"[\d.]+", stiff)[1::2])
    drop = float(bars[0][1]) - float(bars[0][2])  # px of four uncertainties, 0.2
    assert second - first == pytest.approx(0.25 * drop / 0.2, abs=0.5)


def test_a_bias_is_drawn_where_it_is_with_two_scatters_either_way() -> None:
    mark = Mark("a/a", 0, (), "")
    rows = [(mark, "held", Factor(1.25, 0.1, 0.02)), (mark, "all", Factor(None, None, None))]
    drawn = page(str(draw_biases(rows)))
    (dot,) = drawn.every("circle")
    level = {one.text: float(one.named["x"]) for one in drawn.every("text", class_="mid")}
    assert float(dot.named["cx"]) == pytest.approx(level["1.25"], abs=0.2)
    (line,) = drawn.every("path", class_="line")
    first, last = re.findall(r"[MH]([\d.]+)", line.named["d"])
    assert level["1"] == pytest.approx(float(first), abs=0.2)  # 1.25 (1 - 0.2)
    assert level["1.5"] == pytest.approx(float(last), abs=0.2)


def test_answers_of_other_codes_stand_apart_from_what_was_measured(tmp_path: Path) -> None:
    facts = case().variants["T1"]
    (one,) = facts.quantities
    asked = changed(one, name="e", unit="", meaning="restitution", judge="code-to-code")
    other = PrintedFacts(0.75, 5e-5, "another code", "its manual", 0.1)
    given = [
        record("a/a", "T1", dt, quantities=[
            entry(verdict, {}, name="e", unit="", judge="code-to-code", value=value,
                  kind="scalar", printed=other)
        ])
        for dt, value, verdict in ((2e-3, 0.8, "pass"), (1e-3, 0.9375, "fail"))
    ]  # fmt: skip
    whole = of(changed(facts, quantities=[asked]), *given)
    folder = html.build(whole, Store(tmp_path / ".vv"), tmp_path / "r").parent
    assert not (folder / "measured.html").exists()
    cells = re.sub(r"<[^>]*>", " ", (folder / "case-bounce.html").read_text())
    assert re.search(r"restitution\s+another code\s+0.75\s+0.1\s+0.9375 \(outside\)", cells)
    assert "Beside measurements" not in cells


def test_a_map_of_regions_has_its_borders_and_marks_what_is_not_found_right(
    tmp_path: Path,
) -> None:
    points = {"p": (10.0, 20.0), "q": (20.0, 10.0), "r": (5.0, 5.0)}
    chart = RegionMap("psi [deg]", "delta [deg]", ("stays", "topples"), (BORDER,), points)
    facts = dataclasses.replace(case().variants["T1"], regions=chart)
    entries = [
        entry("pass", {}, name=name, kind="count", unit="", value=value, reference=exact)
        for name, value, exact in (("p", 0, 0), ("q", 0, 1), ("r", 1, 1))
    ]
    whole = of(facts, record("a/a", "T1", 1e-3, quantities=entries))
    page = html.build(whole, Store(tmp_path / ".vv"), tmp_path / "r").with_name("case-bounce.html")
    text = page.read_text()
    assert "a/a: 2 of 3" in text
    assert text.count('class="border"') == text.count('class="mode wrong"') == 1
    for word in ("stays", "topples", "psi [deg]", "delta [deg]"):
        assert f">{word}</text>" in text


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"borders": (((0.0, 0.0),),)}, r"borders\[0\] = .*two places or more"),
        ({"points": {"p": (float("nan"), 0.0)}}, "places must be finite"),
    ],
)
def test_a_map_of_regions_names_what_is_wrong_with_it(
    changes: dict[str, object], said: str
) -> None:
    chart = RegionMap("x", "y", ("stays",), (BORDER,), {})
    with pytest.raises(ValueError, match=said):
        dataclasses.replace(chart, **changes)  # type: ignore[arg-type]


def test_energies_share_a_chart_over_time_for_each_scheme(tmp_path: Path) -> None:
    facts = case().variants["T1"]
    (one,) = facts.quantities
    forms = {"E_k": "kinetic energy", "W": "work"}
    kept = [
        changed(one, name=name, symbol=name, unit="J", meaning=meaning)
        for name, meaning in forms.items()
    ]
    entries = [entry("no-reference", {}, name=name, unit="J", norm=None) for name in forms]
    store, made = Store(tmp_path / ".vv"), record("a/a", "T1", 1e-3, quantities=entries)
    t = np.linspace(0.0, 1.0, 9)
    store.keep_summary(made.key, summary_of(made), {"t": t, "E_k.value": t, "W.value": 3 * t})
    whole = of(changed(facts, quantities=kept), made)
    page = html.build(whole, store, tmp_path / "r").with_name("case-bounce.html").read_text()
    assert page.count("<h3>Energy over time in a/a</h3>") == 1
    assert "E_k [J] over time" not in page  # it stands in the chart of all forms
    for name, meaning in forms.items():
        assert f'data-k="{name}"' in page
        assert f"{name}: {meaning}" in page
    assert "not in the store" not in page
