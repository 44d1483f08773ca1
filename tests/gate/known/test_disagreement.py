"""The ledger of known disagreements: bands, orders along one stiffness, and the calendar."""

import datetime
from pathlib import Path
from typing import Any

import pytest

from tests import ROOT
from tests.support.fabricated import changed, entry, record, requantified
from vv.ask import Knobs
from vv.base.errors import UsageError
from vv.gate.disagreement import Disagreement, expiry_findings, judge
from vv.gate.ledger_file import read_disagreements
from vv.records.finding import bits
from vv.records.job_record import Record
from vv.records.outcomes import Verdict
from vv.records.rungs import orders

TODAY = datetime.date(2027, 1, 1)
KNOWN: dict[str, Any] = {
    "code": "dem", "schemes": "*", "versions": "1.*", "case": "bounce", "variants": ("T1",),
    "quantity": "y", "dt": 1e-3, "error": (5e-3, 2e-2), "order": (0.9, 1.1),
    "reason": "drag is late", "expires": "2027-06-01",
}  # fmt: skip


def ladder(slope: float = 1.0, verdict: str = "fail", kn: float | None = None) -> list[Record]:
    """Records of two rungs with an error of 1e-2 at the finer step."""
    made = []
    for dt in (2e-3, 1e-3):
        error = 1e-2 * (dt / 1e-3) ** slope
        quantity = entry(verdict, {"max": error})
        rung = {"dt": dt, "kn": kn}
        made.append(record("dem/default", "T1", dt, quantities=[quantity], rung=rung))
    return made


def passing(tolerance: float) -> list[Record]:
    """The same two rungs where that is the tolerance."""
    return [requantified(one, tolerance=tolerance) for one in ladder(verdict="pass")]


def verdicts(records: list[Record], **changes: Any) -> set[Verdict]:
    known = Disagreement(**{**KNOWN, **changes})
    return {record.quantities[0].verdict for record in judge(records, [known], TODAY)}


def test_a_failure_inside_its_bands_is_known() -> None:
    assert verdicts(ladder()) == {Verdict.XFAIL}


def test_a_failure_outside_its_bands_is_told_with_three_digits() -> None:
    def note(error: float, **band: Any) -> str:
        (told,) = judge(
            [record("dem/default", "T1", 1e-3, quantities=[entry("fail", {"max": error})])],
            [Disagreement(**{**KNOWN, **band})],
            TODAY,
        )
        return told.quantities[0].note

    of = "of the known disagreement"
    assert note(37.9962954901982) == f"outside the error band from 0.005 to 0.02 {of}"


def test_a_failure_of_another_order_is_told_with_the_orders_that_are_known() -> None:
    told = judge(ladder(slope=1.5), [Disagreement(**{**KNOWN, "error": (3e-3, 3e-2)})], TODAY)
    lies = "order 1.5 lies outside the band from 0.9 to 1.1"
    assert {r.quantities[0].note for r in told} == {f"{lies} of the known disagreement"}
    assert {r.quantities[0].verdict for r in told} == {Verdict.FAIL}


def test_a_failure_away_from_the_defaults_is_told_with_the_band_that_holds_there() -> None:
    one = changed(record("dem/default", "T1", 1e-3), modified=True, parameters={"m": 2.0})
    one = changed(one, quantities=[entry("fail", {"max": 0.7})])
    (told,) = judge([one], [Disagreement(**{**KNOWN, "elsewhere": 0.6})], TODAY)
    of = "of the known disagreement"
    assert told.quantities[0].note == f"outside the error band from 0 to 0.6 {of}"


def test_a_pass_inside_a_band_that_reaches_below_the_tolerance_is_a_pass() -> None:
    assert verdicts(passing(1.9e-2)) == {Verdict.PASS}


def test_an_entry_without_an_order_claims_none_and_its_errors_stay_as_the_step_changes() -> None:
    known = Disagreement(**{**KNOWN, "order": None})
    assert {known.band(Knobs(dt=dt)) for dt in (1e-2, 1e-3, 1e-4)} == {known.error}
    records = ladder()
    slope = {"order": (5.0, 5.5), "error": KNOWN["error"]}
    assert verdicts(records, **slope) == {Verdict.FAIL}
    assert Verdict.XFAIL in verdicts(records, order=None, error=KNOWN["error"])


def test_a_band_moves_with_the_stiffness() -> None:
    change = {"kn": 1e9, "softness": 0.5, "error": (1.8e-2, 2.8e-2)}
    assert verdicts(ladder(kn=4e9), **change) == {Verdict.XFAIL}
    assert verdicts(ladder(kn=1e9), **change) == {Verdict.FAIL}


@pytest.mark.parametrize(
    ("records", "change", "verdict"),
    [
        (ladder(), {"error": (5e-3, 9e-3)}, "fail"),  # worse than known
        (ladder(), {"error": (1.1e-2, 2e-2)}, "fail"),  # better than known
        (ladder(1.3), {}, "fail"),  # of a higher order
        (ladder(0.7), {}, "fail"),  # of a lower one
        (passing(5e-2), {}, "xpass"),  # the whole band passes
        (passing(3e-2), {"error": (1.1e-2, 1.9e-2)}, "xpass"),  # better than known
        (ladder(), {"expires": "2026-12-31"}, "fail"),
        (ladder(), {"versions": "2.*"}, "fail"),
        (ladder(), {"quantity": "z"}, "fail"),
        (ladder(), {"variants": ("T2",)}, "fail"),
    ],
)
def test_outside_of_it_on_either_side_it_is_news(
    records: list[Record], change: dict[str, Any], verdict: str
) -> None:
    assert verdicts(records, **change) == {Verdict(verdict)}


@pytest.mark.parametrize(
    ("slope", "verdict"), [(0.3, "fail"), (0.5, "xfail"), (1.5, "xfail"), (1.7, "fail")]
)
def test_at_other_parameters_an_order_may_leave_its_band_by_half(
    slope: float, verdict: str
) -> None:
    records = [changed(one, modified=True) for one in ladder(slope)]
    assert verdicts(records) == {Verdict(verdict)}


@pytest.mark.parametrize("code", ["yade", "liggghts"])
@pytest.mark.parametrize(
    ("modified", "errors", "known"),
    [
        (True, (8.3e-4, 8.4e-4, 3.6e-4), True),  # cancels at the longest step, at m = 1.76 kg
        (True, (8.3e-4, 8.4e-4, 1.1e-2), False),
        (False, (8.3e-4, 8.4e-4, 3.6e-4), False),
    ],
)
def test_late_drag_claims_no_order_of_bounces_to_rest_at_other_parameters(
    code: str, modified: bool, errors: tuple[float, ...], known: bool
) -> None:
    version = {"yade": "2023.02a", "liggghts": "3.8.0"}[code]
    made = [
        changed(
            record(f"{code}/default", "drop", dt, quantities=[entry("fail", {"max": e}, name="z")]),
            case="settling", modified=modified, code_version=version,
        )
        for dt, e in zip((1e-4, 2.5e-5, 1.25e-5), errors, strict=True)
    ]  # fmt: skip
    entries = read_disagreements(ROOT / "cases" / "disagreements.toml")
    last = judge(made, entries, TODAY)[-1].quantities[0].verdict
    assert last is (Verdict.XFAIL if known else Verdict.FAIL)


def off_once(label: str, variant: str, dt: float, name: str, error: float) -> Record:
    """A record in which one quantity is off."""
    return record(label, variant, dt, quantities=[entry("fail", {"max": error}, name=name)])


LATE_START = ("dem/published", "held", 7.5e-5, "s")
SLACK = ("dda/published", "gravity-25", 1e-3, "d")


@pytest.mark.parametrize(
    ("case", "one", "modified", "error", "verdict"),
    [
        ("slow-slide", LATE_START, True, 1.1e-2, Verdict.XFAIL),
        ("slow-slide", LATE_START, True, 5.1e-2, Verdict.FAIL),
        ("slow-slide", LATE_START, False, 1.1e-2, Verdict.FAIL),
        ("incline", SLACK, True, 0.2, Verdict.NO_REFERENCE),  # an answer of zero is known too
        ("incline", SLACK, True, 1.1, Verdict.FAIL),
        ("incline", SLACK, False, 0.2, Verdict.FAIL),
    ],
)
def test_late_starts_and_slack_springs_of_replicas_are_known_at_other_parameters(
    case: str, one: tuple[str, str, float, str], modified: bool, error: float, verdict: Verdict
) -> None:
    made = changed(off_once(*one, error), case=case, modified=modified)
    entries = read_disagreements(ROOT / "cases" / "disagreements.toml")
    assert judge([made], entries, TODAY)[0].quantities[0].verdict is verdict


def test_an_unmoving_result_is_never_a_known_disagreement() -> None:
    note = "nothing moves, though the reference does"
    assert verdicts([requantified(one, note=note) for one in ladder()]) == {Verdict.FAIL}


def test_orders_are_fitted_along_dt_at_one_stiffness_each() -> None:
    soft, stiff = ladder(1.0, kn=1e6), ladder(2.0, kn=1e9)
    found = orders([*soft, *stiff])
    assert sorted(round(order.order, 6) for order in found.values()) == [1.0, 2.0]


@pytest.mark.parametrize(
    ("expires", "kind", "bit"),
    [
        ("2027-02-01", None, 0),  # 31 days
        ("2027-01-31", "expiring", 0),  # 30 days
        ("2027-01-01", "expiring", 0),  # the last day
        ("2026-12-31", "expired", 1),
    ],
)
def test_an_entry_warns_for_thirty_days_and_is_red_when_over_even_if_all_pass(
    expires: str, kind: str | None, bit: int
) -> None:
    known = Disagreement(**{**KNOWN, "expires": expires})
    found = expiry_findings(ladder(verdict="pass"), [known], TODAY)
    assert [finding.kind for finding in found] == ([kind] if kind else [])
    assert bits(found) == bit


def test_an_entry_that_speaks_of_nothing_here_says_nothing() -> None:
    known = Disagreement(**{**KNOWN, "case": "other", "expires": "2000-01-01"})
    assert expiry_findings(ladder(), [known], TODAY) == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[[disagreement]]\ncode = 'a'", "entry 1"),
        ("[[disagreement", "disagreements.toml"),
        ("error = [2.0, 1.0]", "a band must not be empty"),
        ("error = [1e-3, 1.1e-2]", "within a factor of 10"),
        ("error = [0.05, 0.11]", r"must end at 0\.1"),
        ("order = [-9, 9]", r"order = \[-9, 9\]; a band wider than 0\.6 excludes nothing"),
        ("order = [0.9, 1.55]", "excludes nothing"),
        ("reason = ' '", "reason is empty"),
        ("expires = 'soon'", "entry 1"),
    ],
)
def test_a_bad_entry_is_named(tmp_path: Path, text: str, said: str) -> None:
    if not text.startswith("["):
        given = {**KNOWN, "error": [1e-3, 2e-3], "order": [1.8, 2.2], "variants": ["T1"]}
        lines = {name: f"{name} = {value!r}" for name, value in given.items()}
        lines[text.partition(" ")[0]] = text
        text = "\n".join(["[[disagreement]]", *lines.values()])
    path = tmp_path / "disagreements.toml"
    path.write_text(text)
    with pytest.raises(UsageError, match=said):
        read_disagreements(path)


@pytest.mark.parametrize(
    "text",
    [
        "disagreement = 3",
        "disagreement = [1]",
        "[[disagreement]]\ncode = 1",
        '[[disagreement]]\ncode="a"\nschemes=["*"]\nversions="*"\ncase="c"\nvariants=["*"]\n'
        'quantity="*"\ndt=0.1\nerror=[0.01,0.02]\norder=[0,1]\nreason="r"\nexpires="2099-01-01"',
    ],
)
def test_a_ledger_of_wrong_types_is_refused_in_a_line(tmp_path: Path, text: str) -> None:
    (tmp_path / "d.toml").write_text(text)
    with pytest.raises(UsageError, match=r"d\.toml: ") as refused:
        read_disagreements(tmp_path / "d.toml")
    assert "\n" not in str(refused.value)
