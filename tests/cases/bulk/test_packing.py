"""Claims about a pack that comes to rest: a violation of any law is detected."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable

import numpy as np
import pytest

from cases.bulk import packing
from vv.ask import Displacement, Knobs, Method, Run, Status, Velocity
from vv.case import Level
from vv.engines import dem

TRIAL = packing.CASE.declare("seed-1", packing.CASE.defaults("seed-1"))


@functools.cache
def settled() -> Run:
    run = dem.solve_default(TRIAL.study.ask(TRIAL.study.rungs[Level.DEFAULT][0]))
    assert run.status is Status.RAN, run.reason
    return run


def _verdicts(run: Run) -> dict[str, str]:
    from vv.records.record import measured

    return {
        one.name: measured(run, one, Method.SECOND_ORDER, Knobs(dt=5e-5))[0].verdict.value
        for one in TRIAL.quantities
    }


def _changed(what: type, change: Callable[[np.ndarray], np.ndarray]) -> Run:
    run = settled()
    values = {k: change(v) if isinstance(k, what) else v for k, v in run.values.items()}
    return dataclasses.replace(run, values=values)


def _late(by: float) -> Callable[[np.ndarray], np.ndarray]:
    """A change that increases the last values by `by`."""
    return lambda v: v + by * (np.arange(len(v)) == len(v) - 1)[:, None]


def test_a_pack_at_rest_passes() -> None:
    assert set(_verdicts(settled()).values()) == {"pass"}


@pytest.mark.parametrize(
    ("name", "what", "change"),
    [
        ("momentum", Velocity, _late(1e-4)),
        ("decay", Velocity, _late(1e-2)),
        ("gain", Velocity, _late(0.2)),
        ("gain", Displacement, _late(1e-3)),
        ("still", Displacement, _late(1e-5)),
        ("floor", Displacement, _late(-1e-6)),
    ],
)
def test_what_breaks_a_law_is_seen(
    name: str, what: type, change: Callable[[np.ndarray], np.ndarray]
) -> None:
    assert _verdicts(_changed(what, change))[name] == "fail"
