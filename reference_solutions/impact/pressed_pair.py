"""Two spheres one above the other, pressed between two walls: two unknowns on linear springs.

    m1 y1'' = k (R - y1) - k (2 R - (y2 - y1)) - m1 g
    m2 y2'' = k (2 R - (y2 - y1)) - k (R - (H - y2)) - m2 g

y [m] are the heights of the centres over the lower wall, R [m] is the radius of both spheres and H
[m] the distance of the walls. The solution, in terms of both modes, holds while all three contacts
are under pressure.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]


def heights(
    t: ArrayLike, start: tuple[float, float], *, masses: tuple[float, float], k: float,
    R: float, H: float, g: float,
) -> Array:  # fmt: skip
    """y1 and y2 [m] (..., 2) at times t >= 0 [s], from rest.

    Raises ValueError if a contact opens at one of these times.
    """
    require_positive("in SI units", k=k, R=R, H=H)
    t, mass = require_times(t), np.array(masses)
    stiff = k * np.array([[2.0, -1.0], [-1.0, 2.0]])
    load = k * np.array([-R, H + R]) - mass * g
    rest = np.linalg.solve(stiff, load)
    root = np.sqrt(mass)
    squares, modes = np.linalg.eigh(stiff / np.outer(root, root))
    first = modes.T @ (root * (np.array(start) - rest))
    swing = first * np.cos(np.sqrt(squares) * t[..., None])
    y = rest + swing @ modes.T / root
    pressed = np.stack([R - y[..., 0], 2.0 * R - y[..., 1] + y[..., 0], R - H + y[..., 1]])
    if (pressed < 0.0).any():
        raise ValueError("a contact opens; the answer holds only while all are pressed")
    return np.asarray(y)
