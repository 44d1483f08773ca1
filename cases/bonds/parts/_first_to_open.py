"""What blocks that are pulled assume: a bond opens before any slides, and that is soon seen."""

from __future__ import annotations

import numpy as np

from cases.bonds.parts._loading import RATES
from reference_solutions.bonds import lattice_material
from reference_solutions.bonds.close_packed_lattice import Lattice, Static
from reference_solutions.bonds.lattice_material import Element
from vv.case import Parameters


def delay(p: Parameters, block: Lattice, strain: float) -> float:
    """The part of its strain by which the slower block goes on while a wave passes it."""
    E = lattice_material.youngs_modulus(p["kn"], p["ks"], p["d"])
    speed = np.sqrt(E * p["d"] ** 3 / (np.sqrt(2.0) * p["m"]))
    return float(block.height / speed * abs(p["rate"]) / strain)


def require_opening(block: Lattice, answer: Static, element: Element, late: float) -> None:
    """Raise ValueError where a bond of a block that is pulled slides before the first one opens.

    late: the part of the strain by which the slower block goes on, see `delay`.
    """
    i, j = block.bonds.T
    offset, moved = block.position[j] - block.position[i], answer.u[j] - answer.u[i]
    n = offset / np.linalg.norm(offset, axis=1)[:, None]
    stretch = np.einsum("bk,bk->b", n, moved)
    across = np.linalg.norm(moved - stretch[:, None] * n, axis=1)
    opened = element.xb / stretch.max() * (1.0 + RATES[0] * late)
    loads = element.ks * across + element.mu_p * element.kn * stretch
    most = float(loads.max() * opened)
    if not most < element.fs0:
        raise ValueError(
            f"xb = {element.xb:.4g} m: bonds slide before the first one opens, where one bears "
            f"{most:.4g} N of shear and lost friction; that must be below fs0 = {element.fs0:.4g} N"
        )
