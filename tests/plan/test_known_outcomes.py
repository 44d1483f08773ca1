"""Claims about outcomes that are known without running, above all at the points of a map."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from vv.ask import Knobs, Run, Status
from vv.plan import planning

REFUSED, LONG = Run(Status.REFUSED, "it slips"), Run(Status.TOO_LONG, "an hour")


def outcome(
    monkeypatch: pytest.MonkeyPatch, asked: Knobs, rungs: list[Knobs], taken: set[float],
    run: Run | None = REFUSED, unfit: str | None = None,
) -> Run | None:  # fmt: skip
    """What is known of a point of a map whose shorter steps a scheme takes, or does not."""

    def known(adapter: Any, scheme: Any, ask: Any, found: Any) -> Run | None:
        return None if ask.knobs.dt in taken else REFUSED

    monkeypatch.setattr(planning, "_known_outcome", lambda *given: run)
    monkeypatch.setattr(planning, "knobs_in_scene", lambda study: ())
    monkeypatch.setattr(planning, "project_knobs", lambda knobs, scheme, own: knobs)
    monkeypatch.setattr(planning, "no_steps", lambda ask: unfit)
    monkeypatch.setattr(planning, "known_beforehand", known)
    posed: Any = SimpleNamespace(
        trial=SimpleNamespace(study=None), rungs=rungs, ask=lambda k: SimpleNamespace(knobs=k)
    )
    nothing: Any = None
    ask: Any = SimpleNamespace(knobs=asked)
    return planning._known_outcome_on_map(posed, nothing, nothing, ask, nothing)


ROW = [Knobs(dt, kn) for kn in (1e8, 1e9) for dt in (4.0, 2.0, 1.0)]


@pytest.mark.parametrize(
    ("asked", "taken", "runs"),
    [
        (Knobs(4.0, 1e8), {1.0}, True),  # it is refused for its length alone
        (Knobs(4.0, 1e8), {2.0, 1.0}, True),
        (Knobs(4.0, 1e8), set(), False),
        (Knobs(1.0, 1e8), {1.0}, False),  # none is shorter
        (Knobs(1.0, 1e8), {4.0}, False),
        (Knobs(4.0, 1e7), {1.0}, False),  # of another row
        (Knobs(None, 1e8), {1.0}, False),
    ],
)
def test_a_step_on_a_map_that_is_refused_is_run_where_a_shorter_one_is_taken(
    asked: Knobs, taken: set[float], runs: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert outcome(monkeypatch, asked, ROW, taken) == (None if runs else REFUSED)


@pytest.mark.parametrize("run", [None, LONG, Run(Status.NOT_INSTALLED, "no")])
def test_what_is_not_refused_is_known_as_elsewhere(
    run: Run | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert outcome(monkeypatch, Knobs(4.0, 1e8), ROW, set(), run) == run
    assert outcome(monkeypatch, Knobs(4.0, 1e8), ROW, {1.0}, run) == run


def test_steps_that_do_not_fit_are_refused_whatever_shorter_ones_do(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert outcome(monkeypatch, Knobs(4.0, 1e8), ROW, {1.0}, unfit="too long") == REFUSED


@pytest.mark.parametrize(
    ("why", "known", "found"),
    [
        ("", None, None),
        ("an hour", None, "an hour"),
        ("an hour", REFUSED, "it slips"),
        ("", REFUSED, "it slips"),
    ],
)
def test_what_takes_too_long_is_told_unless_it_is_refused(
    why: str, known: Run | None, found: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(planning, "known_beforehand", lambda *given: known)
    monkeypatch.setattr(planning, "why_too_long", lambda *given: why)
    posed: Any = SimpleNamespace(trial=SimpleNamespace(study=None))
    some: Any = SimpleNamespace(knobs=None, pace=None)
    told = planning._known_outcome(posed, some, some, some, some)
    assert (told and told.reason) == found
    assert told is known or (told is not None and told.status is Status.TOO_LONG)
