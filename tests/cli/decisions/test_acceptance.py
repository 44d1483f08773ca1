"""Claims about what `vv accept` and `vv record` decide."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.fabricated import manifest, record, some
from vv.ask import Knobs
from vv.base.errors import UsageError
from vv.case import Level, Variant
from vv.cli import baseline_commands
from vv.plan.plan import EmptyPlanError
from vv.records.manifest import CodeFound


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
    both: Any = baseline_commands._levels_of(project, "fall", "a,b/x")
    assert both == "plan quick, plan default"
    assert asked == [(["fall"], level, ("a", "b/x")) for level in (Level.QUICK, Level.DEFAULT)]
    one: Any = baseline_commands._levels_of(project, "slow", "*")
    assert one == "plan default"
    with pytest.raises(UsageError, match="no scheme of later runs at level default"):
        baseline_commands._levels_of(project, "later", "*")
    with pytest.raises(UsageError, match="accept takes the name of one case, not 'f\\*'"):
        baseline_commands._levels_of(project, "f*", "*")


def test_variants_that_begin_at_level_paper_are_accepted_when_that_is_asked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    variants = [Variant("a", "", ""), Variant("b", "", "", level=Level.PAPER)]
    jobs = {level: [some(case="fall", variant=name) for name in names] for level, names in (
        (Level.QUICK, "a"), (Level.DEFAULT, "a"), (Level.PAPER, "ab"))}  # fmt: skip
    monkeypatch.setattr("vv.cli.options.plan_of", lambda _, __, options: jobs[options.level])
    monkeypatch.setattr("vv.plan.plan.merge_plans", lambda one, other: [*one, *other])
    monkeypatch.setattr("vv.plan.plan.with_jobs_kept", lambda plan, keep: [*filter(keep, plan)])
    project: Any = some(case_names=lambda: ["fall"], load_case=lambda name: some(variants=variants))
    for paper, names in ((False, "aa"), (True, "aab")):
        found: Any = baseline_commands._levels_of(project, "fall", "*", paper)
        assert "".join(one.variant for one in found) == names
    assert baseline_commands._later(project, "fall") == {"b"}


def test_what_only_level_paper_runs_keeps_its_results(monkeypatch: pytest.MonkeyPatch) -> None:
    def job(variant: str, dt: float | None) -> Any:
        ask = some(knobs=Knobs(dt=dt))
        return some(variant=variant, code="dem", scheme="default", ask=ask)

    whole = some(jobs=[job("a", 0.1), job("a", 0.05), job("b", None)])
    monkeypatch.setattr("vv.cli.options.plan_of", lambda *_: whole)
    done: Any = some(jobs=[job("a", 0.1)])
    names = baseline_commands._later_results(some(), "fall", done)
    assert names == {"a dem/default dt=0.05", "b dem/default"}


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
        ("vv.cli.baseline_commands._levels_of", lambda *_: "plan"),
        ("vv.cli.baseline_commands._run", lambda project, plan, timing: whole),
        ("vv.cli.baseline_commands._run_nudged", lambda *_: []),
        ("vv.cli.baseline_commands._later_results", lambda *_: frozenset()),
        ("vv.cli.baseline_commands._write_baseline", lambda *words: wrote.append(words[-2])),
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
