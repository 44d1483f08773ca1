"""What the terminal is told of results, line by line, as written by hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from tests.support.fabricated import NOWHERE, changed, entry, manifest, record
from vv.ask import NO_STIFFNESS
from vv.case import Level
from vv.output import finding_lines, markdown, progress, result_lines
from vv.output.results_table import table
from vv.records.finding import Aspect, Bit, Finding
from vv.records.job_record import Record
from vv.records.outcomes import Outcome

Told = pytest.CaptureFixture[str]
GOOD = entry("pass", {"max": 1e-4})


@pytest.fixture
def told(capsys: Told) -> Told:
    return capsys


def lines(told: Told) -> list[str]:
    """All that was said and noted."""
    said = told.readouterr()
    return (said.out + said.err).splitlines()


def refused(case: str = "bounce", reason: str = "too hot") -> Record:
    return record("dem/default", "T1", 1e-3, case=case, status="refused", reason=reason)


def fine(case: str = "bounce", label: str = "dem/default") -> Record:
    return record(label, "T1", 1e-3, case=case, quantities=[GOOD])


def test_reasons_are_told_each_once_with_how_often_and_the_most_frequent_alone(told: Told) -> None:
    given = [refused(reason=f"reason {n}") for n in range(8) for _ in range(9 - n)]
    result_lines.print_refusals(given)
    found = lines(told)
    assert [line.rpartition("note: ")[2] for line in found[:2]] == [
        "dem/default: not supported: reason 0 (9 times)",
        "dem/default: not supported: reason 1 (8 times)",
    ]  # fmt: skip
    assert len(found) == result_lines.REASONS + 1
    assert "and 2 more reasons; the report has them all" in found[-1]
    result_lines.print_refusals([refused()])
    assert [line.rpartition("note: ")[2] for line in lines(told)] == [
        "dem/default: not supported: too hot"
    ]
    result_lines.print_refusals([refused(reason=f"reason {n}") for n in range(6)])
    assert len(lines(told)) == 6


def test_settings_without_a_stiffness_are_told_once_beside_the_schemes_that_need_it(
    told: Told,
) -> None:
    lacking = [refused(reason=NO_STIFFNESS), refused("fall", reason=NO_STIFFNESS)]
    result_lines.print_refusals([fine(label="exact/default"), *lacking])
    assert [line.rpartition("note: ")[2] for line in lines(told)][1:] == [NO_STIFFNESS]


def test_where_something_was_taken_on_only_schemes_without_any_are_named(told: Told) -> None:
    result_lines.print_refusals([fine(label="exact/default"), refused("fall")])
    (line,) = lines(told)
    assert line.endswith("; `vv explain fall --rung dt=0.001` says why")
    assert "dem" in line
    result_lines.print_refusals([fine()])
    assert lines(told) == []


def test_the_command_that_explains_a_refusal_asks_as_the_run_did(told: Told) -> None:
    def hint(*given: Record) -> str:
        result_lines.print_refusals(given)
        return lines(told)[0].partition("`")[2].partition("`")[0]

    accepted = changed(fine(label="exact/default"), rung={})
    elsewhere = changed(refused(), modified=True, parameters={"m": 2.0}, changed=["m"])
    assert hint(accepted, refused()) == "vv explain bounce --rung dt=0.001"
    assert hint(elsewhere, accepted) == "vv explain bounce --set m=2 --rung dt=0.001"
    assert hint(refused(), changed(fine(label="exact/default"), rung={"dt": 2e-3})) == (
        "vv explain bounce"
    )


def test_a_table_is_shown_where_anything_was_taken_on(told: Told) -> None:
    result_lines.print_table([fine(), refused("fall")], [])
    assert any("bounce:T1" in line for line in lines(told))
    result_lines.print_table([refused()], [])
    assert lines(told) == []


def test_the_last_line_explains_a_case_that_failed_if_there_is_one(told: Told) -> None:
    failed = record("dem/default", "T1", 1e-3, case="fall", quantities=[entry("fail", {"max": 1})])
    words = "fall:T1 --codes dem/default"
    softer = changed(failed, modified=True, changed=["m"], parameters={"m": 2.0, "g": 9.81})
    for given, case in (
        ([fine(), failed], words), ([softer], f"{words} --set m=2"), ([fine()], "bounce"),
        ([], "CASE"),
    ):  # fmt: skip
        result_lines.print_counts(given, "here")
        (line,) = lines(told)
        assert line.endswith(f"; report: here; details: vv explain {case}")


def test_a_parameter_without_effect_is_told_once_of_results_that_were_modified(told: Told) -> None:
    note = f"first{result_lines.INERT.replace(': inert, ', '')}; g = 2{result_lines.INERT}as told"
    model = {"unknowns": 1, "terms": ["gravity"], "note": note}
    one = record("dem/default", "T1", 1e-3, model=model, modified=True)
    bare = changed(one, model=None)
    result_lines.print_inert([one, one, bare, changed(one, modified=False)])
    (line,) = lines(told)
    assert line.endswith(f"bounce:T1: g = 2{result_lines.INERT}as told")


def test_a_case_without_changes_says_so(told: Told) -> None:
    moved = Finding(Aspect.REGRESSION, "worse", "by far", case="bounce", bit=Bit.ACCURACY)
    other = Finding(Aspect.ACCURACY, "fail", "wrong", case="bounce", bit=Bit.ACCURACY)
    result_lines.print_difference(manifest(findings=[other]), "bounce")
    assert lines(told) == ["bounce: no change since its baseline"]
    result_lines.print_difference(manifest(findings=[other, moved]), "bounce")
    (line,) = lines(told)
    assert "by far" in line


def test_whoever_accepts_a_first_baseline_is_not_told_to_accept_one(told: Told) -> None:
    text = "no baseline; to accept one: vv accept bounce --reason ..."
    none = Finding(Aspect.REGRESSION, "no baseline", text, case="bounce")
    result_lines.print_difference(manifest(findings=[none]), "bounce")
    assert lines(told) == ["bounce: no baseline yet"]


def test_changes_are_told_by_kind_and_what_is_left_out_is_counted(told: Told) -> None:
    kinds = [(kind, n) for kind, count in (("worse", 3), ("gone", 2)) for n in range(count)]
    changes: Any = [SimpleNamespace(kind=k, where=f"case {n}", text="moved") for k, n in kinds]
    result_lines.print_changes(changes, manifest(), manifest(), 2)
    assert lines(told)[2:] == [
        "worse: case 0: moved", "worse: case 1: moved", "worse: and 1 more",
        "gone: case 0: moved", "gone: case 1: moved",
    ]  # fmt: skip
    result_lines.print_changes([], manifest(), manifest(), 2)
    first, *_, last = lines(told)
    assert last == "no difference"
    assert first.startswith("A: 2025-01-01T00:00:00+00:00, commit c0ffeec0f with uncommitted")


def test_a_past_run_is_listed_with_its_commit_what_it_holds_and_its_command(told: Told) -> None:
    clean = changed(NOWHERE, dirty=False, command="vv run fall")
    nowhere = changed(clean, commit="")
    result_lines.print_runs(
        [("r1", ("a", "b"), NOWHERE), ("r2", ("a",), clean), ("r3", (), nowhere)]
    )
    assert lines(told) == [
        "r1  c0ffeec0f+  2 cases  vv run --all",
        "r2  c0ffeec0f  a  vv run fall",
        "r3  no commit  0 cases  vv run fall",
    ]


def test_history_tells_of_each_scheme_what_there_is(told: Told) -> None:
    point: Any = SimpleNamespace(
        name="c0ffee", utc="today", outcomes={"b": {Outcome.PASS: 2}, "a": {Outcome.PASS: 1}},
        closeness={"a": 0.5}, cost={"b": 3.0},
    )  # fmt: skip
    result_lines.print_history("bounce", [point])
    assert lines(told) == [
        "bounce at c0ffee, today", "  a: 1 pass, error 0.5 times the tolerance",
        "  b: 2 pass, cost 3 calibration kernels",
    ]  # fmt: skip
    result_lines.print_history("bounce", [])
    assert lines(told) == ["bounce: no run is stored"]


def finding(number: int, **changes: Any) -> Finding:
    given = {"case": f"case-{number}", "bit": Bit.ACCURACY, **changes}
    return Finding(Aspect.ACCURACY, "fail", f"wrong {number}", **given)


def test_the_first_findings_are_told_and_the_others_counted() -> None:
    every = [finding(n, enforced=n < 3) for n in range(finding_lines.SHOWN + 4)]
    found = list(finding_lines.lines(every, [], Level.DEFAULT))
    assert len(found) == finding_lines.SHOWN + 1
    assert found[-1] == "and 4 more, 0 of them red; the report has them all"
    few = list(finding_lines.lines(every[: finding_lines.SHOWN], [], Level.DEFAULT))
    assert len(few) == finding_lines.SHOWN


def test_only_a_red_finding_of_a_single_result_that_is_no_speed_is_told_with_its_command() -> None:
    one = fine()
    at = {"case": "bounce", "variant": "T1", "label": "dem/default", "rung": "dt=0.001"}
    for changes, told in (
        ({}, True), ({"enforced": False}, False), ({"variant": "T2"}, False),
        ({"check": Aspect.SPEED}, False),
    ):  # fmt: skip
        given: dict[str, Any] = {**at, "bit": Bit.ACCURACY, "check": Aspect.ACCURACY, **changes}
        check = given.pop("check")
        found = Finding(check, "fail", "wrong", **given)
        said = list(finding_lines.lines([found], [one], Level.DEFAULT))
        assert any(line.startswith("  again: vv run bounce:T1") for line in said) is told


def test_a_summary_counts_what_it_leaves_out_and_what_is_said_several_times() -> None:
    many = [finding(n) for n in range(markdown.ROWS + 3)]
    notices = [Finding(Aspect.SPEED, "note", "slow machine", case="bounce")] * 2
    notices += [Finding(Aspect.SPEED, "note", "no baseline", case="fall")]
    text = markdown.summary(manifest(fine()), [*many, *notices])
    assert f"**Out of tolerance, stopped or missing** ({markdown.ROWS + 3})" in text
    assert "| | | and 3 more: see the report |" in text
    assert "- bounce: slow machine (2 times)\n- fall: no baseline\n" in text
    assert "more: see" not in markdown.summary(manifest(fine()), many[: markdown.ROWS])
    each = [Finding(Aspect.SPEED, "note", f"note {n}", case="c") for n in range(markdown.ROWS + 2)]
    assert markdown.summary(manifest(fine()), each).endswith("- and 2 more\n")
    assert "more" not in markdown.summary(manifest(fine()), each[: markdown.ROWS])


def test_progress_is_told_now_and_then_and_the_first_runs_that_are_lost(
    told: Told, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [100.0]
    monkeypatch.setattr("time.monotonic", lambda: now[0])
    shown = progress._Lines()
    shown.done(fine())
    assert lines(told) == []  # nothing has begun
    shown.begin(100)
    step = progress.EVERY / 4
    for _ in range(10):
        now[0] += step
        shown.done(fine())
    said = lines(told)
    assert [line.rpartition("note: ")[2] for line in said] == [
        "5 of 100 runs",
        f"10 of 100 runs, about {progress._round(90 * step)} left",
    ]
    lost = record("dem/default", "T1", 1e-3, status="error", reason="it broke")
    for _ in range(progress.NAMED + 2):
        shown.done(lost)
    shown.done(changed(lost, status="diverged", study="grid"))  # a map is there to show that
    assert len([line for line in lines(told) if "it broke" in line]) == progress.NAMED


@pytest.mark.parametrize(
    ("seconds", "words"), [(8.2, "8 s"), (99.0, "99 s"), (100.0, "2 min"), (600.0, "10 min")]
)
def test_a_time_that_is_estimated_is_round(seconds: float, words: str) -> None:
    assert progress._round(seconds) == words


def test_a_table_is_as_wide_as_its_longest_names_and_explains_its_marks() -> None:
    name = "a-code-of-a-long-name/and-a-long-scheme"
    long = record(name, "T1", 1.2345e-5, quantities=[GOOD])
    unjudged = record("dem/default", "T1", 1e-3, quantities=[entry("pass", {"max": None})])
    head, *_, row, other, legend = [*table([long, unjudged], [])][2:]
    assert head.index("setting") == row.index("dt=1.2345e-05") == 2 + len(name) + 2
    assert head.index("error") > head.index("setting") + len("dt=1.2345e-05")
    assert "1.0e-04  1.0e-03" in row
    assert "       -        -" in other
    assert legend == "  (finest setting; ~: timed while other jobs ran)"


def test_each_of_two_invocations_is_told_with_its_own_day_commit_and_count(told: Told) -> None:
    one, other = (
        manifest(*[fine()] * count,
                 provenance=changed(NOWHERE, utc=f"day {count}", commit=commit, dirty=dirty))
        for count, commit, dirty in ((2, "a" * 40, False), (3, "b" * 40, True))
    )  # fmt: skip
    result_lines.print_changes([], one, other, 2)
    assert lines(told)[:2] == [
        "A: day 2, commit aaaaaaaaa, 2 results: vv run --all",
        "B: day 3, commit bbbbbbbbb with uncommitted changes, 3 results: vv run --all",
    ]


def test_what_may_not_be_accepted_is_counted_by_scheme_and_outcome(told: Told) -> None:
    failed = record("dem/default", "T1", 1e-3, quantities=[entry("fail", {"max": 1})])
    result_lines.print_unacceptable([failed, refused(), failed, refused(), failed])
    assert lines(told) == [
        "not in the baseline: 3 of dem/default: fail",
        "not in the baseline: 2 of dem/default: not supported",
    ]
