"""Bounds of the pressure on blocks whose bonds open while waves pass."""

from __future__ import annotations

import numpy as np

from cases.bonds.parts._quartzite import BRITTLE, element_of
from reference_solutions.bonds import lattice_material
from reference_solutions.bonds.close_packed_lattice import Lattice
from reference_solutions.bonds.tetrahedral_unit import opening_failure
from vv.ask import Method
from vv.case import Exact, Parameters, Shown, Tolerance

CLASSES = (Method.SECOND_ORDER, Method.FIRST_ORDER)
SMALL = 82
FIRST = 0.6  # strain of the first opening over that of Eq. 8, at the case's own springs
WAVES = (
    "in blocks of more than 82 elements the wave of an opening also opens bonds that bear up to a "
    "twentieth less, at any rate"
)
PACED = "both errors grow with the stretch of a bond, over xb, while a wave passes it"
ORDER = (
    "which of the bonds that are overstretched together open, and which then bear less and stay, "
    "is not determined by balance. Slow histories of other orders than those that are computed "
    "differ from them by a hundredth, and the bound holds at the case's own parameters only"
)


def bounds(value: float, reason: str, slack: str = "") -> Exact:
    return Exact(dict.fromkeys(CLASSES, Tolerance(value, reason, slack=slack)))


def history_bounds(block: Lattice, own: bool) -> Exact | Shown:
    """Of the mean distance from slow histories; own: the parameters are the case's."""
    value = _waves(block, 5e-3)
    return bounds(value, f"viscosity adds a thousandth; {WAVES}") if own else Shown(ORDER)


def after_openings(p: Parameters, block: Lattice, apart: float, own: bool) -> Exact | Shown:
    """Of a landmark that follows some openings; apart: the strain between two outputs; own: the
    parameters are the case's.
    """
    return first_opening(p, block, apart, None) if own else Shown(ORDER)


def first_opening(p: Parameters, block: Lattice, apart: float, opens: float | None) -> Exact:
    """apart: the strain between two outputs; opens: that at which the slow network's first bond
    opens, or None at the case's own parameters.
    """
    springs = {name: p[name] for name in ("kn", "ks", "d")}
    strength = lattice_material.opening_strength(xb=p["xb"], **springs)
    inside = strength / lattice_material.youngs_modulus(**springs)
    first = FIRST * inside if opens is None else opens
    pace = max(1.0, _pace(p))
    usual = {one.name: one.value for one in BRITTLE}
    sooner = first / inside * max(0.0, _sooner(p) - _sooner(usual))
    return bounds(
        max(_waves(block, 6e-3) * pace, apart / first + 1.8e-3 * pace) + sooner,
        "an output may precede an opening by the strain between outputs, over that of the first "
        "opening, which is 0.6 of that by Eq. 8 at the case's own parameters; viscosity adds a "
        f"thousandth at a rate of 1/s; {WAVES}; {PACED}; the slow network has small strains, and "
        "larger ones than the case's own open bonds sooner, as in the exact path of a unit",
        slack="how soon an output follows an opening is chance",
    )


def slope_bounds(p: Parameters) -> Exact:
    return bounds(
        1e-4 * max(1.0, _pace(p)),
        "the path of units without a base is exact; viscosity adds in proportion to the rate, and "
        "waves of the last opening remain",
    )


def _pace(p: Parameters) -> float:
    """The stretch of a bond while a wave passes it over xb, relative to that at the defaults."""
    given = {one.name: one.value for one in BRITTLE}
    passes = np.sqrt(p["m"] / given["m"] * given["kn"] / p["kn"])
    return float(abs(p["rate"]) * p["d"] / given["d"] * given["xb"] / p["xb"] * passes)


def _sooner(p: Parameters) -> float:
    """How far below Eq. 8, relative to it, the bonds of a unit open at finite strain."""
    element = element_of(p)
    small = lattice_material.opening_strength(*element[:3], p["d"])
    return 1.0 - abs(opening_failure(element, p["d"]).stress) / small


def _waves(block: Lattice, small: float) -> float:
    """The bound `small` for the smallest block, and a larger one for others."""
    return small if len(block.position) <= SMALL else 5e-2
