"""Four bonded elements: at rest under an axial force, breathing, and rotating as a whole."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping

import numpy as np

from cases._papers import LIU_2017
from cases.bonds.parts import _detour
from cases.bonds.parts._quartzite import ELASTIC, slower
from cases.bonds.parts._thrown import breathing, levels, turned
from cases.bonds.parts._unit import (
    BASE,
    CORNERS,
    EDGES,
    SEEN,
    as_it_is,
    beside,
    moved_ends,
    quantity_of,
    seen_at,
    unit,
)
from reference_solutions.bonds import lattice_material, tetrahedral_unit, turning_unit
from reference_solutions.bonds.tetrahedral_unit import Displacements, State
from vv.ask import History, Method, Run
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
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Vector

THROWN = {"breathing": breathing, "turned": turned}
STEP = 2e-8  # s: the coarsest
REST = 6e-5  # s: the time to rest, or a multiple that viscosity needs
LONGER = 4  # rotation is damped only through the motion of the centres
ALMOST = 3e-9  # of the displacement: what rotation may still add, a third of the tolerance
# rounding of positions at which motion stops, over the tolerance of rest
STALLS = 0.5 * 2.0**-52 / 1e-8
KEPT = 10.0  # roundings of positions that nu shows at rest
FINEST = 8  # times the finest step, of the level of the paper, is the coarsest
DECAYS = 30.0  # time constants until 1e-13 of a disturbance is left


def _force(p: Parameters, ks: float) -> float:
    """Fz [N] that Eqs. 5 and 6 give for the strain."""
    E = lattice_material.youngs_modulus(p["kn"], ks, p["d"])
    return float(E * np.sqrt(3) / 2 * p["d"] ** 2 * p["strain"])


def _loaded(p: Parameters, turning: bool) -> Trial:
    """The unit under a dead load; free elements rotate until all shear springs are slack."""
    kn, d = p["kn"], p["d"]
    ks = 0.0 if turning else p["gamma"] * kn
    fz = _force(p, ks)
    load = np.zeros((4, 3))
    load[0, 2] = fz
    scene = unit(p, p["eta"], free=BASE, load=load, free_spin=np.full((4, 3), turning))
    state = tetrahedral_unit.loaded(fz, kn=kn, ks=ks, d=d)
    times, longer = (
        max(LONGER, _rest_multiple_turning(p, load)) if turning else _rest_multiple(p, ks),
        slower(p),
    )
    duration = REST * math.ceil(times / max(1.0, longer)) * max(1.0, longer)
    study = Ladder(scene, History(duration, duration / 10), SEEN, levels(STEP * longer))
    off = _detour.rest_errors(p, ks, fz, STEP * longer)
    rounded = _rounded(p, ks, STEP * longer / FINEST)
    return Trial(study, _measured(kn, ks, d, state, fz, off, rounded))


def _rest_multiple_turning(p: Parameters, load: Vector) -> int:
    """As `_rest_multiple`, for elements whose rotation only the motion of centres damps."""
    _rest_multiple(p, 0.0)
    if p["gamma"] == 0.0:
        return 1
    kn, d, m, eta = (p[name] for name in ("kn", "d", "m", "eta"))
    springs = {"kn": kn, "ks": p["gamma"] * kn, "d": d, "m": m, "eta": eta}
    rest = turning_unit.time_to_rest(CORNERS, EDGES, BASE, load, ALMOST, **springs)
    return max(1, math.ceil(rest / REST))


def _rest_multiple(p: Parameters, ks: float) -> int:
    """The multiple of REST that the unit needs to come to rest, until its slowest mode has decayed.

    The modes are those of the rise of the top and the spread of the base: one of frequency w decays
    at the rate n - sqrt(n^2 - w^2), n = eta/(2 m), or at n where it oscillates.
    """
    if not p["eta"] > 0:
        raise ValueError(
            f"eta = {p['eta']!r} N s/m; it must be positive: without viscosity the unit does not "
            "come to rest"
        )
    w2, n = _modes(p, ks)
    slowest = float((w2 / (n + np.sqrt(np.maximum(n**2 - w2, 0.0)))).clip(max=n).min())
    returns = float(np.where(w2 < n**2, w2 / (2 * n), np.sqrt(w2)).min())
    if STEP * slower(p) * returns * abs(p["strain"]) < STALLS:
        raise ValueError(
            f"m = {p['m']!r} kg, kn = {p['kn']!r} N/m, eta = {p['eta']!r} N s/m: the unit creeps "
            f"to rest at {returns:.3g} 1/s, so slowly that the rounding of positions in each step "
            "stops it before"
        )
    return max(1, int(np.ceil(DECAYS / slowest / REST)))


def _modes(p: Parameters, ks: float) -> tuple[Vector, float]:
    """The squares (2,) [1/s2] of the frequencies of the unit, and n [1/s] of its viscosity."""
    moved = np.sqrt(p["m"] * _detour.MOVED)
    w2 = np.linalg.eigvalsh(_detour.stiffness(p["kn"], ks) / np.outer(moved, moved))
    return np.asarray(w2), p["eta"] / (2 * p["m"])


def _rounded(p: Parameters, ks: float, dt: float) -> float:
    """The part of the displacement that rounding of positions leaves at rest, at a step dt [s].

    A mode that oscillates keeps a few roundings of positions. One with half of critical damping or
    more, w < 2n, creeps to rest in the end, at about the rate w^2/2n, and stops where it moves by
    less than half a rounding in a step. nu shows four times that, since it
    is relative to 1/5 and the ratio of two displacements.
    """
    if not p["strain"]:
        return 0.0
    w2, n = _modes(p, ks)
    creep = np.where(w2 < 4 * n**2, w2 / (2 * n), np.inf).min()
    return float(2.0**-52 / abs(p["strain"]) * max(KEPT, 2.0 / (creep * dt)))


def _measured(
    kn: float, ks: float, d: float, state: State, fz: float,
    off: Mapping[str, _detour.RestErrors], rounded: float,
) -> tuple[Quantity, ...]:  # fmt: skip
    """E, nu and displacements at rest: at finite strain, and to first order in the strain."""
    E, nu = lattice_material.youngs_modulus(kn, ks, d), lattice_material.poissons_ratio(kn, ks)
    small = tetrahedral_unit.small_strain(fz, kn, ks)
    path = (state.modulus, state.poisson, state.x._replace(xs1=_across(state.x, d)))
    linear = (E, nu, small._replace(xs1=abs(small.xs1)))
    return tuple(
        Scalar(
            f"{name}{mark}", f"{name}{sign}", unit, f"{what}, {where}",
            functools.partial(observe, name, fz, d), value, scale, judge(off[name], rounded),
        )
        for where, mark, sign, observe, (modulus, poisson, x), judge in (
            ("at finite strain", "", "", _observed, path, _rest_bounds),
            ("to first order", "-small", " (small strain)", _to_first_order, linear, _linear),
        )
        for (name, unit, what), value, scale in zip(
            MEASURED, (modulus, poisson, *x), (modulus, 0.2, *[abs(x.dz)] * 4), strict=True
        )
    )  # fmt: skip


MEASURED = (
    ("E", "Pa", "secant modulus, on the original area"),
    ("nu", "", "secant ratio of strains, negated; its error is relative to 1/5"),
    ("dz", "m", "displacement of the top"),
    ("X_n1", "m", "stretch of an inclined bond"),
    ("X_s1", "m", "displacement across an inclined bond"),
    ("X_n2", "m", "stretch of a horizontal bond"),
)


def _across(x: Displacements, d: float) -> float:
    """Displacement [m] of the top relative to the base, across the deformed inclined bond.

    It differs, at first order in the strain, from the X_s1 that the shear spring accumulates.
    """
    out, up = x.xn2 / np.sqrt(3), x.dz
    angle = np.arctan2(d / np.sqrt(3) + out, d * np.sqrt(2 / 3) + up)
    return float(abs(up * np.sin(angle) - out * np.cos(angle)))


def _observed(name: str, fz: float, d: float, run: Run) -> float:
    """A quantity at the end of a run, by the deformed bonds."""
    return as_it_is(name, fz, d, seen_at(run, -1))


def _to_first_order(name: str, fz: float, d: float, run: Run) -> float:
    """A quantity at the end of a run, by the undeformed bonds."""
    u = seen_at(run, -1)
    n, moved = moved_ends(d, u)
    stretch = np.einsum("bk,bk->b", n, moved)
    return quantity_of(name, fz, d, float(u[0, 2]) / d, stretch, beside(moved, n))


def _declare(variant: str, p: Parameters) -> Trial:
    if variant in THROWN:
        if p["strain"] == 0:
            raise ValueError(
                f"strain = {p['strain']!r}; the amplitude must not be 0, or nothing moves"
            )
        return THROWN[variant](p)
    return _loaded(p, variant == "turning")


SETTLED = (
    "the state of rest does not depend on the step. Before it comes to rest the unit oscillates "
    "about the path of a slow load, and the incremental shear spring keeps what the oscillations "
    "of the two modes add up to; schemes that use the length of a bond at the end of a step add an "
    "error of half a step. Positions are rounded, which small strains and slow creep show"
)
AT_MIDSTEP = (
    "schemes that rotate springs at mid-step do not lag; without shear springs there is nothing to "
    "keep, and with ks = kn what the two modes add up to cancels"
)
BY_DESIGN = "the equilibrium path and its linearisation differ by about the strain, 1e-6 or 1e-5"
LEANING = (
    "contacts that represent bonds overlap by 1e-4, and their normal force rotates with them: this "
    "changes E by 0.66 times that, and nu by 1.4 times"
)


def _rest_bounds(off: _detour.RestErrors, rounded: float) -> Judge:
    """The bounds of the state of rest against the path.

    off: the errors by oscillation; rounded: that by rounding of positions.
    """
    kept = max(1e-8, rounded) + 1.1 * off.kept
    settled = Tolerance(kept, SETTLED, late=1.1 * off.late / off.dt, slack=AT_MIDSTEP)
    return Exact(
        {
            Method.EXACT: Tolerance(
                1e-12, "the equilibrium path is known to rounding of displacements"
            ),
            Method.SECOND_ORDER: settled,
            Method.FIRST_ORDER: settled,
            Method.PENALTY: Tolerance(2e-4, LEANING),
        },
        not_judged={Method.LINEARISED: BY_DESIGN},
    )


def _linear(_: _detour.RestErrors, __: float) -> Judge:
    """The bounds of the state of rest against Eqs. 2 to 6."""
    return Exact(
        {Method.LINEARISED: Tolerance(1e-12, "Eqs. 2a-d, 4 and 6 are linear, to rounding")},
        not_judged=dict.fromkeys(set(Method) - {Method.LINEARISED}, BY_DESIGN),
    )


PATH = "3 (Fn1 cos a + Fs1 sin a) = Fz, Fn1 sin a - Fs1 cos a + sqrt3 Fn2 = 0, S' = -L a'"
LOADED = {
    "kn": "the load is that of the given strain and grows with kn, so that the unit deforms alike; "
    "a code with the right load whose kn is wrong by 1 % has an error of 1 % in E",
}
IN_BALANCE = frozenset({"m", "eta"})
GAMMAS = (0.0, 0.25, 0.5, 1.0)
VARIANTS = (
    Variant(
        "pulled", "quartzite, pulled to a strain of 1e-6", PATH, inert=IN_BALANCE, unseen=LOADED
    ),
    Variant(
        "pressed", "quartzite, pressed", PATH, {"strain": -1e-6}, inert=IN_BALANCE, unseen=LOADED
    ),
    *(
        Variant(
            f"gamma-{gamma:g}", f"ks = {gamma:g} kn, pulled", PATH, {"gamma": gamma},
            inert=IN_BALANCE, unseen=LOADED, level=Level.DEFAULT if gamma else Level.QUICK,
        )
        for gamma in GAMMAS
    ),
    *(
        Variant(
            f"gamma-{gamma:g}-pressed", f"ks = {gamma:g} kn, pressed", PATH,
            {"gamma": gamma, "strain": -1e-6}, inert=IN_BALANCE, unseen=LOADED, level=Level.PAPER,
        )
        for gamma in GAMMAS
    ),
    *(
        Variant(
            f"{way}-more", f"quartzite, {way} ten times as far", PATH, {"strain": strain},
            inert=IN_BALANCE, unseen=LOADED, level=Level.PAPER,
        )
        for way, strain in (("pulled", 1e-5), ("pressed", -1e-5))
    ),
    Variant(
        "turning", "elements that are free to rotate, unlike those of the paper: E is lower by "
                   "11.8 %",
        f"{PATH}, Fs1 = 0", inert=IN_BALANCE | {"gamma"}, unseen=LOADED,
    ),
    Variant(
        "breathing", "free in space, all bonds oscillate in phase; no bond rotates, at any "
                     "amplitude",
        "L = d (1 + A sin 2 sqrt(kn/m) t)", {"strain": 0.01, "eta": 0.0},
        inert=frozenset({"gamma", "eta"}),
    ),
    Variant(
        "turned", "rotation as a whole, which elements that cannot rotate resist: an artefact",
        "energy 2 ks d^2 a^2 at an angle a, which oscillates at 2 sqrt(ks/m)",
        {"eta": 0.0}, inert=frozenset({"eta"}),
    ),
)  # fmt: skip
CASE = Case(
    name="tetrahedral-unit",
    title="Four bonded elements",
    source=Source(
        *LIU_2017,
        "E and nu are judged by the equilibrium path of the incremental shear spring, not by the "
        "small-strain Eqs. 2 to 6, which differ from it by half the strain and are shown too. The "
        "paper moves the top in steps; here it bears a dead load, and tetrahedral-path goes on to "
        "larger strains. The viscosity that brings the unit to rest is chosen.",
    ),
    parameters=(
        *ELASTIC,
        Parameter("strain", 1e-6, "", "axial strain by Eqs. 5, 6; amplitude A of breathing"),
        Parameter("eta", 6.0, "N s/m", "viscosity on every element"),
    ),
    variants=VARIANTS,
    declare=_declare,
    published={
        "at a strain of -1e-6": "E and nu of a unit coincide with those of quartzite (section 5.2)"
    },
)
