"""Claims about the map of stable steps: what changes with the stiffness, and what is known."""

from __future__ import annotations

import datetime

import pytest

from cases.stability.stability_map import CASE
from tests import ROOT
from tests.findings.figures import asked
from tests.support.fabricated import record
from vv.ask import Status
from vv.case import Grid, Level
from vv.gate import known_breaches
from vv.gate.judgement import unknown_breaches
from vv.gate.ledger_file import read_breaches

BREACHES = read_breaches(ROOT / "cases" / "disagreements.toml")
TODAY = datetime.date(2026, 11, 1)
MOST = 1000  # steps of a run; finer ones sink as deep
SCHEMES = (
    *(f"dda/{name}" for name in ("default", "published", "lagged", "generalised-alpha")),
    *("dda/augmented-lagrangian", "dem/default", "dem/published"),
)


@pytest.mark.parametrize("kn", [1e5, 1e9, 1e12])
def test_a_unit_on_stiffer_bonds_is_as_much_heavier_and_swings_as_fast(kn: float) -> None:
    study = CASE.declare("unit", CASE.defaults("unit")).study
    assert isinstance(study, Grid)
    assert study.scene_with_kn is not None
    own, other = study.scene, study.scene_with_kn(kn)
    assert own.bonds is not None
    assert other.bonds is not None
    assert other.bonds.kn == pytest.approx(kn)
    stiffer, heavier = kn / own.bonds.kn[0], other.spheres.mass / own.spheres.mass
    assert heavier / stiffer == pytest.approx(1.0)


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("variant", ["incline", "responding-block"])
@pytest.mark.parametrize("kn", [1e4, 1e5, 1e6, 1e7, 1e8])
def test_what_a_code_violates_on_soft_springs_or_in_long_steps_is_known(
    variant: str, kn: float, scheme: str
) -> None:
    """Every law broken lies within a band, and every band has its law broken."""
    study = CASE.declare(variant, {}).study
    for knobs in study.rungs[Level.PAPER]:
        steps = study.ask(knobs).goal.steps(knobs.dt or 1.0)
        if knobs.kn != kn or not 1 <= steps <= MOST:
            continue
        run = asked(f"stability-map:{variant}", scheme, knobs).run
        if run.status is not Status.RAN:
            continue
        one = record(
            scheme, variant, knobs.dt, case="stability-map", code_version="0.1.0",
            rung=knobs, ledger=run.ledger, study="grid",
        )  # fmt: skip
        (judged,) = known_breaches.judge([one], BREACHES, TODAY)
        assert not list(unknown_breaches(judged))
        assert not list(known_breaches.not_broken([judged], BREACHES, TODAY))
