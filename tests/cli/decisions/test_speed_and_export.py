"""Claims about what `vv speed`, `export`, `list`, `accept`, `record` and `check` decide."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import typer

from tests.support.fabricated import changed, manifest, record, some
from vv.ask import Knobs, Run, Status
from vv.base.errors import UsageError
from vv.case import Level
from vv.cli import (
    baseline_commands,
    check_command,
    export_command,
    job_tests,
    query_commands,
    speed_command,
)
from vv.cli.speed_command import SpeedCall
from vv.codes.tiny_scene_check import Answered, CheckResult
from vv.plan.plan import EmptyPlanError
from vv.records.finding import Aspect, Bit, Finding
from vv.records.manifest import CodeFound


@dataclasses.dataclass(frozen=True)
class Job:
    """As much of a job as choices depend on."""

    case: str
    variant: str
    timed: bool
    knobs: Knobs = dataclasses.field(default_factory=Knobs)

    @property
    def ask(self) -> Any:
        return some(knobs=self.knobs)


def plan_of(*jobs: Job) -> Any:
    """A plan whose variants have the default rungs 4e-3 s, and 2e-3 s at 1e9 N/m."""
    rungs = {Level.DEFAULT: (Knobs(4e-3), Knobs(2e-3, 1e9))}
    trials = {(job.case, job.variant): some(study=some(rungs=rungs)) for job in jobs}
    return SimpleNamespace(jobs=jobs, trials=trials)


def test_a_variant_without_timed_settings_is_timed_at_those_of_the_default_level() -> None:
    every = [
        Job("a", "own", True, Knobs(4e-3)), Job("a", "own", False, Knobs(2e-3, 1e9)),
        Job("b", "none", False, Knobs(4e-3, 7e7)), Job("b", "none", False, Knobs(2e-3, 1e9)),
        Job("b", "none", False, Knobs(2e-3, 1e8)), Job("b", "none", False, Knobs(1e-3)),
        Job("b", "none", False, Knobs()), Job("b", "none", False, Knobs(2e-3)),
    ]  # fmt: skip
    found = [job.timed for job in speed_command._all_timed(plan_of(*every))]
    #                    4e-3 has no stiffness of its own, 1e8 is not that of 2e-3, 1e-3 is none
    assert found == [True, False, False, True, False, False, True, True]


@pytest.mark.parametrize(
    ("call", "kept"),
    [
        (SpeedCall(), [("a", "own")]),
        (SpeedCall(selection=["b"]), [("a", "own"), ("b", "none")]),
        (SpeedCall(level=Level.PAPER), [("a", "own"), ("b", "none")]),
    ],
)
def test_variants_are_timed_that_are_named_or_else_those_that_are_timed_at_this_level(
    call: SpeedCall, kept: list[tuple[str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "vv.plan.plan.with_jobs_kept",
        lambda plan, keep: SimpleNamespace(jobs=[job for job in plan.jobs if keep(job)]),
    )
    monkeypatch.setattr("dataclasses.replace", replaced)
    plan = plan_of(Job("a", "own", True), Job("b", "none", False))
    left = speed_command._timed_part(plan, call)
    assert [(job.case, job.variant) for job in left.jobs] == kept
    if call == SpeedCall():
        with pytest.raises(UsageError, match="no selected variant is timed at this level"):
            speed_command._timed_part(plan_of(Job("b", "none", False)), call)


def replaced(what: Any, **changes: Any) -> Any:
    """As `dataclasses.replace`, for stand-ins too."""
    kind = type(what)
    return kind(**{**vars(what), **changes})


def export_job(scheme: str, dt: float, status: Status | None = None) -> Any:
    settled = Run(status, "it has no walls") if status else None
    return some(code="a", scheme=scheme, settled=settled, ask=f"{scheme} at {dt:g}",
                label=f"fall:up a/{scheme} dt={dt:g}")  # fmt: skip


@pytest.mark.parametrize(
    ("status", "text"),
    [
        (None, "the input of x at 0.001"),
        (Status.NOT_INSTALLED, "the input of x at 0.001"),
        (Status.REFUSED, "a refuses fall:up: it has no walls"),
    ],
)
def test_what_is_exported_is_the_finest_setting_of_the_first_scheme(
    status: Status | None, text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    jobs = [export_job("x", 1e-2), export_job("x", 1e-3, status), export_job("y", 1e-4)]
    code = some(name="a", native=lambda ask, scheme: f"the input of {ask}")
    first, second = (some(name=name, knobs=("dt",)) for name in ("x", "y"))
    monkeypatch.setattr("vv.plan.planning.make_plan", lambda *_: some(jobs=jobs))
    monkeypatch.setattr("vv.plan.selection.named_adapters", lambda *_: {})
    monkeypatch.setattr(
        "vv.plan.selection.choose_schemes", lambda *_: [(code, first), (code, second)]
    )
    project: Any = some()
    asked: Any = some(codes=("a",))
    if "refuses" in text:
        with pytest.raises(UsageError, match=text):
            export_command._input(project, "fall:up", asked, export_command.Form.NATIVE)
        return
    found = export_command._input(project, "fall:up", asked, export_command.Form.NATIVE)
    assert found == (text, "fall:up a/x dt=0.001")


@pytest.mark.parametrize(
    ("word", "fitting"),
    [
        ("drops", {"fall": ["down"], "rise": []}),  # in the words of a variant
        ("stone", {"fall": ["up", "down"], "rise": []}),  # in the title
        ("motion", {"fall": ["up", "down"], "rise": ["high"]}),  # the family
        ("fall:up", {"fall": ["up"], "rise": []}),
    ],
)
def test_a_word_of_a_title_stands_for_all_variants_and_one_of_variants_for_these(
    word: str, fitting: dict[str, list[str]]
) -> None:
    def case(name: str, title: str, **variants: str) -> Any:
        own = [some(name=one, summary=summary) for one, summary in variants.items()]
        return some(name=name, title=title, variants=own)

    cases = [case("fall", "a stone drops", up="flies", down="it drops"),
             case("rise", "a balloon", high="it flies")]  # fmt: skip
    families = dict.fromkeys(("fall", "rise"), "motion")
    assert query_commands._fitting(families, cases, word) == fitting
    with pytest.raises(UsageError, match="-k 'nothing' matches no variant"):
        query_commands._fitting(families, cases, "nothing")


def test_a_code_runs_what_some_scheme_of_it_does_not_refuse_at_the_highest_level(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def job(variant: str, status: Status | None) -> Any:
        return some(case="fall", variant=variant, settled=status and Run(status, "why"))

    fates = {"a": None, "b": Status.REFUSED, "c": Status.NOT_INSTALLED, "d": Status.TOO_LONG}
    jobs = [job(name, fate) for name, fate in fates.items()]
    asked: list[Any] = []

    def planned(project: object, names: object, options: Any) -> Any:
        asked.append(options.level)
        return some(jobs=[*jobs, job("e", Status.REFUSED), job("e", None)])

    monkeypatch.setattr("vv.cli.options.plan_of", planned)
    project: Any = some()
    found = query_commands._run_by(project, ["fall"], "a")
    assert found == {("fall", name) for name in "acde"}
    assert asked == [Level.PAPER]


def test_what_is_accepted_is_of_the_levels_quick_and_default_where_there_is_any(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[Any] = []

    def planned(project: object, names: list[str], options: Any) -> str:
        asked.append((names, options.level, options.codes))
        if names == ["later"] or (names == ["slow"] and options.level is Level.QUICK):
            raise EmptyPlanError("nothing")
        return f"plan {options.level.value}"

    monkeypatch.setattr("vv.cli.options.plan_of", planned)
    monkeypatch.setattr("vv.plan.plan.merge_plans", lambda one, other: f"{one}, {other}")
    project: Any = some(case_names=lambda: ["fall", "slow", "later"])
    both: Any = baseline_commands._both_levels(project, "fall", "a,b/x")
    assert both == "plan quick, plan default"
    assert asked == [(["fall"], level, ("a", "b/x")) for level in (Level.QUICK, Level.DEFAULT)]
    one: Any = baseline_commands._both_levels(project, "slow", "*")
    assert one == "plan default"
    with pytest.raises(UsageError, match="no scheme of later runs at level default"):
        baseline_commands._both_levels(project, "later", "*")
    with pytest.raises(UsageError, match="accept takes the name of one case, not 'f\\*'"):
        baseline_commands._both_levels(project, "f*", "*")


def test_cases_that_came_with_vv_are_not_changed() -> None:
    with pytest.raises(UsageError, match="cannot change the cases that came with vv"):
        baseline_commands._require_own_cases(some(bundled=True))
    baseline_commands._require_own_cases(some(bundled=False))


def test_an_acceptance_says_which_commit_machine_and_versions_the_results_are_of() -> None:
    codes = {"a": CodeFound("7", True, {"/bin/a": "digest"}), "b": CodeFound("", False, {})}
    whole = manifest(record("a/x", "T1", 1e-3), codes=codes)
    found = baseline_commands._acceptance(whole, "it is right")
    made = whole.provenance
    assert (found.commit, found.dirty, found.utc) == (made.commit, made.dirty, made.utc)
    assert (found.machine.processor, found.machine.system) == ("P", "S")
    assert (found.versions, found.reason) == ({"vv": "0.1", "a": "7"}, "it is right")
    (head,) = baseline_commands._without_results(whole).values()
    assert (head.code, head.version, head.executables) == ("a", "7", {"a": "digest"})


@pytest.mark.parametrize(
    ("reason", "dry_run", "written"),
    [("it is right", False, ["it is right"]), (" it is right ", False, ["it is right"]),
     ("it is right", True, []), ("", True, []), ("", False, None), ("  ", False, None)],
)  # fmt: skip
def test_a_baseline_is_written_for_a_reason_and_never_by_a_dry_run(
    reason: str, dry_run: bool, written: list[str] | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrote: list[str] = []
    told: list[Any] = []
    bad = record("a/x", "T1", 1e-3, status="error")
    whole = manifest(record("a/x", "T1", 2e-3), bad)
    for name, what in (
        ("vv.cli.baseline_commands.find", lambda: some(bundled=False)),
        ("vv.cli.baseline_commands._both_levels", lambda *_: "plan"),
        ("vv.cli.baseline_commands._run", lambda project, plan, timing: whole),
        ("vv.cli.baseline_commands._write_baseline", lambda *words: wrote.append(words[-1])),
        ("vv.gate.acceptance.acceptable", lambda one: one is not bad),
        ("vv.output.result_lines.print_difference", lambda *_: None),
        ("vv.output.result_lines.print_unacceptable", told.extend),
    ):
        monkeypatch.setattr(name, what)
    if written is None:
        with pytest.raises(UsageError, match="--reason is missing"):
            baseline_commands.accept("fall", reason, False, dry_run)
        return
    baseline_commands.accept("fall", reason, False, dry_run)
    assert (wrote, told) == (written, [bad])


@pytest.mark.parametrize(
    ("answers", "lost", "status", "left"),
    [
        ((Answered.RIGHT, Answered.RIGHT, Answered.REFUSED), None, 0, 3),
        ((Answered.RIGHT, Answered.WRONG, Answered.RIGHT), None, 1, 3),
        ((Answered.FAILED, Answered.RIGHT, Answered.RIGHT), None, 8, 3),
        ((Answered.WRONG, Answered.FAILED, Answered.RIGHT), None, 9, 3),
        ((Answered.RIGHT, Answered.FAILED, Answered.RIGHT), 1, 8, 2),
        ((Answered.RIGHT, Answered.RIGHT, Answered.FAILED), 2, 8, 3),
    ],
)
def test_a_check_is_red_by_what_was_wrong_or_failed_and_ends_where_no_answer_comes(
    answers: tuple[Answered, ...],
    lost: int | None,
    status: int,
    left: int,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    scenes = [some(name=f"scene {n}", asks=lambda scheme: [0]) for n in range(len(answers))]
    asked: list[str] = []

    def runs(adapter: object, scheme: object, tiny: Any, *_: object) -> list[Run]:
        asked.append(tiny.name)
        late = lost is not None and tiny.name == f"scene {lost}"
        return [Run(Status.TIMEOUT if late else Status.RAN)]

    monkeypatch.setattr(check_command, "_answers", runs)
    monkeypatch.setattr("vv.codes.tiny_scenes.tiny_scenes", lambda scheme: scenes)
    monkeypatch.setattr("vv.codes.tiny_scenes.unasked", lambda scheme: ())
    found = dict(zip((one.name for one in scenes), answers, strict=True))
    monkeypatch.setattr(
        "vv.codes.tiny_scene_check.judged",
        lambda scheme, tiny, _: CheckResult(found[tiny.name], "so it is"),
    )
    adapter: Any = some(name="a", refuses=lambda ask, scheme: "it has no walls")
    scheme: Any = some(name="x", method=some(value="exact"))
    assert check_command._check_scheme(adapter, scheme, 5.0, Path()) == status
    assert len(asked) == left
    said = capsys.readouterr().out
    assert ("1 not tested, since it gave no answer in 5 s" in said) is (left < len(answers))


def test_a_code_that_is_not_installed_is_checked_incompletely(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    code = some(name="a", found=lambda: some(installed=False, how_to_install="make it"))
    project = some(adapter_names=lambda: ["a"])
    monkeypatch.setattr("vv.cli.options.with_programs", lambda *_: (project, ("a/x",)))
    monkeypatch.setattr("vv.plan.selection.named_adapters", lambda *_: {"a": code})
    with pytest.raises(typer.Exit) as ended:
        check_command.check("a/x", 1.0)
    assert ended.value.exit_code == Bit.INCOMPLETE
    monkeypatch.setattr("vv.cli.options.with_programs", lambda *_: (project, ("b",)))
    with pytest.raises(UsageError, match="no code 'b'"):
        check_command.check("b", 1.0)


def test_a_job_of_pytest_is_judged_by_the_findings_on_its_own_record_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    one = record("a/x", "T1", 1e-3)
    own = Finding(Aspect.ACCURACY, "fail", "own", "bounce", "T1", "a/x", "dt=0.001",
                  bit=Bit.ACCURACY)  # fmt: skip
    elsewhere = {"case": "fall", "variant": "T2", "label": "a/y", "rung": "dt=0.002"}
    others = [changed(own, **{name: other}) for name, other in elsewhere.items()]
    monkeypatch.setattr("vv.gate.judgement.judgement", lambda whole: [*others, own])
    assert [*job_tests._findings(manifest(one), one)] == [own]


@pytest.mark.parametrize(
    ("number", "fate", "lost"),
    [(0, "passed", ()), (1, "failed", ()), (2, "skipped", ()), (2, "skipped", ("b",)),
     (2, "failed", ("a",)), (3, "passed", ())],
)  # fmt: skip
def test_a_job_of_pytest_fails_by_what_is_red_and_is_skipped_if_it_was_refused(
    number: int, fate: str, lost: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A refusal fails too if nothing of the code ran, whose file was named."""
    fine = record("a/x", "T1", 1e-3)
    refused = changed(fine, status="refused", reason="it has no walls")
    records = (fine, changed(fine, variant="T2"), refused, changed(fine, variant="T3"))
    red = Finding(Aspect.ACCURACY, "fail", "too far", "bounce", "T2", "a/x", "dt=0.001",
                  bit=Bit.ACCURACY)  # fmt: skip
    shown = dataclasses.replace(red, variant="T3", enforced=False)
    monkeypatch.setattr("vv.gate.judgement.judgement", lambda whole: [red, shown])
    whole = manifest(*records)
    invocation = some(answered=lambda: whole, lost=lambda: set(lost), again=lambda *_: "")
    test: Any = some(invocation=invocation, number=number)
    if fate == "passed":
        job_tests.JobTest.runtest(test)
        return
    kind = pytest.fail.Exception if fate == "failed" else pytest.skip.Exception
    said = "too far" if number == 1 else "refused: it has no walls"
    with pytest.raises(kind, match=said):
        job_tests.JobTest.runtest(test)
