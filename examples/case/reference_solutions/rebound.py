"""A mass that meets a spring and leaves it: closed form."""

import numpy as np
from numpy.typing import NDArray


def height(t: NDArray[np.float64], *, m: float, kn: float, v: float) -> NDArray[np.float64]:
    """Displacement [m] at times t [s]; it meets the spring at t = 0 with speed v [m/s]."""
    w = np.sqrt(kn / m)
    leaves = np.pi / w
    return np.asarray(np.where(t < leaves, -v / w * np.sin(w * t), v * (t - leaves)))
