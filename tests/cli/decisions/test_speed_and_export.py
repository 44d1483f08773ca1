"""Claims about what `vv speed`, `export` and `list` decide."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace
from typing import Any

import pytest

from tests.support.fabricated import some
from vv.ask import Knobs, Run, Status
from vv.base.errors import UsageError
from vv.case import Level
from vv.cli import (
    export_command,
    query_commands,
    speed_command,
)
from vv.cli.speed_command import SpeedCall


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
