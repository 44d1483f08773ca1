"""Claims that a run says when a parameter was changed that the exact answer does not contain."""

from __future__ import annotations

from vv.plan.plan import Options
from vv.plan.planning import make_plan
from vv.plan.project import find


def test_a_job_says_which_changed_parameters_are_inert_and_why() -> None:
    for setting, said in (("m=1e-3", "m = 0.001: inert, since the exact answer"), ("d=2e-3", "")):
        options = Options(codes=("dem",), settings=(setting,))
        jobs = make_plan(find(), ("tetrahedral-unit:pulled",), options).jobs
        assert jobs
        assert all(job.inert.startswith(said) and bool(job.inert) == bool(said) for job in jobs)
