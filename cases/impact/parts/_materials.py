"""Materials of the impact benchmarks of Chung and Ooi (2011), and their moduli.

Moduli and densities are those of the paper, as benchmarks of other codes quote them.
"""

from __future__ import annotations

import math

from reference_solutions.impact import hertz
from vv.case import Parameters, Source
from vv.scene import Hertz

CHUNG_OOI_2011 = Source(
    "Chung and Ooi (2011), Benchmark tests for verifying discrete element modelling codes at "
    "particle impact level, Granular Matter 13(5), 643-656",
    "10.1007/s10035-011-0277-0",
)
MATERIALS = {  # Young's modulus [Pa], Poisson's ratio, density [kg/m3]
    "glass": (48e9, 0.20, 2800.0),
    "limestone": (20e9, 0.25, 2500.0),
    "aluminium": (70e9, 0.30, 2699.0),
    "magnesium": (40e9, 0.35, 1800.0),
    "alumina": (380e9, 0.23, 4000.0),
    "alloy": (70e9, 0.33, 2700.0),
    "steel": (208e9, 0.30, 7850.0),
    "polyethylene": (1e9, 0.40, 1400.0),
}


def defaults(material: str) -> dict[str, float]:
    """The parameters of a variant of this material."""
    return dict(zip(("young", "poisson", "rho"), MATERIALS[material], strict=True))


def mass(p: Parameters) -> float:
    """The mass of a sphere [kg]."""
    return p["rho"] * 4.0 / 3.0 * math.pi * p["R"] ** 3


def require_shallow(overlap: float, radius: float) -> None:
    """Raises ValueError where bodies overlap [m] by a tenth of a radius [m] or more.

    Laws of contact hold for small overlaps, and codes are judged as penetrating beyond that.
    """
    if not overlap < 0.1 * radius:
        raise ValueError(
            f"an overlap of {overlap:.4g} m at most; it must be below a tenth of the radius, "
            f"{0.1 * radius:g} m"
        )


def moduli(p: Parameters, bodies: int) -> Hertz:
    """Moduli of a contact of `bodies` elastic bodies of one material; any other body is rigid."""
    if not 0.0 <= p["poisson"] <= 0.5:
        raise ValueError(f"poisson = {p['poisson']!r}; Poisson's ratio must lie in [0, 0.5]")
    return Hertz(
        hertz.effective_modulus(p["young"], p["poisson"]) / bodies,
        hertz.effective_shear_modulus(p["young"], p["poisson"]) / bodies,
    )
