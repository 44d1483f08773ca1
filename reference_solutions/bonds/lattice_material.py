"""Conversion between bonds and material constants of a close-packed lattice (Liu et al. 2017).

Identical elements of diameter d [m] are bonded to their twelve neighbours by a normal spring kn and
a shear spring ks [N/m]. A bond opens when it is stretched by xb [m] and slides when its shear force
exceeds fs0 - mu_p F_n (Eq. 1, tension positive). The material is described by Young's modulus E,
tensile strength Tu and uniaxial compressive strength Cu [Pa], Poisson's ratio nu and the
coefficient of internal friction mu_i.

Eq. 11a is twice the horizontal stress of the lattice, which is (sqrt6/2) Fx/d^2 both on a section
and by the virial. Eqs. 12 and 15 therefore state half the P of a lattice with mu_p, and Eq. B5
inverts the printed equations. `printed_internal_friction` is the value that the paper intends,
`internal_friction` that of the lattice. All other equations are correct as printed. Every function
raises ValueError outside its range.
"""

from math import sqrt
from typing import NamedTuple

from reference_solutions.parameters import require_at_least_0, require_finite, require_positive


class Material(NamedTuple):
    """E [Pa], nu [-], Tu [Pa], Cu [Pa], mu_i [-] (Table 1, left); mu_i is that of Eq. 15."""

    E: float
    nu: float
    Tu: float
    Cu: float
    mu_i: float


class Element(NamedTuple):
    """kn [N/m], ks [N/m], xb [m], fs0 [N], mu_p [-] (Table 1, right)."""

    kn: float
    ks: float
    xb: float
    fs0: float
    mu_p: float


QUARTZITE = Material(E=90e9, nu=0.16, Tu=25e6, Cu=252e6, mu_i=1.0)
"""Table 1; the elements there have d = 0.001 m."""


def element(material: Material, d: float) -> Element:
    """The properties of elements of diameter d that form the material (Eqs. B1-B5).

    Raises ValueError unless 0 <= nu <= 1/5 (ks would be negative, or exceed kn) and mu_i is at
    least 0.3535534, since Eq. 15 gives 1/(2 sqrt2) at mu_p = 0.
    """
    E, nu, Tu, Cu, mu_i = material
    require_positive("Pa", E=E, Tu=Tu, Cu=Cu)
    require_positive("m", d=d)
    _require_within("nu", nu, 0.0, 0.2)
    require_finite("[-]", mu_i=mu_i)
    kn = sqrt(2.0) * E * d / (4.0 * (1.0 - 2.0 * nu))
    ks = kn * (1.0 - 5.0 * nu) / (1.0 + nu)
    root = sqrt(1.0 + mu_i * mu_i) + mu_i
    mu_p = sqrt(2.0) * (root * root - 2.0) / (2.0 + 2.0 * root * root)
    if not mu_p >= -1e-15:
        raise ValueError(f"mu_i = {mu_i}; Eq. 15 has no mu_p below mu_i = 1/(2 sqrt2)")
    xb = Tu / tensile_strength(kn, ks, 1.0, d)
    return Element(kn, ks, xb, (1.0 - sqrt(2.0) * mu_p) / 6.0 * Cu * d * d, max(mu_p, 0.0))


def material(element: Element, d: float) -> Material:
    """The material of elements of diameter d by the printed formulas, the inverse of B1-B5."""
    kn, ks, xb, fs0, mu_p = element
    return Material(
        youngs_modulus(kn, ks, d),
        poissons_ratio(kn, ks),
        tensile_strength(kn, ks, xb, d),
        sliding_strength(fs0, mu_p, d),
        printed_internal_friction(mu_p),
    )


def element_mass(rho: float, d: float) -> float:
    """m [kg] = rho sqrt2 d^3/2 (Eq. 27): the share of an element in the volume of the lattice."""
    require_positive("kg/m3", rho=rho)
    require_positive("m", d=d)
    return rho * sqrt(2.0) * d**3 / 2.0


def youngs_modulus(kn: float, ks: float, d: float) -> float:
    """E [Pa] along the axis of a unit (Eq. 6), which is the c axis of the lattice."""
    require_springs(kn, ks, d)
    return 6.0 * sqrt(2.0) * kn * (kn + ks) / (d * (5.0 * kn + ks))


def poissons_ratio(kn: float, ks: float) -> float:
    """nu [-] under strain along the same axis (Eq. 4): 1/5 without shear springs, 0 if ks = kn."""
    require_springs(kn, ks, 1.0)
    return (kn - ks) / (5.0 * kn + ks)


def tensile_strength(kn: float, ks: float, xb: float, d: float) -> float:
    """The tension Tu [Pa] at which the inclined bonds open (Eq. 7)."""
    require_springs(kn, ks, d)
    require_positive("m", xb=xb)
    return 6.0 * sqrt(2.0) * kn * (kn + ks) / (3.0 * kn + ks) * xb / (d * d)


def opening_strength(kn: float, ks: float, xb: float, d: float) -> float:
    """The axial pressure C_open [Pa], positive, at which horizontal bonds open (Eq. 8).

    Raises ValueError if ks >= kn, since the unit then does not widen.
    """
    require_springs(kn, ks, d)
    require_positive("m", xb=xb)
    if not ks < kn:
        raise ValueError(f"ks = {ks} N/m; it must be below kn = {kn} N/m for a bond to open")
    return 6.0 * sqrt(2.0) * kn * (kn + ks) / (kn - ks) * xb / (d * d)


def sliding_strength(fs0: float, mu_p: float, d: float) -> float:
    """The axial pressure Cu [Pa], positive, at which inclined bonds slide (Eq. 14).

    The horizontal bonds are open.
    """
    require_positive("N", fs0=fs0)
    require_positive("m", d=d)
    _require_friction(mu_p)
    return 6.0 / (1.0 - sqrt(2.0) * mu_p) * fs0 / (d * d)


def printed_internal_friction(mu_p: float) -> float:
    """mu_i [-] as printed (Eq. 15): P = (2 + sqrt2 mu_p)/(1 - sqrt2 mu_p)."""
    return _internal_friction(printed_confinement(mu_p))


def internal_friction(mu_p: float) -> float:
    """mu_i [-] of the lattice (Eq. 15 with the stress of Eq. 11a halved): P is twice as large."""
    return _internal_friction(2.0 * printed_confinement(mu_p))


def require_springs(kn: float, ks: float, d: float) -> None:
    """Raises ValueError unless kn > 0, ks >= 0 and d > 0."""
    require_positive("N/m", kn=kn)
    require_at_least_0("N/m", ks=ks)
    require_positive("m", d=d)


def printed_confinement(mu_p: float) -> float:
    """P [-] as printed: the increase of the axial stress at sliding per horizontal stress."""
    _require_friction(mu_p)
    return (2.0 + sqrt(2.0) * mu_p) / (1.0 - sqrt(2.0) * mu_p)


def _internal_friction(P: float) -> float:
    """The slope mu_i of Coulomb's criterion, from P = (sqrt(1 + mu_i^2) + mu_i)^2 (Eq. 13)."""
    return (P - 1.0) / (2.0 * sqrt(P))


def _require_friction(mu_p: float) -> None:
    """Raises ValueError unless 0 <= mu_p < 1/sqrt2, where an inclined bond locks.

    No axial pressure makes a locked bond slide.
    """
    _require_within("mu_p", mu_p, 0.0, 0.7071067811865474)


def _require_within(name: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise ValueError(f"{name} = {value}; it must be within [{low:.7g}, {high:.7g}]")
