"""A body that rotates freely until a corner hits a smooth plane: elliptic functions, one impact.

For the principal moments of inertia I [kg m2] and the spin w in the principal axes, the conserved
energy and angular momentum L = |I w| give (Landau and Lifshitz, Mechanics, section 37)
w1 ~ cn(q, k), w2 ~ sn(q, k), w3 ~ dn(q, k), with q = a (t - t0), where 3 is the axis, of the least
or the greatest inertia, about which L precesses in the body. In space the body precesses about L at
the rate L (I1 w1^2 + I2 w2^2)/(I1^2 w1^2 + I2^2 w2^2), the integrand of an elliptic integral of the
third kind. A corner at r from the centre that meets the plane of normal n at a normal velocity u <
0 stops along n: without friction the impulse is -u/(1/m + (r x n).I^-1 (r x n)) along n.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)
PARTS = 8  # parts of a time, each with these nodes, to integrate the rotation about L
LOOKS = 400  # times at which corners are compared with the plane


@dataclass(frozen=True)
class Body:
    """A rigid body: mass [kg], distinct principal inertias (3,) [kg m2], corners, and its axes.

    corners: (c, 3) [m] in the principal axes; axes: (3, 3), whose rows are the principal axes in
    space at t = 0, right-handed.
    """

    mass: float
    inertia: Array
    corners: Array
    axes: Array

    def __post_init__(self) -> None:
        require_positive("in SI units", mass=self.mass, inertia=float(self.inertia.min()))
        if np.unique(self.inertia).size < 3:
            raise ValueError(f"inertia = {self.inertia} kg m2; all three must be unlike")


def spins(t: Array, inertia: Array, w: Array) -> Array:
    """The spin (k, 3) [1/s] in the body's axes at times t (k,) [s]; w (3,): the spin at t = 0."""
    from scipy.special import ellipj, ellipkinc

    order, mirror = _order(inertia, w)
    J, first = inertia[order], mirror * w[order]
    doubled, square = float(J @ first**2), float(J**2 @ first**2)
    below, above = doubled * J[2] - square, square - doubled * J[0]
    size = np.sqrt([
        below / (J[0] * (J[2] - J[0])),
        below / (J[1] * (J[2] - J[1])),
        above / (J[2] * (J[2] - J[0])),
    ])  # fmt: skip
    sense = np.where(first < 0.0, -1.0, 1.0)
    sense[1] = sense[0] * sense[2] * np.sign(J[2] - J[1])
    rate = np.sqrt((J[2] - J[1]) * above / J.prod())
    m = (J[1] - J[0]) * below / ((J[2] - J[1]) * above)
    start = ellipkinc(np.arctan2(sense[1] * first[1] / size[1], sense[0] * first[0] / size[0]), m)
    sn, cn, dn, _ = ellipj(start + rate * np.asarray(t), m)
    found = np.empty((len(sn), 3))
    found[:, order] = mirror * (sense * size * np.stack([cn, sn, dn], axis=1))
    return found


def _order(inertia: Array, w: Array) -> tuple[list[int], Array]:
    """The order of the axes by inertia, and the signs that keep them right-handed.

    Inertias rise or fall such that L precesses about the last axis.
    """
    order = np.argsort(inertia)
    if inertia**2 @ w**2 < (inertia @ w**2) * inertia[order[1]]:
        order = order[::-1]
    handed = float(np.linalg.det(np.eye(3)[order]))
    return order.tolist(), np.array([1.0, handed, 1.0])


def turned(t: Array, body: Body, w: Array) -> Array:
    """Rotations (k, 3, 3) of vectors in the body's axes into space at times t (k,) [s]."""
    inertia, times = body.inertia, require_times(t)
    last = _order(inertia, w)[0][2]
    L = float(np.linalg.norm(inertia * w))
    ends = np.linspace(0.0, 1.0, PARTS + 1)
    at = (ends[:-1, None] + 0.5 / PARTS * (NODES + 1.0)).ravel()
    weights = np.tile(0.5 / PARTS * WEIGHTS, PARTS)
    others = np.arange(3) != last
    inner = spins(np.outer(times, at).ravel(), inertia, w)[:, others]
    J = inertia[others]
    rate = L * (inner**2 @ J) / (inner**2 @ J**2)
    angle = times * (rate.reshape(len(times), -1) @ weights)
    about = body.axes.T @ (inertia * w) / L
    start = body.axes.T @ _frame(inertia * w, last).T
    now = np.stack([_frame(one, last) for one in inertia * spins(times, inertia, w)])
    turns = np.stack([_about(about, one) for one in angle])
    return np.asarray(turns @ start @ now)


def _frame(momentum: Array, last: int) -> Array:
    """Rows: the direction of L in the body, the line of nodes, and their vector product."""
    along = momentum / np.linalg.norm(momentum)
    node = np.cross(np.eye(3)[last], along)
    node /= np.linalg.norm(node)
    return np.stack([along, node, np.cross(along, node)])


def _about(axis: Array, angle: float) -> Array:
    """The rotation by an angle about a unit vector (Rodrigues)."""
    x, y, z = axis
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turned = np.sin(angle) * across + (1.0 - np.cos(angle)) * across @ across
    return np.asarray(np.eye(3) + turned)


@dataclass(frozen=True)
class Landing:
    """The impact of the first corner on the plane at t [s], and the state after it.

    approach: speed [m/s] of the corner towards the plane; gain: change of velocity [m/s] of the
    centre along the normal; w: spin (3,) [1/s] in the body's axes; axes: (3, 3), as in `Body`.
    """

    t: float
    approach: float
    gain: float
    w: Array
    axes: Array


def clearance(t: Array, body: Body, w: Array, n: Array) -> Array:
    """Heights (k, c) [m] of the corners above the centre along n (3,) at times t (k,) [s]."""
    return np.asarray(turned(t, body, w) @ body.corners.T).transpose(0, 2, 1) @ n


def landing(body: Body, w: Array, n: Array, *, height: float, V: float, latest: float) -> Landing:
    """The impact on a plane `height` [m] below the centre, which approaches it at V [m/s].

    Raises ValueError if no corner meets the plane by `latest` [s].
    """
    from scipy.optimize import brentq

    require_positive("in SI units", height=height, V=V, latest=latest)
    looks = np.linspace(0.0, latest, LOOKS)
    gaps = height - V * looks[:, None] + clearance(looks, body, w, n)
    if (gaps > 0.0).all():
        raise ValueError(f"no corner meets the plane until t = {latest} s")
    past = int(np.argmax((gaps <= 0.0).any(axis=1)))
    if past == 0:
        raise ValueError(f"height = {height} m; a corner is below the plane at t = 0")
    ends = [
        brentq(lambda t, c=c: height - V * t + clearance(np.array([t]), body, w, n)[0, c],
               looks[past - 1], looks[past], xtol=1e-15)
        for c in np.flatnonzero(gaps[past] <= 0.0)
    ]  # fmt: skip
    first = int(np.argmin(ends))
    t, corner = ends[first], body.corners[np.flatnonzero(gaps[past] <= 0.0)[first]]
    rotation = turned(np.array([t]), body, w)[0]
    normal, spin = n @ rotation, spins(np.array([t]), body.inertia, w)[0]
    lever = np.cross(corner, normal)
    approach = V - lever @ spin
    impulse = approach / (1.0 / body.mass + lever**2 @ (1.0 / body.inertia))
    return Landing(
        t, approach, impulse / body.mass, spin + impulse * lever / body.inertia, rotation.T
    )


def height_gained(t: Array, met: Landing, V: float) -> Array:
    """Displacement (k,) [m] of the centre along the normal at times t (k,) [s]."""
    times = require_times(t)
    return np.asarray(-V * times + met.gain * np.maximum(times - met.t, 0.0))
