"""Claims about what `vv list` shows: variants that words fit, and those that a code can run."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from vv.ask import Status
from vv.base.errors import UsageError
from vv.cli.query_commands import _fitting, _run_by


def case(name: str, title: str, **summaries: str) -> Any:
    variants = [SimpleNamespace(name=key, summary=text) for key, text in summaries.items()]
    return SimpleNamespace(name=name, title=title, variants=variants)


CASES = [case("fall", "A ball falls", up="thrown up", down="thrown down"),
         case("slide", "A block slides", level="on a floor")]  # fmt: skip
FAMILIES = {"fall": "free", "slide": "hard"}


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("down", {"fall": ["down"], "slide": []}),
        ("thrown", {"fall": ["up", "down"], "slide": []}),
        ("ball", {"fall": ["up", "down"], "slide": []}),  # the title speaks for all
        ("floor or up", {"fall": ["up"], "slide": ["level"]}),
        ("hard", {"fall": [], "slide": ["level"]}),
    ],
)
def test_words_fit_a_variant_or_the_title_of_its_case(
    words: str, found: dict[str, list[str]]
) -> None:
    assert _fitting(FAMILIES, CASES, words) == found


def test_what_a_variant_lacks_is_not_found_by_its_word() -> None:
    cases = [case("fall", "A ball falls", bare="up, no drag", free="without drag", wet="drag")]
    assert _fitting({"fall": "free"}, cases, "drag") == {"fall": ["wet"]}


def test_words_that_fit_nothing_are_refused() -> None:
    with pytest.raises(UsageError, match="matches no variant"):
        _fitting(FAMILIES, CASES, "nowhere")


def test_a_code_runs_a_variant_of_which_some_job_is_not_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told: dict[str, list[Status | None]] = {
        "runs": [None],
        "absent": [Status.NOT_INSTALLED],
        "long": [Status.TOO_LONG],
        "refused": [Status.REFUSED, Status.REFUSED],
        "partly": [Status.REFUSED, None],
    }
    jobs = [
        SimpleNamespace(case="c", variant=name, settled=one and SimpleNamespace(status=one))
        for name, every in told.items()
        for one in every
    ]
    plan = SimpleNamespace(jobs=jobs)
    monkeypatch.setattr("vv.cli.options.plan_of", lambda *given: plan)
    project: Any = None
    found = {variant for _, variant in _run_by(project, ["c"], "dem")}
    assert found == {"runs", "absent", "long", "partly"}
