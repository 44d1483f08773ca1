"""Claims about errors that are drawn from the table of all settings when they are asked for."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest

from reports import html
from tests.reports.script.made_up import in_browser, seen
from tests.support.fabricated import case, entry, manifest, record
from vv.store.store import Store

pytestmark = in_browser
NAMES = ("q", "q2", "q2x")  # the first two have drawings of their own
ERRORS = {  # of the third, at each stiffness and step; the rest of a row is of other schemes
    (1e6, 4e-3): 8e-3, (1e6, 2e-3): 4e-3, (1e6, 1e-3): 2e-3,
    (1e7, 4e-3): 3e-4, (1e7, 2e-3): 3e-4, (1e7, 1e-3): 0.0,
    (1e8, 4e-3): 5e-4, (1e8, 2e-3): 5e-4, (1e8, 1e-3): 5e-4,  # of which the last share a row
}  # fmt: skip
DRAW = """
  const place = one("[data-draw='q2x']");
  place.querySelector("button").click();
  await until(() => place.plot);
  const plot = place.plot, rows = plot.data.map((row) => [...row]);
  said.curves = Object.fromEntries(plot.series.slice(1).map((one, i) => [one.label,
    rows[0].flatMap((x, k) => rows[i + 1][k] == null ? [] : [[x, rows[i + 1][k]]])]));
  const { x, y } = plot.scales;
  said.ends = [x, y].map((scale) => [scale.min, scale.max, scale.distr]);
"""


def test_each_stiffness_has_its_curve_over_all_steps_that_a_row_names_and_no_error_is_no_point(
    store: Store, tmp_path: Path
) -> None:
    facts = case()
    (height,) = facts.variants["T1"].quantities
    many = tuple(dataclasses.replace(height, name=name, symbol=name) for name in NAMES)
    variant = dataclasses.replace(facts.variants["T1"], quantities=many)
    runs = [
        record(
            "dem/default", "T1", dt, rung={"dt": dt, "kn": kn}, key=f"{dt}{kn}".encode().hex(),
            quantities=[
                entry("pass", {"max": error if name == "q2x" else 1e-5}, name=name)
                for name in NAMES
            ],
        )
        for (kn, dt), error in ERRORS.items()
    ]  # fmt: skip
    cases = {"bounce": dataclasses.replace(facts, variants={"T1": variant})}
    front = html.build(manifest(*runs, cases=cases), store, store.root / "report")
    assert "<tr><td>2e-3, 1e-3<td>1e8" in (front.parent / "case-bounce.html").read_text()
    said = seen(front.parent / "case-bounce.html", DRAW, tmp_path)
    assert said["curves"] == {
        "dem/default, kn 1e6 N/m": [[1e-3, 2e-3], [2e-3, 4e-3], [4e-3, 8e-3]],
        "dem/default, kn 1e7 N/m": [[2e-3, 3e-4], [4e-3, 3e-4]],
        "dem/default, kn 1e8 N/m": [[1e-3, 5e-4], [2e-3, 5e-4], [4e-3, 5e-4]],
    }
    (left, right, across), (low, high, up) = said["ends"]
    assert (across, up) == (3, 3), "both are logarithmic"
    assert (left, right) == pytest.approx((1e-3 / 1.2, 4e-3 * 1.2))
    assert (low, high) == pytest.approx((3e-4 / 1.2, 8e-3 * 1.2))
