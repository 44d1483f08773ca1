"""Units of four that are loaded at two steady rates: stress, state of the bonds, strengths."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from cases.bonds.parts._quartzite import slower
from cases.bonds.parts._unit import CORNERS
from vv.ask import Displacement, Knobs, Reaction, Run
from vv.case import Level, Parameters
from vv.scene import Vector

RATES = (2.0, 1.0)  # rates of loading of the two units, over that of the slower one
APART = 10.0  # diameters between the units, which never meet
BEYOND = 1.15  # of the strain at failure, up to which the slower unit is loaded
EVERY = 1.6e-7  # s between outputs
COARSEST, FINEST = 4e-8, 4  # s, and that over the finest step
SLOWED = 1.5  # times m/eta: the longest step; from 2 on drag of half a step ago is unstable
FIRST = 4  # outputs before a failure, from the last two of which it is extrapolated
FALL = 0.05  # relative fall below the largest stress so far that shows broken bonds, at most


def coarsest(p: Parameters) -> float:
    """The coarsest step [s]: 4e-8, or its part on stiffer bonds or under stronger viscosity."""
    drag = SLOWED * p["m"] / p["eta"] / COARSEST if p["eta"] > 0 else 1.0
    return float(COARSEST * min(1.0, slower(p), 2.0 ** math.floor(math.log2(drag))))


def levels(coarse: float) -> dict[Level, tuple[Knobs, ...]]:
    """The rungs of each level, from the coarsest step [s]."""
    rungs = tuple(Knobs(dt=coarse / n) for n in (1, 2, FINEST))
    return {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:2], Level.PAPER: rungs}


def require_way(p: Parameters, sign: float) -> None:
    """Raise ValueError unless the rate has this sign."""
    if not sign * p["rate"] > 0.0:
        way = "positive where units are pulled" if sign > 0 else "negative where they are pressed"
        raise ValueError(f"rate = {p['rate']!r} 1/s; it must be {way}")


def require_outputs(p: Parameters, strain: float) -> None:
    """Raise ValueError where the faster unit fails, at a strain, within its first outputs."""
    fastest = abs(strain) / (FIRST * EVERY * RATES[0])
    if not abs(p["rate"]) < fastest:
        raise ValueError(
            f"rate = {p['rate']!r} 1/s; its size must be below {fastest:.6g}, at which the faster "
            f"unit fails {FIRST} outputs after the start"
        )


class UnitHistory(NamedTuple):
    """The history of a unit: stress [Pa], stretches [m], shear of inclined bonds [N]."""

    stress: Vector
    inclined: Vector
    level: Vector
    shear: Vector


def unit_history(p: Parameters, unit: int, run: Run) -> UnitHistory:
    """The size of the axial stress on the original area (Eq. 5), and the state of the bonds.

    Units come in pairs at RATES. The shear follows from the axial force, F = 3 (Fn cos a + Fs sin
    a) + eta v, since the top moves at a steady speed v, without inertia.
    """
    first, d = len(CORNERS) * unit, p["d"]
    u = np.array([run.values[Displacement(first + i)] for i in range(3)])
    x = d * CORNERS[:3, None] + u
    force = run.values[Reaction(first)][:, 2]
    inclined, level = (_stretch(d, u, *bond) for bond in ((0, 1), (1, 2)))
    rise = (x[0] - x[1])[:, 2] / np.linalg.norm(x[0] - x[1], axis=1)
    drag = p["eta"] * RATES[unit % len(RATES)] * p["rate"] * d * CORNERS[0, 2]
    shear = ((force - drag) / 3 - p["kn"] * inclined * rise) / np.sqrt(1 - rise**2)
    return UnitHistory(np.abs(force) / (np.sqrt(3) / 2 * d**2), inclined, level, np.abs(shear))


def _stretch(d: float, u: Vector, i: int, j: int) -> Vector:
    """The stretch (k,) [m] of the bond between two elements."""
    moved, offset = u[j] - u[i], d * (CORNERS[j] - CORNERS[i])
    longer = np.einsum("kc,kc->k", 2 * offset + moved, moved)
    return np.asarray(longer / (np.linalg.norm(offset + moved, axis=1) + d))


def tensile_strength(p: Parameters, unit: int, run: Run) -> float:
    seen = unit_history(p, unit, run)
    return _at(seen.stress, seen.inclined / p["xb"], int(seen.stress.argmax()))


def opening_strength(p: Parameters, unit: int, run: Run) -> float:
    seen = unit_history(p, unit, run)
    most = np.maximum.accumulate(seen.stress)
    fallen = np.argmax(seen.stress < (1.0 - min(FALL, 0.5 * lost(p))) * most)
    return _at(seen.stress, seen.level / p["xb"], int(seen.stress[:fallen].argmax()))


def lost(p: Parameters) -> float:
    """The part of the pressure that a unit loses when its base opens, at small strains.

    Fz/dz is 9 kn (kn + ks)/(5 kn + ks) with the bonds of the base, 9 kn ks/(kn + 2 ks) without.
    """
    kn, ks = p["kn"], p["ks"]
    return 1.0 - ks * (5.0 * kn + ks) / ((kn + 2.0 * ks) * (kn + ks))


def slid(p: Parameters, unit: int, run: Run) -> float:
    """The stress [Pa] at which inclined bonds slide, where shear minus friction reaches fs0.

    That difference grows linearly with strain, unlike shear over strength, so that it can be
    extrapolated.
    """
    seen = unit_history(p, unit, run)
    unrubbed = seen.shear + p["mu_p"] * p["kn"] * seen.inclined
    return _at(seen.stress, unrubbed / p["fs0"], int(seen.stress.argmax()))


def _at(stress: Vector, borne: Vector, peak: int) -> float:
    """The stress [Pa] at which bonds break, extrapolated from the last two outputs before that.

    Bonds break where `borne`, their load over their strength, reaches 1: less than an output later,
    and at most two outputs before the stress falls. Bonds that break elsewhere give another stress.
    """
    last = peak - int((borne[peak - 1 : peak + 1] > 1.0).sum())
    share = np.clip((1.0 - borne[last]) / (borne[last] - borne[last - 1]), 0.0, 1.0)
    return float(stress[last] + share * (stress[last] - stress[last - 1]))


def at_zero_rate(seen: Callable[[int, Run], float], run: Run, first: int = 0) -> float:
    """The strength [Pa] extrapolated to zero rate of loading, from specimens at both RATES."""
    fast, slow = (seen(first + unit, run) for unit in range(len(RATES)))
    return slow + (slow - fast) / (RATES[0] / RATES[1] - 1.0)
