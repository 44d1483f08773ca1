"""Claims about energy in `rigid`: contacts exchange no more than their residuals allow."""

from __future__ import annotations

import numpy as np
import pytest

from vv.ask import Knobs, Ledger
from vv.engines import rigid
from vv.gate.judgement import breaches
from vv.plan.project import find

WEDGE = find().load_case("wedge")


def ledger(variant: str, knobs: Knobs, **given: float) -> Ledger:
    """The ledger of a wedge in a groove."""
    trial = WEDGE.declare(variant, {**WEDGE.defaults(variant), **given})
    found = rigid.solve(trial.study.ask(knobs)).ledger
    assert found is not None
    return found


@pytest.mark.parametrize("variant", ["xi-1", "xi-0.1", "xi-1e-06"])
@pytest.mark.parametrize("dt", [1e-2, 5e-3])
@pytest.mark.parametrize("g", [9.81, 3.3])
def test_what_rests_breaks_no_law(variant: str, dt: float, g: float) -> None:
    found = ledger(variant, Knobs(dt), dip=0.0, g=g)
    assert not [*breaches(found)]


def test_what_a_residual_gives_is_beside_the_energy_of_what_moves() -> None:
    found = ledger("xi-1", Knobs(1e-2))
    assert found.bound is not None
    assert found.bound <= 1e-11 * np.abs(list(found.terms.values())).max()


def test_energies_close_to_rounding_whatever_contacts_leave() -> None:
    found = ledger("xi-1e-06", Knobs(1e-2))
    seen, allowed = found.audits["energy beyond rounding [J]"]
    assert found.bound is not None
    assert seen <= allowed < 1e-3 * found.bound
