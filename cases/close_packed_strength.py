"""Blocks of close-packed bonded elements pulled and pressed between their platens to failure."""

from __future__ import annotations

import functools

import numpy as np

from cases._papers import LIU_2017
from cases._quartzite import BRITTLE
from cases.tetrahedral_strength import RATES, balance, unhurried
from reference_solutions import lattice_material
from reference_solutions.close_packed_lattice import SIZES, Lattice, lattice, static
from reference_solutions.lattice_material import Element
from reference_solutions.lattice_strength import first_opening, sliding
from reference_solutions.tetrahedral_unit import sliding_failure
from vv.ask import History, Knobs, Method, Observable, Reaction, Run
from vv.case import (
    Case,
    Exact,
    Judge,
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
from vv.study import Ladder, Level

APART = 2.0  # widths between the centres of the blocks, which never meet
OUTPUTS = 2000


@functools.lru_cache(maxsize=4)
def block_of(size: int, d: float) -> Lattice:
    """The block of that many elements."""
    return lattice(*SIZES[size], d)


def specimen(p: Parameters, block: Lattice, rates: tuple[float, ...] = RATES) -> Scene:
    """Blocks side by side between smooth platens that carry their ends apart, at steady rates.

    All elements start as they would go on in the infinite lattice.
    """
    n, x = len(block.position), block.position - block.position.mean(axis=0)
    free = np.ones_like(x, bool)
    free[:, 2] = ~(block.at(2, 0) | block.at(2, 1))
    nu = lattice_material.poissons_ratio(p["kn"], p["ks"])
    velocity = p["rate"] * (x - [0.0, 0.0, x[:, 2].min()]) * [-nu, -nu, 1.0]
    aside = np.array([APART * np.ptp(x[:, 0]), 0.0, 0.0])
    many = len(rates)
    spheres = Spheres(
        np.concatenate([block.position + k * aside for k in range(many)]),
        np.concatenate([times * velocity for times in rates]),
        np.full(many * n, p["d"] / 2),
        np.full(many * n, p["m"]),
        np.tile(free, (many, 1)),
    )
    pairs = np.concatenate([block.bonds + k * n for k in range(many)])
    values = (p["d"], p["kn"], p["ks"], p["kn"] * p["xb"], p["fs0"])
    bonds = Bonds(pairs, *(np.full(len(pairs), value) for value in values))
    return Scene(
        (spheres,), Contact(p["kn"], p["ks"], p["mu_p"]), _viscosity(p, block), bonds=bonds
    )


def _viscosity(p: Parameters, block: Lattice) -> float:
    """eta [N s/m] of Eq. 28, with the volume of the hull."""
    share = p["d"] / (block.area * block.height) ** (1 / 3)
    return float(share * np.sqrt(8 * p["m"] * p["kn"]))


def _top(block: Lattice, which: int) -> list[Reaction]:
    return [Reaction(int(i) + which * len(block.position)) for i in np.flatnonzero(block.at(2, 1))]


def _largest(block: Lattice, which: int, run: Run) -> float:
    """The largest stress [Pa] on the hull's area, half an output after it was last seen to grow."""
    force = sum(run.values[what][:, 2] for what in _top(block, which))
    stress = np.abs(force) / block.area
    last = int(stress.argmax())
    return float(stress[last] + 0.5 * (stress[last] - stress[last - 1]))


def _declare(variant: str, p: Parameters) -> Trial:
    way, size = variant.split("-")
    block = block_of(int(size), p["d"])
    kn, ks, d, xb, fs0, mu_p = (p[name] for name in ("kn", "ks", "d", "xb", "fs0", "mu_p"))
    if way == "pulled":
        exact = first_opening(block, static(block, kn, ks), xb)
        far = exact / lattice_material.youngs_modulus(kn, ks, d)
        printed = lattice_material.tensile_strength(kn, ks, xb, d)
        named = ("T_u", "tensile strength", "Eq. 7", FIRST)
    else:
        element = Element(kn, ks, xb, fs0, mu_p)
        exact, far = sliding(block, element, d), sliding_failure(element, d).strain
        printed = lattice_material.sliding_strength(fs0, mu_p, d)
        named = ("C_u", "compressive strength", "Eq. 14", AT_ONCE)
    quantities = (*_strength(block, exact, printed, *named), balance(3e-6))
    duration = 1.1 * abs(far / p["rate"])
    goal = History(duration, duration / OUTPUTS)
    watched: tuple[Observable, ...] = tuple(what for k in (0, 1) for what in _top(block, k))
    return Trial(Ladder(specimen(p, block), goal, watched, LEVELS), quantities)


def _strength(
    block: Lattice, exact: float, printed: float, name: str, what: str, equation: str, judge: Judge
) -> tuple[Quantity, ...]:
    whole = functools.partial(unhurried, functools.partial(_largest, block))

    def over(run: Run) -> float:
        return whole(run) / printed - 1.0

    beside = f"{name} over {equation}"
    meaning = f"{beside}, less 1; {PUBLISHED[name]}"
    return (
        Scalar(name, name, "Pa", what, whole, exact, exact, judge),
        Scalar(beside, beside, "", meaning, over, None, 1.0, Shown(FACES)),
    )


PUBLISHED = {
    "T_u": "the paper's mean over its blocks is -8.89 %",
    "C_u": "the paper's mean over its blocks is -18.51 %, which rigid smooth platens do not give",
}
FACES = "the equation knows no faces; it stands beside what the paper reports"
APART_BY = "outputs are 5e-4 of the strength apart, which is seen three times in what is told of "
OPENS = f"the answer is linear, which finite strain changes by 1e-4; {APART_BY}a rate of zero"
SLIDES = f"the answer takes bonds to open at the unit's strain; {APART_BY}a rate of zero"
CLASSES = (Method.SECOND_ORDER, Method.FIRST_ORDER)
FIRST: Judge = Exact(dict.fromkeys(CLASSES, Tolerance(2e-3, OPENS)))
AT_ONCE: Judge = Exact(dict.fromkeys(CLASSES, Tolerance(2e-3, SLIDES)))
RUNGS = tuple(Knobs(dt=8e-8 / 2**i) for i in range(4))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS[:2], Level.PAPER: RUNGS}

OPENING = "the most stretched bond of the linear lattice has the stretch xb"
SLIDING = "C_u of the unit (1 + 1/(6n - 6)), n elements a row: all inclined bonds slide at once"
IN_BALANCE = frozenset({"m", "rate"})
CASE = Case(
    name="close-packed-strength",
    title="Close-packed blocks to failure",
    source=Source(
        *LIU_2017,
        "T_u is judged by where the first bond opens in the linear lattice, at a face, and not by "
        "Eq. 7: with it the block fails. C_u is judged by where inclined bonds slide, all at once "
        "and long after all horizontal ones opened: the paper's mean is lower, by no area that "
        "would leave its E as it is. Stress is on the area of the hull of the centres. The paper "
        "moves the platen in steps; here it is carried steadily, at two rates, from which that of "
        "zero is told. Eq. 28 gives the viscosity.",
    ),
    parameters=(
        *BRITTLE,
        Parameter("rate", 0.6, "1/s", "strain rate of the slower block, tension positive"),
    ),
    variants=(
        Variant("pulled-82", "82 elements, pulled in two", OPENING, inert=IN_BALANCE),
        Variant("pulled-255", "255 elements", OPENING, inert=IN_BALANCE, level=Level.PAPER),
        *(
            Variant(
                f"pressed-{size}", f"{size} elements, pressed until they slide", SLIDING,
                {"rate": -8.0}, inert=IN_BALANCE, level=Level.PAPER,
            )
            for size in (82, 255)
        ),
    ),
    declare=_declare,
    published={
        "T_u of blocks": "8.89 % below Eq. 7 on average (section 5.2)",
        "C_u of blocks": "18.51 % below Eq. 14 on average (section 5.2)",
    },
)  # fmt: skip
