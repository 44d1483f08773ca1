"""Claims about what a reader chooses on the front page: order, search, what cells show, theme."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.reports.script.made_up import in_browser, report, seen

pytestmark = in_browser
MORE = "&show=verdict&find=nobody&error=0.01&hide=aa/two,bb"
START = """
  const key = (key) => new KeyboardEvent("keydown", { key });
  const labels = () => all("#which tbody tr").map((row) => row.dataset.k);
  const head = (column) => all("#which thead th")[column];
  const chip = (what) => all("#show .chip").find((one) => one.dataset.show === what);
  const cells = () => all("#map td[data-v] a").slice(0, 3).map((link) => link.textContent.trim());
  const type = (text) => {
    one("#search").value = text; one("#search").dispatchEvent(new Event("input"));
    return seen("#map tbody").length;
  };
"""


@pytest.fixture(scope="module")
def front(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return report(tmp_path_factory.mktemp("front")) / "index.html"


def noted(page: Path, script: str, scratch: Path, at: str = "") -> dict[str, Any]:
    return seen(page, START + script, scratch, at)


def test_numbers_are_sorted_as_numbers_and_what_has_none_stands_last_either_way(
    front: Path, tmp_path: Path
) -> None:
    script = """
      for (let n = 0; n < 3; n++) {
        head(3).click();
        said[n] = [labels().slice(2), head(3).getAttribute("aria-sort"), location.hash];
      }
      head(2).click();
      said.other = [labels(), head(3).getAttribute("aria-sort"), location.hash];
      head(0).dispatchEvent(key("Enter"));
      said.words = labels();
      head(0).dispatchEvent(key("x"));
      said.same = labels();
    """
    said = noted(front, script, tmp_path)
    assert said["0"] == [["bb/one", "cc/one"], "ascending", "#sort=3"]
    assert said["1"][1:] == ["descending", "#sort=3-"]
    assert said["1"][0][1] == "cc/one"
    assert said["2"] == said["0"]
    assert said["other"] == [["aa/one", "bb/one", "aa/two", "cc/one"], None, "#sort=2"]
    assert said["words"] == said["same"] == ["aa/one", "aa/two", "bb/one", "cc/one"]


@pytest.mark.parametrize(
    ("at", "labels"),
    [
        ("#sort=2", ["aa/one", "bb/one", "aa/two", "cc/one"]),
        ("#sort=2-", ["cc/one", "aa/two", "bb/one", "aa/one"]),
    ],
)
def test_an_address_brings_back_all_that_was_chosen(
    front: Path, tmp_path: Path, at: str, labels: list[str]
) -> None:
    script = """
      said.labels = labels();
      said.cells = cells();
      said.search = [one("#search").value, seen("#map tbody").length];
      said.target = one("#target-said").textContent;
      said.lines = all("#profile g[data-k] .line").map((line) => line.parentNode.dataset.k);
    """
    said = noted(front, script, tmp_path, f"{at}{MORE}")
    assert said["labels"] == labels
    assert said["cells"] == ["pass"] * 3
    assert said["search"] == ["nobody", 0]
    assert said["target"] == "0.01"
    assert said["lines"] == ["aa/one", "cc/one"]


def test_a_case_is_found_by_all_the_words_whatever_their_letters(
    front: Path, tmp_path: Path
) -> None:
    script = """
      said.found = ["T2", "Bounce  t2", "t2 nothing", "nothing t2", ""].map(type);
      type("bounce");
      said.address = location.hash;
      one("#map tbody a").setAttribute("href", "#there");
      const enter = () => one("#search").dispatchEvent(key("Enter"));
      type("nothing"); enter();
      said.nowhere = location.hash;
      type("bounce"); enter();
      said.gone = location.hash;
    """
    said = noted(front, script, tmp_path)
    assert said["found"] == [1, 1, 0, 0, 1]
    assert said["address"] == "#find=bounce"
    assert (said["nowhere"], said["gone"]) == ("#find=nothing", "#there")


def test_cells_show_the_error_the_cost_or_the_verdict_and_the_error_again(
    front: Path, tmp_path: Path
) -> None:
    """The first row is of the case: the medians of T1 to T3 at the finest setting."""
    script = """
      for (const what of ["error", "cost", "verdict", "error"]) {
        said[what] = [...(said[what] ?? []), ...cells()];
        chip(what).click();
        said[`${what} shown`] = [cells(), location.hash, chip(what).ariaPressed];
      }
      said.pressed = all("#show .chip").map((one) => one.ariaPressed);
    """
    said = noted(front, script, tmp_path)
    assert said["error shown"] == [["3e-4", "8e-4", "4e-4"], "", "true"]
    assert said["cost shown"] == [["100 ms", "55 ms", "615 ms"], "#show=cost", "true"]
    assert said["verdict shown"] == [["pass"] * 3, "#show=verdict", "true"]
    assert said["pressed"] == ["true", "false", "false"]


def test_the_theme_is_turned_and_kept(front: Path, tmp_path: Path) -> None:
    script = """
      said.before = document.documentElement.dataset.theme ?? null;
      said.after = [1, 2].map(() => {
        one("#theme").click();
        return [document.documentElement.dataset.theme, localStorage.getItem("vv-theme")];
      });
    """
    said = noted(front, script, tmp_path)
    assert said["before"] is None
    assert said["after"] == [["dark", "dark"], ["light", "light"]]
