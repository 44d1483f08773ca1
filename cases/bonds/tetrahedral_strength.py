"""Four bonded elements pulled and pressed until they fail: T_u, C_open and C_u of the unit."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from cases._energy_balance import balance
from cases._papers import LIU_2017
from cases.bonds.parts._quartzite import BRITTLE, KN, D, M
from cases.bonds.parts._unit import CORNERS, EDGES
from reference_solutions.bonds import lattice_material, sliding_unit, tetrahedral_unit
from reference_solutions.bonds.lattice_material import Element
from vv.ask import Displacement, History, Knobs, Method, Observable, Reaction, Run
from vv.case import (
    Case,
    Exact,
    Judge,
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
from vv.scene import Bonds, Contact, Scene, Spheres, Vector

BASE = np.array([[True, True, False]] * 4)  # the top is driven, the base slides on its plane
RATES = (2.0, 1.0)  # rates of loading of the two units, over that of the slower one
APART = 10.0  # diameters between the units, which never meet
SLIDES_AT = 2.4677e8 * D.value  # N/m: C_u times d at the case's own parameters
SWINGS = 2.0  # times the displacement at rest, after a load that is applied at once
BEYOND = 1.15  # of the strain at failure, up to which the slower unit is loaded
EVERY = 1.6e-7  # s between outputs
FALL = 0.05  # relative fall below the largest stress so far that shows broken bonds


def _scene(p: Parameters) -> Scene:
    """Two units, loaded at two steady rates; their bases start at steady speeds."""
    d, nu = p["d"], lattice_material.poissons_ratio(p["kn"], p["ks"])
    height = CORNERS[0, 2]
    velocity = p["rate"] * d * np.where([[0, 0, 1]], height * (CORNERS > 0.1), -nu * CORNERS)
    n = len(RATES) * len(CORNERS)
    spheres = Spheres(
        np.concatenate([d * (CORNERS + np.array([APART * k, 0, 0])) for k in range(len(RATES))]),
        np.concatenate([times * velocity for times in RATES]),
        np.full(n, d / 2),
        np.full(n, p["m"]),
        np.tile(BASE, (len(RATES), 1)),
    )
    pairs = np.concatenate([EDGES + len(CORNERS) * k for k in range(len(RATES))])
    strength = (p["kn"] * p["xb"], p["fs0"])
    bonds = Bonds(pairs, d, p["kn"], p["ks"], *strength)  # type: ignore[arg-type]  # for all
    return Scene((spheres,), Contact(p["kn"], p["ks"], p["mu_p"]), p["eta"], bonds=bonds)


class UnitHistory(NamedTuple):
    """The history of a unit: stress [Pa], stretches [m], shear of inclined bonds [N]."""

    stress: Vector
    inclined: Vector
    level: Vector
    shear: Vector


def unit_history(p: Parameters, unit: int, run: Run) -> UnitHistory:
    """The size of the axial stress on the original area (Eq. 5), and the state of the bonds.

    Units come in pairs at RATES. The shear follows from the axial force, F = 3 (Fn cos a + Fs sin
    a) + eta v, since the top moves at a steady speed v, without inertia.
    """
    first, d = len(CORNERS) * unit, p["d"]
    u = np.array([run.values[Displacement(first + i)] for i in range(3)])
    x = d * CORNERS[:3, None] + u
    force = run.values[Reaction(first)][:, 2]
    inclined, level = (_stretch(d, u, *bond) for bond in ((0, 1), (1, 2)))
    rise = (x[0] - x[1])[:, 2] / np.linalg.norm(x[0] - x[1], axis=1)
    drag = p["eta"] * RATES[unit % len(RATES)] * p["rate"] * d * CORNERS[0, 2]
    shear = ((force - drag) / 3 - p["kn"] * inclined * rise) / np.sqrt(1 - rise**2)
    return UnitHistory(np.abs(force) / (np.sqrt(3) / 2 * d**2), inclined, level, np.abs(shear))


def _stretch(d: float, u: Vector, i: int, j: int) -> Vector:
    """The stretch (k,) [m] of the bond between two elements."""
    moved, offset = u[j] - u[i], d * (CORNERS[j] - CORNERS[i])
    longer = np.einsum("kc,kc->k", 2 * offset + moved, moved)
    return np.asarray(longer / (np.linalg.norm(offset + moved, axis=1) + d))


def _tensile_strength(p: Parameters, unit: int, run: Run) -> float:
    seen = unit_history(p, unit, run)
    return _at(seen.stress, seen.inclined / p["xb"], int(seen.stress.argmax()))


def _opening_strength(p: Parameters, unit: int, run: Run) -> float:
    seen = unit_history(p, unit, run)
    most = np.maximum.accumulate(seen.stress)
    fallen = np.argmax(seen.stress < (1.0 - FALL) * most)
    return _at(seen.stress, seen.level / p["xb"], int(seen.stress[:fallen].argmax()))


def slid(p: Parameters, unit: int, run: Run) -> float:
    """The stress [Pa] at which inclined bonds slide, where shear minus friction reaches fs0.

    That difference grows linearly with strain, unlike shear over strength, so that it can be
    extrapolated.
    """
    seen = unit_history(p, unit, run)
    unrubbed = seen.shear + p["mu_p"] * p["kn"] * seen.inclined
    return _at(seen.stress, unrubbed / p["fs0"], int(seen.stress.argmax()))


def _at(stress: Vector, borne: Vector, peak: int) -> float:
    """The stress [Pa] at which bonds break, extrapolated from the last two outputs before that.

    Bonds break where `borne`, their load over their strength, reaches 1: less than an output later,
    and at most two outputs before the stress falls. Bonds that break elsewhere give another stress.
    """
    last = peak - int((borne[peak - 1 : peak + 1] > 1.0).sum())
    share = np.clip((1.0 - borne[last]) / (borne[last] - borne[last - 1]), 0.0, 1.0)
    return float(stress[last] + share * (stress[last] - stress[last - 1]))


def at_zero_rate(seen: Callable[[int, Run], float], run: Run, first: int = 0) -> float:
    """The strength [Pa] extrapolated to zero rate of loading, from specimens at both RATES."""
    fast, slow = (seen(first + unit, run) for unit in range(len(RATES)))
    return slow + (slow - fast) / (RATES[0] / RATES[1] - 1.0)


def _strength(
    name: str, meaning: str, seen: Callable[[Parameters, int, Run], float], p: Parameters,
    exact: float, equation: str, printed: float, bound: float, slack: str = "",
) -> tuple[Quantity, ...]:  # fmt: skip
    """A strength at zero rate, its value at the slower rate, and the error of the equation."""
    told = functools.partial(seen, p)
    whole = functools.partial(at_zero_rate, told)
    return (
        Scalar(name, name, "Pa", meaning, whole, exact, exact, _bounds(bound, slack)),
        Scalar(
            f"{name} at the slower rate", f"{name}(rate)", "Pa", f"{meaning}, as observed at that "
            "rate",
            functools.partial(told, 1), exact, exact,
            Shown("viscosity adds to it in proportion to the rate of loading"),
        ),
        Scalar(
            f"{name} over {equation}", f"{name}/{equation} - 1", "", f"{meaning}, over {equation}",
            lambda run: whole(run) / printed - 1.0, exact / printed - 1.0, 1.0,
            Shown(f"{equation} holds for small strains; {OWN[name]}"),
        ),
    )  # fmt: skip


def judged_balance(bound: float, slack: str = "", dt: float = 1e-8, both: bool = False) -> Scalar:
    """The quantity `balance`, judged with a bound at the step dt [s].

    both: schemes of first order are allowed the error of second order as well, which they have.
    """
    second = Tolerance(bound, BOOKED, dt=dt, order=2, slack=slack)
    if both:
        late = bound / dt
        first = Tolerance(
            bound, f"{BOOKED}, in both orders", dt=dt, order=2, late=late, slack=slack
        )
    else:
        first = Tolerance(bound, BOOKED, dt=dt, order=1, slack=slack)
    return balance({Method.SECOND_ORDER: second, Method.FIRST_ORDER: first})


def _declare(variant: str, p: Parameters) -> Trial:
    d, kn, ks, xb, fs0, mu_p = (p[name] for name in ("d", "kn", "ks", "xb", "fs0", "mu_p"))
    element = Element(kn, ks, xb, fs0, mu_p)
    closed = judged_balance(2e-7, FEW)
    if variant.startswith("pulled"):
        failed = tetrahedral_unit.tension_failure(element, d)
        drag = p["eta"] * RATES[0] * abs(p["rate"]) * d * CORNERS[0, 2]  # may shear bonds too
        _require_opening(p, "inclined", ks * abs(failed.x.xs1) + drag)
        strengths = _strength(
            "T_u", "tensile strength", _tensile_strength, p, failed.stress,
            "Eq. 7", lattice_material.tensile_strength(kn, ks, xb, d), 5e-9, ROUNDED,
        )  # fmt: skip
    else:
        pressed = 5e-7 * max(1.0, (p["eta"] * p["rate"] / 45.0) ** 2)
        failed = tetrahedral_unit.sliding_failure(element, d)
        opened = tetrahedral_unit.opening_failure(element, d)
        _require_opening(p, "level", 0.0)
        _require_later(p, abs(opened.strain), abs(failed.strain))
        strengths = _strength(
            "C_open", "pressure that opens the base", _opening_strength, p,
            -opened.stress,
            "Eq. 8", lattice_material.opening_strength(kn, ks, xb, d), pressed,
        ) + _strength(
            "C_u", "compressive strength", slid, p, -failed.stress,
            "Eq. 14", lattice_material.sliding_strength(fs0, mu_p, d),
            pressed * max(1.0, (SLIDES_AT / (abs(failed.stress) * d)) ** 2),
        )  # fmt: skip
        closed = _sliding_balance(p, element, 0.5 * failed.fz * failed.x.dz)
    if variant in HURRIED:
        strengths += (_at_papers_rate(variant, p),)
    goal = History(BEYOND * abs(failed.strain / p["rate"]), EVERY)
    units = [len(CORNERS) * k for k in range(len(RATES))]
    moved = [Displacement(k + i) for k in units for i in range(3)]
    watched: tuple[Observable, ...] = (*(Reaction(k) for k in units), *moved)
    return Trial(Ladder(_scene(p), goal, watched, LEVELS), (*strengths, closed))


def _require_opening(p: Parameters, kind: str, shear: float) -> None:
    """Raises ValueError where stretched bonds slide before they open (Eq. 1).

    shear: on them as they open [N]. While they stretch it grows and their strength falls, so that
    the state at opening decides.
    """
    strength = p["fs0"] - p["mu_p"] * p["kn"] * p["xb"]
    if not shear < strength:
        raise ValueError(
            f"xb = {p['xb']:.4g} m: {kind} bonds slide before they open, where they bear a shear "
            f"of {shear:.4g} N; it must be below fs0 - mu_p kn xb = {strength:.4g} N"
        )


def _require_later(p: Parameters, opened: float, slid: float) -> None:
    """Raises ValueError where inclined bonds may slide in the wave that follows the opening.

    opened, slid: strains. The base opens at once, and the inclined bonds then swing up to twice as
    far as under their load at rest, which grows during half an oscillation.
    """
    grown = RATES[0] / RATES[1] * abs(p["rate"]) * math.pi * math.sqrt(p["m"] / p["kn"])
    if slid < SWINGS * (opened + grown):
        raise ValueError(
            f"inclined bonds slide at a strain of {slid:.4g}, the base opens at {opened:.4g}; they "
            f"may slide in the wave that follows, below {SWINGS * (opened + grown):.4g}"
        )


def _sliding_balance(p: Parameters, element: Element, held: float) -> Scalar:
    """The quantity `balance` of units that slide; held: energy that one stores until then [J].

    A scheme of first order has the error of second order too, in w dt of the bonds.
    """
    coarsest = float(RUNGS[0].dt or 0.0)
    ends = sum(
        sliding_unit.unexplained_energy(
            element, p["d"], coarsest, m=p["m"], eta=p["eta"], rate=times * p["rate"]
        )
        for times in RATES
    )
    orders = {Method.SECOND_ORDER: 2, Method.FIRST_ORDER: 1}
    turned = 1e8 * coarsest * math.sqrt(p["kn"] / p["m"] / (KN.value / M.value))
    rotating = {n: sum(2e-7 * turned**order for order in range(n, 3)) for n in orders.values()}
    return balance({
        method: Tolerance(
            rotating[n] + ends / held, PARTED,
            dt=coarsest, order=n, slack=FEW,
        )
        for method, n in orders.items()
    })  # fmt: skip


def _at_papers_rate(variant: str, p: Parameters) -> Scalar:
    """The strength at the paper's own rate and viscosity, over the paper's formula, minus 1."""
    seen, name = (_tensile_strength, "T_u") if variant.startswith("pulled") else (slid, "C_u")
    printed = (
        lattice_material.tensile_strength(p["kn"], p["ks"], p["xb"], p["d"])
        if name == "T_u"
        else lattice_material.sliding_strength(p["fs0"], p["mu_p"], p["d"])
    )
    return Scalar(
        f"{name} at the paper's rate", f"{name}(rate)/{name} - 1", "",
        f"{name} as observed at the paper's rate, over its formula, minus 1",
        lambda run: seen(p, 1, run) / printed - 1.0, None, 1.0, Shown(OWN[name]),
    )  # fmt: skip


HURRIED = {  # V of Eq. 28 over d^3: a unit's share of the lattice, or its own hull
    "pulled-share": 1 / np.sqrt(2),
    "pressed-share": 1 / np.sqrt(2),
    "pressed-hull": 1 / (6 * np.sqrt(2)),
}


def _of_paper(variant: str) -> dict[str, float]:
    """The paper's rate, 1.70e-9 or 1.70e-10 m in 100 steps of 1e-8 s, and viscosity, Eq. 28."""
    moved = 1.70e-10 if variant.startswith("pulled") else -1.70e-9
    critical = np.sqrt(8 * M.value * KN.value)
    eta = critical / HURRIED[variant] ** (1 / 3)
    return {"rate": moved / 1e-6 / (D.value * CORNERS[0, 2]), "eta": float(eta)}


OWN = {
    "T_u": "the paper's own run is 0.011 % below Eq. 7, in steps of 0.075 %",
    "C_open": "the paper shows no run of its own",
    "C_u": "the paper's own run is 1.73 % below Eq. 14, with its viscosity and at its rate",
}
BOOKED = (
    "the energy of breaking bonds is recorded as the scheme computes it; the rest is due to bonds "
    "that rotate and contacts that close within a step"
)
PARTED = (
    f"{BOOKED}. A contact that opens within a step also adds or removes energy that its springs do "
    "not store, in proportion to the squares of the step and of the speed at which the unit flies "
    "apart"
)
FEW = "in tension the bonds of the unit hardly rotate"
RATE = (
    "the strength at zero rate is extrapolated from two rates; the error is of second order in the "
    "rates, larger in compression, where failure comes later, and does not depend on the step; it "
    "is as the square of the force of viscosity over the strength"
)


def _bounds(bound: float, slack: str) -> Judge:
    one = Tolerance(bound, RATE, slack=slack)
    return Exact(dict.fromkeys((Method.SECOND_ORDER, Method.FIRST_ORDER), one))


ROUNDED = "codes round coordinates differently, by up to a third of the bound"
RUNGS = tuple(Knobs(dt=4e-8 / 2**i) for i in range(3))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS[:2], Level.PAPER: RUNGS}

CASE = Case(
    name="tetrahedral-strength",
    title="Four bonded elements to failure",
    source=Source(
        *LIU_2017,
        "The reference is equilibrium at finite displacement where a bond fails (Eq. 1), not Eqs. "
        "7, 8 and 14 for small strains, which are shown. The paper moves the top in steps; here it "
        "moves steadily, at two rates. Viscosity and rates are chosen.",
    ),
    parameters=(
        *BRITTLE,
        Parameter("eta", 6.0, "N s/m", "viscosity on every element"),
        Parameter("rate", 1.6, "1/s", "strain rate of the slower unit, tension positive"),
    ),
    variants=(
        Variant(
            "pulled", "to where the inclined bonds open", "pulled until the inclined bonds open",
            inert=frozenset({"m", "eta", "rate", "fs0", "mu_p"}),
        ),
        Variant(
            "pressed", "compressed until the base opens, and on until the inclined bonds slide",
            "X_n2 = xb; then, without the base, |F_s1| = fs0 - mu_p F_n1", {"rate": -7.5},
            inert=frozenset({"m", "eta", "rate"}),
        ),
        *(
            Variant(
                name, f"at the paper's rate, with Eq. 28 for V = {HURRIED[name]:.4g} d^3",
                "as at zero rate; at this rate the effect of viscosity is shown", _of_paper(name),
                frozenset({"m", "eta", "rate"}),
                Level.DEFAULT if name.startswith("pulled") else Level.PAPER,
            )
            for name in HURRIED
        ),
    ),
    declare=_declare,
    published={
        "T_u of a unit": "0.011 % below that of quartzite, Eq. 7 (section 5.2)",
        "C_u of a unit": "1.73 % below that of quartzite, Eq. 14 (section 5.2)",
    },
)  # fmt: skip
