"""Claims about what `vv gate` and `vv run` decide from their options, as tables of truths."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from tests.support.fabricated import entry, manifest, record, some
from vv.ask import Knobs
from vv.base.errors import UsageError
from vv.case import Level
from vv.cli import gate_command, invocation, options, run_command
from vv.cli.gate_command import GateCall
from vv.cli.run_command import RunCall
from vv.plan.project import Project
from vv.run.limits import Limits, Timing

PROJECT: Any = some(programs=())


@pytest.mark.parametrize(
    ("call", "timing"), [(GateCall(), Timing.LAST), (GateCall(timing=True), Timing.NEW)]
)
def test_the_gate_judges_the_last_speeds_or_new_ones(call: GateCall, timing: Timing) -> None:
    assert gate_command._limits(call).timing is timing


def test_the_gate_takes_its_limits_as_they_are_given() -> None:
    call = GateCall(fresh=True, jobs=3, timeout=7.0, against=Path("baselines"))
    assert gate_command._limits(call) == Limits(3, 7.0, True, Timing.LAST, Path("baselines"))
    assert gate_command._limits(GateCall(jobs=1)) == Limits(1, 300.0, False, Timing.LAST, None)


@pytest.mark.parametrize(
    ("call", "timed", "repeatable", "narrows"),
    [
        (RunCall(), False, True, False),
        (RunCall(everything=True), True, True, False),
        (RunCall(everything=True, level=Level.PAPER), True, True, False),
        (RunCall(everything=True, level=Level.QUICK), False, True, False),
        (RunCall(everything=True, keyword="T1"), False, True, False),
        (RunCall(everything=True, first=True), False, False, False),
        (RunCall(everything=True, failed=True), False, False, True),
        (RunCall(everything=True, since="HEAD"), False, False, True),
        (RunCall(everything=True, budget="1s"), False, False, True),
        (RunCall(selection=["fall"]), False, True, False),
    ],
)
def test_costs_are_timed_where_every_case_runs_to_its_end(
    call: RunCall, timed: bool, repeatable: bool, narrows: bool
) -> None:
    assert (call.timed, call.repeatable, call.narrows) == (timed, repeatable, narrows)
    assert run_command._limits(call).timing is (Timing.STORED if timed else Timing.NONE)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (RunCall(), "give a case or --all"),
        (RunCall(selection=["fall"], everything=True), "not both"),
        (RunCall(selection=["fall"]), ""),
        (RunCall(everything=True), ""),
        (RunCall(failed=True), ""),
        (RunCall(since="HEAD"), ""),
        (RunCall(budget="1s"), ""),
        (RunCall(keyword="T1"), ""),
        (RunCall(first=True), "give a case or --all"),
    ],
)
def test_a_run_is_of_cases_or_of_all_or_of_what_is_left_of_them(call: RunCall, said: str) -> None:
    if not said:
        run_command._check_selection(call)
        return
    with pytest.raises(UsageError, match=said):
        run_command._check_selection(call)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (RunCall(failed=True, since="HEAD"), "nothing failed in the last run"),
        (RunCall(since="HEAD~2"), "no change since HEAD~2 can affect a result"),
        (RunCall(budget="1s"), "no job fits 1s"),
    ],
)
def test_an_empty_run_says_why(call: RunCall, said: str) -> None:
    assert run_command._nothing(call, None) == f"nothing to run: {said}"
    passed, failed = (
        manifest(record("a/x", "T1", 1e-3, quantities=[entry(verdict, {"max": 1.0})]))
        for verdict in ("pass", "fail")
    )
    assert run_command._nothing(call, passed) == f"nothing to run: {said}"
    assert run_command._nothing(call, failed) == (
        "nothing to run: what failed is not selected; the last run: vv run --all"
    )


def test_what_failed_is_run_again_at_the_settings_at_which_it_failed_each_once() -> None:
    def came(dt: float, verdict: str, label: str = "a/x") -> Any:
        return record(label, "T1", dt, quantities=[entry(verdict, {"max": 1.0})])

    last = manifest(came(4e-3, "fail"), came(2e-3, "pass"), came(4e-3, "fail", "a/y"),
                    came(1e-3, "xpass"), came(5e-3, "xfail"))  # fmt: skip
    assert run_command._rungs_that_failed(last) == (Knobs(4e-3), Knobs(1e-3))
    with pytest.raises(UsageError, match="there is no previous run"):
        run_command._last(some(manifests=some(latest=lambda: None)))


@pytest.mark.parametrize(("fresh", "stored"), [(True, set()), (False, {1})])
def test_jobs_that_are_stored_are_listed_so_unless_all_run_anew(
    fresh: bool, stored: set[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    listed: list[Any] = []
    monkeypatch.setattr("vv.plan.keys.run_keys", lambda *_: {0: "aa", 1: "bb"})
    monkeypatch.setattr("vv.output.listing.print_jobs", lambda plan, known: listed.append(known))
    store: Any = some(has_run={"aa": False, "bb": True}.__getitem__)
    run_command._list_jobs(PROJECT, store, some(), fresh)
    assert listed == [stored]


@pytest.mark.parametrize(("first", "until"), [(True, "the first failure"), (False, None)])
def test_a_run_stops_at_the_first_failure_if_it_is_told_to(
    first: bool, until: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[Any] = []

    def carried(project: object, plan: object, limits: object, until: object) -> str:
        asked.append(until)
        return "manifest"

    monkeypatch.setattr("vv.gate.first_failure.is_failure", lambda project: "the first failure")
    monkeypatch.setattr(invocation, "carry_out_with_progress", carried)
    monkeypatch.setattr(run_command, "_conclude", lambda project, found, call, required: found)
    plan: Any = some(jobs=(1,))
    done: Any = run_command._run_once(PROJECT, plan, RunCall(first=first), Limits(1, 1.0), ())
    assert (done, asked) == ("manifest", [until])


@pytest.mark.parametrize(
    ("fresh", "timing", "reused"),
    [
        (False, Timing.NONE, True),
        (False, Timing.LAST, True),
        (False, Timing.STORED, True),
        (False, Timing.NEW, False),
        (True, Timing.NONE, False),
    ],
)
def test_an_earlier_answer_is_taken_unless_something_is_asked_anew(
    fresh: bool, timing: Timing, reused: bool
) -> None:
    assert invocation._may_reuse(Limits(1, 1.0, fresh, timing)) is reused


def test_an_answer_is_that_to_its_question_timing_and_baselines(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("vv.run.reuse.identity", lambda *words: words)
    limits = Limits(1, 1.0, False, Timing.LAST, Path("others"))
    found: Any = invocation._identity(PROJECT, ("run", "fall"), limits)
    project, asked, today, against = found
    assert (project, asked) == (PROJECT, ("run", "fall", Timing.LAST))
    assert (len(today.isoformat()), against) == (10, Path("others"))


@pytest.mark.parametrize(("edited", "kept"), [(False, 1), (True, 0)])
def test_an_answer_is_kept_unless_a_file_was_edited_meanwhile(
    edited: bool, kept: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    states = iter(["before", "after" if edited else "before"])
    remembered: list[Any] = []
    monkeypatch.setattr(invocation, "_identity", lambda *_: next(states))
    monkeypatch.setattr(invocation, "carry_out_with_progress", lambda *_: "manifest")
    monkeypatch.setattr("vv.run.reuse.recall", lambda *_: None)
    monkeypatch.setattr("vv.run.reuse.remember", lambda *words: remembered.append(words))
    project: Any = some(data=lambda: tmp_path)
    found: Any = invocation.reuse_or_carry_out(project, (), some, Limits(1, 1.0))
    assert found == "manifest"
    assert len(remembered) == kept


@pytest.mark.parametrize(("untouched", "built"), [(True, 0), (False, 1)])
def test_a_report_that_is_not_that_of_the_run_is_written(
    untouched: bool, built: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    written: list[Any] = []
    monkeypatch.setattr("vv.run.reuse.untouched", lambda *_: untouched)
    monkeypatch.setattr("vv.run.reuse.note_report", lambda *_: None)
    writer = some(build=lambda *words: written.append(words))
    monkeypatch.setattr(invocation, "report_writer", lambda project: writer)
    monkeypatch.setattr(invocation, "report_extras", lambda *_: None)
    (tmp_path / "report").mkdir()
    (tmp_path / "report" / "index.html").write_text("of another run")
    project: Any = some(data=lambda: tmp_path)
    page = invocation.write_report(project, manifest())
    assert (page, len(written)) == (tmp_path / "report" / "index.html", built)


@pytest.mark.parametrize(("asked", "count"), [(3, 3), (1, 1), (0, len(os.sched_getaffinity(0)))])
def test_processes_are_as_many_as_asked_for_or_as_cores(asked: int, count: int) -> None:
    assert options.workers(asked) == count


@pytest.mark.parametrize("timeout", [0.0, -1.0, float("nan")])
def test_a_timeout_is_positive(timeout: float) -> None:
    with pytest.raises(UsageError, match="it must be positive"):
        options.positive(timeout)
    assert options.positive(0.5) == 0.5


def test_codes_are_told_apart_by_commas_and_programs_by_their_ending(tmp_path: Path) -> None:
    assert options.codes(" a/x , b,,") == ("a/x", "b")
    for nothing in ("", " , "):
        with pytest.raises(UsageError, match="names no code"):
            options.codes(nothing)
    file = tmp_path / "my_code.toml"
    file.write_text("")
    project, named = options.with_programs(Project(tmp_path), f"a/x,{file}/fast,{file}")
    assert named == ("a/x", "my-code/fast", "my-code")
    assert set(project.programs) == {file}
    with pytest.raises(UsageError, match="there is no file"):
        options.with_programs(Project(tmp_path), str(tmp_path / "no.toml"))


def test_a_program_whose_file_is_named_must_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vv.plan.selection.named_adapters", lambda *_: {})
    monkeypatch.setattr("vv.plan.selection.choose_schemes", lambda *_: [])
    project: Any = some(programs=(Path("my_code.toml"),))
    assert options.required(project, "a, b/x") == ("a", "b/x", "my-code")
    assert options.required(PROJECT, "") == ()


@pytest.mark.parametrize(
    ("word", "fitting"), [("impact", ["T1", "T2"]), ("bounce:t1", ["T1"]), ("a/x", ["T1", "T2"])]
)
def test_a_keyword_is_looked_for_in_family_case_variant_and_code(
    word: str, fitting: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    jobs = [some(case="bounce", variant=name, name=f"bounce:{name} a/x") for name in ("T1", "T2")]
    monkeypatch.setattr("vv.plan.planning.make_plan", lambda *_: some(jobs=jobs))
    monkeypatch.setattr(
        "vv.plan.plan.with_jobs_kept",
        lambda plan, keep: some(jobs=[job for job in plan.jobs if keep(job)]),
    )
    project: Any = some(families=lambda: {"bounce": "impact"})
    asked: Any = some(settings=(), rungs=())
    found = options.plan_of(project, [], asked, word)
    assert [job.variant for job in found.jobs] == fitting
    with pytest.raises(UsageError, match="-k 'nothing' matches none of 2 jobs"):
        options.plan_of(project, [], asked, "nothing")


@pytest.mark.parametrize(("count", "taken"), [(200, True), (201, False)])
@pytest.mark.parametrize("what", ["names", "--set", "--rung"])
def test_two_hundred_names_are_taken_and_no_more(
    what: str, count: int, taken: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("vv.plan.planning.make_plan", lambda project, names, asked: names)
    many = ["x"] * count
    given = {"names": [], "--set": (), "--rung": (), what: many}
    asked: Any = some(settings=given["--set"], rungs=given["--rung"])
    if taken:
        found: Any = options.plan_of(PROJECT, list(given["names"]), asked)
        assert found == (many if what == "names" else ["*"])
        return
    with pytest.raises(UsageError, match=f"201 times {what}; at most 200"):
        options.plan_of(PROJECT, list(given["names"]), asked)


@pytest.mark.parametrize(("json", "known", "runs"), [
    (None, "printed", False), (None, None, True), (Path("out.json"), "printed", True),
])  # fmt: skip
def test_a_run_that_writes_a_file_never_repeats_what_another_printed(
    json: Path | None, known: str | None, runs: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[Any] = []

    def carry_out(*words: Any) -> Any:
        ran.extend(words)
        return some(name="run")

    for name, what in (
        ("vv.cli.invocation.earlier_output", lambda *_: known),
        ("vv.cli.invocation.reuse_or_carry_out", carry_out),
        ("vv.cli.invocation.keep_output", lambda *_: None),
        ("vv.cli.run_command._conclude", lambda *_: "new"),
    ):
        monkeypatch.setattr(name, what)
    call: Any = RunCall(json_file=json)
    told: Any = run_command._reuse_or_run(some(), (), some, call, some(), ())
    assert (told, bool(ran)) == ("new" if runs else known, runs)
