"""Claims about a motion that is played: marks, words, and the bodies of the drawing, by hand.

The data of the motion, which `reports/drawing/playback.py` makes, are replaced by small ones.
"""

from __future__ import annotations

import dataclasses
import json
import re
from pathlib import Path
from typing import Any

import pytest

from reports import html
from tests.reports.script.made_up import in_browser, seen
from tests.support.fabricated import case, manifest, ran
from vv.scene.picture.moved import Moved
from vv.scene.picture.sketch import Sketch
from vv.store.store import Store

pytestmark = in_browser
DRAWN = Sketch(
    size=2.0, axes=("x", "z"), bodies=4, circles=((-0.3, 0.0, 0.1), (0.0, 0.0, 0.1)),
    held=(False, False), bonds=(((-0.3, 0.0), (0.0, 0.0)),),
    polygons=(((0.2, 0.0), (0.3, 0.0), (0.3, 0.1)), ((0.2, -0.4), (0.4, -0.4), (0.4, -0.2))),
    fixed=(False, False),
)  # fmt: skip
MOTION: dict[str, Any] = {  # in thousandths of 2 m and of 0.5
    "ends": [2.0, 6.0],
    "exact": [["y [m]", 2.0, [0, 500, 1000, 500, 0]], ["turn", 0.5, [100, 200, 300, 400, 500]]],
    "codes": {
        "aa/one": [3, [[0, 500, None, 750, -250], [100, 300, 200, 400, 500]]],
        "bb/one": [4, [0, 0]],
    },
    # part, circles, faces, pixels to the right and down and degrees for each thousandth
    "moves": [[0, 1, 1, 0, 0, 0.02, -0.06, 0.0], [1, 0, 0, 1, 1, 0.01, 0.0, 0.09]],
    "drawn": "motion to the scale of the drawing",
}
PLAY = """
  const box = one(".playback"), scene = box.closest(".variant").querySelector("svg.scene");
  const bar = box.querySelector("input"), chosen = box.querySelector("select");
  const button = box.querySelector("button");
  const every = (what) => [...scene.querySelectorAll(what)];
  const [circles, faces, ghosts] = ["circle.body", "path.body", ".ghost"].map(every);
  const numbers = (text) => text?.match(/-?[\\d.]+/g).map(Number) ?? null;
  const at = (shape) => [
    numbers(shape.getAttribute("transform")), shape.getAttribute("visibility") ?? "visible"];
  const go = (i) => { bar.value = i; bar.dispatchEvent(new Event("input")); };
  const show = () => ({ told: box.querySelector("output").textContent,
    exact: box.querySelector(".exact").getAttribute("d"),
    marks: [...box.querySelectorAll("circle")].map((dot) =>
      [dot.getAttribute("cx"), dot.getAttribute("visibility")]),
    circles: circles.map(at), faces: faces.map(at), ghosts: ghosts.map(at),
    bond: scene.querySelector(".bond").getAttribute("d") });
"""


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("played")
    store, facts = Store(root / ".vv"), case()
    moved = {"y": Moved((1, 1), (0, 0), along=(0.0, 1.0))}
    one = dataclasses.replace(facts.variants["T1"], sketch=DRAWN, moved=moved)
    runs = [ran(store, label, "T1", 4e-3, "pass") for label in ("aa/one", "bb/one")]
    cases = {"bounce": dataclasses.replace(facts, variants={"T1": one})}
    made = html.build(manifest(*runs, cases=cases), store, root / "report").parent
    page = made / "case-bounce.html"
    own = r'(hidden><script type="application/json">)(.*?)(</script>)'
    text, count = re.subn(own, lambda found: found[1] + json.dumps(MOTION) + found[3],
                          page.read_text())  # fmt: skip
    assert count == 1
    page.write_text(text)
    return page


def test_a_frame_tells_time_and_values_and_marks_each_scheme_beside_the_exact_answer(
    page: Path, tmp_path: Path
) -> None:
    """Marks are on 300 pixels from the least of all, -250, to the largest, 1000."""
    script = PLAY + "for (const i of [0, 1, 2, 4]) { go(i); said[i] = show(); }"
    said = seen(page, script, tmp_path)
    end = "Dashed outline: exact; motion to the scale of the drawing."
    assert [said[i]["told"] for i in "0124"] == [
        f"t = 2 s, exact y [m]: 0.00, aa/one: 0.00. {end}",
        f"t = 3 s, exact y [m]: 1.00, aa/one: 1.00. {end}",
        f"t = 4 s, exact y [m]: 2.00, aa/one: none. {end}",
        f"t = 6 s, exact y [m]: 0.00, aa/one: -0.500. {end}",
    ]
    assert [said[i]["exact"] for i in "012"] == ["M80 16V46", "M200 16V46", "M320 16V46"]
    assert [said[i]["marks"] for i in "0124"] == [
        [["80", "visible"], ["80", "visible"]],
        [["200", "visible"], ["200", "visible"]],
        [["200", "hidden"], ["320", "visible"]],
        [["20", "visible"], ["80", "visible"]],
    ]


def test_bodies_go_and_turn_as_the_chosen_scheme_has_them_and_outlines_as_they_should(
    page: Path, tmp_path: Path
) -> None:
    """A turn is from where it begins; a place is hidden that a scheme does not have."""
    script = (
        PLAY
        + """
      const middle = (path) => { const n = numbers(path.getAttribute("d"));
        return [0, 1].map((axis) => (n[axis] + n[axis + 2] + n[axis + 4]) / 3); };
      said.middle = middle(faces[1]);
      for (const i of [1, 2, 3]) { go(i); said[i] = show(); }
      chosen.value = "bb/one"; chosen.dispatchEvent(new Event("change"));
      said.other = show();
    """
    )
    said = seen(page, script, tmp_path)
    middle = [pytest.approx(one, abs=0.06) for one in said["middle"]]
    assert [said[i]["circles"][1] for i in "123"] == [
        [[10.0, -30.0], "visible"], [[0.0, 0.0], "hidden"], [[15.0, -45.0], "visible"]
    ]  # fmt: skip
    assert [said[i]["faces"][1] for i in "123"] == [
        [[3.0, 0.0, 18.0, *middle], "visible"],
        [[2.0, 0.0, 9.0, *middle], "visible"],
        [[4.0, 0.0, 27.0, *middle], "visible"],
    ]
    assert [said[i]["ghosts"] for i in "12"] == [
        [[[10.0, -30.0], "visible"], [[2.0, 0.0, 9.0, *middle], "visible"]],
        [[[20.0, -60.0], "visible"], [[3.0, 0.0, 18.0, *middle], "visible"]],
    ]
    still = [said["3"]["circles"][0], said["3"]["faces"][0]]
    assert still == [[None, "visible"]] * 2
    assert [said["other"]["circles"][1], said["other"]["faces"][1]] == said["3"]["ghosts"]
    assert "bb/one: 1.00" in said["other"]["told"]


def test_a_bond_ends_where_its_spheres_are(page: Path, tmp_path: Path) -> None:
    script = (
        PLAY
        + """
      const centre = (shape) => ["cx", "cy"].map((name) => Number(shape.getAttribute(name)));
      said.centres = circles.map(centre);
      go(1);
      said.bond = numbers(show().bond);
    """
    )
    said = seen(page, script, tmp_path)
    (x, y), (a, b) = said["centres"]
    assert said["bond"] == [pytest.approx(one, abs=0.06) for one in (x, y, a + 10.0, b - 30.0)]


def test_it_plays_from_the_end_to_the_start_and_stops_when_told(page: Path, tmp_path: Path) -> None:
    script = (
        PLAY
        + """
      go(4);
      button.click();
      said.playing = button.textContent;
      await until(() => Number(bar.value) < 4);
      said.round = Number(bar.value);
      await until(() => Number(bar.value) > 0);
      button.click();
      said.stopped = button.textContent;
      const before = bar.value;
      await wait(300);
      said.still = bar.value === before;
    """
    )
    said = seen(page, script, tmp_path)
    assert (said["playing"], said["stopped"], said["still"]) == ("stop", "play", True)
    assert said["round"] == 0
