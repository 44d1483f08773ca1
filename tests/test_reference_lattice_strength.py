"""Claims about the stress at which the first bond of a pulled block opens."""

import pytest

from reference_solutions import lattice_material
from reference_solutions.checks import lattice_strength as crystal
from reference_solutions.close_packed_lattice import SIZES, lattice, static
from reference_solutions.lattice_strength import first_opening

D = 1e-3
ELEMENT = lattice_material.element(lattice_material.QUARTZITE, D)
KN, KS, XB = ELEMENT[:3]
EQ_7 = lattice_material.tensile_strength(KN, KS, XB, D)


def strength(N: int) -> float:
    block = lattice(*SIZES[N], D)
    return first_opening(block, static(block, KN, KS), XB)


@pytest.mark.parametrize("shape", [(2, 1, 1), (3, 2, 1), SIZES[82]])
def test_two_routes_agree(shape: tuple[int, int, int]) -> None:
    block = lattice(*shape, D)
    one = first_opening(block, static(block, KN, KS), XB)
    other = crystal.first_opening(*shape, KS / KN) * KN * XB / D**2
    assert one == pytest.approx(other, rel=1e-9)


def test_blocks_are_weaker_than_the_lattice_as_published() -> None:
    """The paper's mean over its blocks is 8.89 %; that of all nine sizes is 8.47 %."""
    short = [1 - strength(N) / EQ_7 for N in (82, 255, 580, 1105, 2166)]
    assert short == sorted(short)
    assert short[0] == pytest.approx(0.0582, abs=1e-4)
    assert short[-1] == pytest.approx(0.0878, abs=1e-4)


def test_a_stretch_must_be_positive() -> None:
    block = lattice(2, 1, 1, D)
    with pytest.raises(ValueError, match="xb"):
        first_opening(block, static(block, KN, KS), -1.0)
