"""The elements that represent quartzite in Liu et al. (2017): Table 1, and Eq. 27 for the mass."""

import math

from reference_solutions.bonds.lattice_material import Element
from vv.case import Parameter, Parameters

KN = Parameter("kn", 46793831.1079, "N/m", "normal stiffness of a bond (Table 1)")
D = Parameter("d", 1e-3, "m", "diameter of an element, length of a bond")
M = Parameter("m", 1.87383297e-6, "kg", "mass of an element (Eq. 27)")
ELASTIC = (KN, Parameter("gamma", 5 / 29, "", "ks/kn of a bond (Table 1)"), D, M)
KS = Parameter("ks", 8067901.91516, "N/m", "shear stiffness of a bond (Table 1)")
BRITTLE = (
    KN,
    KS,
    Parameter("xb", 1.70370370e-7, "m", "stretch that opens a bond (Table 1)"),
    Parameter("fs0", 18.4522728, "N", "shear strength under no normal force (Table 1)"),
    Parameter("mu_p", 0.396446609, "", "friction between elements (Table 1)"),
    D,
    M,
)


def element_of(p: Parameters) -> Element:
    """The element with the parameters of BRITTLE."""
    return Element(*(p[name] for name in ("kn", "ks", "xb", "fs0", "mu_p")))


def slower(p: Parameters) -> float:
    """The factor by which bonds oscillate more slowly than at the defaults, a power of 2.

    Steps are scaled by it. On stiffer bonds the default steps would be unstable; on softer ones
    they would only add rounding errors, since positions are known to 1e-16 and the strain is 1e-6.
    """
    ratio = math.sqrt(p["m"] / M.value * KN.value / p["kn"])
    return float(2.0 ** math.floor(math.log2(ratio)))


def slower_lattice(kn: float, ks: float, m: float) -> float:
    """As `slower`, for lattices, where stiff shear springs quicken the oscillation as well.

    The squares of the frequencies of an element add up to 4 (kn + 2 ks)/m in three directions.
    """
    springs = (KN.value + 2.0 * KS.value) / (kn + 2.0 * ks)
    return float(2.0 ** math.floor(math.log2(math.sqrt(m / M.value * springs)) + ROUNDS))


ROUNDS = 1e-9  # of a power of 2: how far the ratio of the usual springs may be from one
