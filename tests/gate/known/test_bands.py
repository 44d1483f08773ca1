"""Which failures are known: bands of an entry, one row a decision, by hand."""

import datetime
from typing import Any

import pytest

from tests.support.fabricated import changed, entry, record
from vv.gate.disagreement import Disagreement, expiry_findings, judge
from vv.records.job_record import Record
from vv.records.outcomes import Verdict

TODAY = datetime.date(2027, 1, 1)
KNOWN: dict[str, Any] = {
    "code": "dem", "schemes": "*", "versions": "*", "case": "bounce", "variants": ("T1",),
    "quantity": "y", "dt": 1e-3, "error": (5e-3, 2e-2), "reason": "late", "expires": "2027-06-01",
}  # fmt: skip


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
    assert len(expiry_findings([failing(1e-2, "T9"), failing(1e-2)], [known], TODAY)) == 1


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"dt": 0.0}, "both must be > 0"),
        ({"error": (0.0, 0.0)}, "both must be > 0"),
        ({"error": None, "order": None}, "error none; both must be > 0"),
        ({"error": (0.06, 0.2), "order": (0.0, 1.0)}, "must end at 0.1"),
        ({"error": (0.06, 0.2), "order": (0.0, 0.0)}, None),  # stays where it is
        ({"order": (0.0, 0.6)}, None),
        ({"order": (0.0, 0.61)}, "a band wider than 0.6 excludes nothing"),
        ({"order": (1.1, 0.9)}, "must not be empty"),
        ({"order": (0.9, float("nan"))}, "must not be empty"),
        ({"error": (1e-3, float("inf"))}, "must end within a factor of"),
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


def test_an_entry_without_a_band_speaks_of_other_parameters_alone() -> None:
    known = Disagreement(**{**KNOWN, "error": None, "order": None, "elsewhere": 0.5})
    for error, modified, verdict in (
        (1e-2, False, "fail"),
        (1e-2, True, "xfail"),
        (0.4, True, "xfail"),
        (0.6, True, "fail"),
    ):
        (found,) = judge([failing(error, modified=modified)], [known], TODAY)
        assert found.quantities[0].verdict is Verdict(verdict)
    passing = record("dem/default", "T1", 1e-3, quantities=[entry("pass", {"max": 1e-4})])
    (found,) = judge([passing], [known], TODAY)
    assert found.quantities[0].verdict is Verdict.PASS


def test_an_entry_may_say_how_far_off_a_code_is_elsewhere() -> None:
    known = Disagreement(**{**KNOWN, "elsewhere": 0.5})
    for error, modified, verdict in (
        (0.4, True, "xfail"),
        (0.6, True, "fail"),
        (0.4, False, "fail"),
    ):
        (found,) = judge([failing(error, modified=modified)], [known], TODAY)
        assert found.quantities[0].verdict is Verdict(verdict)


@pytest.mark.parametrize(("error", "verdict"), [(0.4, "xfail"), (0.6, "fail")])
def test_at_other_parameters_the_entry_that_speaks_of_them_counts_though_another_comes_first(
    error: float, verdict: str
) -> None:
    own = Disagreement(**KNOWN)
    there = Disagreement(**{**KNOWN, "error": None, "order": None, "elsewhere": 0.5})
    (found,) = judge([failing(error, modified=True)], [own, there], TODAY)
    assert found.quantities[0].verdict is Verdict(verdict)
    (unmoved,) = judge([failing(1e-2)], [there, own], TODAY)
    assert unmoved.quantities[0].verdict is Verdict.XFAIL


@pytest.mark.parametrize("modified", [False, True])
@pytest.mark.parametrize(("other", "verdict"), [(9e-4, "xfail"), (1.1e-3, "fail"), (None, "fail")])
def test_a_code_that_has_another_quantity_s_answer_instead_is_known_at_any_parameters(
    other: float | None, verdict: str, modified: bool
) -> None:
    known = Disagreement(**{**KNOWN, "error": None, "order": None, "instead": "late"})
    late = entry("no-reference", {"max": other}, name="late")
    wrong = changed(failing(0.7).quantities[0], tolerance=1e-3)
    run = changed(failing(0.7), quantities=[wrong, late], modified=modified)
    (found,) = judge([run], [known], TODAY)
    assert found.quantities[0].verdict is Verdict(verdict)
    (alone,) = judge([changed(run, quantities=[wrong])], [known], TODAY)
    assert alone.quantities[0].verdict is Verdict.FAIL
