"""The time to rest of four bonded elements that may rotate, with viscosity on their centres only.

Equal elements of mass m and inertia 2/5 m r^2 are joined by bonds of length d = 2 r with kn along
and ks across them; a shear spring resists the slip u_j - u_i - (d/2) (w_i + w_j) x n. Three
elements stand on a smooth plane. Rotation is damped only as far as it moves the centres, which is
less the smaller ks is.
"""

import numpy as np
from numpy.typing import NDArray

from reference_solutions.bonds.lattice_material import require_springs
from reference_solutions.parameters import require_positive

Array = NDArray[np.float64]
STILL = 1e-9  # decay rates smaller than this, over the fastest rate, are of modes without stiffness


# The case passes its parameters by name, one for one.
def time_to_rest(
    corners: Array, edges: NDArray[np.int64], free: NDArray[np.bool_], load: Array, part: float, *,
    kn: float, ks: float, d: float, m: float, eta: float,
) -> float:  # fmt: skip
    """The time [s] after which the unit under a sudden load is at rest to a given accuracy.

    It is the least time after which no mode moves a centre by more than `part` of the largest
    displacement. corners (4, 3) in diameters; edges (6, 2); free (4, 3): whether each centre may
    move along each axis; load (4, 3). Raises ValueError for springs, sizes or viscosities out
    of range.
    """
    require_springs(kn, ks, d)
    require_positive("in SI units", m=m, eta=eta, part=part)
    mass = np.repeat([m, 0.1 * m * d**2], 12)
    held = np.concatenate([free.ravel(), np.ones(12, bool)])
    root = np.sqrt(mass)[held]
    stiff = _stiffness(corners, edges, kn, ks, d)[np.ix_(held, held)] / np.outer(root, root)
    drag = np.diag((np.repeat([eta, 0.0], 12) / mass)[held])
    moved = np.linalg.lstsq(stiff, np.concatenate([load.ravel(), np.zeros(12)])[held] / root,
                            rcond=1e-10)[0]  # fmt: skip
    none = np.zeros_like(stiff)
    rates, modes = np.linalg.eig(np.block([[none, np.eye(len(stiff))], [-stiff, -drag]]))
    begun = np.concatenate([-moved, 0.0 * moved]).astype(complex)
    parts = np.abs(np.linalg.lstsq(modes, begun, rcond=None)[0])
    centres = int(free.sum())
    size = parts * np.abs(modes[:centres]).max(axis=0) / np.abs(moved[:centres]).max()
    fading = -rates.real
    seen = (size > part) & (fading > STILL * np.abs(rates).max())
    return float((np.log(size[seen] / part) / fading[seen]).max(initial=0.0))


def _stiffness(corners: Array, edges: NDArray[np.int64], kn: float, ks: float, d: float) -> Array:
    """The stiffness matrix (24, 24) for all displacements, then all rotations."""
    whole = np.zeros((24, 24))
    for i, j in edges:
        n = corners[j] - corners[i]
        x, y, z = 0.5 * d * n
        lever = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])  # times w: (d/2) n x w
        slip = np.zeros((3, 24))
        slip[:, 3 * i : 3 * i + 3], slip[:, 3 * j : 3 * j + 3] = -np.eye(3), np.eye(3)
        slip[:, 12 + 3 * i : 15 + 3 * i] = slip[:, 12 + 3 * j : 15 + 3 * j] = lever
        spring = (kn - ks) * np.outer(n, n) + ks * np.eye(3)
        whole += slip.T @ spring @ slip
    return whole
