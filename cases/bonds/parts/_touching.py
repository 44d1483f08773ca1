"""What broken bonds that act as contacts change of the energy of blocks, within a step."""

from __future__ import annotations

import math

import numpy as np

from reference_solutions.bonds.close_packed_lattice import Lattice
from vv.case import Parameters


def touching(p: Parameters, block: Lattice, dt: float) -> float:
    """The energy [J] by which contacts that begin and end within a step dt [s] may change a block.

    Each changes it by up to kn (v dt)^2/8, and by 4 mu^2 kn/ks of that as its shear spring is cut
    off. Elements that an opening bond sets free separate at up to v^2 = 2 kn/m xb^2. The bonds of a
    cross-section may all be contacts, at random places within a step and of either sign, which add
    up to the root of their number.
    """
    z = block.position[block.bonds, 2]
    layers = np.unique(np.round(z, 9 - math.floor(math.log10(p["d"]))))
    cuts = 0.5 * (layers[1:] + layers[:-1])
    crossed = max(int(((z[:, 0] - at) * (z[:, 1] - at) < 0).sum()) for at in cuts)
    one = (p["kn"] * p["xb"] * dt) ** 2 / (4 * p["m"])
    return math.sqrt(crossed) * one * (1 + 4 * p["mu_p"] ** 2 * p["kn"] / p["ks"])


TOUCHING = (
    "broken bonds that act as contacts begin and end within a step, each with an error of up to kn "
    "(v dt)^2/8 and that of its shear spring; v is that of an opening bond, and as many bonds as a "
    "cross-section has may do so, of either sign"
)
