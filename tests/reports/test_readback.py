"""Claims about the cells and curves of the report, which are read back and compared by hand.

The numbers are chosen so that any mistake changes a cell: the coarsest setting for the finest, a
ratio inverted, milliseconds for microseconds, a cost from the wrong end, a missing error as none.
"""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from reports import html
from reports.text import NONE
from tests.support.fabricated import case, changed, cost, entry, manifest, record
from tests.support.read_back import Node, curves, page, section, table
from vv.records.case_facts import ToleranceFacts
from vv.records.job_record import Record, summary_of
from vv.records.manifest import CodeFound, Manifest
from vv.store.store import Store

STEPS = (4e-3, 2e-3, 1e-3)  # s
BOUNDS = {  # of classes that no scheme here has
    "all at once": ToleranceFacts(2e-2, "all", 5e-3, 1, 3e-4, "", 7e8, 0.5, 6.0),
    "late alone": ToleranceFacts(3e-2, "late", late=8.0),
    "stiffness alone": ToleranceFacts(4e-2, "soft", kn=9e7, softness=1.5),
    "the same at all": ToleranceFacts(5e-2, "fixed"),
}
Table = dict[str, dict[str, tuple[float | None, ...]]]
ERRORS: Table = {  # the largest error at each of STEPS, variant by variant
    "T1": {
        "dem/default": (8e-3, 2e-3, 5e-4),
        "yade/default": (2.4e-2, 1.2e-2, 6e-3),
        "liggghts/default": (9e-4, 4e-4, None),
    },
    "T2": {
        "dem/default": (1.024e-3, 2.56e-4, 6.4e-5),
        "yade/default": (6.4e-3, 3.2e-3, 1.6e-3),
        "liggghts/default": (3.2e-4, 1.6e-4, 8e-5),
    },
}
CPU: dict[str, dict[str, tuple[float, ...]]] = {  # s
    "T1": {
        "dem/default": (2e-4, 3e-3, 5e-2),
        "yade/default": (1e-3, 2e-2, 1.5),
        "liggghts/default": (5e-4, 6e-3, 0.7),
    },
    "T2": {
        "dem/default": (1e-4, 1e-3, 1e-2),
        "yade/default": (2e-3, 4e-3, 8e-3),
        "liggghts/default": (5e-3, 1e-2, 2e-2),
    },
}
TOLERANCE = {"dem/default": 2e-3, "yade/default": 1.5e-2, "liggghts/default": 3e-3}
METHODS = {"dem": "second-order", "yade": "first-order", "liggghts": "leapfrog"}
START, END = 3.0, 7.0  # of the exact series [m]; errors are relative to the largest value, 7


def series(error: float | None) -> dict[str, np.ndarray]:
    """A rising line, and the same times 1 + error; without an error its last value is nan."""
    t = np.linspace(0.0, 1.0, 5)
    reference = START + (END - START) * t
    value = reference * (1 + (error or 0.0))
    value[-1] = value[-1] if error is not None else np.nan
    return {"t": t, "y.value": value, "y.reference": reference}


def result(store: Store, label: str, variant: str, k: int) -> Record:
    error, bound = ERRORS[variant][label][k], TOLERANCE[label]
    arrays = series(error)
    good = error is not None and error <= bound
    last = None if error is None else float(arrays["y.value"][-1])
    seen = entry(
        "pass" if good else "fail", {"max": error, "pointwise": error, "final": error},
        tolerance=bound, scale=END, end=END, figures={"final": last},
    )  # fmt: skip
    quantities = [seen]
    if variant == "T2":
        small = {"max": 0.01 * (error or 0.0)}
        number = {"name": "E", "kind": "scalar", "unit": "J", "value": 10.0 + k, "norm": None}
        quantities.append(entry("pass", small, reference=20.0, tolerance=bound, **number))
    made = record(
        label, variant, STEPS[k], method=METHODS[label.partition("/")[0]], steps=100 * (k + 1),
        quantities=quantities, cost=cost(timed=True, cpu=CPU[variant][label][k]),
    )  # fmt: skip
    store.keep_summary(made.key, summary_of(made), arrays)
    return made


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Node]:
    root: Path = tmp_path_factory.mktemp("readback")
    store = Store(root / ".vv")
    runs = [result(store, label, v, k) for v in ERRORS for label in ERRORS[v] for k in range(3)]
    codes = {
        "dem": CodeFound("1", True, {}),
        "yade": CodeFound("2", True, {"/yade": "f00"}),
        "liggghts": CodeFound("3", True, {"/lmp": "ba7"}),
    }
    facts = case()
    (quantity,) = facts.variants["T1"].quantities
    (bound,) = (quantity.tolerances or {}).values()
    stated = changed(bound, dt=2e-3)
    own = changed(quantity, tolerances={"second order in dt": stated, **BOUNDS})
    variants = {name: changed(one, quantities=[own]) for name, one in facts.variants.items()}
    whole: Manifest = manifest(
        *runs, codes=codes, cases={"bounce": dataclasses.replace(facts, variants=variants)}
    )
    folder = html.build(whole, store, root / "report").parent
    return {one.name: page(one.read_text(encoding="utf-8")) for one in folder.glob("*.html")}


def of(pages: dict[str, Node], variant: str) -> Node:
    return section(pages["case-bounce.html"], f"bounce--{variant}")


def test_the_schemes_of_a_variant_stand_at_their_finest_setting_best_first(
    pages: dict[str, Node],
) -> None:
    headings = ("Error", "Tolerance", "Observed order", "CPU", "Finest setting")
    found = table(of(pages, "T1"), *headings)
    assert list(found.items()) == [
        ("dem/default", ["5.0e-4", "2.0e-3", "2.00 ± 0.00", "50 ms", "dt = 0.001 s"]),
        ("yade/default", ["6.0e-3", "1.5e-2", "1.00 ± 0.00", "1.5 s", "dt = 0.001 s"]),
        ("liggghts/default", [NONE, "3.0e-3", "1.17 ± 0.00", "700 ms", "dt = 0.001 s"]),
    ]
    found = table(of(pages, "T2"), *headings)
    assert [(name, row[0], row[3]) for name, row in found.items()] == [
        ("dem/default", "6.4e-5 y", "10 ms"),
        ("liggghts/default", "8.0e-5 y", "20 ms"),
        ("yade/default", "1.6e-3 y", "8 ms"),
    ]


def test_every_setting_has_its_error_bound_order_cost_and_steps(pages: dict[str, Node]) -> None:
    found = table(of(pages, "T1"), "error", "tolerance", "order", "CPU", "steps", "verdict")
    assert found == {
        "dem/default · y [m]/4e-3": ["8.00e-3", "2.0e-3", NONE, "200 µs", "100", "✗ fail"],
        "dem/default · y [m]/2e-3": ["2.00e-3", "2.0e-3", "2.00", "3 ms", "200", "✓ pass"],
        "dem/default · y [m]/1e-3": ["5.00e-4", "2.0e-3", "2.00", "50 ms", "300", "✓ pass"],
        "liggghts/default · y [m]/4e-3": ["9.00e-4", "3.0e-3", NONE, "500 µs", "100", "✓ pass"],
        "liggghts/default · y [m]/2e-3": ["4.00e-4", "3.0e-3", "1.17", "6 ms", "200", "✓ pass"],
        "liggghts/default · y [m]/1e-3": [NONE, "3.0e-3", NONE, "700 ms", "300", "✗ fail"],
        "yade/default · y [m]/4e-3": ["2.40e-2", "1.5e-2", NONE, "1 ms", "100", "✗ fail"],
        "yade/default · y [m]/2e-3": ["1.20e-2", "1.5e-2", "1.00", "20 ms", "200", "✓ pass"],
        "yade/default · y [m]/1e-3": ["6.00e-3", "1.5e-2", "1.00", "1.5 s", "300", "✓ pass"],
    }


def test_a_number_stands_beside_the_exact_one(pages: dict[str, Node]) -> None:
    found = table(of(pages, "T2"), "value", "exact", "error")
    own = {name: row for name, row in found.items() if name.startswith("dem/default · E [J]")}
    assert own == {
        "dem/default · E [J]/4e-3": ["10", "20", "1.02e-5"],
        "dem/default · E [J]/2e-3": ["11", "20", "2.56e-6"],
        "dem/default · E [J]/1e-3": ["12", "20", "6.40e-7"],
    }


def test_an_error_costs_what_lies_between_its_neighbours(pages: dict[str, Node]) -> None:
    # on logarithmic scales: 3 ms (50/3)^(1/2) = 12.2 ms; 20 ms 75^(ln 1.2/ln 2) = 62.3 ms
    assert table(of(pages, "T1"), "0.01", "1e-3", "1e-4", "smallest error") == {
        "dem/default": ["≤ 200 µs", "12.2 ms", NONE, "5.0e-4"],
        "liggghts/default": ["≤ 500 µs", "≤ 500 µs", NONE, "4.0e-4"],
        "yade/default": ["62.3 ms", NONE, NONE, "6.0e-3"],
    }


def test_the_recommended_setting_is_the_cheapest_that_is_as_accurate(
    pages: dict[str, Node],
) -> None:
    said = "the cheapest setting of each code that is as accurate, cheapest code first"
    found = table(of(pages, "T1"), said)
    assert found == {
        "0.01": [
            "dem/default dt = 4e-3 s: 200 µs; liggghts/default dt = 4e-3 s: 500 µs; "
            "yade/default dt = 1e-3 s: 1.5 s"
        ],
        "1e-3": ["liggghts/default dt = 4e-3 s: 500 µs; dem/default dt = 1e-3 s: 50 ms"],
    }


def test_a_tolerance_stands_with_all_by_which_it_changes(pages: dict[str, Node]) -> None:
    rows = [r.text.replace("\N{MINUS SIGN}", "-") for r in pages["case-bounce.html"].every("tr")]
    assert [row for row in rows if row.startswith(tuple(BOUNDS))] == [
        "all at once 0.02 at dt = 5e-3 s at kn = 7e8 N/m dt 1 kn -0.5 , plus 6 /s times dt, "
        "at least 3e-4 all",
        "late alone 0.03 fixed, plus 8 /s times dt late",
        "stiffness alone 0.04 at kn = 9e7 N/m kn -1.5 soft",
        "the same at all 0.05 fixed fixed",
    ]


def test_the_source_is_compared_at_its_own_step(pages: dict[str, Node]) -> None:
    found = table(pages["case-bounce.html"], "Variant", "dem/default", "yade/default")
    assert found["T1"] == ["T1", "2.00e-3", "1.20e-2"]  # at 2 ms, which the tolerance states
    assert "at dt = 2e-3 s (schemes without a step" in pages["case-bounce.html"].text


def test_the_front_page_has_medians_of_the_finest_over_what_all_solve(
    pages: dict[str, Node],
) -> None:
    # all solve T2 only. To 1e-3: dem 12.2 ms and 104 µs, liggghts 0.5 and 5 ms, of which over the
    # cheapest 24.5 and 1, and 1 and 48.1; the median of logarithms is the geometric mean of two
    front = pages["index.html"]
    columns = ("Covers", "Median error", "CPU to 1e-3, over the cheapest", "Open failures")
    assert table(front, *columns) == {
        "dem/default in-house": ["2 of 2", "6.4e-5", "4.9 2 of 2", "1"],
        "liggghts/default": ["2 of 2", "8.0e-5", "6.9 2 of 2", "1"],
        "yade/default": ["2 of 2", "1.6e-3", NONE, "1"],
    }


def test_the_shares_solved_are_of_what_anybody_solves(pages: dict[str, Node]) -> None:
    found = table(pages["index.html"], "0.01", "1e-3", "1e-4")
    assert found == {
        "dem/default": ["100 %", "100 %", "100 %"],
        "liggghts/default": ["100 %", "100 %", "100 %"],
        "yade/default": ["100 %", NONE, NONE],
    }


def test_the_map_has_the_finest_error_of_each_variant_and_their_median(
    pages: dict[str, Node],
) -> None:
    (drawn,) = pages["index.html"].every("table", id="map")
    cells = ([*line.every("th"), *line.every("td")] for line in drawn.every("tr"))
    rows = {first.text: [one.text.split()[0] for one in more if one.text] for first, *more in cells}
    assert rows["T1"] == ["5e-4", "✗", "6e-3"]  # liggghts has no error at its finest step
    assert rows["T2"] == ["6e-5", "8e-5", "2e-3"]
    assert rows["bounce 2"] == ["3e-4", "8e-5", "4e-3"]
    assert [cell.named["data-c"] for cell in drawn.every("td")][:3] == ["30 ms", "360 ms", "754 ms"]


def figure(part: Node, title: str) -> Node:
    return next(f for f in part.every("figure") if any(title in h.text for h in f.every("h3")))


def test_curves_over_steps_and_cost_lead_through_the_errors(pages: dict[str, Node]) -> None:
    drawn = curves(figure(of(pages, "T1"), "Error of y against step"))
    assert set(drawn) == {"dem/default", "yade/default", "liggghts/default"}
    for label, points in drawn.items():
        known = [(dt, e) for dt, e in zip(STEPS, ERRORS["T1"][label], strict=True) if e]
        assert points == [pytest.approx(pair, rel=0.02) for pair in known]
    drawn = curves(figure(of(pages, "T1"), "Error of y against cost"))
    for label in ("dem/default", "yade/default"):
        for k, point in enumerate(drawn[label]):
            assert point[0] == pytest.approx(CPU["T1"][label][k], rel=0.03)
            assert point[1] == pytest.approx(ERRORS["T1"][label][k], rel=0.03)


def test_curves_over_time_are_those_of_the_finest_setting(pages: dict[str, Node]) -> None:
    drawn = curves(figure(of(pages, "T1"), "Relative error"))
    for label in ("dem/default", "yade/default"):
        ends = [y for _, y in drawn[label]]
        assert ends == [pytest.approx(ERRORS["T1"][label][-1], rel=0.03)] * len(ends)
    exact = curves(figure(of(pages, "T1"), "over time"))[""]
    assert exact[0] == pytest.approx((0.0, START), abs=0.05)
    assert exact[-1] == pytest.approx((1.0, END), abs=0.05)


def test_the_profile_rises_with_the_factor_of_cost(pages: dict[str, Node]) -> None:
    (drawn,) = pages["index.html"].every("div", id="profile")
    found = curves(drawn)
    assert set(found) == {"dem/default", "liggghts/default"}
    share = {label: [y for _, y in points] for label, points in found.items()}
    assert all(row == sorted(row) for row in share.values())
    assert all(row[0] == pytest.approx(0.5, abs=0.02) for row in share.values())
    assert all(row[-1] == pytest.approx(1.0, abs=0.02) for row in share.values())
    steps = {label: points[2][0] for label, points in found.items()}
    assert steps["dem/default"] == pytest.approx(24.49, rel=0.03)
    assert steps["liggghts/default"] == pytest.approx(48.07, rel=0.03)
    assert math.isclose(found["dem/default"][0][0], 1.0, rel_tol=0.05)
