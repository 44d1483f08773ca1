"""What a record comes to, as tables of truths written by hand, one row a decision."""

import math
from dataclasses import replace
from typing import Any

import pytest

from tests.support.fabricated import entry, manifest, record
from vv.ask import Ledger, Status
from vv.case import Check
from vv.gate.judgement import (
    against_code,
    against_measurement,
    blew_up,
    breach_in_words,
    breaches,
    counted,
    exit_bits,
    judgement,
    outcome,
    record_findings,
)
from vv.records.finding import Aspect, Bit, Finding, bits
from vv.records.job_record import Record
from vv.records.outcomes import Outcome
from vv.records.quantity import MeasuredQuantity, MeasurementFacts, PrintedFacts

FATES = [  # status, exit bits of an optional code, of a required one, outcome
    ("ran", 0, 0, "pass"),
    ("refused", 0, 0, "refused"),
    ("not-installed", 0, 32, "not installed"),
    ("too-long", 0, 0, "too long"),
    ("not-run", 32, 32, "not run"),
    ("error", 8, 8, "error"),
    ("diverged", 8, 8, "diverged"),
    ("timeout", 16, 16, "timeout"),
]
UNEXPLAINED = "energy that no term explains [J]"
LOSS = "friction dissipation"
SEEN = MeasurementFacts(2.0, 0.3, 0.4, "dry", "Someone (2001)", 0.4)  # of uncertainty 0.5
PRINTED = PrintedFacts(2.0, 0.05, "other", "Someone (2001)", 0.25)
GOOD = entry("pass", {"max": 1e-4})


def of(*quantities: MeasuredQuantity, label: str = "dem/default", **changes: Any) -> Record:
    return record(label, "T1", 1e-3, quantities=quantities or (GOOD,), **changes)


def fate(status: str, **changes: Any) -> Record:
    quantities = (GOOD,) if status == "ran" else ()
    return record("dem/default", "T1", 1e-3, status=status, quantities=quantities, **changes)


@pytest.mark.parametrize(("status", "optional", "required", "what"), FATES)
def test_a_status_sets_these_bits_and_comes_to_this(
    status: str, optional: int, required: int, what: str
) -> None:
    other = of(label="exact/default")  # something ran
    assert exit_bits([other, fate(status)]) == optional
    ran = 0 if status == "ran" else Bit.INCOMPLETE  # of what is required nothing did
    assert exit_bits([other, fate(status)], ["dem/default"]) == required | ran
    assert outcome(fate(status)) is Outcome(what)


def test_every_status_is_in_the_table() -> None:
    assert {status for status, *_ in FATES} == {s.name.lower().replace("_", "-") for s in Status}


@pytest.mark.parametrize(
    ("status", "study", "shown_only"),
    [
        ("diverged", "grid", True),
        ("diverged", "ladder", False),
        ("diverged", "search", False),
        ("ran", "grid", False),
        ("error", "grid", False),
    ],
)
def test_only_a_map_is_there_to_show_where_codes_diverge(
    status: str, study: str, shown_only: bool
) -> None:
    one = fate(status, study=study)
    assert blew_up(one) is shown_only
    assert (outcome(one) is Outcome.BLOW_UP) is shown_only
    red = status in ("diverged", "error") and not shown_only
    assert exit_bits([of(label="exact/default"), one]) == (Bit.CRASH if red else 0)


@pytest.mark.parametrize(
    ("verdicts", "conserves", "what"),
    [
        (["pass", "pass"], True, "pass"),
        (["no-reference", "pass"], True, "pass"),
        (["no-reference"], True, "shown only"),
        (["pass", "xfail"], True, "xfail"),
        (["xfail", "xpass", "pass"], True, "xpass"),
        (["xpass", "fail", "pass"], True, "fail"),
        ([], True, "not reported"),
        (["pass"], False, "not conserved"),
        (["xfail"], False, "not conserved"),
        (["no-reference"], False, "not conserved"),
        (["fail"], False, "fail"),
        (["xpass"], False, "xpass"),
        ([], False, "not reported"),
    ],
)
def test_a_record_comes_to_its_worst_verdict_and_a_broken_law_spoils_what_is_fine(
    verdicts: list[str], conserves: bool, what: str
) -> None:
    ledger = Ledger({}, 0.0 if conserves else 1.0, 1.0, bound=1e-9)
    quantities = [entry(verdict, {"max": 1e-4}) for verdict in verdicts]
    one = record("dem/default", "T1", 1e-3, quantities=quantities, ledger=ledger)
    assert outcome(one) is Outcome(what)
    assert counted([one, one]) == {Outcome(what): 2}


@pytest.mark.parametrize(
    ("ledger", "laws"),
    [
        (None, []),
        (Ledger({}, 0.9e-9, 1.0, 1e-9), []),
        (Ledger({}, 1e-9, 1.0, 1e-9), []),  # at the bound itself
        (Ledger({}, 1.1e-9, 1.0, 1e-9), [UNEXPLAINED]),
        (Ledger({}, math.nan, 1.0, 1e-9), [UNEXPLAINED]),
        (Ledger({}, 1e9, 1.0, None), []),  # promises nothing
        (Ledger({LOSS: -2e-9}, 0.0, 1.0, 1e-9), [f"negative {LOSS} [J]"]),
        (Ledger({LOSS: 2e-9}, 0.0, 1.0, 1e-9), []),
        (Ledger({LOSS: -2e-9}, 0.0, 1.0, None), []),
        (Ledger({"kinetic energy": -2e-9}, 0.0, 1.0, 1e-9), []),  # not dissipated
        (Ledger({}, 0.0, 1.0, None, {"Coulomb": (2.0, 1.0)}), ["Coulomb"]),
        (Ledger({}, 0.0, 1.0, 1e-9, {"Coulomb": (1.0, 1.0)}), []),
        (Ledger({}, 0.0, 1.0, 1e-9, {"Coulomb": (math.nan, 1.0)}), ["Coulomb"]),
        (Ledger({}, 0.0, 1.0, 1e-9, {"Coulomb": (0.5, math.nan)}), ["Coulomb"]),
        (Ledger({}, 0.0, 1.0, 1e-9, {"a": (0.0, 1.0), "b": (1.1, 1.0)}), ["b"]),
        (Ledger({}, 1.0, 1.0, 1e-9, {"a": (2.0, 1.0)}), [UNEXPLAINED, "a"]),
    ],
)  # fmt: skip
def test_a_ledger_breaks_these_laws(ledger: Ledger | None, laws: list[str]) -> None:
    assert [law for law, _, _ in breaches(ledger)] == laws


def test_a_broken_law_is_told_with_what_was_seen_and_what_is_allowed() -> None:
    (breach,) = breaches(Ledger({}, 1390.0, 1.0, 2e-10))
    assert breach == (UNEXPLAINED, 1390.0, 2e-10)
    assert breach_in_words(breach) == "energy not conserved: unexplained 1390 J, allowed 2e-10 J"
    (found,) = record_findings([of(ledger=Ledger({}, 1390.0, 1.0, 2e-10))])
    assert found.size == pytest.approx(1390.0 / 2e-10)
    (found,) = record_findings([of(ledger=Ledger({}, 1.0, 1.0, 0.0))])
    assert found.size == 0.0


@pytest.mark.parametrize(
    ("required", "missing"),
    [
        (["dem"], []),
        (["dem/default"], []),
        (["dem/other"], ["dem/other"]),
        (["d*"], []),
        (["liggghts"], ["liggghts"]),
        (["dem", "yade"], ["yade"]),
        (["yade", "dem"], ["yade"]),
    ],
)
def test_what_is_required_must_have_run(required: list[str], missing: list[str]) -> None:
    absent = record("yade/default", "T1", 1e-3, status="refused")
    found = record_findings([of(), absent], required)
    assert [one.label for one in found if one.kind == "missing"] == missing
    assert all(one.red and one.bit is Bit.INCOMPLETE for one in found)


def test_any_of_several_patterns_makes_a_code_required() -> None:
    absent = record("yade/default", "T1", 1e-3, status="not-installed")
    kinds = [one.kind for one in record_findings([of(), absent], ["dem", "yade"])]
    assert kinds == ["missing", Status.NOT_INSTALLED.value]


def test_what_ran_and_reports_nothing_is_incomplete_and_what_did_not_run_says_why_once() -> None:
    (found,) = record_findings([record("dem/default", "T1", 1e-3, quantities=())])
    assert (found.kind, found.bit) == ("not reported", Bit.INCOMPLETE)
    kinds = [one.kind for one in record_findings([of(), fate("error")])]
    assert kinds == ["error"]


@pytest.mark.parametrize(
    ("judge", "checks", "bit", "red"),
    [
        ("exact", {Check.ACCURACY}, Bit.ACCURACY, True),
        ("exact", {Check.CONSERVATION}, Bit.ACCURACY, False),
        ("interval", {Check.ACCURACY}, Bit.ACCURACY, True),
        ("invariant", {Check.CONSERVATION}, Bit.CONSERVATION, True),
        ("invariant", {Check.ACCURACY}, Bit.CONSERVATION, False),
    ],
)
def test_a_failure_sets_the_bit_of_its_judge_where_the_case_enforces_it(
    judge: str, checks: set[Check], bit: Bit, red: bool
) -> None:
    for verdict in ("fail", "xpass"):
        one = of(entry(verdict, {"max": 2e-3}, judge=judge))
        (found,) = record_findings([one], enforced={"bounce": checks})
        assert (found.bit, found.red, found.kind) == (bit, red, verdict)
        assert found.check is (Aspect.CONSERVATION if judge == "invariant" else Aspect.ACCURACY)


@pytest.mark.parametrize(
    ("changes", "text", "size"),
    [
        ({"errors": {"max": 4e-3}}, "error 0.004, tolerance 0.001", 4.0),
        ({"errors": {"max": 4e-3}, "note": "late"}, "error 0.004, tolerance 0.001; late", 4.0),
        ({"value": 2.5, "why": "in [0, 1]"}, "value 2.5: in [0, 1]", 0.0),
        ({"tolerance": None, "value": 2.5, "why": "why"}, "value 2.5: why", 0.0),
        ({"errors": {"max": None}}, "not finite", 0.0),
        ({"value": 2.5, "why": "far", "measurement": SEEN},
         "computed 2.5, measured 2 +- 0.5, band 0.4: far", 0.0),
        ({"value": 2.5, "why": "far", "printed": PRINTED},
         "computed 2.5, other has 2, band 0.25: far", 0.0),
        ({"measurement": SEEN}, "not finite", 0.0),
        ({"printed": PRINTED}, "not finite", 0.0),
    ],
)  # fmt: skip
def test_a_failure_is_told_with_its_numbers(
    changes: dict[str, Any], text: str, size: float
) -> None:
    given = {"errors": {}, **changes}
    (found,) = record_findings([of(entry("fail", **given))])
    assert found.text == text
    assert found.size == pytest.approx(size)


def test_a_value_without_a_band_is_shown_beside_another() -> None:
    seen, printed = replace(SEEN, band=None), replace(PRINTED, band=None)
    assert against_measurement(2.5, seen) == "computed 2.5, measured 2 +- 0.5, shown"
    assert against_code(2.5, printed) == "computed 2.5, other has 2, shown"


def test_what_passes_or_is_known_is_no_finding() -> None:
    for verdict in ("pass", "xfail", "no-reference"):
        assert record_findings([of(entry(verdict, {"max": 1.0}))]) == []


def test_what_an_invocation_found_besides_its_records_is_judged_too() -> None:
    lost = Finding(Aspect.REGRESSION, "gone", "has a baseline, but is no longer there", bit=Bit(1))
    whole = manifest(of(), findings=[lost])
    assert judgement(whole) == [lost]
    assert bits(judgement(whole)) == Bit.ACCURACY
    assert judgement(manifest(of())) == []


def test_each_broken_law_has_its_own_numbers() -> None:
    terms = {LOSS: -3.0, "viscous dissipation": -0.5, "kinetic energy": -4.0}
    audits = {"a [N]": (7.0, 6.0), "b [m]": (1.0, 2.0), "c": (9.0, 8.0)}
    assert [*breaches(Ledger(terms, 5.0, 11.0, 1.0, audits))] == [
        (UNEXPLAINED, 5.0, 1.0), (f"negative {LOSS} [J]", 3.0, 1.0), ("a [N]", 7.0, 6.0),
        ("c", 9.0, 8.0),
    ]  # fmt: skip
