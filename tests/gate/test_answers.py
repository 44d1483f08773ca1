"""Claims about what schemes answer to a case: it is accepted with the results, and guarded."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import Tiny
from tests.support.fabricated import record, some
from vv.ask import Run, Status
from vv.case import Level
from vv.gate import answers
from vv.plan.plan import Options
from vv.records.finding import Bit
from vv.records.job_record import Record

CODES = ("--codes", "fake/good,fake/refuses,fake/weightless,missing")
UNWILLING = 'return "it does not feel like it" if scheme == "refuses" else None'


@pytest.fixture
def accepted(tiny: Tiny) -> Tiny:
    """The tiny project without the schemes that misbehave, and what it answers on record."""
    names = (tiny.root / "adapters/fake.py").read_text().partition("NAMES = (")[2].partition(")")
    tiny.edit("adapters/fake.py", names[0], '"good", "refuses"')
    done = tiny.vv("accept", "fall", "--reason", "it is right")
    assert done.returncode == 0, done.stderr
    return tiny


def on_record(project: Tiny) -> Path:
    return project.root / "cases" / "answers" / "fall.json"


def test_accepting_puts_on_record_the_unknowns_of_what_runs_and_why_others_refuse(
    accepted: Tiny,
) -> None:
    """A code that is not here has no answer yet."""
    weightless = "fake/weightless does not support: gravity, spheres"
    assert json.loads(on_record(accepted).read_text()) == {
        "fake/good": {"up": 1, "slow": 1},
        "fake/refuses": dict.fromkeys(("up", "slow"), "it does not feel like it"),
        "fake/weightless": dict.fromkeys(("up", "slow"), weightless),
    }
    assert accepted.vv("gate", "fall", *CODES).returncode == 0


def test_what_was_refused_and_runs_is_red_until_it_is_accepted(accepted: Tiny) -> None:
    accepted.edit("adapters/fake.py", UNWILLING, "return None")
    done = accepted.vv("gate", "fall", *CODES)
    assert done.returncode == 1
    assert "was refused: it does not feel like it; to accept that it runs" in done.stdout
    accepted.vv("accept", "fall", "--reason", "it changed its mind")
    assert accepted.vv("gate", "fall", *CODES).returncode == 0


def test_what_ran_and_is_refused_is_red(accepted: Tiny) -> None:
    accepted.edit("adapters/fake.py", 'if scheme == "refuses"', "if scheme")
    done = accepted.vv("gate", "fall", *CODES)
    assert done.returncode & Bit.ACCURACY
    assert "has a baseline, but now: refused" in done.stdout


def test_another_reason_to_refuse_is_noted(accepted: Tiny) -> None:
    accepted.edit("adapters/fake.py", "it does not feel like it", "it is tired")
    done = accepted.vv("gate", "fall", *CODES)
    assert done.returncode == 0
    assert "was refused: it does not feel like it; now: it is tired" in done.stdout


def test_a_scheme_that_is_not_on_record_is_not_compared(accepted: Tiny) -> None:
    table = json.loads(on_record(accepted).read_text())
    del table["fake/refuses"]
    on_record(accepted).write_text(json.dumps(table))
    accepted.edit("adapters/fake.py", UNWILLING, "return None")
    assert accepted.vv("gate", "fall", *CODES).returncode == 0


def test_answers_of_a_code_that_is_not_here_stay(accepted: Tiny) -> None:
    table = {**json.loads(on_record(accepted).read_text()), "missing/default": {"up": 7}}
    on_record(accepted).write_text(json.dumps(table))
    accepted.vv("accept", "fall", "--reason", "again")
    assert json.loads(on_record(accepted).read_text()) == table


def test_a_broken_file_is_a_usage_error_that_names_it(accepted: Tiny) -> None:
    on_record(accepted).write_text("{")
    done = accepted.vv("gate", "fall", *CODES)
    assert done.returncode == 64
    assert "answers/fall.json" in done.stderr


NO_WALLS = "it has no walls at 0.1 s"


def given(label: str, variant: str = "T1", status: str = "refused", **changes: Any) -> Record:
    reason = changes.pop("reason", "" if status == "ran" else NO_WALLS)
    return record(label, variant, 1e-3, status=status, reason=reason, **changes)


@pytest.mark.parametrize(
    ("one", "found"),
    [
        (given("a/x"), []),
        (given("a/x", reason="it has no walls at 0.25 s"), []),  # of another step
        (given("a/x", reason="it has no floor"), [("refused otherwise", Bit(0))]),
        (given("a/x", status="ran"), [("no longer refused", Bit.ACCURACY)]),
        (given("a/x", status="ran", modified=True), []),
        (given("a/x", status="error"), []),
        (given("a/x", "T2", "ran"), []),  # it ran before
        (given("a/x", "T3", "ran"), []),
        (given("a/y", status="ran"), []),
        (given("a/x", status="ran", case="fall"), []),
    ],
)
@pytest.mark.parametrize("enforced", [True, False])
def test_a_record_is_compared_with_what_its_scheme_answered_to_its_variant(
    one: Record, found: list[tuple[str, Bit]], enforced: bool
) -> None:
    known: answers.Answers = {"a/x": {"T1": NO_WALLS, "T2": 3}}
    seen = [*answers.compare("bounce", [one], known, enforced)]
    assert [(finding.kind, finding.bit) for finding in seen] == found
    for finding in seen:
        assert finding.enforced is enforced
        assert (finding.variant, finding.label, finding.rung) == ("T1", "a/x", "dt=0.001")
        assert finding.text.startswith(f"was refused: {NO_WALLS}; ")


def test_the_answers_of_the_project_itself_stand_before_those_that_came_with_the_case(
    tmp_path: Path,
) -> None:
    own, bundled = tmp_path / "own", tmp_path / "bundled"
    project: Any = some(roots=(own, bundled))
    assert answers.accepted(project, "fall") is None
    for root, count in ((bundled, 1), (own, 2)):
        (root / "cases" / "answers").mkdir(parents=True)
        (root / "cases" / "answers" / "fall.json").write_text(f'{{"a/x": {{"up": {count}}}}}')
        assert answers.accepted(project, "fall") == {"a/x": {"up": count}}


def test_a_scheme_answers_with_its_model_if_it_runs_any_setting_at_any_level(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def job(scheme: str, variant: str, reason: str = "", code: str = "a") -> Any:
        settled = Run(Status.REFUSED, reason) if reason else None
        return some(code=code, scheme=scheme, variant=variant, settled=settled, ask=len(variant))

    jobs = [job("x", "T1", "no"), job("x", "T1"), job("x", "T1", "nor here"), job("x", "T22"),
            job("y", "T1", "no"), job("z", "T1", code="absent")]  # fmt: skip
    model = some(describe=lambda ask, scheme: some(unknowns=ask))
    plan = some(
        jobs=jobs,
        found={"a": some(installed=True), "absent": some(installed=False)},
        adapters={"a": model, "absent": model},
    )
    asked: list[tuple[Any, ...]] = []

    def planned(*words: Any) -> Any:
        asked.append(words)
        return plan

    monkeypatch.setattr(answers, "make_plan", planned)
    project: Any = some()
    assert answers.given(project, "fall") == {"a/x": {"T1": 2, "T22": 3}, "a/y": {"T1": "no"}}
    assert asked == [(project, ["fall"], Options(Level.PAPER))]
