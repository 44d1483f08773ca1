"""What a dry run lists: a line for each scheme and variant, and how many jobs would run."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from vv.ask import Run, Status
from vv.output.listing import print_jobs


def job(label: str, fate: Status | None = None) -> Any:
    """A job by its label; fate: what is known of it before it runs."""
    variant, scheme, *_ = label.split()
    code, _, own = scheme.partition("/")
    settled = None if fate is None else Run(fate, "so it is")
    return SimpleNamespace(
        name=f"{variant} {scheme}", label=label, code=code, scheme=own, settled=settled
    )


def test_jobs_that_are_stored_and_that_would_run_are_listed_and_counted_apart(
    capsys: pytest.CaptureFixture[str],
) -> None:
    jobs = [
        job("fall:up dem/default dt=0.3"),
        job("fall:up dem/default dt=0.2"),
        job("fall:up dem/default dt=0.1"),
        job("fall:up exact/default"),
        job("fall:up yade/default dt=0.1", Status.REFUSED),
        job("fall:up dem/default dt=9", Status.REFUSED),  # other settings of it run
    ]
    print_jobs(SimpleNamespace(jobs=jobs), {0, 2, 3})  # type: ignore[arg-type]  # no more is read
    assert capsys.readouterr().out.splitlines() == [
        "fall:up dem/default  dt=0.3 dt=0.1  (stored)",
        "fall:up dem/default  dt=0.2",
        "fall:up exact/default  (stored)",
        "not supported: yade/default",
        "6 jobs, 1 would run, 3 are stored, 2 not supported",
    ]
