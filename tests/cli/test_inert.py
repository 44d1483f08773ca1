"""What is said beside results: inert parameters that were changed, and why a setting is refused."""

from __future__ import annotations

import pytest

from vv.case import Level
from vv.cli.query_commands import explain
from vv.plan.plan import Options
from vv.plan.planning import make_plan
from vv.plan.project import find


def test_a_job_says_which_changed_parameters_are_inert_and_why() -> None:
    for setting, said in (("m=1e-3", "m = 0.001: inert, since the exact answer"), ("d=2e-3", "")):
        options = Options(codes=("dem",), settings=(setting,))
        jobs = make_plan(find(), ("tetrahedral-unit:pulled",), options).jobs
        assert jobs
        assert all(job.inert.startswith(said) and bool(job.inert) == bool(said) for job in jobs)


def test_explain_says_why_a_setting_or_a_level_is_refused(
    capsys: pytest.CaptureFixture[str],
) -> None:
    refusal = "dem/default: not supported: dt = 0.2 s is beyond the largest stable step 0.125483 s"
    for rungs, refused in ((["dt=0.2"], True), (["dt=1e-3"], False), (None, False)):
        explain(["single-contact:T4"], "dem/default", rungs=rungs)
        assert (refusal in capsys.readouterr().out) is refused
    explain(["masonry"], "dem/default", level=Level.PAPER)
    at_paper = capsys.readouterr().out
    explain(["masonry"], "dem/default")
    assert "masonry:" in at_paper
    assert len(at_paper) > len(capsys.readouterr().out)
