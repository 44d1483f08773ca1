"""Close-packed bonded elements pulled and compressed to strains of a thousandth: E and nu."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator

import numpy as np

from cases._papers import LIU_2017
from cases.bonds.close_packed_lattice import (
    LEAST_NU,
    held,
    lowest,
    observed,
    scale_of,
    seen_of,
)
from cases.bonds.parts._quartzite import ELASTIC, slower_lattice
from cases.bonds.parts._specimens import block_of
from reference_solutions.bonds import close_packed_lattice, lattice_path
from reference_solutions.bonds.close_packed_lattice import Lattice
from vv.ask import History, Knobs, Method
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
from vv.scene import Vector

OUTPUTS = 10  # at the first of them the start has decayed, and all changes begin
STOPS = (2, 5, 10)  # the outputs at which E and nu are measured
DURATION = 500.0  # over the lowest frequency: the duration
PARTS = 4  # increments of the reference between two outputs


def _declare(variant: str, p: Parameters) -> Trial:
    """The top moves at a steady rate; bonds do not break."""
    if not 1e-6 <= abs(p["strain"]) <= 5e-3:
        raise ValueError(f"strain = {p['strain']!r}; its size must be from 1e-6 to 5e-3")
    block = block_of(int(variant.partition("-")[2]), p["d"])
    coarse = COARSE * slower_lattice(p["kn"], p["gamma"] * p["kn"], p["m"])
    steps = max(1, round(DURATION / OUTPUTS / lowest(p, block) / coarse))  # between two outputs
    goal = History(OUTPUTS * steps * coarse, steps * coarse)
    scene = held(p, block, goal.duration, turning=False)
    levels = dict.fromkeys(Level, (Knobs(coarse), Knobs(coarse / 2)))
    study = Ladder(scene, goal, seen_of(block), levels)
    strains = p["strain"] * np.array([1, *STOPS]) / OUTPUTS

    @functools.cache
    def exact() -> Vector:
        return lattice_path.path(block, p["kn"], p["gamma"] * p["kn"], strains, PARTS)

    return Trial(study, tuple(_moduli(p, block, strains, exact)))


def _moduli(
    p: Parameters, block: Lattice, strains: Vector, exact: Callable[[], Vector]
) -> Iterator[Quantity]:
    """E and nu_x from the changes since the first output, and E over that at zero strain."""

    def due(which: int, column: int, sign: float) -> float:
        found = exact()
        return float(sign * (found[which, column] - found[0, column])
                     / (strains[which] - strains[0]))  # fmt: skip

    @functools.cache
    def small() -> close_packed_lattice.Static:
        return close_packed_lattice.static(block, p["kn"], p["gamma"] * p["kn"])

    judge = _on_path(p)
    for which, stop in enumerate(STOPS, 1):
        strain = strains[which]
        for name, column, sign, unit, least in (
            ("E", 0, 1.0, "Pa", 0.0),
            ("nu_x", 1, -1.0, "", LEAST_NU),
        ):
            value = functools.partial(due, which, column, sign)
            yield Scalar(
                f"{name}({strain:g})", f"{name}({strain:g})", unit,
                f"secant from a strain of {strains[0]:g} to one of {strain:g}",
                functools.partial(observed, name, block, since=1, until=stop),
                value, functools.partial(scale_of, value, least), judge,
            )  # fmt: skip
    last = functools.partial(observed, "E", block, since=1, until=STOPS[-1])
    yield Scalar(
        "grown", "E/E_0 - 1", "", "E of the whole path over E at zero strain, minus 1",
        lambda run: last(run) / small().E - 1.0, None, 1.0, Shown(GROWS),
    )  # fmt: skip


def _on_path(p: Parameters) -> Exact:
    lags = Tolerance(max(ROUNDING, 2 / DURATION * abs(p["strain"])), SLOW)
    return Exact(dict.fromkeys((Method.SECOND_ORDER, Method.FIRST_ORDER), lags))


ROUNDING = 1e-7  # of strains of 1e-6 and less
GROWS = "the paper says that errors grow with the strain; this shows by how much"
SLOW = (
    "at a steady rate the effect of inertia decays. The tangent changes by about the strain, and "
    "the motion lags behind that by 2/w of its duration, w the lowest frequency, which is "
    "critically damped; half a step, by which some shear springs lag, is less. An error of nu is "
    "that of a ratio of strains, and nu is measured by 0.1 where it is less, as where ks = kn"
)
COARSE = 1e-7  # s
PATH = "sum over bonds kn (L - d) n + S = 0 between the platens, S' = ks v_across + turn x S"
NO_SIZE = {
    "d": "forces per displacement are those of the springs, whatever the size of the elements",
    "strain": "moduli change by half of the change of strain, and are computed from strains that a "
    "code reports",
}
CASE = Case(
    name="close-packed-path",
    title="Close-packed blocks to finite strain",
    source=Source(
        *LIU_2017,
        "Figs. 4a and b, in which strains go to 1e-3 and bonds are made too strong to break. The "
        "reference is the equilibrium of the same block at finite strain, with the incremental "
        "shear spring. E and nu are computed from the changes since a tenth of the strain, where "
        "the start has decayed. Stress is the force over the hull of the centres.",
    ),
    parameters=(
        *ELASTIC,
        Parameter("strain", -1e-3, "", "the largest axial strain, tension positive"),
    ),
    variants=tuple(
        Variant(
            f"{way}-{n}", f"{n} elements, to a strain of {strain:g}", PATH, {"strain": strain},
            inert=frozenset({"m"}), level=level,
            unseen=NO_SIZE,
        )
        for n, way, strain, level in (
            (82, "in", -1e-3, Level.QUICK),
            (82, "out", 1e-3, Level.DEFAULT),
            (580, "in", -1e-3, Level.PAPER),
            (2166, "in", -1e-3, Level.PAPER),
        )
    ),
    declare=_declare,
    published={
        "mean error of nine blocks": "0.6 % in E and in nu from -1e-6 to -1e-3 (section 5.2)"
    },
)  # fmt: skip
