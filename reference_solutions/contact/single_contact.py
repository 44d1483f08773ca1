"""Closed forms of the four single-contact tests T1 to T4 of Li et al. (2018).

In T1 and T2 a particle hits a fixed one head on, without and with viscosity. In T3 and T4 a
particle with a constant overlap with a wall is launched along it, without and with viscosity; it
sticks, slips and then sticks for ever. Displacements y [m] are along the motion and 0 at t = 0.
There is no gravity.

Symbols are the paper's, per metre of thickness: density rho [kg/m3], radius r [m], contact
stiffnesses kn and ks [N/m], friction coefficient mu [-], viscosity eta [N s/m], initial velocities
v_a < 0 (approaching, T1 and T2) and v_b of either sign (T3 and T4) [m/s]. m = 2 sqrt3 rho r^2,
n = eta/(2m), k = sqrt(kn/m) in T1 and T2, sqrt(ks/m) in T3 and T4, wd = sqrt(k^2 - n^2).

All solutions follow from the differential Eqs. 14 to 23. The printed v_a = -0.01 m/s (Eq. 27)
contradicts Eqs. 29 and 31, which need -0.1; the printed n, k, t_s1 and v_s1 are wrong in the last
digit. With the paper's dx the motions T3 and T4 do not depend on mu and kn, which change dx alone.
Every function raises ValueError for a parameter that is not finite or has the wrong sign.
"""

from math import asin, copysign, cos, exp, factorial, isfinite, log1p, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]

_UNITS = {"rho": "kg/m3", "r": "m", "kn": "N/m", "ks": "N/m", "mu": "[-]"}
# T4's slip has -2 n s in [ln sin(pi/8), 0] for every eta it admits: 0.961^18/20! < 1e-18.
_PHI2_SERIES = np.array([1.0 / factorial(j + 2) for j in range(18)])


class Separation(NamedTuple):
    """The end of the contact of T1 or T2: time `t` [s] and velocity `v` [m/s]."""

    t: float
    v: float


class Slip(NamedTuple):
    """The one slip of T3 or T4: `begin` and `end` [s], critical displacement `y1` [m], velocity
    `v` [m/s] at its begin, deceleration `a` [m/s2], `distance` slipped [m]; signs follow v_b.
    """

    begin: float
    end: float
    y1: float
    v: float
    a: float
    distance: float


def mass(rho: float, r: float) -> float:
    """m [kg per metre of thickness] = 2 sqrt3 rho r^2 (Li 2018, Eq. 24)."""
    _require_positive(rho=rho, r=r)
    return 2.0 * sqrt(3.0) * rho * r * r


def overlap(
    *, rho: float, r: float, kn: float, ks: float, mu: float, eta: float, v_b: float
) -> float:
    """dx [m] of T3 and T4, chosen so that T4 starts to slip at wd t = pi/8.

    mu kn dx/ks = |y1|, y1 = (v_b/wd) e^(-n pi/(8 wd)) sin(pi/8) (Li 2018, 'Shear Contact Force').
    At that time T4 still moves forward if n tan(pi/8) < wd, that is n < k cos(pi/8); otherwise it
    slips earlier, at the root of a transcendental equation. T3 always slips: k |y1/v_b| < 0.391.

    Raises ValueError if n >= k cos(pi/8), and if dx >= r (the centre would be beyond the wall).
    """
    _require_positive(kn=kn, ks=ks, mu=mu)
    if not isfinite(v_b) or v_b == 0.0:
        raise ValueError(f"v_b = {v_b} m/s; the velocity along the wall must be finite and not 0")
    n, _, wd = _rates(mass(rho, r), ks, eta, cos(pi / 8))
    dx = ks * abs(v_b) * exp(-n * pi / (8 * wd)) * sin(pi / 8) / (wd * mu * kn)
    if not dx < r:
        raise ValueError(f"dx = {dx} m; the overlap with the wall must be below r = {r} m")
    return dx


def separation(*, rho: float, r: float, kn: float, eta: float, v_a: float) -> Separation:
    """t_n2 and v_n2 of T2, or with eta = 0 t_n1 and v_n1 of T1 (Li 2018, Eqs. 28-31).

    Raises ValueError if eta >= 2 m k (no rebound) or |v_a|/k >= 2 r (the centres might meet).
    """
    n, _, wd = _approach(rho, r, kn, eta, v_a)
    return Separation(pi / wd, -v_a * exp(-n * pi / wd))


def t3_slip(
    *, rho: float, r: float, kn: float, ks: float, mu: float, eta: float, v_b: float
) -> Slip:
    """t_s1, t_s4, y1, v_s1, a, b of T3 (Li 2018, Eqs. 34-42). Raises ValueError as `overlap`."""
    dx = overlap(rho=rho, r=r, kn=kn, ks=ks, mu=mu, eta=eta, v_b=v_b)
    y1 = copysign(mu * kn * dx / ks, v_b)
    _, k, _ = _rates(mass(rho, r), ks, 0.0)
    begin = asin(y1 * k / v_b) / k
    v, a = v_b * cos(k * begin), k * k * y1
    return Slip(begin, begin + v / a, y1, v, a, v * v / (2.0 * a))


def t4_slip(
    *, rho: float, r: float, kn: float, ks: float, mu: float, eta: float, v_b: float
) -> Slip:
    """t_s2, t_s3, y2 = y1, v_s2, a = c, d of T4 (Li 2018, Eqs. 43-51); errors as `overlap`."""
    dx = overlap(rho=rho, r=r, kn=kn, ks=ks, mu=mu, eta=eta, v_b=v_b)
    y1 = copysign(mu * kn * dx / ks, v_b)
    n, k, wd = _rates(mass(rho, r), ks, eta)
    begin = pi / (8.0 * wd)
    v = v_b * exp(-n * begin) * (cos(pi / 8) - n / wd * sin(pi / 8))
    a = k * k * y1
    x = 2.0 * n * v / a
    s = v / a * (log1p(x) / x if x > 0.0 else 1.0)
    return Slip(begin, begin + s, y1, v, a, float(_slipped(np.asarray(s), n, v, a)))


def t1(t: ArrayLike, *, rho: float, r: float, kn: float, v_a: float) -> Array:
    """y [m] of T1 at times t >= 0 [s] of any shape (Li 2018, Eqs. 14, 15).

    (v_a/k) sin kt until t_n1 = pi/k; then -v_a (t - t_n1).
    """
    t = require_times(t)
    _, k, _ = _approach(rho, r, kn, 0.0, v_a)
    return np.where(t < pi / k, v_a / k * np.sin(k * t), -v_a * (t - pi / k))


def t2(t: ArrayLike, *, rho: float, r: float, kn: float, eta: float, v_a: float) -> Array:
    """y [m] of T2 at times t >= 0 [s] of any shape (Li 2018, Eqs. 16, 17).

    (v_a/wd) e^(-nt) sin(wd t) until t_n2 = pi/wd; then (v_n2/2n)(1 - e^(-2n(t - t_n2))).
    """
    t = require_times(t)
    end, v = separation(rho=rho, r=r, kn=kn, eta=eta, v_a=v_a)
    n, _, wd = _approach(rho, r, kn, eta, v_a)
    contact = v_a / wd * np.exp(-n * t) * np.sin(wd * t)
    return np.where(t < end, contact, _coasted(np.maximum(t - end, 0.0), n, v))


def t3(
    t: ArrayLike, *, rho: float, r: float, kn: float, ks: float, mu: float, eta: float, v_b: float
) -> Array:
    """y [m] of T3 at times t >= 0 [s] of any shape (Li 2018, Eqs. 18-20); eta acts through dx only.

    (v_b/k) sin kt until t_s1; y1 + v_s1 s - a s^2/2, s = t - t_s1, until t_s4; then b + y1
    cos k(t - t_s4), which reaches the friction limit at each reversal without slipping.
    """
    t = require_times(t)
    slip = t3_slip(rho=rho, r=r, kn=kn, ks=ks, mu=mu, eta=eta, v_b=v_b)
    _, k, _ = _rates(mass(rho, r), ks, 0.0)
    s = np.clip(t, slip.begin, slip.end) - slip.begin
    slipping = slip.y1 + slip.v * s - slip.a * s**2 / 2.0
    stuck = slip.distance + slip.y1 * np.cos(k * (t - slip.end))
    later = np.where(t < slip.end, slipping, stuck)
    return np.where(t < slip.begin, v_b / k * np.sin(k * t), later)


def t4(
    t: ArrayLike, *, rho: float, r: float, kn: float, ks: float, mu: float, eta: float, v_b: float
) -> Array:
    """y [m] of T4 at times t >= 0 [s] of any shape (Li 2018, Eqs. 21-23).

    (v_b/wd) e^(-nt) sin(wd t) until t_s2 = pi/(8 wd); with s = t - t_s2, B = v_s2 + a/2n,
    y1 + (B/2n)(1 - e^(-2ns)) - (a/2n) s until t_s3; then, with s = t - t_s3,
    d + y1 e^(-ns) (cos(wd s) + (n/wd) sin(wd s)). It does not slip again: its energy, ks y1^2/2 at
    t_s3, never grows, so that the spring never reaches |y1| with a velocity other than zero.
    """
    t = require_times(t)
    slip = t4_slip(rho=rho, r=r, kn=kn, ks=ks, mu=mu, eta=eta, v_b=v_b)
    n, _, wd = _rates(mass(rho, r), ks, eta)
    first = v_b / wd * np.exp(-n * t) * np.sin(wd * t)
    s = np.clip(t, slip.begin, slip.end) - slip.begin
    slipping = slip.y1 + _slipped(s, n, slip.v, slip.a)
    s = np.maximum(t - slip.end, 0.0)
    swing = np.cos(wd * s) + n / wd * np.sin(wd * s)
    stuck = slip.distance + slip.y1 * np.exp(-n * s) * swing
    return np.where(t < slip.begin, first, np.where(t < slip.end, slipping, stuck))


def _coasted(s: Array, n: float, v: float) -> Array:
    """y of y'' + 2n y' = 0 from velocity v: (v/2n)(1 - e^(-2ns)) = v s phi1(-2ns), v s if n = 0."""
    z = -2.0 * n * s
    moved: Array = v * s * np.divide(np.expm1(z), z, out=np.ones_like(z), where=z != 0.0)
    return moved


def _slipped(s: Array, n: float, v: float, a: float) -> Array:
    """y of y'' + 2n y' + a = 0 from velocity v: (B/2n)(1 - e^(-2ns)) - (a/2n) s, B = v + a/2n.

    For small n the terms in a cancel; their sum is -a s^2 phi2(-2ns) with s^2 phi2(-2ns) =
    (2ns - 1 + e^(-2ns))/(2n)^2, which is evaluated without cancellation.
    """
    phi2: Array = np.polynomial.polynomial.polyval(-2.0 * n * s, _PHI2_SERIES)
    return _coasted(s, n, v) - a * s**2 * phi2


def _rates(
    m: float, stiffness: float, eta: float, share: float = 1.0
) -> tuple[float, float, float]:
    """n, k and wd [1/s]. Raises ValueError unless 0 <= n < share k."""
    n, k = eta / (2.0 * m), sqrt(stiffness / m)
    if not 0.0 <= n < share * k:
        limit = f"{share * 2.0 * m * k:.9g} N s/m"
        critical = "critical damping" if share == 1.0 else f"{share:.4g} of critical damping"
        raise ValueError(f"eta = {eta} N s/m; it must be at least 0 and below {limit}, {critical}")
    return n, k, sqrt((k - n) * (k + n))


def _approach(
    rho: float, r: float, kn: float, eta: float, v_a: float
) -> tuple[float, float, float]:
    """n, k and wd [1/s] of a contact that begins with velocity v_a."""
    _require_positive(kn=kn)
    if not (isfinite(v_a) and v_a < 0.0):
        raise ValueError(f"v_a = {v_a} m/s; an approach must be finite and negative")
    rates = _rates(mass(rho, r), kn, eta)
    if not abs(v_a) < 2.0 * r * rates[1]:
        raise ValueError(f"v_a = {v_a} m/s; |v_a|/k must be below 2 r = {2.0 * r} m")
    return rates


def _require_positive(**values: float) -> None:
    for name, value in values.items():
        require_positive(_UNITS[name], **{name: value})
