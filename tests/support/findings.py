"""Runs what the command of a finding runs: one variant, one scheme, one setting."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from bench.mutation.sensitivity import answer
from vv.ask import Ask, Knobs, Run, Status
from vv.case import Level, Norm, Trial
from vv.codes import Scheme
from vv.plan.project import find
from vv.records.record import measured

PROJECT = find(Path(__file__))


def asked(name: str, scheme: str, at: Knobs | Level | None) -> tuple[Trial, Scheme, Ask, Run]:
    """The trial of CASE:VARIANT NAME=VALUE..., the scheme, and what it answers at a setting.

    A level stands for its last setting, None for the first of the quick level.
    """
    name, *changed = name.split()
    case, _, variant = name.partition(":")
    code, _, which = scheme.partition("/")
    sets = {key: float(value) for key, value in (one.split("=") for one in changed)}
    trial = (told := PROJECT.load_case(case)).declare(variant, told.defaults(variant) | sets)
    adapter = PROJECT.load_adapter(code)
    own = next(one for one in adapter.schemes if one.name == which)
    rungs = trial.study.rungs
    knobs = rungs[at][-1] if isinstance(at, Level) else at or rungs[Level.QUICK][0]
    ask = trial.study.ask(knobs)
    return trial, own, ask, answer(adapter, own, ask)


def found(
    name: str, scheme: str, at: Knobs | Level | None, quantity: str,
    given: Mapping[str, float] = MappingProxyType({}),
) -> float:  # fmt: skip
    """The error of a quantity in a scheme, at these parameters and else the case's own."""
    changed = " ".join([name, *(f"{key}={value!r}" for key, value in given.items())])
    trial, own, ask, run = asked(changed, scheme, at)
    assert run.status is Status.RAN, run.reason
    wanted = next(one for one in trial.quantities if one.name == quantity)
    method = own.method_for(ask.scene.terms())
    error = measured(run, wanted, method, ask.knobs)[0].errors[Norm.MAX]
    assert error is not None
    return error
