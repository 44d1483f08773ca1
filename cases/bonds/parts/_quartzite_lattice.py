"""Numbers of the close-packed lattice for quartzite, to which statements of a paper refer."""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from reference_solutions.bonds import lattice_directions, tetrahedral_unit
from reference_solutions.bonds import lattice_material as theory
from reference_solutions.bonds.close_packed_lattice import SIZES, lattice, static
from reference_solutions.bonds.lattice_strength import first_opening

D = 1e-3  # m
MASS = theory.element_mass(2650.0, D)
ELEMENT = theory.element(theory.QUARTZITE, D)
KN, KS, XB, FS0, MU_P = ELEMENT
BLOCK = lattice(*SIZES[82], D)
MODULI = (  # error of E [%] of the blocks, on the hull's area; of nu
    (3.64, 2.29, 1.69, 1.34, 1.05, 0.83, 0.65, 0.54, 0.44),
    (-1.28, -0.80, -0.39, -0.14, 1.10, 0.46, 0.75, 0.62, 0.54),
)


def first_pair() -> NDArray[np.int64]:
    """The two elements whose bond opens first as a block of 82 is pulled."""
    i, j = BLOCK.bonds.T
    n, u = (BLOCK.position[j] - BLOCK.position[i]) / D, static(BLOCK, KN, KS).u
    return np.asarray(BLOCK.bonds[int(((u[j] - u[i]) * n).sum(axis=1).argmax())])


def at_faces(elements: NDArray[np.int64]) -> float:
    """How many of these elements have fewer than the twelve bonds of an inner one."""
    return float((np.bincount(BLOCK.bonds.ravel())[elements] < 12).sum())


def over_printed(state: tetrahedral_unit.State, printed: float) -> float:
    """The difference of a strength from the printed formula, in %."""
    return 100.0 * (abs(state.stress) / printed - 1.0)


def softest_direction() -> float:
    """The least E over E_z; around the axis all directions are alike."""
    tilts = np.linspace(0.0, np.pi / 2.0, 181)
    sides = np.stack([np.cos(tilts), np.zeros(181), np.sin(tilts)], axis=1)
    return min(share_of_modulus(side.tolist()) for side in sides)


def mean_error(which: int, signed: bool = True) -> float:
    errors = MODULI[which]
    return sum(e if signed else abs(e) for e in errors) / len(errors)


def bonds_downward() -> float:
    """The fewest bonds that an element of the last layer has with the layer below."""
    top = BLOCK.at(2, 1)[BLOCK.bonds]
    crossing = BLOCK.bonds[top.sum(axis=1) == 1]
    ends = crossing[BLOCK.at(2, 1)[crossing]]
    return float(np.bincount(ends)[np.flatnonzero(BLOCK.at(2, 1))].min())


def decay_rate() -> float:
    """The decay rate eta/m [1/s] of kinetic energy by Eq. 28, in a block of 2166."""
    block = lattice(*SIZES[2166], D)
    return float(D / (block.area * block.height) ** (1.0 / 3.0)) * sqrt(8.0 * KN / MASS)


def energy_dropped() -> float:
    """The part [%] of its elastic energy that a lattice of constant length loses at A1."""
    with_base = 9.0 * KN * (KN + KS) / (5.0 * KN + KS)  # Fz/dz by Eq. 2a
    without = 9.0 * KN * KS / (KN + 2.0 * KS)  # by Eq. 9, with Fx = 0
    return 100.0 * (1.0 - without / with_base)


def shear_at_break() -> float:
    """F_s1 over F_smax as a pulled unit breaks: by Eqs. 1, 2b and 2c."""
    shear = 2.0 * sqrt(2.0) * KN / (3.0 * KN + KS) * XB * KS
    return shear / (FS0 - MU_P * KN * XB)


def raised_strength() -> float:
    """T_u of a block of 82 over the quartzite's, once its X_b is increased by 9.76 %."""
    return first_opening(BLOCK, static(BLOCK, KN, KS), 1.0976 * XB) / 25e6


def strength_slid(times: float) -> float:
    """C_u [Pa] of a unit with `times` the shear resistance."""
    stronger = ELEMENT._replace(fs0=times * FS0)
    return -tetrahedral_unit.sliding_failure(stronger, D).stress


def first_at_platens() -> float:
    """The number of the two elements of the first bond to open that touch a platen."""
    return float((BLOCK.at(2, 0) | BLOCK.at(2, 1))[first_pair()].sum())


def share_of_modulus(direction: list[float]) -> float:
    """E along a direction of the lattice over that along the axis of the unit."""
    along = lattice_directions.modulus(direction, kn=KN, ks=KS, d=D)
    return along / theory.youngs_modulus(KN, KS, D)
