"""Claims about bias and scatter of computed against measured values."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests.support.fabricated import entry, manifest, record
from vv.insight.against_measurements import Agreement, Compared, agreements, factor, overall
from vv.records.job_record import Record
from vv.records.quantity import MeasuredQuantity, MeasurementFacts
from vv.records.reading import ran


def _points(factors: np.ndarray, sure: float) -> list[Compared]:
    return [
        Compared(f"q{i}", "", 2.0 * one, 2.0, 2.0 * sure, 1.0, True)
        for i, one in enumerate(factors)
    ]


def test_bias_and_scatter_of_a_made_up_model_are_found_again() -> None:
    noise = np.random.default_rng(5).normal(0.0, math.hypot(0.10, 0.05), 4000)
    bias, scatter, sure = factor(_points(1.2 * np.exp(noise - 0.5 * (0.1**2 - 0.05**2)), 0.05))
    assert bias == pytest.approx(1.2, rel=1e-2)
    assert scatter == pytest.approx(0.10, rel=5e-2)
    assert sure == pytest.approx(0.05)


def test_three_points_scatter_by_what_two_degrees_of_freedom_leave() -> None:
    # ln r = -0.2, 0, 0.2: s^2 = 0.08/2; of it 0.1^2 is the measurements'
    bias, scatter, sure = factor(_points(np.exp([-0.2, 0.0, 0.2]), 0.1))
    assert scatter == pytest.approx(math.sqrt(0.03))
    assert sure == pytest.approx(0.1)
    assert bias == pytest.approx(math.exp(0.01))


def test_a_scatter_that_the_measurements_explain_is_not_laid_on_the_model() -> None:
    assert factor(_points(np.array([0.99, 1.0, 1.01]), 0.05))[1] == 0.0


def test_of_too_few_points_no_figure_is_stated() -> None:
    assert factor(_points(np.array([0.9, 1.1]), 0.05)) == (None, None, None)


def test_a_measured_quantity_of_a_record_is_read_as_it_was_written() -> None:
    facts = MeasurementFacts(2.0, 0.03, 0.04, "dry", "somebody", 0.1)
    one = entry("pass", {}, judge="measured", value=2.05, kind="scalar", measurement=facts)
    kept = record("dem/default", "T1", 1e-3, quantities=[one])
    assert ran(kept)
    assert kept.quantities[0].measurement == facts


def test_a_scheme_has_one_statistic_of_all_variants_and_one_of_what_is_shown_too() -> None:
    held = _points(np.array([0.98, 1.0, 1.02]), 0.01)
    shown = [Compared("far", "", 3.0, 2.0, 0.02, None, False)]
    found = [
        Agreement("a", "x", "dem/default", tuple(held), *factor(held)),
        Agreement("b", "y", "dem/default", tuple(shown), *factor(shown)),
        Agreement("b", "y", "yade/default", tuple(shown), *factor(shown)),
    ]
    dem, yade = overall(found)
    assert (dem.label, dem.count, dem.within, dem.points) == ("dem/default", 3, 3, 4)
    assert dem.held == factor(held)
    assert dem.every == factor([*held, *shown])
    assert (yade.count, yade.points, yade.every.bias) == (0, 1, None)


def measured(value: float | None, band: float | None = 0.1, **more: Any) -> MeasuredQuantity:
    facts = MeasurementFacts(2.0, 0.03, 0.04, "dry", "somebody", band)
    return entry(
        "pass", {}, judge="measured", value=value, kind="scalar", measurement=facts, **more
    )


def test_the_finest_run_with_a_measurement_is_compared_by_the_values_it_has() -> None:
    plain = entry("pass", {"max": 1e-4})
    rows = (measured(2.05), measured(None, name="b"), measured(3.0, None, name="c"), plain)
    runs = [record("dem/default", "T1", dt, quantities=rows) for dt in (2e-3, 1e-3)]
    lost = record("dem/default", "T2", 1e-3, status="error", quantities=rows)
    bare = record("other/default", "T1", 1e-3, quantities=[plain])
    (found,) = agreements(manifest(*runs, lost, bare))
    assert (found.case, found.variant, found.label) == ("bounce", "T1", "dem/default")
    assert [point.quantity for point in found.points] == ["y", "c"]
    assert [point.quantity for point in found.held] == ["y"]


def test_only_ratios_of_what_is_positive_enter_a_statistic() -> None:
    good = _points(np.array([0.98, 1.0, 1.02]), 0.01)
    off = [replace(good[0], computed=-1.0), replace(good[0], measured=-1.0)]
    assert factor([*good, *off]) == factor(good)


def test_of_a_scheme_each_variant_speaks_at_its_finest_setting_whatever_the_order() -> None:
    def run(label: str, variant: str, dt: float, value: float) -> Record:
        facts = MeasurementFacts(2.0, 0.03, 0.04, "dry", "somebody", 0.1, "angle", 30.0)
        seen = entry("pass", {}, judge="measured", value=value, kind="scalar", unit="N",
                     measurement=facts)  # fmt: skip
        return record(label, variant, dt, quantities=[seen])

    runs = [run("b/b", "T2", 1e-3, 2.1), run("b/b", "T1", 1e-3, 2.2), run("a/z", "T1", 1e-3, 2.3),
            run("a/z", "T1", 2e-3, 2.4), run("a/a", "T1", 2e-3, 2.5),
            run("a/a", "T1", 1e-3, 2.6)]  # fmt: skip
    found = agreements(manifest(*runs))
    assert [(one.variant, one.label, one.points[0].computed) for one in found] == [
        ("T1", "a/a", 2.6), ("T1", "a/z", 2.3), ("T1", "b/b", 2.2), ("T2", "b/b", 2.1)
    ]  # fmt: skip
    assert found[0].points == (
        Compared("y", "N", 2.6, 2.0, math.hypot(0.03, 0.04), 0.1, True, "angle", 30.0),
    )
