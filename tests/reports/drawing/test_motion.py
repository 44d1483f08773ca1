"""Claims about the motion of bodies in the drawing of a scene: in the data, and in a browser."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest

from reports.drawing.playback import moving, playback
from tests.reports.test_browser import quiet
from tests.support.browser import CHROMIUM, opened
from tests.support.built_report import pages
from tests.support.fabricated import case, manifest, ran
from vv.plan.planning import declare_trial
from vv.plan.project import find
from vv.records.case_facts import CaseFacts
from vv.run.case_facts import _moved
from vv.scene.picture.moved import Moved
from vv.scene.picture.sketch import Sketch
from vv.store.store import Store

TWO = Sketch(  # spheres side by side, the second of which goes up, and the bond between them
    size=2.0,
    axes=("x", "z"),
    bodies=2,
    circles=((-0.25, 0.0, 0.25), (0.25, 0.0, 0.25)),
    held=(False, False),
    bonds=(((-0.25, 0.0), (0.25, 0.0)),),
)
UP = Moved(circles=(1, 1), faces=(0, 0), along=(0.0, 1.0))
SEEN = """
  const at = (shape) => (shape.getAttribute("transform") ?? "").match(/-?[\\d.]+/g)?.map(Number);
  const [box, other] = all(".playback"), scene = box.closest(".variant").querySelector(".scene");
  const bar = box.querySelector("input"), chosen = box.querySelector("select");
  const lifted = scene.querySelectorAll("circle.body")[1];
  const look = () => [at(lifted), at(scene.querySelector(".ghost"))];
  bar.value = 20; bar.dispatchEvent(new Event("input"));
  said.off = look();
  said.bond = scene.querySelector(".bond").getAttribute("d");
  said.still = at(scene.querySelector("circle.body")) ?? null;
  said.beside = at(other.closest(".variant").querySelectorAll(".scene circle.body")[1]);
  chosen.value = "exact/default"; chosen.dispatchEvent(new Event("change"));
  said.right = look();
  said.codes = [...chosen.options].map((one) => one.value);
  said.told = box.querySelector("output").textContent;
  box.querySelector("button").click();
  await wait(200);
  said.plays = Number(bar.value);
"""


def moved_case(size: float = 2.0) -> CaseFacts:
    """The fabricated case with a drawing `size` metres wide, in which y lifts a sphere."""
    facts = case()
    drawn = dataclasses.replace(TWO, size=size)
    variants = {
        name: dataclasses.replace(one, sketch=drawn, moved={"y": UP})
        for name, one in facts.variants.items()
    }
    return dataclasses.replace(facts, variants=variants)


def played(store: Store, size: float) -> dict[str, object]:
    """The data from which the page of the case plays its first variant."""
    records = [ran(store, "dem/default", "T1", 4e-3, "pass")]
    whole = manifest(*records, cases={"bounce": moved_case(size)})
    page = pages(whole, store)["case-bounce.html"]
    found: dict[str, object] = json.loads(
        page.partition('hidden><script type="application/json">')[2].partition("<")[0]
    )
    return found


@pytest.mark.parametrize(
    ("size", "words", "far"),
    [  # y reaches 1 m, and a drawing of `size` m is 150 pixels wide
        (2.0, "motion to the scale of the drawing", 75.0),
        (200.0, "motion magnified 50 times, bodies to scale", 37.5),
        (0.2, "motion reduced 10 times, bodies to scale", 75.0),
    ],
)
def test_a_motion_is_drawn_so_large_that_it_is_seen_and_says_so(
    store: Store, size: float, words: str, far: float
) -> None:
    found = played(store, size)
    assert found["drawn"] == words
    assert found["moves"] == [[0, 1, 1, 0, 0, 0.0, pytest.approx(-far / 1000, rel=1e-2), -0.0]]


def test_what_moves_no_body_is_played_without_a_scene() -> None:
    facts = case().variants["T1"]
    assert moving(facts) == ["y"]
    assert playback({"y": []}, facts) == ""


@pytest.mark.parametrize(
    ("name", "variant", "quantity", "seen"),
    [
        ("single-contact", "T1", "y", Moved((1, 1), (0, 0), along=(0.0, 1.0))),
        ("single-contact", "T1-swapped", "y", Moved((0, 1), (0, 0), along=(0.0, 1.0))),
        ("rocking", "released", "z", Moved((0, 0), (0, 1), along=(0.0, 1.0))),
    ],
)
def test_cases_say_which_body_a_quantity_moves(
    name: str, variant: str, quantity: str, seen: Moved
) -> None:
    one = find().load_case(name)
    trial = declare_trial(one, variant, one.defaults(variant))
    assert _moved(trial.quantities, trial.study.scene)[quantity] == seen


def test_a_lean_turns_the_block_clockwise_where_x_is_to_the_right() -> None:
    one = find().load_case("rocking")
    trial = declare_trial(one, "released", one.defaults("released"))
    lean = _moved(trial.quantities, trial.study.scene)["lean"]
    assert lean.along == (0.0, 0.0)
    assert lean.turn < 0


@pytest.mark.skipif(not CHROMIUM, reason="Chromium is not installed")
def test_the_bodies_of_a_drawing_move_as_a_code_has_them_over_the_exact_ones(
    store: Store, tmp_path: Path
) -> None:
    records = [
        ran(store, label, variant, dt, "pass")
        for variant in ("T1", "T2")
        for label, dt in (("dem/default", 0.2), ("exact/default", None))
    ]
    whole = manifest(*records, cases={"bounce": moved_case()})
    pages(whole, store)
    page = store.root / "report" / "case-bounce.html"
    said = quiet(opened(page, SEEN, tmp_path)).said
    t = 20 / 39  # of 41 outputs, in 40 frames
    exact = np.sin(3 * t)
    wrong = exact * (1 + 0.4 * np.cos(7 * t))
    (x, y), ghost = said["off"]
    assert (x, y) == (0, pytest.approx(-75 * wrong, rel=0.01))
    assert ghost == [0, pytest.approx(-75 * exact, rel=0.01)]
    assert said["bond"].startswith("M102.5 104L177.5 ")
    assert float(said["bond"].split()[-1]) == pytest.approx(104 - 75 * wrong, rel=0.01)
    assert said["still"] is None
    assert said["beside"] == [0, pytest.approx(-75 * 1.4, rel=0.01)]  # of T2, still at its start
    assert said["right"][0] == said["right"][1] == ghost
    assert said["codes"] == ["dem/default", "exact/default"]
    assert "exact/default: " in said["told"]
    assert "to the scale of the drawing" in said["told"]
    assert said["plays"] > 20
