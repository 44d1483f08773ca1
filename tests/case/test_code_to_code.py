"""Claims about answers of other codes: no error, no measurement, a band with a reason."""

import pytest

from tests.support.fabricated import entry, manifest, record
from vv.ask import Knobs, Method, Run, Status
from vv.case import CodeToCode, Measured, Measurement, Printed, Scalar, Series
from vv.gate.judgement import against_code
from vv.insight.against_measurements import agreements
from vv.records.outcomes import JudgeKind, Verdict
from vv.records.quantity import MeasuredQuantity, PrintedFacts, judge_kind
from vv.records.record import measured

OTHER = Printed(2.0, 5e-4, "another code, with arms of its own", "its manual, table 3")


def _found(value: float, band: float | None) -> MeasuredQuantity:
    judge = CodeToCode(OTHER, band, "its arms")
    quantity = Scalar("kept", "e", "", "what is kept", lambda run: value, None, 1.0, judge)
    return measured(Run(Status.RAN), quantity, Method.EXACT, Knobs())[0]


@pytest.mark.parametrize(
    ("value", "band", "verdict"),
    [
        (2.09, 0.1, Verdict.PASS),
        (1.85, 0.1, Verdict.FAIL),
        (5.0, None, Verdict.NO_REFERENCE),
        (float("nan"), 0.1, Verdict.FAIL),
    ],
)
def test_a_value_is_judged_by_the_band_about_another_code_s_answer(
    value: float, band: float | None, verdict: Verdict
) -> None:
    found = _found(value, band)
    assert found.verdict is verdict
    assert found.judge is JudgeKind.CODE_TO_CODE


@pytest.mark.shows("as code-to-code answers, which are neither errors nor measurements")
def test_the_distance_from_another_code_is_no_error_and_no_measurement() -> None:
    found = _found(2.01, 0.1)
    assert (found.error, found.tolerance, found.reference) == (None, None, None)
    assert not found.errors
    assert found.measurement is None
    assert found.printed is not None
    said = against_code(2.01, found.printed)
    assert said == "computed 2.01, another code, with arms of its own has 2, band 0.1"


def test_no_statistic_of_measurements_takes_another_code_s_answer_in() -> None:
    other = PrintedFacts(2.0, 5e-4, "another code", "its manual", 0.1)
    one = entry("pass", {}, judge="code-to-code", value=2.05, kind="scalar", printed=other)
    kept = record("dem/default", "T1", 1e-3, quantities=[one])
    assert kept.quantities[0].printed == other
    assert agreements(manifest(kept)) == []


def test_three_kinds_of_reference_are_told_apart_and_never_one_quantity() -> None:
    other, seen = CodeToCode(OTHER, 0.1, "why"), Measured(Measurement(2, 1, 1, "", ""), 2, "why")
    assert judge_kind(other) is not judge_kind(seen)
    with pytest.raises(ValueError, match="beside another code's answer"):
        Scalar("kept", "e", "", "", lambda run: 1.0, 2.0, 1.0, other)
    with pytest.raises(ValueError, match="series"):
        Series("kept", "e", "", "", lambda run: run.times, None, other)


def test_an_answer_is_some_code_s_to_some_digit() -> None:
    with pytest.raises(ValueError, match="code is empty"):
        Printed(1.0, 0.1, "", "")
    with pytest.raises(ValueError, match="rounding = 0"):
        Printed(1.0, 0, "a code", "")
    with pytest.raises(ValueError, match="value = nan"):
        Printed(float("nan"), 0.1, "a code", "")
    with pytest.raises(ValueError, match=r"band = 1e-05"):
        CodeToCode(OTHER, 1e-5, "nearer than it is printed")
