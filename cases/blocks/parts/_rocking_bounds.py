"""Bounds of a rocking block: of free swings, and of a pulse at and near its threshold."""

from __future__ import annotations

import math

from vv.ask import Method
from vv.case import EnergyAllowance, Exact, Parameters, Tolerance
from vv.scene import Scene

COARSE = 1e-3  # s
FOUND = 4e-6  # relative resolution of a search for the threshold
SPRUNG = (
    "on springs an impact takes time, and its restitution depends on stiffness and step: it is "
    "like Housner's at 1e10 N/m and 1e-3 s, but the block bounces at 1e-4 s"
)
SHOWN = {
    **dict.fromkeys((Method.PENALTY, Method.LAGGING), SPRUNG),
    Method.FIRST_ORDER: "this class places an impact at the end of a step, and the errors of five "
    "impacts add up",
}
LAGS = Tolerance(
    0.1,
    "when a corner strikes, friction of the previous iteration may act in the direction of slip "
    "and add energy: at most 0.04 m g R was found for eight blocks",
)


def friction_energy(scene: Scene, p: Parameters) -> EnergyAllowance:
    """The energy that lagging friction may add at impacts, relative to m g R."""
    weight = sum(block.mass for block in scene.blocks) * p["g"]
    return EnergyAllowance(weight * math.hypot(p["b"], p["h"]), {Method.LAGGING: LAGS})


def free_swings(rate: float) -> Exact:
    """For free swings: their rate p [1/s] is the scale of the step."""
    five = Tolerance(
        17.0 * (rate * COARSE) ** 2,
        "the step changes the rate of each swing by (p dt)^2/12 = 1e-6, and by the square root of "
        "that at the turn of a swing that ends upright; the errors of five impacts add up",
        dt=COARSE,
        order=2,
    )
    return Exact({Method.SECOND_ORDER: five}, not_judged=SHOWN)


def released_swing(rate: float, part: float) -> Exact:
    """For the first swing, at the rate p [1/s], of a block released at `part` of alpha.

    The moment that brings the block back is in proportion to alpha - theta. An error of alpha
    therefore counts relative to 1 - part.
    """
    shift = 5e-4 * min(50.0, max(1.0, 0.4 / (1.0 - part)))
    bounds = {
        Method.SECOND_ORDER: Tolerance(
            (rate * COARSE) ** 2,
            "the step changes the rate p by (p dt)^2/12",
            dt=COARSE,
            order=2,
        ),
        Method.PENALTY: Tolerance(
            0.5 * rate * COARSE + shift,
            "the motion starts half a step late, an error of p dt/2. A block on small spheres at "
            "its corners turns about these, whose size is a thousandth of its own: that shifts the "
            "angle at the top, and counts relative to 1 - part, since the nearer the top, the "
            "weaker is the moment that brings the block back",
            dt=COARSE,
            order=1,
            floor=shift,
        ),
    }
    shown = {method: why for method, why in SHOWN.items() if method not in bounds}
    return Exact(bounds, not_judged=shown)


def near_threshold(w: float, part: float) -> Exact:
    """For a pulse of frequency w [1/s] whose amplitude is `part` times the threshold."""
    left = 0.2 * _threshold_error(w) / max(abs(part - 1.0), 1e-3)
    slow = Tolerance(
        2e-4 + left,
        "the step shifts the threshold by (w dt)^2/2, which counts relative to the distance of the "
        "pulse from the threshold",
        dt=COARSE,
        order=2,
        slack="close to the threshold the block stands on its corner for long, where its height is "
        "at a maximum and hardly depends on the lean",
    )
    return Exact({Method.SECOND_ORDER: slow}, not_judged=SHOWN)


def at_threshold(w: float) -> Exact:
    """For the threshold itself, as far as a search resolves it."""
    least = Tolerance(
        max(FOUND, _threshold_error(w)),
        "an error of (w dt)^2/2: a step averages the sine, and the block starts to lean within a "
        "step",
        dt=COARSE,
        order=2,
        floor=FOUND,
    )
    return Exact({Method.SECOND_ORDER: least}, not_judged=SHOWN)


def overturning_time(w: float, part: float, rate: float, due: float) -> Exact:
    """For the time `due` [s] in which a pulse of `part` times the threshold overturns a block."""
    late = Tolerance(
        1e-5 + _threshold_error(w) * part / ((part - 1.0) * rate * due),
        "the step shifts the threshold by (w dt)^2/2, which counts relative to the excess of the "
        "pulse over the threshold: when that falls by a factor of e, the time to overturn grows by "
        "1/p",
        dt=COARSE,
        order=2,
        floor=1e-5,
    )
    return Exact({Method.SECOND_ORDER: late}, not_judged=SHOWN)


def _threshold_error(w: float) -> float:
    """The relative error of the threshold at the longest step, (w dt)^2/2."""
    return 0.5 * (w * COARSE) ** 2
