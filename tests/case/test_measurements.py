"""Claims about measurements as references: no error of a code, a band with a reason, a verdict."""

import dataclasses

import numpy as np
import pytest

from vv.ask import Knobs, Method, Run, Status
from vv.case import Exact, Measured, Measurement, Scalar, Series, Tolerance
from vv.gate.judgement import against_measurement
from vv.records.outcomes import JudgeKind, Verdict
from vv.records.record import measured

SEEN = Measurement(2.0, 0.03, 0.04, "dry", "somebody (2001)")
RUN = Run(Status.RAN)


def _judged(value: float, band: float | None) -> Scalar:
    judge = Measured(SEEN, band, "the law holds")
    return Scalar("kept", "e", "", "what is kept", lambda run: value, None, 1.0, judge)


@pytest.mark.parametrize(
    ("value", "band", "verdict"),
    [
        (2.09, 0.1, Verdict.PASS),
        (1.85, 0.1, Verdict.FAIL),
        (5.0, None, Verdict.NO_REFERENCE),
        (float("nan"), 0.1, Verdict.FAIL),
    ],
)
def test_a_value_is_judged_by_the_band_about_the_measurement(
    value: float, band: float | None, verdict: Verdict
) -> None:
    found, _ = measured(RUN, _judged(value, band), Method.FIRST_ORDER, Knobs(1e-3))
    assert found.verdict is verdict
    assert found.judge is JudgeKind.MEASURED


@pytest.mark.shows("with `--set` nothing is compared with it, except measured laws")
def test_at_other_parameters_only_a_measured_law_has_something_to_say() -> None:
    at_home = _judged(5.0, 0.1)
    judged = [
        measured(RUN, dataclasses.replace(at_home, judge=judge), Method.EXACT, Knobs(), True)[0]
        for judge in (at_home.judge, Measured(SEEN, 0.1, "the law holds", law=True))
    ]
    assert [one.judge for one in judged] == [JudgeKind.SHOWN, JudgeKind.MEASURED]
    assert [one.verdict for one in judged] == [Verdict.NO_REFERENCE, Verdict.FAIL]
    assert judged[0].measurement is None


def test_the_distance_from_a_measurement_is_no_error_of_a_code() -> None:
    found, _ = measured(RUN, _judged(2.01, 0.1), Method.EXACT, Knobs())
    assert (found.error, found.tolerance, found.reference) == (None, None, None)
    assert not found.errors
    assert found.measurement is not None
    assert found.measurement.uncertainty == pytest.approx(0.05)
    assert "computed 2.01, measured 2 +- 0.05, band 0.1" in against_measurement(
        2.01, found.measurement
    )


def test_a_band_is_never_narrower_than_the_measurement_is_sure() -> None:
    with pytest.raises(ValueError, match=r"band = 0\.01"):
        Measured(SEEN, 0.01, "as good as exact")


def test_a_number_without_uncertainty_is_no_measurement() -> None:
    with pytest.raises(ValueError, match="no uncertainty"):
        Measurement(1.0, 0.0, 0.0, "", "")
    with pytest.raises(ValueError, match="digitisation = -1"):
        Measurement(1.0, -1.0, 1.0, "", "")


def test_an_exact_reference_and_a_measurement_are_never_one_quantity() -> None:
    judge = Measured(SEEN, 0.1, "why")
    with pytest.raises(ValueError, match="beside its measurement"):
        Scalar("kept", "e", "", "", lambda run: 1.0, 2.0, 1.0, judge)
    with pytest.raises(ValueError, match="series"):
        Series("kept", "e", "", "", lambda run: np.ones(1), None, judge)
    exact = Exact({Method.EXACT: Tolerance(0.1, "why")})
    with pytest.raises(ValueError, match="no reference"):
        Scalar("kept", "e", "", "", lambda run: 1.0, None, 1.0, exact)
