"""Four bonded elements slowly pulled and compressed: E and nu at strains of up to 5e-3."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator

import numpy as np

from cases._papers import LIU_2017
from cases.bonds.parts._quartzite import ELASTIC
from cases.bonds.parts._unit import CORNERS, SEEN, as_it_is, seen_at, unit
from reference_solutions.bonds import lattice_material, tetrahedral_unit
from vv.ask import History, Knobs, Method, Observable, Reaction, Run
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

OUTPUTS = 500  # on the way to the largest strain
STOPS = (1, 10, 100, 500)  # the outputs at which E and nu are measured
TOP = Reaction(0)
WATCHED: tuple[Observable, ...] = (TOP, *SEEN)
DRAWN = np.array([[True, True, False]] * 4)  # the top is driven, the base slides on its plane


def _declare(variant: str, p: Parameters) -> Trial:
    """The top is driven at a steady rate; the base starts as it moves at small strains."""
    kn, d, strain = p["kn"], p["d"], p["strain"]
    if not p["rate"] > 0:
        raise ValueError(f"rate = {p['rate']!r} 1/s; its size must be positive")
    if strain == 0:
        raise ValueError("strain = 0.0; E and nu are taken at strains, which must not be 0")
    fastest = abs(strain) / (OUTPUTS * float(RUNGS[0].dt or 0.0))
    if p["rate"] > fastest * (1 + 1e-9):
        raise ValueError(
            f"rate = {p['rate']!r} 1/s; it must not exceed {fastest:g}, at which the outputs, "
            f"{OUTPUTS} to the largest strain, lie a step of {RUNGS[0].dt:g} s apart"
        )
    every = _whole_steps(abs(strain) / (OUTPUTS * p["rate"]))
    rate = strain / (OUTPUTS * every)
    nu = lattice_material.poissons_ratio(kn, p["gamma"] * kn)
    shape = np.where([[0.0, 0.0, 1.0]], CORNERS[0, 2] * (CORNERS > 0.1), -nu * CORNERS)
    scene = unit(p, 0.0, velocity=rate * d * shape, free=DRAWN)
    quantities = tuple(q for stop in STOPS for q in _at(p, stop))
    return Trial(Ladder(scene, History(OUTPUTS * every, every), WATCHED, LEVELS), quantities)


def _whole_steps(interval: float) -> float:
    """The interval [s], rounded up to whole steps of every rung, so that strains are exact."""
    coarsest = float(RUNGS[0].dt or 0.0)
    return math.ceil(interval / coarsest * (1.0 - 1e-9)) * coarsest


def _at(p: Parameters, stop: int) -> Iterator[Quantity]:
    """E and nu at an output: on the path, and their differences from Eqs. 6 and 4."""
    kn, gamma, d = p["kn"], p["gamma"], p["d"]
    ks, strain = gamma * kn, p["strain"] * stop / OUTPUTS
    state = tetrahedral_unit.equilibrium(strain, kn=kn, ks=ks, d=d)
    E, nu = lattice_material.youngs_modulus(kn, ks, d), lattice_material.poissons_ratio(kn, ks)
    for name, unit_name, exact, scale in (
        ("E", "Pa", state.modulus, state.modulus),
        ("nu", "", state.poisson, SCALE),
    ):
        seen = functools.partial(_secant, name, d, stop)
        yield Scalar(
            f"{name}({strain:g})", f"{name}({strain:g})", unit_name,
            f"secant at a strain of {strain:g}", seen, exact, scale, _on_path(p, strain),
        )  # fmt: skip
    for name, what, small, scale, slope in (
        ("E", "E over Eq. 6, less 1", E, E, tetrahedral_unit.modulus_slope(gamma)),
        ("nu", "nu less that of Eq. 4", nu, 1.0, tetrahedral_unit.poisson_slope(gamma)),
    ):
        beyond = functools.partial(_beyond, name, d, stop, small, scale)
        yield Scalar(
            f"{name}({strain:g})-small", what, "", f"{what}, at a strain of {strain:g}",
            beyond, slope * strain, abs(strain), BESIDE,
        )  # fmt: skip


def _on_path(p: Parameters, strain: float) -> Judge:
    """The base is R = d/sqrt3 wide and shrinks by (nu + c e) e R, so that R'' = -2 c rate^2 R.

    Its bonds resist with kn (10 + 2 gamma)/3: 3 kn along the base, the rest up to the top.
    """
    gamma = p["gamma"]
    lags = 2 * abs(tetrahedral_unit.poisson_slope(gamma)) * 3 / (10 + 2 * gamma)
    left = 2 * lags / SCALE * p["rate"] ** 2 * p["m"] / p["kn"] / abs(strain)
    return Exact({Method.SECOND_ORDER: Tolerance(max(4e-7, left), SLOW, slack=SLACK)})


def _secant(name: str, d: float, stop: int, run: Run) -> float:
    """E [Pa] or nu at an output, by the force that drives the top."""
    return as_it_is(name, float(run.values[TOP][stop, 2]), d, seen_at(run, stop))


def _beyond(name: str, d: float, stop: int, small: float, scale: float, run: Run) -> float:
    """The difference of a secant from its value at small strains, over a scale."""
    return (_secant(name, d, stop, run) - small) / scale


SCALE = 0.2  # of nu
SLOW = (
    "the base shrinks ever more slowly, by 2 c rate^2 of its size with nu + c e; that inertia "
    "shifts it by as much over w^2, w^2 = kn (10 + 2 gamma)/(3 m), and since the shift begins at "
    "once it oscillates: twice that over the strain. At any strain, shear springs that rotate half "
    "a step late add up to 3e-7 of nu at gamma = 1"
)
SLACK = "springs that rotate at mid-step do not lag; the effect of inertia falls with the strain"
BESIDE = Shown(
    "Eqs. 4 and 6 hold for small strains; the error is of first order in the strain, and is "
    "divided by it"
)
RUNGS = tuple(Knobs(dt=4e-8 / 2**i) for i in range(4))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS[:2], Level.PAPER: RUNGS}
PATH = "3 (Fn1 cos a + Fs1 sin a) = Fz, Fn1 sin a - Fs1 cos a + sqrt3 Fn2 = 0, S' = -L a'"
BALANCED = frozenset({"m", "rate"})
NO_SIZE = {
    "d": "forces per displacement are those of the springs, whatever the size of the elements",
    "strain": "secants are computed from the strains that a code reports, and hardly change with "
    "them",
}
WAYS = (("out", 5e-3), ("in", -5e-3))

CASE = Case(
    name="tetrahedral-path",
    title="Four bonded elements to finite strain",
    source=Source(
        *LIU_2017,
        "The reference is the equilibrium path of the incremental shear spring; differences from "
        "the small-strain Eqs. 4 and 6 are shown beside their first order in the strain. Under a "
        "load applied at once, as in tetrahedral-unit, the unit departs from that path by a tenth "
        "of the strain before it comes to rest. Here the top is driven steadily, without "
        "viscosity, at a rate that is chosen. Bonds do not break.",
    ),
    parameters=(
        *ELASTIC,
        Parameter("strain", 5e-3, "", "the largest axial strain, tension positive"),
        Parameter("rate", 12.5, "1/s", "upper bound of the strain rate, since outputs are at "
                                       "whole steps"),
    ),
    variants=(
        *(
            Variant(
                way, f"quartzite, to a strain of {strain:g}", PATH, {"strain": strain},
                inert=BALANCED, level=Level.QUICK if way == "out" else Level.DEFAULT,
                unseen=NO_SIZE,
            )
            for way, strain in WAYS
        ),
        *(
            Variant(
                f"{way}-gamma-{gamma:g}", f"ks = {gamma:g} kn, to a strain of {strain:g}", PATH,
                {"strain": strain, "gamma": gamma}, inert=BALANCED, level=Level.PAPER,
                unseen=NO_SIZE,
            )
            for gamma in (0.0, 0.25, 0.5, 1.0)
            for way, strain in WAYS
        ),
    ),
    declare=_declare,
    published={
        "at a strain of -1e-6": "E and nu of a unit coincide with those of quartzite (section 5.2)"
    },
)  # fmt: skip
