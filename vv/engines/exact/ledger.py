"""The energy ledger of an exact motion; every term is integrated separately and exactly."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from vv.ask import Ledger
from vv.engines.exact.modes import WITHOUT_FORCE, State
from vv.engines.exact.path import Path, taylor_sum
from vv.engines.exact.roots import EPS
from vv.scene import Vector

ROUNDINGS = 16  # allowed per piece, in units of eps times the largest sum of |terms|


def ledger(path: Path) -> Ledger:
    """The energies [J] at the end of a path, whose sum must equal the energy at t = 0.

    Potentials of gravity and dead loads are zero at t = 0. The sum is checked at the end of every
    piece. Its bound is ROUNDINGS eps per piece, times the largest sum of absolute values.
    """
    system = path.system
    q, rate = taylor_sum(path.series, path.end)
    q, v = np.vstack((0 * q[:1], q)), np.vstack((system.velocity, rate / path.h[:, None]))
    lengths = _lengths(path)
    normal, shear = _springs(path, lengths)
    terms = {
        "kinetic": 0.5 * v**2 @ system.mass,
        "normal elastic": normal,
        "shear elastic": shear,
        "friction dissipation": sum_so_far(_friction(path, lengths)),
        "drag dissipation": sum_so_far(_drag(path) + _parting(path, lengths)),
        "gravity potential": -q @ system.weight,
        "load potential": -q @ system.load,
    }
    return ledger_of_terms(terms, 3)


def ledger_of_terms(terms: dict[str, Vector], stored: int) -> Ledger:
    """The ledger of terms given at t = 0 and at the end of every piece, (p + 1,) each [J].

    stored: the number of leading terms that are kinetic or elastic energy.
    """
    held = np.array(list(terms.values()))
    total = held.sum(axis=0)
    return Ledger(
        terms={name: float(term[-1]) for name, term in terms.items()},
        unaccounted=float(np.abs(total - total[0]).max()),
        peak=float(held[:stored].sum(axis=0).max()),
        bound=ROUNDINGS * EPS * len(total) * float(np.abs(held).sum(axis=0).max()),
    )


def _lengths(path: Path) -> Vector:
    """Gaps and stretches in each piece as polynomials, (p, order + 1, c + s + h) [m]."""
    lengths = np.asarray(path.series @ path.system.rows.T)
    lengths[:, 0] = path.lengths
    return lengths


def _springs(path: Path, lengths: Vector) -> tuple[Vector, Vector]:
    """Normal and shear elastic energies (p + 1,) [J] at t = 0 and at the end of each piece."""
    system, count = path.system, len(path.system.gap)
    at = np.concatenate((path.lengths[:1], taylor_sum(lengths, path.end)[0]))
    closed = np.array([[state is not State.OPEN for state in row] for row in path.states])
    closed, sign = _from_start(closed), _from_start(_signs(path))
    overlap = np.where(closed, -at[:, :count], 0.0)
    cap, own = system.ratio * overlap[:, list(system.springs)], closed[:, list(system.springs)]
    first, bonds = count + len(system.springs), len(system.bond_springs.names)
    stretch = np.where(sign == 0, np.where(own, at[:, count:first], 0.0), sign * cap)
    tied = 0.5 * system.bond_springs.stiffness * at[:, first:] ** 2
    normal = 0.5 * system.kn * (overlap**2).sum(axis=1) + tied[:, :bonds].sum(axis=1)
    return normal, 0.5 * system.ks * (stretch**2).sum(axis=1) + tied[:, bonds:].sum(axis=1)


def _from_start(rows: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Values of pieces (p, ...), extended to t = 0 and the end of each piece (p + 1, ...)."""
    return np.concatenate((rows[:1], rows))


def _signs(path: Path) -> Vector:
    """The direction of slip (p, s) of each shear spring in each piece, 0 without slip."""
    own = path.system.springs
    signs = [[states[c].sign for c in own] for states in path.states]
    return np.array(signs, float).reshape(len(path.states), len(own))


def _friction(path: Path, lengths: Vector) -> Vector:
    """Work of friction (p,) [J]: the integral of mu kn U (sigma x' - r U'), r = mu kn/ks."""
    system, sign = path.system, _signs(path)
    overlap = -lengths[:, :, list(system.springs)]
    first = len(system.gap)
    travel = lengths[:, :, first : first + len(system.springs)]
    slip = sign[:, None] * travel - system.ratio * overlap
    work = product_integral(path.end, overlap, derivative(slip)) * (sign != 0)
    return np.asarray(system.mu * system.kn * work.sum(axis=1))


def _drag(path: Path) -> Vector:
    """Work against drag (p,) [J]: the integral of eta v^2."""
    rate = derivative(path.series)
    work = product_integral(path.end, rate, rate) / path.h[:, None]
    return np.asarray(path.system.eta * work.sum(axis=1))


def _parting(path: Path, lengths: Vector) -> Vector:
    """Work against viscous contacts (p,) [J]: the integral of (Fn - kn U) U' for U > 0.

    Fn = 0 in parted contacts, whose remaining overlap relaxes without force.
    """
    system, count = path.system, len(path.system.gap)
    if not system.eta_n > 0:
        return np.zeros(len(path.start))
    gap = lengths[:, :, :count]
    rate = derivative(gap)
    moving = [[state not in WITHOUT_FORCE for state in states] for states in path.states]
    parted = [[state is State.PARTED for state in states] for states in path.states]
    slowed = system.eta_n / path.h[:, None] * product_integral(path.end, rate, rate) * moving
    relaxed = system.kn * product_integral(path.end, gap, rate) * parted
    return np.asarray((slowed - relaxed).sum(axis=1))


def derivative(series: Vector) -> Vector:
    """Derivatives of polynomials (p, k, n) with respect to their variable x."""
    derived = np.zeros_like(series)
    derived[:, :-1] = series[:, 1:] * np.arange(1.0, series.shape[1])[:, None]
    return derived


def product_integral(end: Vector, a: Vector, b: Vector) -> Vector:
    """Integrals (p, n) of products of polynomials a, b (p, k, n), each from 0 to its end (p,)."""
    rank = np.arange(a.shape[1])
    powers = end[:, None, None] ** rank[:, None]
    hilbert = 1.0 / (rank[:, None] + rank + 1)
    products = a * powers * (hilbert @ (b * powers))
    return np.asarray(end[:, None] * products.sum(axis=1))


def sum_so_far(work: Vector) -> Vector:
    """Cumulative sum of (p,) values, starting with 0: (p + 1,)."""
    return np.concatenate(((0.0,), np.cumsum(work)))
