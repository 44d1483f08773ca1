"""A close-packed block compressed slowly until its level bonds are open (Liu et al. 2017, Fig. 5).

Between smooth rigid platens the block is a linear network (`close_packed_lattice`), whose bonds are
removed as they open: at a strain e the stretch of a bond is e times that at the strain 1, and the
bond opens at xb. A bond that opens passes its load to its neighbours, some of which then open at
the same strain. The stress falls at each opening (A3 and A1 of Fig. 5). Equilibrium does not
determine which of two overstretched bonds opens first; here it is the most stretched one, together
with all bonds whose stretch is within 2 % of it.

When all level bonds are open, every inclined bond bears the same vertical force
(`lattice_strength`), and the block follows the path of units without base bonds until they slide
(A2).

Where shear springs are weak, ks/kn below 0.03 in a block of 82 elements, some inclined bonds are
pulled, and open before the last level bond does; then the others bear unequal forces.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from reference_solutions.bonds.close_packed_lattice import Lattice, static
from reference_solutions.parameters import require_positive

Array = NDArray[np.float64]
TOGETHER = 0.02  # relative difference from the largest stretch up to which bonds open with it
LEVEL = 0.1  # sine of the slope up to which a bond counts as level


class History(NamedTuple):
    """The openings in order, (k,) each: compressive strain, modulus [Pa] and open bonds after it.

    whole: the modulus [Pa] before the first opening; pulled: the largest stretch of an inclined
    bond at any opening, over xb.
    """

    strain: Array
    modulus: Array
    opened: NDArray[np.int64]
    whole: float
    pulled: float = 0.0

    def stress(self, strain: Array) -> Array:
        """The pressure (k,) [Pa] on the area of the hull at compressive strains (k,)."""
        modulus = np.concatenate([[self.whole], self.modulus])
        return np.asarray(strain * modulus[np.searchsorted(self.strain, strain, "right")])

    def before(self) -> Array:
        """The pressure (k,) [Pa] just before each opening."""
        return np.asarray(self.strain * np.concatenate([[self.whole], self.modulus[:-1]]))


def pressed(block: Lattice, kn: float, ks: float, xb: float, together: float = TOGETHER) -> History:
    """All openings of a block as its strain grows from zero; raises ValueError for xb <= 0.

    together: the relative difference from the largest stretch up to which bonds open with it.
    """
    require_positive("m", xb=xb)
    strain, modulus, opened, now, pulled, bonds = [], [], [], 0.0, 0.0, block.bonds
    whole = answer = static(block, kn, ks)
    while True:
        i, j = bonds.T
        offset = block.position[j] - block.position[i]
        n = offset / np.linalg.norm(offset, axis=1)[:, None]
        stretch = np.einsum("bk,bk->b", n, answer.u[i] - answer.u[j])  # at the strain -1
        if not stretch.max() > 1e-9 * block.height:
            break
        now = max(now, xb / float(stretch.max()))
        inclined = stretch[np.abs(n[:, 2]) > LEVEL]
        pulled = max(pulled, now * float(inclined.max(initial=0.0)) / xb)
        bonds = bonds[stretch < (1.0 - together) * stretch.max()]
        answer = static(block._replace(bonds=bonds), kn, ks)
        strain.append(now)
        modulus.append(answer.E)
        opened.append(len(block.bonds) - len(bonds))
    return History(np.array(strain), np.array(modulus), np.array(opened), whole.E, pulled)
