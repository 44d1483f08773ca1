"""What is compared with what was accepted, recorded or known, one row a decision, by hand."""

import datetime
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.fabricated import changed, entry, record, requantified
from vv.base.errors import UsageError
from vv.gate import acceptance, answers, baseline, recorded, regression
from vv.gate.disagreement import Disagreement, dated, judge
from vv.gate.regression import EXTERNAL, IN_HOUSE, LARGE, Strictness
from vv.records import codec
from vv.records.accepted import Acceptance, Baseline, Place
from vv.records.finding import Bit, Finding
from vv.records.job_record import Record
from vv.records.outcomes import Verdict
from vv.records.recorded import RecordedFile

ACCEPTANCE = Acceptance("c", False, Place("P", "S"), "r", "u", {})
TODAY = datetime.date(2027, 1, 1)
KNOWN: dict[str, Any] = {
    "code": "dem", "schemes": "*", "versions": "*", "case": "bounce", "variants": ("T1",),
    "quantity": "y", "dt": 1e-3, "error": (5e-3, 2e-2), "reason": "late", "expires": "2027-06-01",
}  # fmt: skip


def ran(error: float | None = 1e-4, **changes: Any) -> Record:
    figures = {"final": 3.0, "mean": 1.0}
    quantity = entry("pass", {"max": error}, scale=2.0, figures=figures)
    return changed(record("dem/default", "T1", 1e-3, quantities=[quantity]), **changes)


def accepted(*records: Record, old: Baseline | None = None) -> Baseline:
    return acceptance.accepted("bounce", old, records, ACCEPTANCE, ())


def compared(now: list[Record], then: Baseline | None, demanded: bool = False) -> list[Finding]:
    return regression.compare("bounce", now, then, Strictness((), True, demanded))


@pytest.mark.parametrize(
    ("then", "now", "told"),
    [
        (1e-4, 1e-4 + 3e-9, "error 0.0001, now 0.000100003"),
        (8.2e34, 8.2e34 * (1 + 1e-6), "error 8.2e+34, now 8.20001e+34"),
        (8.2e34, 8.2e34 * (1 - 1e-6), None),  # as wrong as before
        (8.2e34, 4.1e34, "error 8.2e+34, now 4.1e+34"),
    ],
)
def test_a_change_of_an_error_is_told_in_digits_that_show_it(
    then: float, now: float, told: str | None
) -> None:
    found = compared([requantified(ran(), errors={"max": now})], accepted(ran(then)))
    assert [one.text.partition(";")[0] for one in found] == ([told] if told else [])


@pytest.mark.parametrize(
    ("error", "value", "kind", "size"),
    [
        (1e-4 + 3e-9, 3.0, "worse", 3.0),
        (1e-4 - 3e-9, 3.0, "better", 3.0),
        (1e-4, 3.0 + 8e-9, "moved", 4.0),  # over the scale, 2
        (1e-4, 3.0 - 8e-9, "moved", 4.0),
        (1e-4 + 3e-9, 3.0 + 8e-9, "worse", 4.0),  # the larger of both
        (1e-4, 3.0 + 1.9e-9, None, 0.0),
    ],
)
def test_the_size_of_a_change_is_in_bands(
    error: float, value: float, kind: str | None, size: float
) -> None:
    figures = {"final": value, "mean": 1.0}
    found = compared([requantified(ran(), errors={"max": error}, figures=figures)], accepted(ran()))
    assert [one.kind for one in found] == ([kind] if kind else [])
    assert all(one.size == pytest.approx(size, rel=1e-3) for one in found)


def test_a_value_that_was_not_finite_and_is_or_the_reverse_has_moved_without_end() -> None:
    then = accepted(requantified(ran(), figures={"final": None, "mean": 1.0}))
    (found,) = compared([ran()], then)
    assert (found.kind, found.size) == ("moved", LARGE)
    same = requantified(ran(), figures={"final": None, "mean": 1.0})
    assert compared([same], then) == []


def test_the_scale_is_that_which_was_accepted_and_one_where_there_was_none() -> None:
    moved = {"final": 3.0 + 3e-9, "mean": 1.0}
    wide, none = (
        accepted(requantified(ran(), scale=10.0)),
        accepted(requantified(ran(), scale=None)),
    )
    assert compared([requantified(ran(), figures=moved, scale=1.0)], wide) == []
    (found,) = compared([requantified(ran(), figures=moved, scale=10.0)], none)
    assert found.kind == "moved"
    assert found.size == pytest.approx(3.0, rel=1e-3)


@pytest.mark.parametrize(("off", "kinds"), [(2e-6, []), (4e-6, ["moved"])])
def test_a_figure_far_above_its_scale_moves_by_its_own_last_bits(
    off: float, kinds: list[str]
) -> None:
    """3000 is kept to twelve digits, 5e-9, and may move by 3e-6."""
    figures = {"final": 3000.0, "mean": 1.0}
    far = requantified(ran(None), figures=figures, scale=1.0)
    moved = requantified(far, figures={**figures, "final": 3000.0 + off})
    assert [found.kind for found in compared([moved], accepted(far))] == kinds


def test_the_bands_are_these() -> None:
    assert (IN_HOUSE.width, EXTERNAL.width) == (1e-9, 1e-6)


@pytest.mark.parametrize("status", ["refused", "not-run", "too-long"])
def test_a_result_that_no_longer_comes_is_red(status: str) -> None:
    gone = changed(ran(), status=status, quantities=[])
    (found,) = compared([gone], accepted(ran()))
    assert (found.kind, found.red) == ("gone", True)


@pytest.mark.parametrize("status", ["not-installed", "error", "timeout", "diverged"])
def test_what_another_check_tells_is_not_told_twice(status: str) -> None:
    assert compared([changed(ran(), status=status, quantities=[])], accepted(ran())) == []


def test_a_result_or_a_case_without_a_baseline_is_red_only_where_one_is_demanded() -> None:
    fresh, refused = ran(variant="T2"), changed(ran(), status="refused", quantities=[])
    for then, kind in ((None, "no baseline"), (accepted(ran()), "new")):
        for demanded in (False, True):
            (found,) = compared([fresh, refused] if then is None else [fresh], then, demanded)
            assert (found.kind, found.red) == (kind, demanded)
    assert compared([refused], None, demanded=True) == []  # nothing ran
    assert compared([changed(ran(variant="T2"), status="refused")], accepted(ran()), True) == []


def test_other_parameters_name_only_those_that_differ() -> None:
    then = accepted(ran(parameters={"m": 1.0, "g": 9.81}), ran(variant="T2"))
    now = [ran(parameters={"m": 2.0, "g": 9.81}), ran(variant="T2")]
    (found,) = compared(now, then)
    assert found.text == "the baseline was taken with m = 1.0, now 2.0"
    assert (found.variant, found.bit) == ("T1", Bit.INCOMPLETE)


@pytest.mark.parametrize(
    ("variants", "labels", "codes", "count"),
    [
        (["T1"], ["dem/default"], ["dem"], 0),
        ([], ["dem/default"], ["dem"], 1),
        (["T1"], [], ["dem"], 1),
        ([], [], ["dem"], 1),
        ([], [], ["yade"], 0),  # not looked at
        ([], ["dem/default"], [], 0),
    ],
)
def test_a_result_whose_variant_or_scheme_is_no_more_is_gone(
    variants: list[str], labels: list[str], codes: list[str], count: int
) -> None:
    then = accepted(ran(), changed(ran(), rung={"dt": 5e-4}))  # told once
    found = regression.removed_results("bounce", then, variants, labels, codes)
    assert [one.kind for one in found] == ["gone"] * count
    assert regression.removed_results("bounce", None, variants, labels, codes) == []


@pytest.mark.parametrize(
    ("verdicts", "good"),
    [
        (["pass", "xfail", "no-reference"], True),
        (["pass", "fail"], False),
        (["fail", "pass"], False),
        (["pass", "xpass"], False),
    ],
)
def test_every_quantity_must_be_right_to_be_accepted(verdicts: list[str], good: bool) -> None:
    quantities = [entry(verdict, {"max": 1e-4}) for verdict in verdicts]
    assert acceptance.acceptable(changed(ran(), quantities=quantities)) is good


def test_an_acceptance_gets_the_number_after_the_largest() -> None:
    kept = accepted(ran(variant="T1"))
    for error, number in ((2e-4, "2"), (3e-4, "3")):
        kept = accepted(ran(), ran(error, variant="T2"), old=kept)
        assert {result.by for result in kept.results.values()} == {"1", number}
    assert set(kept.acceptances) == {"1", "3"}  # of 2 nothing is left


def test_a_baseline_reads_back_and_one_of_another_case_is_refused(tmp_path: Path) -> None:
    assert baseline.read(tmp_path, "bounce") is None
    kept = accepted(ran())
    for name in ("bounce", "fall"):
        (tmp_path / f"{name}.json").write_text(json.dumps(codec.to_data(kept)))
    assert baseline.read(tmp_path, "bounce") == kept
    with pytest.raises(UsageError, match="not a baseline of fall"):
        baseline.read(tmp_path, "fall")


@pytest.mark.parametrize(
    ("changes", "kind", "red"),
    [
        ({}, "no longer refused", True),
        ({"status": "refused", "reason": "no springs"}, None, False),
        ({"status": "refused", "reason": "too hot"}, "refused otherwise", False),
        ({"status": "error", "reason": "too hot"}, None, False),
        (
            {"variant": "T4", "status": "refused", "reason": "dt = 2.5e-4 s is too long"},
            None,
            False,
        ),
        (
            {"variant": "T4", "status": "refused", "reason": "dt = 1e-3 s is too short"},
            "refused otherwise",
            False,
        ),
        ({"case": "fall"}, None, False),
        ({"modified": True}, None, False),
        ({"variant": "T2"}, None, False),  # on record with its unknowns
        ({"variant": "T3"}, None, False),  # not on record
        ({"scheme": "other"}, None, False),
    ],
)
def test_an_answer_is_compared_with_that_on_record(
    changes: dict[str, Any], kind: str | None, red: bool
) -> None:
    known: answers.Answers = {
        "dem/default": {"T1": "no springs", "T2": 7, "T4": "dt = 0.001 s is too long"}
    }
    found = list(answers.compare("bounce", [ran(**changes)], known, True))
    assert [(one.kind, one.red) for one in found] == ([(kind, red)] if kind else [])


def recorded_file() -> RecordedFile:
    utc = "2026-12-22T10:00:00+00:00"
    return RecordedFile("yade", "", "2.0", utc, "c", False, Place("P", "S"))


def series(_: str) -> dict[str, np.ndarray]:
    t = np.linspace(0.0, 1.0, 101)
    return {"t": t, "y.value": t * t}


def theirs(dt: float, **changes: Any) -> Record:
    quantity = entry("pass", {"max": 1e-4}, figures={"final": 1.0 / 3.0})
    made = record("yade/default", "T1", dt, quantities=[quantity])
    return changed(made, **changes)


def test_recorded_are_runs_at_the_case_s_own_parameters_and_the_finest_with_its_series(
    tmp_path: Path,
) -> None:
    runs = [theirs(2e-3), theirs(1e-3), theirs(5e-4, modified=True), theirs(4e-3, status="error")]
    (path,) = recorded.write_recorded(tmp_path, runs, series, {"yade": recorded_file()})
    assert path == tmp_path / "yade" / "bounce.json"
    results = json.loads(path.read_text())["results"]
    assert sorted(results) == ["T1 yade/default dt=0.001", "T1 yade/default dt=0.002"]
    fine, coarse = (results[name]["y"] for name in sorted(results))
    assert fine["final"] == coarse["final"] == 0.333333
    assert "t" not in coarse
    assert (len(fine["t"]), fine["t"][0], fine["t"][-1], fine["y"][-1]) == (41, 0.0, 1.0, 1.0)


@pytest.mark.parametrize(
    ("changes", "count"),
    [
        ({}, 1),
        ({"status": "ran"}, 0),
        ({"status": "refused"}, 0),
        ({"parameters": {"m": 2.0}}, 0),
        ({"case": "other"}, 0),
        ({"variant": "T9"}, 0),
    ],
)
def test_recorded_results_stand_where_the_code_is_absent(
    tmp_path: Path, changes: dict[str, Any], count: int
) -> None:
    recorded.write_recorded(tmp_path, [theirs(1e-3)], series, {"yade": recorded_file()})
    asked = theirs(1e-3, **{"status": "not-installed", **changes})
    found = recorded.shown(tmp_path, [asked], TODAY)
    assert [one.days for one in found] == [10] * count


def failing(error: float | None, variant: str = "T1", **changes: Any) -> Record:
    quantities = [entry("fail", {"max": error})]
    return record("dem/default", variant, 1e-3, quantities=quantities, **changes)


@pytest.mark.parametrize(
    ("error", "modified", "verdict"),
    [
        (1e-2, False, "xfail"),
        (3e-3, False, "fail"),  # below the band
        (3e-2, False, "fail"),
        (3e-3, True, "xfail"),  # bands were measured at other parameters
        (9e-2, True, "xfail"),
        (1.1e-1, True, "fail"),
        (None, True, "fail"),
        (None, False, "fail"),
    ],
)
def test_a_failure_is_known_within_its_band(
    error: float | None, modified: bool, verdict: str
) -> None:
    (found,) = judge([failing(error, modified=modified)], [Disagreement(**KNOWN)], TODAY)
    assert found.quantities[0].verdict is Verdict(verdict)


def test_at_other_parameters_a_pass_is_no_news() -> None:
    passing = record("dem/default", "T1", 1e-3, quantities=[entry("pass", {"max": 1e-4})])
    for modified, verdict in ((False, Verdict.XPASS), (True, Verdict.PASS)):
        (found,) = judge([changed(passing, modified=modified)], [Disagreement(**KNOWN)], TODAY)
        assert found.quantities[0].verdict is verdict


@pytest.mark.parametrize(
    ("order", "modified", "verdict"),
    [(1.0, False, "xfail"), (1.4, False, "fail"), (1.4, True, "xfail"), (1.7, True, "fail")],
)
def test_an_order_may_leave_its_band_by_a_half_at_other_parameters(
    order: float, modified: bool, verdict: str
) -> None:
    known = Disagreement(**{**KNOWN, "dt": 1e-3, "error": (4e-3, 3.9e-2), "order": (0.9, 1.1)})
    runs = [
        record(
            "dem/default", "T1", dt, modified=modified,
            quantities=[entry("fail", {"max": 1e-2 * (dt / 1e-3) ** order})],
        )
        for dt in (1.2e-3, 1e-3, 8e-4)
    ]  # fmt: skip
    found = judge(runs, [known], TODAY)
    assert {one.quantities[0].verdict for one in found} == {Verdict(verdict)}


def test_a_band_above_the_largest_tolerance_holds_for_other_parameters_too() -> None:
    known = Disagreement(**{**KNOWN, "error": (0.3, 0.4)})
    (found,) = judge([failing(0.35, modified=True)], [known], TODAY)
    assert found.quantities[0].verdict is Verdict.XFAIL


@pytest.mark.parametrize(
    ("variants", "variant", "known"),
    [
        (("T1",), "T1", True),
        (("T1", "T2"), "T2", True),
        (("T[13]",), "T3", True),
        (("T1",), "T2", False),
    ],
)
def test_one_of_an_entry_s_patterns_is_enough(
    variants: tuple[str, ...], variant: str, known: bool
) -> None:
    entry_ = Disagreement(**{**KNOWN, "variants": variants})
    (found,) = judge([failing(1e-2, variant)], [entry_], TODAY)
    assert (found.quantities[0].verdict is Verdict.XFAIL) is known


def test_the_other_quantities_of_a_record_keep_their_verdicts() -> None:
    both = failing(1e-2, "T1")
    more = changed(both, quantities=[*both.quantities, entry("fail", {"max": 1e-2}, name="z")])
    (found,) = judge([more], [Disagreement(**KNOWN)], TODAY)
    assert [one.verdict for one in found.quantities] == [Verdict.XFAIL, Verdict.FAIL]


def test_an_entry_warns_if_it_speaks_of_one_record_of_many() -> None:
    known = Disagreement(**{**KNOWN, "expires": "2027-01-02"})
    assert len(dated([failing(1e-2, "T9"), failing(1e-2)], [known], TODAY)) == 1


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"dt": 0.0}, "both must be > 0"),
        ({"error": (0.0, 0.0)}, "both must be > 0"),
        ({"error": (0.06, 0.2), "order": (0.0, 1.0)}, "must end at 0.1"),
        ({"error": (0.06, 0.2), "order": (0.0, 0.0)}, None),  # stays where it is
    ],
)
def test_a_band_that_says_nothing_is_refused(changes: dict[str, Any], said: str | None) -> None:
    if said is None:
        Disagreement(**{**KNOWN, **changes})
        return
    with pytest.raises(ValueError, match=said):
        Disagreement(**{**KNOWN, **changes})


def test_a_stiffness_moves_a_band_only_if_both_name_one() -> None:
    given = {**KNOWN, "kn": 1e8, "softness": 1.0}
    known, unspoken = Disagreement(**given), Disagreement(**{**given, "kn": None})
    soft = record("dem/default", "T1", 1e-3, rung={"dt": 1e-3, "kn": 1e7}).rung
    none = record("dem/default", "T1", 1e-3).rung
    assert known.band(soft) == pytest.approx((5e-2, 2e-1))
    assert known.band(none) == unspoken.band(soft) == KNOWN["error"]
