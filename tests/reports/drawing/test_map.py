"""Claims about the map of an error over step and contact stiffness."""

from __future__ import annotations

import dataclasses
from xml.etree import ElementTree

import numpy as np
import pytest

from cases.blocks.responding_block import CASE
from cases.stability.stability_map import CASE as STABILITY
from reports.drawing.collect import Ladder, Point
from reports.drawing.gallery import figures
from reports.drawing.maps import error_map
from reports.drawing.panels import draw_map
from reports.marks import marks
from reports.outcomes import shown_outcome
from tests.support.fabricated import changed, entry, record
from vv.ask import Knobs
from vv.case import Grid, Level, Norm
from vv.gate.judgement import exit_bits
from vv.records.case_facts import QuantityFacts
from vv.records.finding import Bit
from vv.records.outcomes import JudgeKind, Outcome

LOOKS = marks(["one", "two"])
QUANTITY = QuantityFacts("d", "d", "m", "distance", JudgeKind.EXACT)


def ladder(name: str, kn: float, errors: dict[float, float | None]) -> Ladder:
    points = tuple(Point(dt, error, 0.1, False, error is None) for dt, error in errors.items())
    return Ladder(LOOKS[name], kn, points)


FULL = [
    ladder("one", 1e9, {1e-3: 0.03, 1e-4: 0.002}),
    ladder("one", 1e7, {1e-3: 0.04, 1e-4: 0.05}),
    ladder("one", 1e10, {1e-3: None, 1e-4: 0.004}),
]


def test_a_cell_is_where_its_stiffness_and_step_are() -> None:
    heat = error_map(FULL)
    assert heat is not None
    (panel,) = heat.panels
    assert list(panel.kn) == [1e7, 1e9, 1e10]
    assert list(panel.dt) == [1e-4, 1e-3]
    assert np.array_equal(panel.error, [[0.05, 0.04], [0.002, 0.03], [0.004, np.nan]], True)
    assert panel.best() == 1e9


def test_the_best_stiffness_is_that_at_the_finest_step_that_has_an_error() -> None:
    soft = ladder("one", 1e7, {1e-3: 0.01, 1e-4: 0.05, 1e-5: None})
    stiff = ladder("one", 1e9, {1e-3: 0.03, 1e-4: 0.002, 1e-5: None})
    heat = error_map([soft, stiff])
    assert heat is not None
    assert [panel.best() for panel in heat.panels] == [1e9]


def test_there_is_no_map_where_steps_follow_the_stiffness() -> None:
    assert error_map([*FULL[:2], ladder("one", 1e10, {1e-4: 0.1, 1e-5: 0.1})]) is None
    assert error_map(FULL[:1]) is None
    assert error_map([]) is None


@pytest.mark.parametrize(
    ("counts", "mapped"), [((2, 2), False), ((2, 3), True), ((3, 2), True), ((1, 3), False)]
)
def test_a_map_has_two_of_one_and_three_of_the_other_at_least(
    counts: tuple[int, int], mapped: bool
) -> None:
    errors: dict[float, float | None] = {10.0**-n: 0.1 for n in range(counts[1])}
    rows = [ladder("one", 10.0**n, errors) for n in range(counts[0])]
    assert (error_map(rows) is not None) is mapped


def test_errors_that_are_all_nil_and_stiffnesses_without_a_critical_step_have_no_map() -> None:
    nil: dict[float, float | None] = {1e-3: 0.0, 1e-4: None}
    assert error_map([ladder("one", kn, nil) for kn in (1e7, 1e8, 1e9)]) is None
    rows = [related(kn, {2.0: 0.2, 0.1: 0.1}) for kn in (*CRITICAL, 1e5) if kn]
    heat = error_map(rows, CRITICAL)
    assert heat is not None
    assert [panel.kn.tolist() for panel in heat.panels] == [[1e4, 1e7, 1e12]]


def test_an_error_of_100_per_cent_is_lost_and_a_little_less_is_not() -> None:
    errors: dict[float, float | None] = {1e-3: 1.0, 1e-4: 0.999}
    heat = error_map([ladder("one", kn, errors) for kn in (1e7, 1e8, 1e9)])
    assert heat is not None
    assert heat.panels[0].lost().tolist() == [[False, True]] * 3


def test_a_code_without_steps_has_no_map_over_the_critical_step() -> None:
    exact = [Ladder(LOOKS["two"], kn, (Point(None, 0.1, 0.1, False, False),)) for kn in CRITICAL]
    stepping = [related(kn or 0.0, {2.0: 0.2, 0.1: 0.1}) for kn in CRITICAL]
    heat = error_map([*exact, *stepping], CRITICAL)
    assert heat is not None
    assert [panel.mark.label for panel in heat.panels] == ["one"]


def test_a_map_stands_instead_of_curves_and_names_the_best_stiffness_of_each_code() -> None:
    two = [dataclasses.replace(one, mark=LOOKS["two"]) for one in FULL]
    (figure,) = figures([], [*FULL, *two], QUANTITY, Norm.MAX)
    assert figure.svg.count("<rect") == 2 * 6 + 11  # two panels, and the scale
    assert "one 1e9 N/m and two 1e9 N/m" in figure.caption
    assert "Cross: no result" in figure.caption
    assert "not supported" not in figure.caption
    assert "too many" not in figure.caption
    assert "one 2.00e-3 to 5.00e-2" in figure.alt


def test_a_map_is_drawn_with_its_numbers_on_the_axes_and_the_same_each_time() -> None:
    heat = error_map(FULL)
    assert heat is not None
    svg = draw_map(heat)
    assert svg == draw_map(heat)
    ElementTree.fromstring(svg)
    for text in ("one", "1e-4", "1e-3", "1e7", "1e9", "1e10", "kn [N/m]", "dt [s]"):
        assert f">{text}<" in svg


def test_the_responding_block_is_mapped_over_nine_stiffnesses_and_six_steps() -> None:
    trial = CASE.declare("map", CASE.defaults("map"))
    counts = []
    for level in (Level.DEFAULT, Level.PAPER):
        rungs = trial.study.rungs[level]
        dt, kn = {k.dt for k in rungs}, {k.kn for k in rungs}
        assert len(rungs) == len(set(rungs)) == len(dt) * len(kn)
        counts.append((len(kn), len(dt)))
    assert counts == [(2, 2), (9, 6)]
    assert (min(k.kn or 0 for k in rungs), max(k.kn or 0 for k in rungs)) == (1e7, 1e10)


def related(kn: float, errors: dict[float, float | None], refused: bool = False) -> Ladder:
    """A ladder of errors at multiples of a critical step that decreases as kn^-1/2."""
    points = tuple(
        Point(ratio * kn**-0.5, error, 0.1, False, False, refused and error is None)
        for ratio, error in errors.items()
    )
    return Ladder(LOOKS["one"], kn, points)


CRITICAL: dict[float | None, float] = {kn: kn**-0.5 for kn in (1e4, 1e7, 1e12)}


def test_steps_that_follow_the_stiffness_make_a_map_over_the_critical_step() -> None:
    rows = [
        related(1e4, {2.0: None, 0.1: 0.2}, refused=True),
        related(1e7, {2.0: None, 0.1: 0.02}),
        related(1e12, {2.0: 30.0, 0.1: 0.001}),
    ]
    assert error_map(rows) is None
    heat = error_map(rows, CRITICAL)
    assert heat is not None
    (panel,) = heat.panels
    assert list(panel.dt) == [0.1, 2.0]
    assert panel.refused.tolist() == [[False, True], [False, False], [False, False]]
    assert panel.lost().tolist() == [[False, False], [False, True], [False, True]]
    svg = draw_map(heat)
    assert ">dt / critical step<" in svg
    (figure,) = figures([], rows, QUANTITY, Norm.MAX, CRITICAL)
    assert "or an error of 100 % or more. Dash: not supported." in figure.caption
    assert "one 1e12 N/m" in figure.caption


def test_a_point_too_long_to_run_is_a_dot_and_neither_lost_nor_refused() -> None:
    rows = [related(kn, {0.1: 0.1, 1.0: 0.2}) for kn in (1e4, 1e7, 1e12)]
    left_out = dataclasses.replace(rows[2].points[0], error=None, refused=True, too_long=True)
    rows[2] = dataclasses.replace(rows[2], points=(left_out, rows[2].points[1]))
    heat = error_map(rows, CRITICAL)
    assert heat is not None
    (panel,) = heat.panels
    assert panel.too_long.tolist() == [[False] * 2, [False] * 2, [True, False]]
    assert not panel.lost().any()
    (figure,) = figures([], rows, QUANTITY, Norm.MAX, CRITICAL)
    assert figure.caption.endswith(" Dot: not run, since it would need too many steps.")
    assert "Dash" not in figure.caption
    dots = draw_map(heat)
    bare = dataclasses.replace(panel, too_long=np.zeros((3, 2), bool))
    assert dots != draw_map(dataclasses.replace(heat, panels=(bare,)))


def test_the_stability_maps_span_what_the_issue_asks_for() -> None:
    for variant in ("incline", "responding-block", "unit"):
        study = STABILITY.declare(variant, {}).study
        assert isinstance(study, Grid)
        ratios = {round((k.dt or 0) / study.critical(k.kn), 9) for k in study.rungs[Level.PAPER]}
        assert (min(ratios), max(ratios)) == (1e-3, 10.0)
        assert len(ratios) >= 6
        stiffnesses = {k.kn or 0.0 for k in study.rungs[Level.PAPER]}
        assert len(stiffnesses) == 9
        assert (min(stiffnesses), max(stiffnesses)) == (1e4, 1e12)


def test_the_unit_has_each_stiffness_itself_and_swings_at_one_rate() -> None:
    study = STABILITY.declare("unit", {}).study
    assert isinstance(study, Grid)
    rates = set()
    for kn in (1e4, 1e12):
        scene = study.ask(Knobs(1e-8, kn)).scene
        assert scene.bonds is not None
        assert set(scene.bonds.kn) == {kn}
        rates.add(round(2 * (kn / scene.spheres.mass[0]) ** 0.5 * study.critical(kn), 9))
    assert rates == {2.0}


def test_what_diverges_in_a_map_is_shown_and_turns_nothing_red() -> None:
    good = record("one/s", "v", 1.0, quantities=[entry("pass", {})])
    lost = record("one/s", "v", 1.0, status="diverged", reason="it blew up")
    for study, bit, key in (
        ("grid", Bit(0), Outcome.BLOW_UP),
        ("ladder", Bit.CRASH, Outcome.DIVERGED),
    ):
        blown = changed(lost, study=study)
        assert exit_bits([blown, changed(good, study=study)]) == bit
        assert shown_outcome(blown).key is key
