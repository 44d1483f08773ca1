"""Claims about the parts of the report: what is drawn where, how numbers and looks come out."""

from __future__ import annotations

import itertools
import math
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import reports
from reports import plain, text
from reports.book import Book
from reports.drawing import charts
from reports.drawing.collect import ladders
from reports.drawing.curves import draw
from reports.drawing.svg import SLACK, path, straightened, thinned
from reports.marks import COLOURS, mark, marks
from reports.outcomes import OUTCOMES, counted
from reports.pages.findings import findings
from reports.variant import ranking, settings
from reports.variant.likeness import difference
from tests.support.fabricated import STEPS, changed, cost, entry, manifest, ran, record
from vv.gate.judgement import counted as counted_by_gate
from vv.records.outcomes import Outcome
from vv.store.store import Store

BUILT_IN = [
    *(f"dem/{name}" for name in ("default", "published")),
    *(f"exact/{name}" for name in ("default", "linearised")),
    *(f"dda/{name}" for name in ("default", "published", "lagged")),
    *(f"yade/{name}" for name in ("default", "half-step-mass", "clump", "polyhedra")),
    *(f"liggghts/{name}" for name in ("default", "half-step-mass", "clump", "pre-overlapped")),
    *(f"{code}/default" for code in ("rigid", "lmgc90", "pybullet", "kratos")),
]


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


def test_built_in_schemes_differ_in_marker_or_colour_and_within_a_code_in_dash() -> None:
    looks = [mark(label) for label in BUILT_IN]
    assert len({(m.colour, m.shape) for m in looks}) == len(looks)
    assert len({(m.colour, m.dash) for m in looks}) == len(looks)


def test_a_look_is_that_of_the_name_whatever_stands_beside_it() -> None:
    assert marks(["zz/new", "dem/default"])["zz/new"] == marks(["zz/new"])["zz/new"]
    assert marks(BUILT_IN)["dem/default"] == marks(["dem/default"])["dem/default"]


def luminance(colour: str) -> float:
    """The relative luminance of #rrggbb (WCAG 2.2)."""
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """The contrast of two colours (WCAG 2.2), 1 to 21."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_curves_and_their_names_are_seen_on_light_and_on_dark_paper() -> None:
    for light, dark in COLOURS:
        assert contrast(light, "#ffffff") >= 3
        assert contrast(dark, "#14181c") >= 4.5


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


def test_laws_are_broken_in_plain_words() -> None:
    said = plain.breach(("energy created [J]", 1390.0, 2e-10))
    assert said == "Energy not conserved: created 1.39e3 J, allowed 2.00e-10 J"
    assert plain.breach(("negative drag dissipation [J]", 1.0, 0.1)).startswith("Drag dissipation")
    assert plain.breach(("something [N]", 1.0, 0.1)) == "Law broken, something: 1 N, allowed 0.1 N"


def test_a_command_shows_the_very_setting_again_and_is_safe_to_paste() -> None:
    one = record("a/a; rm x", "T1", 4e-3, modified=True)
    typed = "vv run bounce:T1 --codes 'a/a; rm x' --rung dt=0.004 --set m=1"
    assert plain.command(one) == typed


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


@given(st.floats(-1e300, 1e300).filter(lambda x: x == 0 or abs(x) > 1e-300))
def test_written_numbers_read_back(value: float) -> None:
    assert float(text.sci(value)) == pytest.approx(value, rel=6e-3)
    assert float(text.short(value)) == pytest.approx(value, rel=6e-3)
    assert float(text.brief(value)) == pytest.approx(value, rel=6e-6)


@given(st.lists(st.text(max_size=90), min_size=2, max_size=2, unique=True))
def test_identifiers_differ_and_are_safe(names: list[str]) -> None:
    made = [text.slug(name) for name in names]
    assert made[0] != made[1]
    assert all("/" not in one and len(one) < 100 and one.isascii() for one in made)
    pairs = itertools.permutations(names, 2)
    assert len({text.slug(*pair) for pair in pairs}) == 2


def test_a_table_has_columns_only_for_what_some_row_tells() -> None:
    rows: list[dict[str, float | None]] = [{"dem": 1.0, "yade": None}, {"exact": 2.0}]
    assert text.known_columns(["yade", "exact", "rigid", "dem"], rows) == ["exact", "dem"]


def test_a_time_has_a_unit() -> None:
    said = [text.seconds(value) for value in (9.16e-2, 2.03, 4e-6, 7200.0, None)]
    assert said == ["91.6 ms", "2.03 s", "4 µs", "120 min", "\N{EN DASH}"]


def test_an_xpass_says_so() -> None:
    one = changed(entry("xpass", {"max": 1e-9}))
    assert "passes, though a disagreement is on record" in plain.excess(one)


def test_a_note_that_several_quantities_share_is_said_once() -> None:
    late = [entry("xfail", {"max": 1e-2}, name=name, note="drag is late") for name in "xy"]
    said = plain.reason(record("a/a", "T1", 1e-3, quantities=late), Outcome.XFAIL)
    parts = [f"Error of {name} 0.01, 10 times the tolerance 1.00e-3" for name in "xy"]
    assert said == "; ".join([*parts, "drag is late"])


def test_how_many_times_a_tolerance_is_a_number_that_people_say() -> None:
    said = plain.excess(changed(entry("fail", {"max": 5.34e-3}), tolerance=2.79e-5))
    assert said.endswith(", 191 times the tolerance 2.79e-5")


def test_a_long_explanation_stands_once_on_a_page_and_is_referred_to() -> None:
    why, told = "a spring is charged for a whole step " * 2, dict[str, str]()
    assert plain.once(f"Error 1; {why}", "here", told) == f"Error 1; {why}"
    assert plain.once(f"Error 2; {why}", "there", told) == "Error 2; explained at here"
    assert plain.once(f"Error 1; {why}", "here", told) == f"Error 1; {why}"


def test_no_line_ends_within_a_small_number_and_tags_stay_text() -> None:
    said = text.unbroken("at dt = 2.5e-05 s <b>, at-will, 1e+09")
    assert said == 'at dt = <span class="n">2.5e-5</span> s &lt;b&gt;, at-will, 1e9'


def test_texts_are_read_on_every_background_light_and_dark() -> None:
    sheet = (Path(reports.__file__).parent / "assets" / "report.css").read_text()
    light, dark, system, *_ = re.findall(r"\{([^{}]*--ink:[^{}]*)\}", sheet)
    assert dark.replace(" ", "") == system.replace(" ", "")
    for block in (light, dark):
        named = dict(re.findall(r"--([\w-]+): (#\w{6})", block))
        pairs = [("ink", "paper"), ("soft", "paper"), ("link", "paper"), ("ink", "band")]
        pairs += [(f"{n}-ink", n) for n in ("good", "known", "bad", "odd", "idle", "shown")]
        pairs += [("ink", f"e{i}") for i in range(8)] + [("soft", "band")]
        assert {
            pair: ratio
            for pair in pairs
            if (ratio := contrast(named[pair[0]], named[pair[1]])) < 4.5
        } == {}


@given(
    st.lists(st.sampled_from("abcdefgh"), max_size=30),
    st.lists(st.sampled_from("abc"), max_size=30),
)
def test_a_difference_makes_the_text_of_its_base(old: list[str], new: list[str]) -> None:
    base, text_ = ("".join(f"{line * 60}\n" for line in lines) for lines in (old, new))
    told = difference(base, text_)
    assert not told or patched(base, told) == text_


def patched(base: str, told: str) -> str:
    """What `patch` makes of a base."""
    made, at, lines = [], 0, base.splitlines(keepends=True)
    for line in told.splitlines(keepends=True):
        if line[0] == "@":
            start, _, count = line.split()[1][1:].partition(",")
            first = int(start) - (count != "0")
            made += lines[at:first]
            at = first + int(count or 1)
        elif line[0] == "+":
            made.append(line[1:])
    return "".join([*made, *lines[at:]])
