"""Claims about what `vv check` and jobs of pytest decide."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import pytest
import typer

from tests.support.fabricated import changed, manifest, record, some
from vv.ask import Run, Status
from vv.base.errors import UsageError
from vv.cli import check_command, job_tests
from vv.codes.tiny_scene_check import Answered, CheckResult
from vv.records.finding import Aspect, Bit, Finding


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
