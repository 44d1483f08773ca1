"""Four bonded elements compressed to failure while loads confine their base: friction."""

from __future__ import annotations

import functools
import math

import numpy as np

from cases._papers import LIU_2017
from cases.bonds.parts._quartzite import BRITTLE
from cases.bonds.parts._unit import CORNERS, EDGES
from cases.bonds.tetrahedral_strength import BEYOND, EVERY, RATES, at_zero_rate, slid
from reference_solutions.bonds import confined_unit, lattice_material
from reference_solutions.bonds.confined_unit import Failure
from reference_solutions.bonds.lattice_material import Element
from vv.ask import Displacement, History, Knobs, Method, Observable, Reaction, Run
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Shown,
    Source,
    Trial,
    Variant,
    capped,
)
from vv.scene import Bonds, Contact, Scene, Spheres

ON_BASE = np.array([[True, True, False]] * 4)  # the top is driven, the base slides on its plane
APART = 10.0  # diameters between the units, which never meet
SHARES = {"two": (0.0, 1.0), "five": (0.0, 0.125, 0.25, 0.5, 1.0)}  # of the largest load


def _scene(p: Parameters, shares: tuple[float, ...]) -> Scene:
    """Two units for each load, compressed at two steady rates; loads act from the start."""
    d, nu = p["d"], lattice_material.poissons_ratio(p["kn"], p["ks"])
    velocity = p["rate"] * d * np.where([[0, 0, 1]], CORNERS[0, 2] * (CORNERS > 0.1), -nu * CORNERS)
    inward = np.where(CORNERS[:, 2:] > 0.1, 0.0, -CORNERS * np.sqrt(3.0)) * [1.0, 1.0, 0.0]
    units = [(share, rate) for share in shares for rate in RATES]
    many, size = len(units), len(CORNERS)
    aside = [np.array([APART * k, 0.0, 0.0]) for k in range(many)]
    spheres = Spheres(
        np.concatenate([d * (CORNERS + shift) for shift in aside]),
        np.concatenate([rate * velocity for _, rate in units]),
        np.full(many * size, d / 2),
        np.full(many * size, p["m"]),
        np.tile(ON_BASE, (many, 1)),
        load=np.concatenate([share * p["fx"] * inward for share, _ in units]),
    )
    pairs = np.concatenate([EDGES + size * k for k in range(many)])
    strength = (p["kn"] * p["xb"], p["fs0"])
    bonds = Bonds(pairs, d, p["kn"], p["ks"], *strength)  # type: ignore[arg-type]  # for all
    return Scene((spheres,), Contact(p["kn"], p["ks"], p["mu_p"]), p["eta"], bonds=bonds)


def _declare(variant: str, p: Parameters) -> Trial:
    if not p["fx"] > 0.0:
        raise ValueError(f"fx = {p['fx']!r} N; it must be positive")
    shares = SHARES[variant]
    exact = [_failure(p, share) for share in shares]
    goal = History(BEYOND * abs(exact[-1].strain / p["rate"]), EVERY)
    firsts = [len(CORNERS) * k for k in range(len(RATES) * len(shares))]
    moved = [Displacement(first + i) for first in firsts for i in range(3)]
    watched: tuple[Observable, ...] = (*(Reaction(first) for first in firsts), *moved)
    strengths = tuple(
        Scalar(
            f"C_u at {share:g} fx", f"C_u({share:g} fx)", "Pa", "pressure at which inclined bonds "
            "slide",
            functools.partial(_strength, p, which), failed.pressure, failed.pressure,
            _bounds(p, _remaining_oscillation(p, failed)),
        )
        for which, (share, failed) in enumerate(zip(shares, exact, strict=True))
    )  # fmt: skip
    study = Ladder(_scene(p, shares), goal, watched, LEVELS)
    return Trial(study, (*strengths, *_slopes(p, exact)))


def _strength(p: Parameters, which: int, run: Run) -> float:
    """The pressure [Pa] at which the units under a load fail, extrapolated to zero rate."""
    return at_zero_rate(functools.partial(slid, p), run, len(RATES) * which)


def _failure(p: Parameters, share: float) -> Failure:
    """The failure by sliding of inclined bonds under a share of the load fx.

    Raises ValueError if it is not the largest pressure.
    """
    element = Element(*(p[name] for name in ("kn", "ks", "xb", "fs0", "mu_p")))
    failed = confined_unit.sliding_failure(element, p["d"], share * p["fx"])
    given = f"fx = {p['fx']!r} N, of which one unit bears {share:g}"
    if not failed.pressure > failed.held:
        raise ValueError(f"{given}; its bonds slide below the pressure that opens the base")
    if not failed.spare > 0.0:
        raise ValueError(
            f"{given}; the oscillation after the base opens makes inclined bonds slide"
        )
    return failed


def _remaining_oscillation(p: Parameters, failed: Failure) -> float:
    """The part of the oscillation after the base opens that viscosity leaves in the faster unit."""
    late = (failed.opened - failed.strain) / (RATES[0] * abs(p["rate"]))
    return math.exp(-p["eta"] * late / (2.0 * p["m"]))


def _slopes(p: Parameters, exact: list[Failure]) -> tuple[Quantity, ...]:
    """The increase of C_u over the largest horizontal stress, and that over the printed value."""
    across = confined_unit.horizontal_stress(p["fx"], p["d"])
    free, held = exact[0].pressure, exact[-1].pressure
    due = (held - free) / across
    swing = sum(one.pressure * _remaining_oscillation(p, one) for one in (exact[0], exact[-1])) / (
        held - free
    )
    printed = lattice_material.printed_confinement(p["mu_p"])

    def slope(run: Run) -> float:
        last = len(exact) - 1
        return (_strength(p, last, run) - _strength(p, 0, run)) / across

    return (
        Scalar("P", "P", "", "increase of C_u over the horizontal stress", slope, due, due,
               _bounds(p, swing)),
        Scalar("P over Eq. 15", "P/P_15", "", "the same over P as printed", lambda run:
               slope(run) / printed, None, 1.0, Shown(HALF)),
        Scalar("P over twice Eq. 15", "P/2P_15", "", "the same over P with the stress of Eq. 11a "
               "halved", lambda run: slope(run) / (2.0 * printed), None, 1.0, Shown(SMALL)),
    )  # fmt: skip


def _bounds(p: Parameters, swing: float) -> Exact:
    """For equilibrium, apart from effects of the rate and of the oscillation."""
    hurry = (p["eta"] * p["rate"] * p["d"] / p["fs0"] / USUAL) ** 2
    bound = capped(1e-5 * max(1.0, hurry) + swing, RATE)
    return Exact({Method.SECOND_ORDER: bound, Method.FIRST_ORDER: bound})


USUAL = 6.0 * 30.0 * 1e-3 / 18.4522728  # force of viscosity over strength, by default
RATE = (
    "strengths are extrapolated from two rates: an error of second order in the viscous force over "
    "the strength remains. The unit also oscillates after its base opens, until viscosity damps "
    "that"
)
HALF = (
    "Eq. 11a gives twice the stress of a section through the unit, so that its P is half of that "
    "here"
)
SMALL = (
    "P is derived for small strains; at failure the unit is shorter by half a per cent, and wider"
)
RUNGS = tuple(Knobs(dt=4e-8 / 2**i) for i in range(3))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS[:2], Level.PAPER: RUNGS}
FORMULA = "|F_s1| = fs0 - mu_p F_n1 on the path of balances under the loads; P = dC_u/dsigma_xx"
INERT = frozenset({"m", "eta", "rate"})
CLOSED = {"xb": "no bond fails by opening: 1 % of xb changes the strength by 2e-8"}
CASE = Case(
    name="confined-strength",
    title="Four bonded elements pressed under confinement",
    source=Source(
        *LIU_2017,
        "Eqs. 9 to 15. Eq. 11a gives twice the horizontal stress of a section or of the virial, so "
        "that P of Eqs. 12 and 15 is half of its right value, and mu_i of Table 1 is 1.56 and not "
        "1. The reference is equilibrium at finite displacement. The paper shows no such test; "
        "loads, viscosity and rates are chosen.",
    ),
    parameters=(
        *BRITTLE,
        Parameter("fx", 8.0, "N", "largest inward load on each element of the base"),
        Parameter("eta", 6.0, "N s/m", "viscosity on every element"),
        Parameter("rate", -30.0, "1/s", "strain rate of the slower units, tension positive"),
    ),
    variants=(
        Variant(
            "two", "without loads, and with the largest ones", FORMULA, inert=INERT, unseen=CLOSED
        ),
        Variant(
            "five", "with five loads", FORMULA, inert=INERT, level=Level.DEFAULT, unseen=CLOSED
        ),
    ),
    declare=_declare,
)
