"""The steps of a run, and the parameters of generalised-alpha steps: DDA's own, and others."""

from __future__ import annotations

from typing import NamedTuple


class Steps(NamedTuple):
    """A row per `stride` steps of dt [s]; `settling` steps of gravity alone before t = 0."""

    stride: int
    dt: float
    settling: int


class Stepping(NamedTuple):
    """The parameters of a step D of displacements d, velocities v0, v1 and accelerations a0, a1.

    d = D v0 + D^2 ((1/2 - beta) a0 + beta a1), v1 = v0 + D ((1 - gamma) a0 + gamma a1), and the
    forces at the part 1 - alpha_f of the step equal M ((1 - alpha_m) a1 + alpha_m a0) (Chung and
    Hulbert 1993, Eqs. 3-8).
    """

    alpha_m: float
    alpha_f: float
    beta: float
    gamma: float


IMPLICIT = Stepping(0.0, 0.0, 0.5, 1.0)
"""DDA's own: d'' = (2/D^2)(d - D v0), forces at the end (Yagoda-Biran 2016, Eq. 5 corrected)."""

LEAPING = Stepping(0.0, 0.0, 1.0, 1.0)
"""For impacts without rebound: v1 = d/D, the velocity at the middle of the step, for a0 = 0.

Contact then limits d, and with it v1 (Paoli and Schatzman 2002, with zero restitution).
"""

HALF_LEAP = Stepping(0.0, 0.0, 0.5, 0.5)
"""The first such step: it starts from the velocity at its beginning, not at a middle."""


def generalised_alpha(radius: float) -> Stepping:
    """The second-order step with the least damping for a spectral radius at infinite w D.

    Chung and Hulbert (1993), Eqs. 17, 20, 25. Raises ValueError for a radius outside 0 to 1.
    """
    if not 0.0 <= radius <= 1.0:
        raise ValueError(f"radius = {radius!r}; a spectral radius lies between 0 and 1")
    alpha_m, alpha_f = (2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0)
    shift = alpha_f - alpha_m
    return Stepping(alpha_m, alpha_f, 0.25 * (1.0 + shift) ** 2, 0.5 + shift)
