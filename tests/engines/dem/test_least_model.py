"""Claims about reduced models of the DEM engine: as accurate as the general one, and cheaper."""

from __future__ import annotations

import dataclasses
import json
import time

import numpy as np
import pytest

from adapters.dem import ADAPTER, LEAPFROGS, SCHEMES
from tests import ROOT
from tests.scenes.spheres.dem_contacts import VARIANTS, displacement, forced, unknowns_passed
from tests.support.adapters.small_asks import case_ask as asked
from vv.ask import Displacement
from vv.codes import Scheme, unsupported
from vv.engines import dem
from vv.engines.dem.solve import PreparedSpheres, solve
from vv.engines.dem.space.model import space
from vv.scene import Term

ANSWERS = json.loads((ROOT / "cases" / "answers" / "single-contact.json").read_text())


def test_t1_with_all_freedoms_and_terms_is_the_same_to_rounding() -> None:
    ask = asked("T1", 1e-3)
    least, full = dem.prepare(ask, dem.CENTRED), dem.prepare(forced(ask), dem.CENTRED)
    assert (least.model.unknowns, full.model.unknowns) == (1, 6)
    others = {Term.OBLIQUE_LOCK, Term.BLOCK, Term.RIGID_CONTACT, Term.CARRIED}
    others |= {Term.CONTACT_VISCOSITY, Term.VISCOUS_FRICTION, Term.HERTZ, Term.HERTZ_VISCOSITY}
    others |= {Term.MICRO_SLIP, Term.FLUID}
    others |= {Term.BOND, Term.BOND_SHEAR, Term.BREAKAGE}
    assert full.model.terms == ADAPTER.schemes[0].terms - others
    one, six = (displacement("T1", program.run(program.solve())) for program in (least, full))
    assert np.abs(one - six).max() <= 1e-13 * np.abs(one).max()


def test_the_minimal_model_of_t1_is_three_times_cheaper_a_step() -> None:
    ask = asked("T1", 1e-5)
    seconds = {}
    for name, question in (("least", ask), ("full", forced(ask))):
        program = dem.prepare(question, dem.CENTRED)
        program.warm()
        seconds[name] = min(_clocked(program) for _ in range(5))
    assert seconds["full"] > 3 * seconds["least"]


def _clocked(program: PreparedSpheres) -> float:
    began = time.perf_counter()
    program.solve()
    return time.perf_counter() - began


@pytest.mark.parametrize("scheme", LEAPFROGS)
@pytest.mark.parametrize("variant", ["T4", "T4-rotated"])
def test_the_general_model_holds_oblique_locks_to_rounding(variant: str, scheme: str) -> None:
    ask = asked(variant, 1e-3)
    least_model = dem.prepare(ask, LEAPFROGS[scheme])
    general = dataclasses.replace(least_model, system=space(ask.scene))
    y = displacement(variant, solve(ask, LEAPFROGS[scheme]))
    run = general.run(general.solve())
    # the overlap is the difference of lengths 450 times its size
    assert np.abs(displacement(variant, run) - y).max() <= 1e-12 * np.abs(y).max()
    least = solve(ask, LEAPFROGS[scheme]).ledger
    assert run.ledger is not None
    assert least is not None
    for term in ("kinetic", "shear elastic", "friction dissipation", "drag dissipation"):
        assert run.ledger.terms[term] == pytest.approx(least.terms[term], rel=1e-9)
    moved = run.values[Displacement(1)]
    assert np.abs(moved - np.outer(moved @ ask.scene.axes[1], ask.scene.axes[1])).max() < 1e-16


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_unknowns_are_those_of_the_committed_table(scheme: Scheme) -> None:
    name = scheme.name
    for variant in VARIANTS:
        ask = asked(variant, 1e-3)
        program = dem.prepare(ask, LEAPFROGS[name])
        count = ANSWERS[f"dem/{name}"][variant]
        assert unknowns_passed(program) == count, variant
        assert ADAPTER.describe(ask, name).unknowns == count
        assert unsupported(scheme, ask.scene.terms()) == frozenset()
