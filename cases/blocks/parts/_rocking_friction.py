"""The friction that a rocking block needs so that its corner does not slip."""

from __future__ import annotations

import numpy as np

from cases.blocks.parts._leaning import Leaning
from cases.blocks.parts._rocking_quantities import ExactMotion
from vv.case import Parameters

TIMES = 400  # instants at which the force on the corner is computed
STANDS = 1e-9  # rad: a smaller lean is none


def require_grip(block: Leaning, exact: ExactMotion, p: Parameters, last: float) -> None:
    """Raise ValueError unless the force on the corner is within the cone of friction until `last`.

    The centre moves about the corner: with u = alpha - |theta| and R the arm, x' = R cos(u) theta'
    and z' = sgn(theta) R sin(u) theta'. The force is m (x'' - a, z'' + g), a the body acceleration.
    Impacts are not included.
    """
    needed = _needed(block, exact, p["g"], last)
    if not p["mu"] > needed:
        raise ValueError(
            f"mu = {p['mu']!r}; it must exceed {needed:.4g}, or the corner on which the block "
            "rocks slips"
        )


def _needed(block: Leaning, exact: ExactMotion, g: float, last: float) -> float:
    """The largest friction over pressure while the block leans, outside of impacts."""
    t, drive = np.linspace(0.0, last, TIMES), dict(exact.drive)
    lean, rate = exact.leans(t), exact.rates(t)
    a = np.where(t <= drive["T"], drive["A"] * np.sin(drive["w"] * t), 0.0)
    side, u, arm = np.sign(lean), block.alpha - np.abs(lean), block.arm
    s, c = np.sin(u), np.cos(u)
    turn = 0.75 / arm * (a * c - side * g * s)
    along = arm * (c * turn + side * s * rate**2) - a
    up = arm * (side * s * turn - c * rate**2) + g
    leans = np.abs(lean) > STANDS
    return float(np.max(np.abs(along[leans]) / up[leans], initial=0.0))
