"""Second route to unlike spheres in a row: Newton's equations of spheres on bonds in space.

The equations are nonlinear and assume no row. Each bond has a normal, which rotates, and a shear
displacement, a vector that rotates with the bond and grows with the relative displacement of the
surfaces across it.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
State = tuple[Array, Array, Array, Array]


# The case passes its parameters by name, one for one.
def motion(
    t: Array,
    bonds: NDArray[np.int64],
    *,
    m: Array,
    r: Array,
    x: Array,
    v: Array,
    spin: Array,
    length: Array,
    kn: Array,
    ks: Array,
    push: Array,
    eta: float = 0.0,
) -> Array:
    """Displacements (k, N, 3) [m] at times t (k,) [s] of spheres under constant forces `push`.

    x [m], v [m/s], spin [1/s], push [N]: (N, 3); eta [N s/m]: of the drag -eta v on every sphere.
    """
    from scipy.integrate import solve_ivp

    n, first = len(m), (x, v, spin, np.zeros((len(bonds), 3)))

    def rate(_: float, flat: Array) -> Array:
        state = _apart(flat, n, len(bonds))
        return np.concatenate(
            [
                one.ravel()
                for one in _rates(state, bonds, m, r, length, kn, ks, push - eta * state[1])
            ]
        )

    start = np.concatenate([one.ravel() for one in first])
    found = solve_ivp(rate, (0.0, t[-1]), start, "DOP853", t, rtol=1e-12, atol=1e-15)
    return np.asarray(found.y[: 3 * n].T.reshape(len(t), n, 3) - x)


def _apart(flat: Array, n: int, b: int) -> State:
    x, v, w, s = np.split(flat, [3 * n, 6 * n, 9 * n])
    return x.reshape(n, 3), v.reshape(n, 3), w.reshape(n, 3), s.reshape(b, 3)


def _rates(
    state: State,
    bonds: NDArray[np.int64],
    m: Array,
    r: Array,
    length: Array,
    kn: Array,
    ks: Array,
    push: Array,
) -> State:
    x, v, w, slip = state
    force, torque, slips = push.copy(), np.zeros_like(x), np.zeros_like(slip)
    for k, (i, j) in enumerate(bonds):
        apart = x[j] - x[i]
        far = np.linalg.norm(apart)
        n, beyond = apart / far, 0.5 * (far - r[i] - r[j])
        at_i, at_j = (r[i] + beyond) * n, -(r[j] + beyond) * n
        meets = v[j] + np.cross(w[j], at_j) - v[i] - np.cross(w[i], at_i)
        tips = np.cross(n, v[j] - v[i]) / far + 0.5 * np.dot(w[i] + w[j], n) * n
        slips[k] = meets - np.dot(meets, n) * n + np.cross(tips, slip[k])
        on_i = kn[k] * (far - length[k]) * n + ks[k] * slip[k]
        for body, arm, sign in ((i, at_i, 1.0), (j, at_j, -1.0)):
            force[body] += sign * on_i
            torque[body] += sign * np.cross(arm, on_i)
    return v, force / m[:, None], torque / (0.4 * m * r**2)[:, None], slips
