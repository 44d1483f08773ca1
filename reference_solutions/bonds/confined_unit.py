"""The unit of four bonded elements under axial pressure, held together by dead loads (Liu 2017).

The unit is that of `tetrahedral_unit` with an inward load Fx [N] on each of the three base
elements: bonds are springs kn, ks [N/m] of length d [m], and an inclined bond of length L makes the
angle a with the axis, sin a0 = 1/sqrt3. With lengths in d, forces in kn d, g = ks/kn and
f = Fx/(kn d), a base element is in equilibrium if

(L - 1) sin a - g S cos a + sqrt3 (sqrt3 L sin a - 1) + f = 0

and without the third term after the base has opened. The shear spring rotates with its bond,
S' = -L, so that S sin^q a is an integral of sines: q = g/4 until the base opens (X_n2 = xb), and
q = g from there until inclined bonds slide (Eq. 1). Twice, when the loads are applied and when the
base opens, the unit moves to its new equilibrium at a fixed height z, where L = z/cos a and
S = -z asinh(tan a) + c.

The loads correspond to the horizontal stress (sqrt6/2) Fx/d^2, both on a section and by the virial,
which is half of Eq. 11a. Every function raises ValueError outside its range.
"""

from collections.abc import Callable
from math import asin, asinh, atan, cos, sin, sqrt, tan
from typing import NamedTuple

import numpy as np

from reference_solutions.bonds.lattice_material import Element, sliding_strength
from reference_solutions.parameters import require_at_least_0, require_positive

A0 = asin(1.0 / sqrt(3.0))
LARGEST = 0.08  # largest rotation [rad] of a bond; those of quartzite slide at smaller ones
_X, _W = np.polynomial.legendre.leggauss(12)  # exact to rounding on such arcs


class Failure(NamedTuple):
    """The pressure [Pa] on the original area and the axial strain at which inclined bonds slide.

    opened, held: the strain and the pressure [Pa] at which the base opened before that. settled:
    the pressure [Pa] in the new equilibrium there. Loads of inclined bonds are their shear less the
    friction that closed bonds would have, over fs0, so that they slide at one: before the base
    opens, in the new equilibrium (after), and where the unit swings beyond it (swung). pulled:
    their stretch there over xb, at which they open.
    """

    pressure: float
    strain: float
    opened: float
    held: float
    settled: float
    before: float
    after: float
    swung: float
    pulled: float


def horizontal_stress(fx: float, d: float) -> float:
    """The horizontal stress [Pa] of inward loads fx [N] on the base, which is half of Eq. 11a."""
    require_at_least_0("N", fx=fx)
    require_positive("m", d=d)
    return sqrt(6.0) / 2.0 * fx / (d * d)


def sliding_failure(element: Element, d: float, fx: float, overshoot: float = 1.0) -> Failure:
    """The pressure at which inclined bonds slide under inward loads fx [N] on the base.

    overshoot: how far the unit swings beyond its new equilibrium when the base opens, over its
    distance from that before; 1 without damping. Raises ValueError where inclined bonds slide
    before the base opens, or where it never opens.
    """
    kn, ks, xb, fs0, mu_p = element
    sliding_strength(fs0, mu_p, d)
    require_at_least_0("N", fx=fx)
    require_positive("m", xb=xb)
    force, g = kn * d, ks / kn
    unit = _Unit(g, fx / force)
    limit = fs0 / force

    def load(length: float, shear: float) -> float:
        return (g * abs(shear) + mu_p * (length - 1.0)) / limit

    def pressure(a: float, length: float, shear: float) -> float:
        fz = 3.0 * force * ((length - 1.0) * cos(a) + g * shear * sin(a))
        return -2.0 * fz / (sqrt(3.0) * d * d)

    loaded = unit.widened(A0, cos(A0), 0.0, sqrt(3.0))
    opens = _root(lambda a: _base(a, unit.bonded(a, *loaded)[0]) - xb / d, A0, LARGEST)
    length, shear = unit.bonded(opens, *loaded)
    opened = length * cos(opens) / cos(A0) - 1.0
    z, held, before = length * cos(opens), pressure(opens, length, shear), load(length, shear)
    rests, then = unit.widened(opens, z, shear, 0.0)
    after = load(z / cos(rests), then)
    if before >= 1.0 or after >= 1.0:
        raise ValueError(f"fx = {fx} N; inclined bonds slide before the base opens")
    far = atan(tan(rests) + overshoot * (tan(rests) - tan(opens)))
    swung = load(z / cos(far), shear - z * (asinh(tan(far)) - asinh(tan(opens))))
    pulled = (z / cos(far) - 1.0) * d / xb
    settled = pressure(rests, z / cos(rests), then)

    def margin(length: float, shear: float) -> float:
        # bonds that turn outwards have a negative shear: a ratio without |S| has no kink
        return -g * shear / (limit - mu_p * (length - 1.0)) - 1.0

    a = _root(lambda a: margin(*unit.open(a, rests, then)), rests, LARGEST, opens)
    length, shear = unit.open(a, rests, then)
    strain = length * cos(a) / cos(A0) - 1.0
    failed = pressure(a, length, shear)
    return Failure(failed, strain, opened, held, settled, before, after, swung, pulled)


class _Unit(NamedTuple):
    """The parameters g and f of a unit; its paths give (L, S) at an angle a from a start (a, S)."""

    g: float
    f: float

    def bonded(self, a: float, begin: float, shear: float) -> tuple[float, float]:
        """The path (L, S) with the bonds of the base."""
        q, pull = self.g / 4.0, sqrt(3.0) - self.f
        summed = _integral(lambda s: s**q + pull * s ** (q - 1.0), begin, a)
        now = (shear * sin(begin) ** q - summed / 4.0) / sin(a) ** q
        return (sin(a) + pull + self.g * now * cos(a)) / (4.0 * sin(a)), now

    def open(self, a: float, begin: float, shear: float) -> tuple[float, float]:
        """The path (L, S) without the bonds of the base."""
        summed = _integral(lambda s: s**self.g - self.f * s ** (self.g - 1.0), begin, a)
        now = (shear * sin(begin) ** self.g - summed) / sin(a) ** self.g
        return 1.0 + (self.g * now * cos(a) - self.f) / sin(a), now

    def widened(self, begin: float, z: float, shear: float, bonds: float) -> tuple[float, float]:
        """(a, S) in equilibrium at the height z; `bonds` is sqrt3 if the base is bonded, else 0."""

        def now(a: float) -> float:
            return shear - z * (asinh(tan(a)) - asinh(tan(begin)))

        def force(a: float) -> float:
            length = z / cos(a)
            base = bonds * (sqrt(3.0) * length * sin(a) - 1.0)
            return (length - 1.0) * sin(a) - self.g * now(a) * cos(a) + base + self.f

        a = _root(force, begin, LARGEST)
        return a, now(a)


def _base(a: float, length: float) -> float:
    """X_n2: the stretch of a bond of the base, whose length at rest is 1."""
    return sqrt(3.0) * length * sin(a) - 1.0


def _integral(f: Callable[..., object], begin: float, end: float) -> float:
    """The integral over the angle a of a function of sin a."""
    sines = np.sin(begin + (end - begin) * (_X + 1.0) / 2.0)
    return float((end - begin) / 2.0 * (_W @ np.asarray(f(sines))))


def _root(
    f: Callable[[float], float], guess: float, reach: float, other: float | None = None
) -> float:
    """A root of a smooth function within `reach` of a guess, to rounding by the secant method.

    other: a second guess near the first.
    """
    x, y = guess - 1e-4 if other is None else other, guess
    fx, fy = f(x), f(y)
    for _ in range(60):
        if fy == fx or abs(y - x) <= 1e-13:
            return y
        x, fx, y = y, fy, y - fy * (y - x) / (fy - fx)
        if not abs(y - guess) <= reach:
            break
        fy = f(y)
    raise ValueError(
        f"no balance within {reach} rad of {guess:.6g}; the base never opens, or the springs are "
        "too weak"
    )
