"""Four bonded elements compressed to failure while loads confine their base: friction."""

from __future__ import annotations

import functools

import numpy as np

from cases._papers import LIU_2017
from cases.bonds.parts import _open_base as open_base
from cases.bonds.parts._loading import (
    APART,
    BEYOND,
    EVERY,
    RATES,
    at_zero_rate,
    coarsest,
    levels,
    require_way,
    slid,
)
from cases.bonds.parts._quartzite import BRITTLE
from cases.bonds.parts._unit import CORNERS, EDGES
from reference_solutions.bonds import confined_unit, lattice_material
from reference_solutions.bonds.confined_unit import Failure
from vv.ask import Displacement, History, Method, Observable, Reaction, Run
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
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Bonds, Contact, Scene, Spheres

ON_BASE = np.array([[True, True, False]] * 4)  # the top is driven, the base slides on its plane
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
    require_way(p, -1.0)
    shares = SHARES[variant]
    scene = _scene(p, shares)
    exact = [_failure(p, share) for share in shares]
    late = open_base.late_strain(p, shares[-1] * p["fx"], exact[-1].strain)
    goal = History(BEYOND * abs(late / p["rate"]), EVERY)
    firsts = [len(CORNERS) * k for k in range(len(RATES) * len(shares))]
    moved = [Displacement(first + i) for first in firsts for i in range(3)]
    watched: tuple[Observable, ...] = (*(Reaction(first) for first in firsts), *moved)
    strengths = tuple(
        Scalar(
            f"C_u at {share:g} fx", f"C_u({share:g} fx)", "Pa", "pressure at which inclined bonds "
            "slide",
            functools.partial(_strength, p, which), failed.pressure, failed.pressure,
            _bounds(_uncertain(p, share, failed) / failed.pressure),
        )
        for which, (share, failed) in enumerate(zip(shares, exact, strict=True))
    )  # fmt: skip
    study = Ladder(scene, goal, watched, levels(coarsest(p)))
    return Trial(study, (*strengths, *_slopes(p, shares, exact)))


def _strength(p: Parameters, which: int, run: Run) -> float:
    """The pressure [Pa] at which the units under a load fail, extrapolated to zero rate."""
    return at_zero_rate(functools.partial(slid, p), run, len(RATES) * which)


def _failure(p: Parameters, share: float) -> Failure:
    """The failure by sliding of inclined bonds under a share of the load fx.

    Raises ValueError if it is not the largest pressure.
    """
    failed = open_base.under(p, share * p["fx"])
    given = f"fx = {p['fx']!r} N, of which one unit bears {share:g}"
    open_base.require_largest(p, share * p["fx"], given)
    open_base.require_sound(p, failed, given)
    return failed


def _uncertain(p: Parameters, share: float, failed: Failure) -> float:
    """What rates of loading and the oscillation leave in the strength of a unit [Pa]."""
    left = max(abs(_hurried(p, share, failed)), SETTLED * failed.pressure)
    return left + open_base.swings(p, failed)


def _hurried(p: Parameters, share: float, failed: Failure) -> float:
    """What viscosity leaves in the strength of a unit under a share of the load fx [Pa]."""
    return open_base.hurried(p, share * p["fx"], failed)


def _slopes(p: Parameters, shares: tuple[float, ...], exact: list[Failure]) -> tuple[Quantity, ...]:
    """The increase of C_u over the largest horizontal stress, and that over the printed value."""
    across = confined_unit.horizontal_stress(p["fx"], p["d"])
    free, held = exact[0].pressure, exact[-1].pressure
    due = (held - free) / across
    unsure = _unsure_increase(p, (shares[0], exact[0]), (shares[-1], exact[-1]))
    printed = lattice_material.printed_confinement(p["mu_p"])

    def slope(run: Run) -> float:
        last = len(exact) - 1
        return (_strength(p, last, run) - _strength(p, 0, run)) / across

    return (
        Scalar("P", "P", "", "increase of C_u over the horizontal stress", slope, due, due,
               _bounds(unsure / (held - free))),
        Scalar("P over Eq. 15", "P/P_15", "", "the same over P as printed", lambda run:
               slope(run) / printed, None, 1.0, Shown(HALF)),
        Scalar("P over twice Eq. 15", "P/2P_15", "", "the same over P with the stress of Eq. 11a "
               "halved", lambda run: slope(run) / (2.0 * printed), None, 1.0, Shown(SMALL)),
    )  # fmt: skip


def _unsure_increase(
    p: Parameters, lower: tuple[float, Failure], upper: tuple[float, Failure]
) -> float:
    """What rates and oscillations leave in the difference of two strengths [Pa].

    Viscosity leaves between nothing and `_hurried` in each, mostly of one sign, so that the larger
    one bounds their difference.
    """
    (_, free), (_, held) = lower, upper
    one, other = _hurried(p, *lower), _hurried(p, *upper)
    left = max(abs(one), abs(other), abs(one - other))
    swings = sum(open_base.swings(p, of) for of in (free, held))
    return max(left, SETTLED * (free.pressure + held.pressure)) + swings


def _bounds(value: float) -> Exact:
    """For equilibrium, apart from effects of the rate and of the oscillation."""
    bound = Tolerance(value, RATE)
    return Exact({Method.SECOND_ORDER: bound, Method.FIRST_ORDER: bound})


SETTLED = 1e-6  # of the strength: what inertia, steps and outputs leave at a low rate
RATE = (
    "strengths are extrapolated from two rates. Viscosity on the base, which moves outwards as the "
    "top comes down, is one more load on it: twice what the extrapolation leaves of the strength "
    "under that load is allowed, 1e-6 at least. What viscosity leaves of the oscillation after the "
    "base opens changes the pressure and the load of inclined bonds at failure"
)
HALF = (
    "Eq. 11a gives twice the stress of a section through the unit, so that its P is half of that "
    "here"
)
SMALL = (
    "P is derived for small strains; at failure the unit is shorter by half a per cent, and wider"
)
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
