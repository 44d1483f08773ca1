"""The step of generalised alpha as a matrix: the second route to its roots."""

import numpy as np

Matrix = np.ndarray[tuple[int, int], np.dtype[np.float64]]


def amplification(angle: float, radius: float) -> Matrix:
    """The matrix (3, 3) of a step of 1 s on (x, v, a) of x'' = -angle^2 x."""
    alpha_m, alpha_f = (2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0)
    gamma = 0.5 - alpha_m + alpha_f
    beta = (1.0 - alpha_m + alpha_f) ** 2 / 4.0
    left, right = np.zeros((3, 3)), np.zeros((3, 3))
    left[0, 0], left[0, 2] = 1.0, -beta
    right[0] = 1.0, 1.0, 0.5 - beta
    left[1, 1], left[1, 2] = 1.0, -gamma
    right[1] = 0.0, 1.0, 1.0 - gamma
    left[2, 0], left[2, 2] = (1.0 - alpha_f) * angle**2, 1.0 - alpha_m
    right[2, 0], right[2, 2] = -alpha_f * angle**2, -alpha_m
    return np.asarray(np.linalg.solve(left, right), dtype=np.float64).reshape((3, 3))


def roots(angle: float, radius: float) -> np.ndarray[tuple[int], np.dtype[np.complex128]]:
    """The three roots of a step, as the eigenvalues of its matrix."""
    return np.linalg.eigvals(amplification(angle, radius)).astype(complex)
