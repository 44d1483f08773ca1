"""Strengths of close-packed blocks between smooth rigid platens (Liu et al. 2017, section 5.2).

In tension a block responds linearly, so that its most stretched bond opens at a strain equal to xb
over its stretch at the strain 1. This bond lies at a face, where elements have fewer bonds than
inside. Blocks are therefore weaker than Eq. 7, by 5.8 % at 82 elements and 9.7 % at 37681. A block
whose platens move apart fails when this bond opens. The effect of finite strain is some 1e-4.

In compression a block widens until all its horizontal bonds are open, long before any inclined one
slides. Each element then has the same neighbours above and below. A uniform widening, under which
every inclined bond bears the same vertical force, is then an equilibrium at any strain. That force
is a third of the load on a unit without base bonds, so that all inclined bonds slide together, at
the strain at which those of the unit slide. On its hull a block with n elements in a row has 6n - 5
inclined bonds for each 6n - 6 of the infinite lattice, whatever p and q, and C_u is
1 + 1/(6n - 6) times that of the unit.
"""

import numpy as np

from reference_solutions.bonds.close_packed_lattice import Lattice, Static
from reference_solutions.bonds.lattice_material import Element
from reference_solutions.bonds.tetrahedral_unit import opened, sliding_failure
from reference_solutions.parameters import require_positive


def first_opening(block: Lattice, answer: Static, xb: float) -> float:
    """The stress [Pa] on the area of the hull at which a bond is first stretched by xb [m].

    Raises ValueError unless xb is positive.
    """
    require_positive("m", xb=xb)
    i, j = block.bonds.T
    offset = block.position[j] - block.position[i]
    n = offset / np.linalg.norm(offset, axis=1)[:, None]
    stretch = np.einsum("bk,bk->b", n, answer.u[j] - answer.u[i])
    return float(answer.E * xb / stretch.max())


def sliding(block: Lattice, element: Element, d: float) -> float:
    """The pressure [Pa] on the area of the hull at which all inclined bonds of length d [m] slide.

    Raises ValueError where `sliding_failure` of the unit does.
    """
    return _borne(block, sliding_failure(element, d).fz)


def opened_slope(block: Lattice, element: Element, d: float, strains: tuple[float, float]) -> float:
    """The slope [Pa] of pressure between two compressive strains, with all level bonds open.

    Raises ValueError where the unit has no equilibrium.
    """
    low, high = (_borne(block, opened(-strain, element, d).fz) for strain in strains)
    return (high - low) / (strains[1] - strains[0])


def _borne(block: Lattice, fz: float) -> float:
    """The pressure [Pa] of a block whose inclined bonds are loaded as in a unit under fz [N]."""
    lowest = block.at(2, 0)[block.bonds]
    crossing = int((lowest[:, 0] != lowest[:, 1]).sum())
    return -crossing * fz / 3.0 / block.area
