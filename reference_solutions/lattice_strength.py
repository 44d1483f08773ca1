"""Where the first bond of a pulled close-packed block opens (after Liu et al. 2017, section 5.2).

The block stands between smooth platens and answers linearly, so that the most stretched of its
bonds opens at a strain xb over its stretch at the strain 1. It lies at a face, where elements have
fewer bonds than inside: this is why blocks are weaker than Eq. 7 says, by 5.8 % at 82 elements and
9.7 % at 37681. A block whose platens are carried apart fails with it. Finite strain adds some 1e-4.
"""

import numpy as np

from reference_solutions.close_packed_lattice import Lattice, Static
from reference_solutions.parameters import require_positive


def first_opening(block: Lattice, answer: Static, xb: float) -> float:
    """The stress [Pa] on the hull's area at which a bond is first stretched by xb [m].

    Raises ValueError unless xb is positive.
    """
    require_positive("m", xb=xb)
    i, j = block.bonds.T
    offset = block.position[j] - block.position[i]
    n = offset / np.linalg.norm(offset, axis=1)[:, None]
    stretch = np.einsum("bk,bk->b", n, answer.u[j] - answer.u[i])
    return float(answer.E * xb / stretch.max())
