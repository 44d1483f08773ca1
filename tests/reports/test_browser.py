"""Claims about the report's pages in a browser; skipped where Chromium is not installed."""

from __future__ import annotations

import dataclasses
import hashlib
import re
from pathlib import Path

import pytest

from reports import html, library
from reports.beside import Beside
from reports.text import brief, sci
from tests.support.browser import CHROMIUM, Opened, opened
from tests.support.fabricated import (
    HEAD,
    STEPS,
    TAIL,
    case,
    entry,
    manifest,
    manifest_of_all,
    native,
    ran,
    record,
    with_external,
)
from vv.case.published import Assessment, Paper
from vv.insight.papers import Answer, Row
from vv.store.store import Store

pytestmark = pytest.mark.skipif(not CHROMIUM, reason="Chromium is not installed")

FRONT = """
  const chip = (name) => all(".chip").find((c) => [c.dataset.code, c.dataset.show].includes(name));
  said.hash = { find: one("#search").value, codes: all("#chips .chip").map((c) => c.ariaPressed) };
  said.lines = all("#profile g[data-k] .line").length;
  chip("other").click();
  said.afterChip = [location.hash, seen("#which tr[data-k^='other/']").length,
                    seen("#map td[data-v]").length];
  chip("other").click();
  const line = one("#profile g[data-k='dem/default']");
  line.dispatchEvent(new MouseEvent("click", { bubbles: true }));
  said.afterLine = [all("#profile g[data-k='dem/default']").length,
                    seen("#which tr[data-k='dem/default']").length];
  one("#targets .chip").click();
  said.target = [location.hash, one("#target-said").textContent];
  all("#which thead th")[1].click();
  said.sorted = all("#which tbody tr").map((row) => Number(row.cells[1].dataset.s));
  one("#search").value = "nothing like it"; one("#search").dispatchEvent(new Event("input"));
  said.found = seen("#map tbody").length;
  one("#search").value = "t2"; one("#search").dispatchEvent(new Event("input"));
  said.foundAgain = seen("#map tbody").length;
  said.folded = seen("#map .v").length;
  one(".fold").click();
  said.unfolded = seen("#map .v").length;
  chip("verdict").click();
  said.verdict = seen("#map td[data-v='fail'] a")[0].textContent;
  document.activeElement.blur();
  document.dispatchEvent(new KeyboardEvent("keydown", { key: "/" }));
  said.focused = document.activeElement.id;
  one("#theme").click();
  said.paper = getComputedStyle(document.body).backgroundColor;
"""
CASE = """
  said.tips = seen("svg.chart").filter((s) => s.querySelector("[data-tip]")).map((svg) => {
    svg.scrollIntoView();
    const spot = svg.querySelector("[data-tip]");
    const at = spot.getAttribute("d").slice(1).split(" ").map(parseFloat);
    const place = new DOMPoint(at[0], at[1]).matrixTransform(svg.getScreenCTM());
    const where = { bubbles: true, clientX: place.x, clientY: place.y };
    svg.dispatchEvent(new PointerEvent("pointermove", where));
    said.faint = svg.querySelectorAll(".faint").length > 0;
    return one("#tip").textContent;
  });
  const bar = one(".playback input");
  const before = one(".playback circle").getAttribute("cx");
  bar.value = 20; bar.dispatchEvent(new Event("input"));
  said.moved = before !== null && one(".playback circle").getAttribute("cx") !== before;
  said.time = one(".playback output").textContent;
  said.target = document.getElementById(location.hash.slice(1))?.id;
"""
INPUT = """
  URL.createObjectURL = (blob) => { said.blob = blob; return "#"; };
  HTMLAnchorElement.prototype.click = function () { said.file = this.download; };
  said.texts = [];
  for (const button of all(".input [data-save]")) {
    said.shown = !button.hidden;
    said.blob = null;
    button.click();
    await until(() => said.blob);
    said.texts.push([said.file, await said.blob.text()]);
  }
  one("[data-whole]").click();
  said.whole = all(".input pre")[1].textContent;
"""
PAPERS = [
    (
        Paper("Doe (2001)", "Doe, A paper", "", ()),
        [
            Row(place, "x", "1", "m", "1.0", (Answer("bounce:T1", "1", ("dem/default",)),), how, "")
            for place, how in (("Eq. 2", Assessment.REPRODUCED), ("Eq. 1", Assessment.REPRODUCED))
        ],
    )
]
PAPER = """
  one("table.papers thead th").click();
  said.rows = all("table.papers tbody th").map((cell) => cell.textContent);
  said.links = all("table.papers a").map((link) => link.getAttribute("href"));
"""
ZOOM = """
  const buttons = all("figure h3 .chip");
  const steps = buttons.find((b) => b.closest("figure").textContent.includes("of y against step"));
  said.many = buttons.length;
  steps.click();
  const figure = steps.closest("figure");
  await until(() => figure.plot);
  const plot = figure.plot;
  said.names = plot.series.map((one) => one.label);
  said.values = plot.series.slice(1).map((one, i) => plot.data[i + 1].filter((v) => v != null));
  said.steps = plot.data[0];
  const ends = () => ["x", "y"].flatMap((k) => [plot.scales[k].min, plot.scales[k].max]);
  said.whole = ends();
  const over = plot.over.getBoundingClientRect();
  const mouse = (what, x, y) => (what === "mouseup" ? document : plot.over).dispatchEvent(
    new MouseEvent(what, { bubbles: true, movementX: 1, clientX: over.left + x,
                           clientY: over.top + y }));
  mouse("mousedown", 100, 50); mouse("mousemove", 300, 250); mouse("mouseup", 300, 250);
  await until(() => ends()[0] !== said.whole[0]);
  said.part = ends();
  one("dialog .u-series:nth-child(2) th").click();
  said.hidden = plot.series[1].show === false;
  one("dialog button").click();
  await until(() => !all("dialog").length);
  said.closed = all("dialog").length;
"""
DRAW = """
  const place = one("[data-draw='q2']");
  said.offered = !one("[data-drawn]").hidden;
  place.querySelector("button").click();
  await until(() => place.plot);
  said.names = place.plot.series.map((one) => one.label);
  said.drawn = place.plot.data.map((row) => [...row]);
"""
WIDE = "said.wide = [innerWidth, document.documentElement.scrollWidth];"

OUTSIDE = """
  const beyond = (a, b) => a.width && (a.right > b.right + 0.5 || a.left < b.left - 0.5);
  said.outside = seen("svg.chart").flatMap((svg) => [...svg.querySelectorAll("text")]
    .filter((t) => beyond(t.getBoundingClientRect(), svg.getBoundingClientRect()))
    .map((t) => t.textContent));
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a report on two variants in many schemes."""
    store = Store(tmp_path_factory.mktemp("store"))
    whole = with_external(manifest_of_all(store), "other")
    return html.build(whole, store, store.root / "report", Beside(PAPERS, native)).parent


def quiet(found: Opened) -> Opened:
    """The opened page, after checks for requests to the network and messages in the console."""
    assert found.asked == []
    assert found.console == []
    assert "failed" not in found.said, found.said
    return found


def test_the_front_page_filters_sorts_searches_and_keeps_it_in_the_address(
    folder: Path, tmp_path: Path
) -> None:
    said = quiet(opened(folder / "index.html", FRONT, tmp_path, "#find=t&hide=exact")).said
    assert said["hash"]["find"] == "t"
    assert said["hash"]["codes"].count("false") == 1
    assert said["lines"] > 1
    assert "other" in said["afterChip"][0]
    assert said["afterChip"][1] == 0
    assert said["afterChip"][2] > 0
    assert said["afterLine"] == [0, 0]
    assert "error=0.01" in said["target"][0]
    assert said["target"][1] == "0.01"
    assert said["sorted"] == sorted(said["sorted"])
    assert (said["found"], said["foundAgain"]) == (0, 1)
    assert (said["folded"], said["unfolded"]) == (0, 2)
    assert said["verdict"] == "fail"
    assert said["focused"] == "search"
    assert said["paper"] == "rgb(20, 24, 28)"


def test_a_case_tells_points_plays_motion_and_opens_at_a_scheme(
    folder: Path, tmp_path: Path
) -> None:
    at = "#bounce--T1--dem~default"
    said = quiet(opened(folder / "case-bounce.html", CASE, tmp_path, at)).said
    steps, costs = said["tips"][:2]
    assert re.fullmatch(r"[a-z]+/[a-z-]+: dt \S+ s: error \S+", steps)
    assert re.match(r"[a-z]+/[a-z-]+: dt \S+ s: error \S+, \S+ .s", costs)
    assert said["faint"]
    assert said["moved"]
    assert said["time"].startswith("t = 0.5")
    assert said["target"] == at[1:]


def test_a_chart_is_zoomed_into_by_the_library_and_shows_the_numbers_of_the_table(
    folder: Path, tmp_path: Path
) -> None:
    said = quiet(opened(folder / "case-bounce.html", ZOOM, tmp_path)).said
    page = (folder / "case-bounce.html").read_text()
    assert said["many"] > 2
    assert {"dem/default", "other/default"} <= set(said["names"])
    assert all(f"<td>{sci(error)}" in page for error in said["values"][0])
    assert all(float(sci(error)) == error for error in said["values"][0])
    assert all(f"<tr><td>{brief(dt)}" in page for dt in said["steps"])
    (left, right, low, high), part = said["whole"], said["part"]
    assert left < part[0] < part[1] < right
    assert low < part[2] < part[3] < high
    assert said["hidden"]
    assert said["closed"] == 0


def test_a_quantity_in_bounds_is_drawn_from_the_table_when_it_is_asked_for(
    store: Store, tmp_path: Path
) -> None:
    """If a thousand of them were drawn beforehand, they would be half of the report."""
    names = ("q0", "q1", "q2")
    facts = case()
    (height,) = facts.variants["T1"].quantities
    many = tuple(dataclasses.replace(height, name=name, symbol=name) for name in names)
    variant = dataclasses.replace(facts.variants["T1"], quantities=many)
    rungs = [
        record(label, "T1", dt, quantities=[
            entry("pass", {"max": dt / 4}, name=name) for name in names
        ])
        for label in ("dem/default", "yade/default") for dt in STEPS
    ]  # fmt: skip
    cases = {"bounce": dataclasses.replace(facts, variants={"T1": variant})}
    whole = manifest(*rungs, cases=cases)
    front = html.build(whole, store, store.root / "report")
    said = quiet(opened(front.parent / "case-bounce.html", DRAW, tmp_path)).said
    assert said["offered"]
    assert said["names"][1:] == ["dem/default", "yade/default"]
    steps, *errors = said["drawn"]
    assert steps == sorted(STEPS)
    assert errors == [[pytest.approx(dt / 4) for dt in steps]] * 2


def test_the_library_is_the_one_that_its_authors_released() -> None:
    digest = hashlib.sha256(library.script().encode()).hexdigest()
    assert digest == "2d27e8ad3d228164525ce213f9dc716f39b4e3aee0cc773fb3491c96cf4921a2"  # 1.6.31


def test_the_input_of_a_code_is_saved_whole(folder: Path, tmp_path: Path) -> None:
    said = quiet(opened(folder / "case-bounce.html", INPUT, tmp_path)).said
    assert said["shown"]
    assert said["texts"] == [
        [f"bounce-{v}-other.in", f'{HEAD}variant = "{v}"\n{TAIL}'] for v in ("T1", "T2")
    ]
    assert said["whole"] == f'variant = "T2"\n{TAIL}'


def test_the_page_of_the_papers_sorts_and_leads_to_variants(folder: Path, tmp_path: Path) -> None:
    said = quiet(opened(folder / "papers.html", PAPER, tmp_path)).said
    assert said["rows"] == ["Eq. 1", "Eq. 2"]
    assert set(said["links"]) == {"case-bounce.html#bounce--T1"}


@pytest.mark.parametrize("page", ["index.html", "case-bounce.html"])
def test_long_names_keep_within_their_drawings(store: Store, tmp_path: Path, page: str) -> None:
    labels = ("short/own", "a-code-of-a-long-name/default")
    whole = manifest(*(ran(store, label, "T1", dt, "pass") for label in labels for dt in STEPS))
    front = html.build(whole, store, store.root / "report")
    assert quiet(opened(front.parent / page, OUTSIDE, tmp_path)).said["outside"] == []


@pytest.mark.parametrize("page", ["index.html", "case-bounce.html", "papers.html"])
def test_pages_fit_a_narrow_window(folder: Path, tmp_path: Path, page: str) -> None:
    wide = quiet(opened(folder / page, WIDE, tmp_path, width=390)).said["wide"]
    assert wide[1] <= wide[0]
