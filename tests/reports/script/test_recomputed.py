"""Claims about what the front page works out anew when codes are hidden or errors chosen."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from reports.text import NONE
from tests.reports.script.made_up import in_browser, report, seen

pytestmark = in_browser
ROWS = """
  const chip = (name) => all(".chip").find((c) => [c.dataset.code, c.dataset.show].includes(name));
  const rows = () => Object.fromEntries(all("#which tbody tr").map((row) => [row.dataset.k, [
    row.querySelector(".median").textContent.trim(), row.querySelector(".dear").textContent.trim(),
    row.querySelector(".median").dataset.s, row.checkVisibility()]]));
  const line = (label) => one(`#profile g[data-k='${label}']`);
  const hide = (label) => line(label).dispatchEvent(new MouseEvent("click", { bubbles: true }));
  const place = (text, along) => Number(text.getAttribute(along));
  const drawn = () => Object.fromEntries(all("#profile g[data-k] .holes").map((path) => [
    path.parentNode.dataset.k, [path.dataset.tip.split("|"), path.getAttribute("d"),
    path.parentNode.querySelector(".line").getAttribute("d")]]));
"""


@pytest.fixture(scope="module")
def front(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return report(tmp_path_factory.mktemp("front")) / "index.html"


def table(said: dict[str, list[object]]) -> dict[str, tuple[object, object]]:
    return {label: (row[0], row[1]) for label, row in said.items()}


ALL = {  # common to all codes: T1, T2. Of the cheapest, costs to 1e-3 are 2, 1, 2; 4, 1; 1, 9
    "aa/one": ("2.0e-4", "2 3 of 3"),
    "aa/two": ("7.0e-4 1 of 2", "2 2 of 3"),
    "bb/one": ("4.0e-4", "3 2 of 3"),
    "cc/one": ("1.5e-2", NONE),
}


def test_with_all_shown_again_numbers_are_those_that_the_page_came_with(
    front: Path, tmp_path: Path
) -> None:
    script = (
        ROWS
        + """
      said.before = rows();
      said.target = [one("#target-said").textContent, Object.keys(drawn())];
      chip("bb").click();
      chip("bb").click();
      said.after = rows();
      said.common = one("#common").textContent;
    """
    )
    said = seen(front, script, tmp_path)
    assert said["target"] == ["1e-3", ["aa/one", "aa/two", "bb/one"]]
    assert table(said["before"]) == table(said["after"]) == ALL
    assert float(said["after"]["aa/one"][2]) == pytest.approx(2e-4)
    assert said["common"] == "2"


def test_without_a_code_others_are_over_what_they_have_in_common_and_the_cheapest_of_them(
    front: Path, tmp_path: Path
) -> None:
    """Without bb all have T1 to T3; costs over the cheapest are 1, 1, 2 and 2, 1."""
    script = (
        ROWS
        + """
      chip("bb").click();
      said.rows = rows();
      said.common = one("#common").textContent;
      said.columns = seen("#map thead th").map((cell) => cell.dataset.k ?? "");
      said.cells = seen("#map tbody:first-of-type tr:first-child td").length;
      said.address = location.hash;
    """
    )
    said = seen(front, script, tmp_path)
    assert table({k: row for k, row in said["rows"].items() if row[3]}) == {
        "aa/one": ("3.0e-4", "1 3 of 3"),
        "aa/two": ("8.0e-4 2 of 3", "1.4 2 of 3"),
        "cc/one": ("2.0e-2", NONE),
    }
    assert said["common"] == "3"
    assert said["columns"] == ["", "aa/one", "aa/two", "cc/one"]
    assert said["cells"] == 3
    assert said["address"] == "#hide=bb"


def test_costs_of_other_jobs_running_stay_marked(tmp_path: Path) -> None:
    page = report(tmp_path, timed=False) / "index.html"
    said = seen(
        page, ROWS + "chip('bb').click(); chip('bb').click(); said.rows = rows();", tmp_path
    )
    assert {label: row[1] for label, row in said["rows"].items()} == {
        "aa/one": "~2 3 of 3", "aa/two": "~2 2 of 3", "bb/one": "~3 2 of 3", "cc/one": NONE,
    }  # fmt: skip


def test_a_line_that_is_clicked_hides_one_scheme_and_the_last_of_a_code_the_code(
    front: Path, tmp_path: Path
) -> None:
    script = (
        ROWS
        + """
      const pressed = () => all("#chips .chip").map((c) => c.ariaPressed).join(" ");
      const lines = () => Object.keys(drawn()).join(" ");
      const state = () => [decodeURIComponent(location.hash), pressed(), lines()];
      hide("aa/one");
      said.one = state();
      said.rows = rows();
      hide("aa/two");
      said.both = state();
      chip("aa").click();
      said.again = state();
    """
    )
    said = seen(front, script, tmp_path)
    assert said["one"] == ["#hide=aa/one", "true true true", "aa/two bb/one"]
    assert (said["rows"]["aa/one"][3], said["rows"]["aa/two"][3]) == (False, True)
    assert said["both"] == ["#hide=aa", "false true true", "bb/one"]
    assert said["again"] == ["", "true true true", "aa/one aa/two bb/one"]


TIPS = {  # at each error: variant, cost [s] and how many times the cheapest, cheapest first
    "0.01": {
        "aa/one": [("T1", "0.00100", "1"), ("T2", "0.00200", "1"), ("T3", "0.00100", "1")],
        "aa/two": [("T3", "0.00200", "2"), ("T1", "0.00300", "3")],
        "bb/one": [("T1", "0.00200", "2"), ("T2", "0.00400", "2")],
        "cc/one": [("T2", "0.00400", "2")],
    },
    "1e-3": {
        "aa/one": [("T2", "0.0400", "1"), ("T1", "0.0100", "2"), ("T3", "0.0100", "2")],
        "aa/two": [("T3", "0.00500", "1"), ("T1", "0.0200", "4")],
        "bb/one": [("T1", "0.00500", "1"), ("T2", "0.360", "9")],
    },
    "1e-4": {"aa/one": [("T1", "0.100", "1")]},
}
SOLVED = {"0.01": 3, "1e-3": 3, "1e-4": 1}  # variants that anybody solves


def test_the_profile_of_each_error_has_every_cost_at_its_place(front: Path, tmp_path: Path) -> None:
    script = (
        ROWS
        + """
      for (const target of all("#targets .chip").slice(0, 3)) {
        target.click();
        said[one("#target-said").textContent] = [drawn(),
          all("#profile text.mid").slice(0, 2).map((text) => [text.textContent, place(text, "x")]),
          all("#profile text.end").map((text) => [text.textContent, place(text, "y")]),
          location.hash];
      }
    """
    )
    said = seen(front, script, tmp_path)
    hashes = {target: told[3] for target, told in said.items()}
    assert hashes == {"0.01": "#error=0.01", "1e-3": "", "1e-4": "#error=0.0001"}
    for target, (drawn, across, up, _) in said.items():
        assert {label: row[0] for label, row in drawn.items()} == {
            label: [f"bounce:{v}, {cpu} s, {ratio} times the cheapest" for v, cpu, ratio in row]
            for label, row in TIPS[target].items()
        }
        assert [words for words, _ in across] == ["1", "10¹"]
        assert [words for words, _ in up] == [f"{share} %" for share in range(0, 101, 20)]
        assert across[1][1] - across[0][1] > 150.0, "a decade takes half of the drawing"
        bottom, top = up[0][1] - 3.0, up[-1][1] - 3.0
        for label, (_, places, line) in drawn.items():
            given = [(float(ratio), (k + 1) / SOLVED[target])
                     for k, (_, _, ratio) in enumerate(TIPS[target][label])]  # fmt: skip
            due = [(across[0][1] + math.log10(ratio) * (across[1][1] - across[0][1]),
                    bottom + share * (top - bottom)) for ratio, share in given]  # fmt: skip
            assert _pairs(places.removesuffix("h0")[1:]) == [pytest.approx(one) for one in due]
            corners = _pairs(line[1:].replace("L", " "))
            assert [corners[0][1], *(y for _, y in corners[1:-1:2])] == pytest.approx(
                [bottom, *(y for _, y in due)]
            )
            assert corners[-1][1] == pytest.approx(due[-1][1])


def _pairs(text: str) -> list[tuple[float, float]]:
    numbers = [float(one) for one in text.split()]
    return list(zip(numbers[::2], numbers[1::2], strict=True))
