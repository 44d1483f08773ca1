"""Claims about what a chart says where it is pointed at, and which curves it then fades."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.reports.script.made_up import RUNS, in_browser, report, seen
from tests.support.fabricated import STEPS

pytestmark = in_browser
POINT = """
  const chart = (title, n = 0) => all("figure").filter((figure) =>
    figure.querySelector("h3").textContent.startsWith(title))[n].querySelector("svg.chart");
  const tip = one("#tip");
  const move = (svg, x, y) => {
    svg.scrollIntoView();
    const at = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM());
    const where = { bubbles: true, clientX: at.x, clientY: at.y };
    svg.dispatchEvent(new PointerEvent("pointermove", where));
    return tip.hidden ? null : tip.textContent;
  };
  const spots = (path) => {
    const all = path.getAttribute("d").slice(1).split(" ").map(parseFloat);
    return path.dataset.tip.split("|").map((_, i) => [all[2 * i], all[2 * i + 1]]);
  };
"""


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return report(tmp_path_factory.mktemp("page")) / "case-bounce.html"


def time(milliseconds: float) -> str:
    if milliseconds < 1.0:
        return f"{1e3 * milliseconds:g} µs"
    return f"{milliseconds:g} ms" if milliseconds < 1e3 else f"{1e-3 * milliseconds:g} s"


def test_each_point_tells_its_scheme_step_error_and_cost(page: Path, tmp_path: Path) -> None:
    script = (
        POINT
        + """
      const svg = chart("Error of y against cost");
      const points = [...svg.querySelectorAll("[data-tip]")].flatMap(spots);
      said.told = points.map((at) => move(svg, ...at));
    """
    )
    due = [
        f"{label}: dt {dt * 1e3:g}e-3 s: error {error:.2e}, {time(cpu)}".replace("e-0", "e-")
        for (label, variant), settings in RUNS.items()
        if variant == "T1"
        for dt, (error, cpu) in zip(STEPS, settings, strict=True)
    ]
    assert seen(page, script, tmp_path)["told"] == due


def test_costs_of_other_jobs_running_are_told_as_such(tmp_path: Path) -> None:
    script = (
        POINT
        + """
      const svg = chart("Error of y against cost");
      said.told = move(svg, ...spots(svg.querySelector("[data-tip]"))[0]);
    """
    )
    told = seen(report(tmp_path, timed=False) / "case-bounce.html", script, tmp_path)["told"]
    assert told == "aa/one: dt 4e-3 s: error 1.00e-2, 1 ms (indicative)"


def test_the_nearest_point_within_reach_is_told_and_others_fade_until_the_chart_is_left(
    page: Path, tmp_path: Path
) -> None:
    """Of T1 against the step: the point of cc/one at 1 ms stands alone."""
    script = (
        POINT
        + """
      const svg = chart("Error of y against step");
      const paths = [...svg.querySelectorAll("[data-tip]")], [x, y] = spots(paths.at(-1))[2];
      const faint = () => [...svg.querySelectorAll(".faint")].map((g) =>
        g.dataset.k ?? document.getElementById(g.classList[0]).dataset.k);
      const off = [[0, 13], [0, -13], [13, 0], [0, 15], [11, 11]];
      said.told = off.map(([dx, dy]) => move(svg, x + dx, y + dy));
      const [[u, low], [, high]] = [paths[0], paths[2]].map((path) => spots(path)[2]);
      said.between = [0.45, 0.55].map((part) => move(svg, u, low + part * (high - low)));
      move(svg, x, y);
      said.faint = [...new Set(faint())];
      const out = (relatedTarget) => svg.dispatchEvent(
        new PointerEvent("pointerout", { bubbles: true, relatedTarget }));
      out(svg.querySelector("path"));
      said.inside = [tip.hidden, faint().length > 0];
      out(document.body);
      said.left = [tip.hidden, faint().length];
    """
    )
    said = seen(page, script, tmp_path)
    own = "cc/one: dt 1e-3 s: error 2.00e-2"
    assert said["told"] == [own, own, own, None, None]
    due = ["aa/one: dt 1e-3 s: error 1.00e-4", "bb/one: dt 1e-3 s: error 2.00e-4"]
    assert said["between"] == due, "both are within reach"
    assert sorted(said["faint"]) == ["aa/one", "aa/two", "bb/one"]
    assert said["inside"] == [False, True]
    assert said["left"] == [True, 0]


ZOOM = """
  const zoomed = async (title) => {
    const figure = chart(title).closest("figure");
    figure.querySelector("h3 .chip").click();
    await until(() => figure.plot);
    const plot = figure.plot, told = plot.data.map((row) => [...row]);
    const curves = plot.series.slice(1).map((one, i) => [one.label,
      told[0].flatMap((x, k) => told[i + 1][k] == null ? [] : [[x, told[i + 1][k]]])]);
    const { x, y } = plot.scales;
    const ends = [x, y].map((scale) => [scale.min, scale.max, scale.distr]);
    plot.setLegend({ idx: told[0].length - 1 });
    const legend = all("dialog .u-value").map((cell) => cell.textContent);
    const title_said = one("dialog b").textContent;
    one("dialog button").click();
    await until(() => !all("dialog").length);
    return { curves: Object.fromEntries(curves), ends, legend, title: title_said };
  };
"""


def test_a_zoomed_chart_has_the_numbers_of_its_points(page: Path, tmp_path: Path) -> None:
    script = (
        POINT
        + ZOOM
        + """
      said.cost = await zoomed("Error of y against cost");
      const { x, y } = chart("Error of y against cost").dataset;
      said.axes = [x, y].map((axis) => axis.split(" ").slice(0, 2).map(Number));
      said.step = await zoomed("Error of y against step");
    """
    )
    said = seen(page, script, tmp_path)
    labels = [label for label, variant in RUNS if variant == "T1"]
    for what, curves in ((what, said[what]["curves"]) for what in ("cost", "step")):
        assert {*labels} <= {*curves}
        for label in labels:
            settings = zip(STEPS, RUNS[label, "T1"], strict=True)
            due = sorted((1e-3 * cpu if what == "cost" else dt, error)
                         for dt, (error, cpu) in settings)  # fmt: skip
            assert [tuple(one) for one in curves[label]] == [pytest.approx(one) for one in due]
    (left, right, across), (low, high, up) = said["cost"]["ends"]
    assert (across, up) == (3, 3), "both are logarithmic"
    powers = [*said["axes"][0], *said["axes"][1]]
    assert [left, right, low, high] == pytest.approx([10**power for power in powers])
    assert left < 0.4e-3
    assert right > 0.1
    assert low < 1e-4
    assert high > 0.1
    assert said["step"]["legend"][:2] == ["4e-3", "0.01"]
    assert said["step"]["title"] == "Error of y against step"


def test_a_point_of_the_front_is_the_cheapest_for_its_error(page: Path, tmp_path: Path) -> None:
    """Of T1: 1 ms for 1e-2, 5 ms for 1e-3, 30 ms for 2e-4, 100 ms for 1e-4, from their places."""
    said = seen(
        page, POINT + ZOOM + "said.cost = await zoomed('Error of y against cost');", tmp_path
    )
    corners = [tuple(one) for one in said["cost"]["curves"]["the front"]]
    for point in ((1e-3, 1e-2), (5e-3, 1e-3), (30e-3, 2e-4), (100e-3, 1e-4)):
        assert any(one == pytest.approx(point, rel=0.03) for one in corners), corners
