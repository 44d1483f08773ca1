"""Claims about units of four pulled or pressed to failure: bounds follow the viscosity."""

from __future__ import annotations

import pytest

from cases.bonds.tetrahedral_strength import CASE
from vv.ask import Method
from vv.case import Exact, Scalar

PRESSED = next(one.name for one in CASE.variants if one.name.startswith("pressed"))


def bound(times: float) -> float:
    """The bound of the compressive strength for `times` the usual viscosity."""
    p = CASE.defaults(PRESSED)
    usual = 45.0 / abs(p["rate"])
    quantities = CASE.declare(PRESSED, {**p, "eta": times * usual}).quantities
    strength = next(q for q in quantities if q.name == "C_u")
    assert isinstance(strength, Scalar)
    assert isinstance(strength.judge, Exact)
    return strength.judge.tolerance(Method.SECOND_ORDER).value


def test_stronger_dashpots_widen_the_bound_by_their_square_and_weaker_ones_narrow_nothing() -> None:
    assert bound(2.0) == pytest.approx(4.0 * bound(1.0))
    assert bound(0.5) == pytest.approx(bound(1.0))
