"""Equilibria and strengths of four bonded elements under an axial force (Liu 2017).

Three elements stand on a smooth base, free to move in its plane; the fourth, bonded to them, is
displaced along the axis. Elements do not rotate, and shear forces act at their centres. Bonds are
springs kn, ks [N/m] of length d [m]; tension is positive, stress refers to the original area
sqrt3 d^2/2 of a unit (Eq. 5), strain is dz over the original height d sqrt(2/3).

At finite strain an inclined bond has length L and makes the angle a with the axis, sin a0 =
1/sqrt3; the radius of the base is L sin a. With lengths in d, forces in kn d and g = ks/kn, a base
element is in equilibrium if (L - 1) sin a - g S cos a + sqrt3 (sqrt3 L sin a - 1) = 0 (Eq. A2),
which is linear in L. S is the shear displacement. In the spring of Cundall and Strack (1979) it
grows with the displacement across the bond and rotates with the bond, dS = -L da. With L from the
equilibrium this is a linear differential equation in a, whose solution is an integral of sines. The
last term is absent for a base without bonds, which has its own path. `total` is the other common
spring, S = sin(a0 - a): the total displacement across the bond. Every function raises ValueError
outside its range.
"""

from collections.abc import Callable
from math import asin, cos, sin, sqrt, tan
from typing import NamedTuple

import numpy as np

from reference_solutions.bonds.lattice_material import Element, require_springs, sliding_strength
from reference_solutions.parameters import require_finite

A0 = asin(1.0 / sqrt(3.0))
LARGEST = 0.02  # largest strain and angle [rad]; quartzite fails at smaller ones
_X, _W = np.polynomial.legendre.leggauss(10)  # exact to rounding on arcs of 0.05
Spring = Callable[[float, float], float]


class Displacements(NamedTuple):
    """Displacements [m]: dz of the top element, X_n1 along and X_s1 across an inclined bond, X_n2
    along a horizontal bond.
    """

    dz: float
    xn1: float
    xs1: float
    xn2: float


class State(NamedTuple):
    """A point of a path: axial strain, lateral strain, stress [Pa], force Fz [N], displacements."""

    strain: float
    lateral: float
    stress: float
    fz: float
    x: Displacements

    @property
    def modulus(self) -> float:
        """The secant modulus [Pa]."""
        return self.stress / self.strain

    @property
    def poisson(self) -> float:
        """The secant Poisson's ratio, the negative lateral strain over the axial strain."""
        return -self.lateral / self.strain


def small_strain(fz: float, kn: float, ks: float) -> Displacements:
    """The displacements [m] under a force Fz [N] to first order (Eqs. 2a-d)."""
    require_springs(kn, ks, 1.0)
    require_finite("N", fz=fz)
    c = fz / (kn * (kn + ks))
    return Displacements(
        (5.0 * kn + ks) / 9.0 * c,
        sqrt(6.0) * (3.0 * kn + ks) / 18.0 * c,
        2.0 * sqrt(3.0) * kn / 9.0 * c,
        -sqrt(6.0) * (kn - ks) / 18.0 * c,
    )


def modulus_slope(gamma: float) -> float:
    """cE of the secant modulus E (1 + cE strain) with the incremental spring; gamma = ks/kn."""
    g = gamma
    return -6.0 * (g - 1.0) * (g + 3.0) / ((g + 1.0) * (g + 5.0) ** 2)


def poisson_slope(gamma: float) -> float:
    """c of the secant Poisson's ratio nu + c strain with the incremental spring, nu of Eq. 4."""
    g = gamma
    return 3.0 * (g - 4.0) * (g + 1.0) / (g + 5.0) ** 3


def incremental(turn: float, gamma: float) -> float:
    """S of Cundall and Strack (1979) with a bonded base, after a rotation of bonds by a - a0.

    It solves S' + (g/4) cot(a) S = -1/4 - (sqrt3/4)/sin a by the integrating factor sin^(g/4) a.
    """
    q = gamma / 4.0
    sines = np.sin(A0 + turn * (_X + 1.0) / 2.0)
    summed = turn / 2.0 * float(_W @ (sines**q + sqrt(3.0) * sines ** (q - 1.0))) / 4.0
    return float(-summed / sin(A0 + turn) ** q)


def total(turn: float, gamma: float) -> float:
    """S as the total displacement since the start, across the present direction of the bond."""
    return -sin(turn)


def equilibrium(
    strain: float, *, kn: float, ks: float, d: float, spring: Spring = incremental
) -> State:
    """The unit in equilibrium at an axial strain reached without reversal; no bond breaks.

    Raises ValueError unless 0 < |strain| <= 0.02.
    """
    require_springs(kn, ks, d)
    if not 0.0 < abs(strain) <= LARGEST:
        raise ValueError(f"strain = {strain}; it must be within +-{LARGEST} and not 0")
    turn = _root(lambda a: _bonded(a, kn, ks, d, spring).strain / strain - 1.0, -strain)
    return _bonded(turn, kn, ks, d, spring)


def loaded(fz: float, *, kn: float, ks: float, d: float, spring: Spring = incremental) -> State:
    """The unit in equilibrium under a force Fz [N] that grew from zero; no bond breaks.

    Raises ValueError if Fz is 0 or the strain by Eq. 2a exceeds 0.01.
    """
    strain = small_strain(fz, kn, ks).dz / (d * cos(A0))
    if not 0.0 < abs(strain) <= LARGEST / 2.0:
        raise ValueError(f"fz = {fz} N; it must not be 0 nor strain the unit by more than 0.01")
    turn = _root(lambda a: _bonded(a, kn, ks, d, spring).fz / fz - 1.0, -strain)
    return _bonded(turn, kn, ks, d, spring)


def tension_failure(element: Element, d: float) -> State:
    """The state at which the inclined bonds open, X_n1 = xb; its stress Tu compares with Eq. 7."""
    kn, ks, xb, *_ = element
    turn = _root(lambda a: _bonded(a, kn, ks, d).x.xn1 / xb - 1.0, -xb / d)
    return _bonded(turn, kn, ks, d)


def opening_failure(element: Element, d: float) -> State:
    """The state in compression at which horizontal bonds open, X_n2 = xb.

    Its stress -C_open compares with Eq. 8.
    """
    return _bonded(_opening(element, d), *element[:2], d)


def sliding_failure(element: Element, d: float) -> State:
    """The state at which the inclined bonds slide; its stress -Cu compares with Eq. 14.

    The horizontal bonds open first, at a fixed height z: the base widens to its new equilibrium,
    and the shear displacements change by dS = -(z/cos a) da. From there on S' + g cot(a) S = -1.
    """
    kn, ks, _, fs0, mu_p = element
    sliding_strength(fs0, mu_p, d)
    begin, shear = _widened(element, d)

    def margin(turn: float) -> float:
        state = _open(turn, begin, shear, kn, ks, d)
        return ks * abs(state.x.xs1) / (fs0 - mu_p * kn * state.x.xn1) - 1.0

    return _open(_root(margin, 2.0 * begin), begin, shear, kn, ks, d)


def opened(strain: float, element: Element, d: float) -> State:
    """The state at an axial strain on the path to `sliding_failure`, once the base has opened."""
    kn, ks, *_ = element
    begin, shear = _widened(element, d)

    def off(turn: float) -> float:
        return _open(turn, begin, shear, kn, ks, d).strain / strain - 1.0

    return _open(_root(off, 2.0 * begin), begin, shear, kn, ks, d)


def _bonded(turn: float, kn: float, ks: float, d: float, spring: Spring = incremental) -> State:
    """The state after a rotation of inclined bonds, without differences of nearly equal numbers."""
    g, a = ks / kn, A0 + turn
    shear = spring(turn, g)
    wider = 2.0 * cos(A0 + turn / 2.0) * sin(turn / 2.0)  # sin a - sin a0
    stretch = (g * shear * cos(a) - 3.0 * wider) / (4.0 * sin(a))
    return _state(turn, stretch, shear, kn, ks, d)


def _open(turn: float, begin: float, shear: float, kn: float, ks: float, d: float) -> State:
    """The state after a rotation without horizontal bonds, from `begin` where S was `shear`."""
    g, a = ks / kn, A0 + turn
    sines = np.sin(A0 + begin + (turn - begin) * (_X + 1.0) / 2.0)
    summed = (turn - begin) / 2.0 * float(_W @ sines**g)
    now = (shear * sin(A0 + begin) ** g - summed) / sin(a) ** g
    return _state(turn, g * now / tan(a), now, kn, ks, d)


def _state(turn: float, stretch: float, shear: float, kn: float, ks: float, d: float) -> State:
    a = A0 + turn
    half = 2.0 * sin(turn / 2.0)
    height = stretch * cos(a) - half * sin(A0 + turn / 2.0)
    radius = stretch * sin(a) + half * cos(A0 + turn / 2.0)
    fz = 3.0 * d * (kn * stretch * cos(a) + ks * shear * sin(a))
    x = Displacements(d * height, d * stretch, d * shear, d * sqrt(3.0) * radius)
    return State(height / cos(A0), sqrt(3.0) * radius, 2.0 * fz / (sqrt(3.0) * d * d), fz, x)


def _opening(element: Element, d: float) -> float:
    kn, ks, xb, *_ = element
    if not ks < kn:
        raise ValueError(f"ks = {ks} N/m; it must be below kn = {kn} N/m for a bond to open")
    return _root(lambda a: _bonded(a, kn, ks, d).x.xn2 / xb - 1.0, 3.0 * xb / d)


def _widened(element: Element, d: float) -> tuple[float, float]:
    """The rotation of inclined bonds at which the open base is in equilibrium, and their S."""
    kn, ks, *_ = element
    begin = _opening(element, d)
    before = _bonded(begin, kn, ks, d)
    z, held = cos(A0) * (1.0 + before.strain), before.x.xs1 / d

    def shear(turn: float) -> float:
        angles = A0 + begin + (turn - begin) * (_X + 1.0) / 2.0
        return held - z * (turn - begin) / 2.0 * float(_W @ (1.0 / np.cos(angles)))

    def force(turn: float) -> float:
        a = A0 + turn
        return (z / cos(a) - 1.0) * tan(a) - ks / kn * shear(turn)

    end = _root(force, 1.1 * begin)
    return end, shear(end)


def _root(f: Callable[[float], float], guess: float) -> float:
    """A root of a smooth function near `guess`, to 1e-11 of it by the secant method."""
    x, y = 0.999 * guess, guess
    fx, fy = f(x), f(y)
    for _ in range(60):
        if fy == fx or abs(y - x) <= 1e-11 * abs(y):
            return y
        x, fx, y = y, fy, y - fy * (y - x) / (fy - fx)
        if not abs(y) <= LARGEST * 4:
            break
        fy = f(y)
    raise ValueError(f"no balance within strains of {LARGEST}; the springs are too weak")
