"""Bounds for the strains of a block that oscillates: damping and lag of the steps, and springs."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from reference_solutions.blocks import elastic_block as exact
from vv.ask import Method
from vv.case import Exact, Parameters, Tolerance
from vv.scene import Vector

STEPS, STIFF = (0.02, 0.01, 0.005, 0.0025), 1e4  # steps times w, springs over E a b/L
# time between outputs, times w, and their number: a period and a half
SEEN, OUTPUTS = 4 * STEPS[0], 118
FIRST = 1.3  # bound of the damping of the first mode of a bar, over w dt
NO_PULL = "formulations of this class may lack the centrifugal force, the only cause of strain here"
DAMPED = Exact(
    dict.fromkeys(
        (Method.PENALTY, Method.LAGGING),
        Tolerance(1e-3, "the springs at the edges soften the block by a fraction of 1e-4"),
    ),
    not_judged={
        Method.DAMPED: "this class integrates by another scheme, which the case damped-swing judges"
    },
)


def sides(p: Parameters) -> exact.Sides:
    """The sides of the block [m] along x, y and z."""
    return p["a"], p["b"], p["L"]


def law(p: Parameters) -> dict[str, Any]:
    """What all references of the block need: sides, density and elastic constants."""
    return {"sides": sides(p), "rho": p["rho"], "young": p["E"], "poisson": p["nu"]}


def period(p: Parameters) -> Vector:
    """Times over a period of a bar on its base [s]."""
    w = exact.first(side=p["L"], rho=p["rho"], young=p["E"])
    return np.linspace(0.0, 2 * math.pi, 200) / w


def of_coupled(p: Parameters, w: float) -> tuple[Exact, ...]:
    """The bounds of a standing block's strains along z, x and y, which oscillate in three modes."""
    shares, squares = exact.standing_modes(**law(p), g=p["g"])
    path = exact.standing(period(p), **law(p), g=p["g"])
    rates, amplitude = np.sqrt(squares) / w, np.abs(path).max() / 2
    damped, lowered = (np.maximum(1.0, shares @ rates**n / amplitude) for n in (2, 3))
    return tuple(swing_bounds(float(damped[axis]), float(lowered[axis]), w) for axis in (2, 0, 1))


def of_spun(p: Parameters, w: float) -> tuple[Exact, ...]:
    """The bounds of a spun block's strains along x, y and z."""
    return tuple(
        Exact(
            {
                method: _with_slowing(tolerance, float(slowed))
                for method, tolerance in swing_bounds(
                    float(quick), float(quick), w
                ).tolerances.items()
            },
            not_judged={Method.LAGGING: NO_PULL},
        )
        for quick, slowed in zip(_quick(p, w), _slowed(p, w), strict=True)
    )


def _slowed(p: Parameters, w: float) -> Vector:
    """What strains change of each strain (3,) of a spun block, over the largest of all.

    A block strained by e spins slower, at 1 - 2 e, and its inertia grows to 1 + 2 e. Of w_j^2 e a
    mode lacks 4 e by the first and 4 e by the second, in products of two oscillations: 8 e at rest,
    and, as part of them has the frequency w_j of the mode, w_j t/2 times that.
    """
    shares, squares = exact.spun_modes(**law(p), spin=p["spin"])
    followed = 1.0 + np.sqrt(squares) / w * OUTPUTS * SEEN / 2
    return np.asarray(8.0 * shares @ followed)


def _with_slowing(bound: Tolerance, slowed: float) -> Tolerance:
    """A bound that contains what the strains change of themselves."""
    return replace(
        bound,
        reason=f"{bound.reason}. The answer is linear in the strains e, which slow the spin and "
        "add inertia: 8 e of them, and w t/2 times that, as a part follows each mode",
        more=lambda kn: slowed,
    )


def _quick(p: Parameters, w: float) -> Vector:
    """The damping of each strain (3,) of a spun block, over that of a bar of frequency w [1/s].

    A mode of frequency w_j loses w_j^2 dt t/4 of its amplitude; the largest strain is twice the
    amplitude of a bar.
    """
    shares, squares = exact.spun_modes(**law(p), spin=p["spin"])
    spun = exact.spinning(period(p), **law(p), spin=p["spin"])
    lost = shares @ (squares / w**2) * OUTPUTS * SEEN / 4 / np.abs(spun).max()
    return np.asarray(lost / FIRST)


def swing_bounds(quick: float, lowered: float, w: float) -> Exact:
    """The bounds of strains that oscillate.

    quick: damping of all modes over that of the first mode of a bar, of frequency w [1/s];
    lowered: the errors of their phases over that of the same mode.
    """
    step = Tolerance(
        max(5 / STIFF, FIRST * quick * STEPS[0]),
        "DDA's step has the damping ratio w dt/4: an error of (1 - exp(-w dt w t/4))/2 of the "
        "largest strain, 1.2 w dt after a period and a half. The damping of faster modes grows "
        "with the square of their frequency",
        dt=STEPS[0] / w, order=1, floor=5 / STIFF,
    )  # fmt: skip
    second = Tolerance(
        max(5 / STIFF, 2.0 * lowered * STEPS[0] ** 2),
        "the generalised-alpha method lowers the frequency by (w dt)^2/8, a phase error of 1.2 "
        "(w dt)^2 radians over a period and a half, which grows with the cube of the frequency; "
        "the floor is the compliance of the springs at the edges",
        dt=STEPS[0] / w, order=2, floor=5 / STIFF,
    )  # fmt: skip
    return Exact({Method.PENALTY: step, Method.LAGGING: step, Method.DAMPED: second})


def frequency_bounds(w: float) -> Exact:
    """The bounds of the frequency of a bar, w [1/s]."""
    step = Tolerance(
        STEPS[0] ** 2,
        "an error of (w dt)^2; the floor is the compliance of the springs at two edges, 9/16 of E "
        "a b/(L kn)",
        dt=STEPS[0] / w, order=2, floor=1 / STIFF,
    )  # fmt: skip
    return Exact({Method.PENALTY: step, Method.LAGGING: step})
