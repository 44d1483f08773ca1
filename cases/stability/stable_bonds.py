"""The largest stable step of every code on bonded elements: four of them, or a lattice of 82."""

from __future__ import annotations

import math

import numpy as np

from cases._papers import LIU_2017
from cases.bonds.parts._unit import CORNERS, EDGES
from cases.bonds.tetrahedral_unit import CASE as UNIT
from reference_solutions.bonds import bonded_modes, close_packed_lattice
from reference_solutions.contact import stability
from vv.ask import Bracket, Displacement, Method
from vv.case import (
    Case,
    Exact,
    Interval,
    Level,
    Parameters,
    Search,
    Source,
    Tolerance,
    Trial,
    Variant,
    largest_step,
)
from vv.scene import Bonds, Contact, Pairs, Scene, Spheres, Vector

SPEED = 1e-9  # m/s: the start, which does not enter the answer


def _elements(variant: str, d: float) -> tuple[Vector, Pairs]:
    """Centres and bonded pairs: the unit, or the smallest block of the paper."""
    if variant == "unit":
        return d * CORNERS, EDGES
    block = close_packed_lattice.lattice(*close_packed_lattice.SIZES[82], d)
    return block.position, block.bonds


def _scene(p: Parameters, position: Vector, pairs: Pairs) -> Scene:
    """Elements free in space on unbreakable bonds, each with a velocity in its own direction."""
    count = len(position)
    spheres = Spheres(
        position=position,
        velocity=SPEED * np.sin(1.0 + np.arange(3.0 * count)).reshape(count, 3),
        radius=np.full(count, p["d"] / 2),
        mass=np.full(count, p["m"]),
        free=np.ones((count, 3), bool),
    )
    bonds = Bonds(pairs, p["d"], p["kn"], p["gamma"] * p["kn"])  # type: ignore[arg-type]  # for all
    return Scene((spheres,), Contact(p["kn"]), bonds=bonds)


def _declare(variant: str, p: Parameters) -> Trial:
    position, pairs = _elements(variant, p["d"])
    w = bonded_modes.fastest_mode(position, pairs, kn=p["kn"], ks=p["gamma"] * p["kn"], m=p["m"])
    theory, bracket = stability.centred(w), Bracket(SPAN, FAR * SPEED / w)
    seen = tuple(map(Displacement, range(len(position))))
    study = Search(_scene(p, position, pairs), seen, START * theory, STEPS, bracket)
    limit = largest_step("limit", theory, "2/w", bracket, FOUND)
    if variant == "unit" or p["gamma"] != UNIT.defaults("pulled")["gamma"]:
        return Trial(study, (limit,))
    wave = stability.centred(math.sqrt(bonded_modes.LATTICE * p["kn"] / p["m"]))
    return Trial(study, (
        limit, largest_step("lattice", wave, "2/w of the infinite lattice", bracket, MORE)
    ))  # fmt: skip


START, SPAN = 0.45, 5.0  # of the limit: where a search begins, and how far it goes
STEPS = 400
FAR = 1e3  # amplitudes of one element alone; the slow drift of a block is at most 400 of them
OTHERS = dict.fromkeys(
    (Method.SECOND_ORDER, Method.FIRST_ORDER, Method.STRAIGHT),
    "the limit is that of a leapfrog; other methods have other limits",
)
FOUND = Exact(
    dict.fromkeys(
        [method for method in Method if method not in OTHERS],
        Tolerance(
            3e-3,
            "the search ends with an interval of 1.5e-3; beyond the limit the fastest mode grows "
            "by exp(2 sqrt(2 d)) a step, d the relative excess",
        ),
    ),
    not_judged=OTHERS,
)
MORE = Interval(
    1.0,
    1.1,
    "a block lacks bonds that the infinite lattice has, and fewer springs make no mode faster: the "
    "limit of the lattice, 1.33548e-7 s, is safe for every block",
)
FORMULA = (
    "a leapfrog is stable up to 2/w, where w is the frequency of the fastest mode of the bonds"
)
CASE = Case(
    name="stable-bonds",
    title="Largest stable step on bonds",
    source=Source(
        *LIU_2017,
        "The paper uses 1e-8 s and states no limit. Elements do not rotate. A step is unstable if "
        "within 400 steps something moves by 1000 amplitudes v/w, or the code gives up.",
    ),
    parameters=tuple(one for one in UNIT.parameters if one.name in ("kn", "gamma", "d", "m")),
    variants=(
        Variant("unit", "four elements, six bonds", FORMULA, inert=frozenset({"d", "gamma"})),
        Variant(
            "lattice-82",
            "82 elements, close-packed",
            FORMULA,
            inert=frozenset({"d"}),
            level=Level.DEFAULT,
        ),
    ),
    declare=_declare,
)
