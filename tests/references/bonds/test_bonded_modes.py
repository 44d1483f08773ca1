"""Claims about the fastest mode of bonded elements: two routes agree on chain, unit and lattice."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cases.bonds.parts._unit import CORNERS, EDGES
from reference_solutions.bonds import bonded_modes as modes
from reference_solutions.bonds.close_packed_lattice import lattice
from reference_solutions.checks.bonds import bonded_modes as pulled
from tests.support.turned_signs import caught, signs, turned

KN, KS, M = 46793831.1079, 8067901.91516, 1.87383297e-6
PATH = np.array([[0.0, 0.0, 0.0], [1.0, 0.2, 0.1], [0.3, 1.1, 0.4]]), np.array([[0, 1], [1, 2]])


@given(st.floats(0.0, 1.0), st.floats(0.1, 10.0))
@settings(max_examples=8)
def test_the_two_routes_agree(gamma: float, m: float) -> None:
    for position, bonds in (PATH, (CORNERS, EDGES)):
        one, other = (r.fastest_mode(position, bonds, 2.0, 2.0 * gamma, m) for r in (modes, pulled))
        assert one == pytest.approx(other, rel=1e-6)  # iteration separates close modes slowly


def test_they_agree_on_a_block_of_the_lattice() -> None:
    block = lattice(4, 2, 2, 1e-3)
    one, other = (r.fastest_mode(block.position, block.bonds, KN, KS, M) for r in (modes, pulled))
    assert one == pytest.approx(other, rel=1e-9)
    assert 2 / one == pytest.approx(1.41599e-7, rel=1e-5)


def test_nothing_in_the_unit_is_faster_than_its_breathing() -> None:
    fastest = modes.fastest_mode(CORNERS, EDGES, KN, KS, M)
    assert fastest == pytest.approx(2 * sqrt(KN / M), rel=1e-12)


def test_the_fastest_wave_limits_the_step_of_every_lattice() -> None:
    assert pulled.fastest_wave(5 / 29) == pytest.approx(modes.LATTICE, rel=1e-6)
    assert 2 / sqrt(modes.LATTICE * KN / M) == pytest.approx(1.33548e-7, rel=1e-5)


def same(route: object) -> bool:
    """Whether a route has the known fastest mode of a chain in a plane, and that of a wave."""
    found = route.fastest_mode(*PATH, 2.0, 0.5, 1.0)  # type: ignore[attr-defined]
    good = bool(np.isclose(found, modes.fastest_mode(*PATH, 2.0, 0.5, 1.0), rtol=1e-9))
    if hasattr(route, "square"):
        good &= bool(np.isclose(route.square(np.array([0.5, 0.0, 0.5]), 5 / 29), 8.959563075))
    return good


TRIED = ("fastest_mode", "square", "_contacts")
STARTS = ("1.0 + np.arange(3.0 * len(position))",)  # any start will do


@pytest.mark.parametrize("sign", signs(modes))
def test_any_wrong_sign_in_the_modes_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(modes, sign)))


@pytest.mark.parametrize("sign", signs(pulled, TRIED, STARTS))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(pulled, sign)))
