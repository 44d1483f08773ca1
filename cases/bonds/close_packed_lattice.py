"""Blocks of close-packed bonded elements between smooth platens: E and nu."""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np

from cases._papers import LIU_2017
from cases.bonds.parts._quartzite import ELASTIC, slower_lattice
from reference_solutions.bonds import (
    close_packed_lattice,
    lattice_directions,
    lattice_material,
    turning_lattice,
)
from reference_solutions.bonds.close_packed_lattice import SIZES, Lattice, Static
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
from vv.scene import Bonds, Contact, Mask, Scene, Spheres, Vector

SIDES = ((0, 0), (0, 1), (1, 0), (1, 1))  # axis and side of the extreme rows across the load
LOADING = 5.0  # over the lowest frequency: the interval over which changes are measured
# degrees from c
LEANS = {"vertex": np.degrees(np.arccos(1 / 3)), "in-plane": 90.0, "softest": 50.0}
CUT = 8.5  # diameters: the width of a block that is cut across layers, half its height
SETTLED = {False: 4, True: 80}  # number of such intervals before; True: elements rotate
SOFT = 0.1  # ks/kn below which modes of shear decay so slowly that it takes twice as many


@functools.lru_cache(maxsize=16)
def _block(variant: str, d: float) -> Lattice:
    if variant in LEANS:
        sides = (CUT * d, CUT * d, 2.0 * CUT * d)
        return close_packed_lattice.cut(sides, np.radians(LEANS[variant]), d)
    return close_packed_lattice.lattice(*SIZES[int(variant.partition("-")[0])], d)


def lowest(p: Parameters, block: Lattice) -> float:
    """The approximate lowest frequency [1/s] of a block: 1.4 times the wave speed over its size.

    Factors of 1.3 to 1.6 were found for the blocks of 82 to 2166 elements.
    """
    E = lattice_material.youngs_modulus(p["kn"], p["gamma"] * p["kn"], p["d"])
    speed = np.sqrt(E * p["d"] ** 3 / (np.sqrt(2) * p["m"]))
    return float(1.4 * speed / np.ptp(block.position, axis=0).max())


def held(p: Parameters, block: Lattice, time: float, turning: bool) -> Scene:
    """The block with a fixed base and a moving top; it starts with the motion of the lattice."""
    kn, d, n = p["kn"], p["d"], len(block.position)
    rate = p["strain"] / time
    widths = np.array([-lattice_material.poissons_ratio(kn, p["gamma"] * kn)] * 2 + [1.0])
    ends = block.at(2, 0) | block.at(2, 1)
    free = np.ones((n, 3), bool)
    free[:, 2] = ~ends
    spheres = Spheres(
        block.position,
        velocity=rate * widths * block.position,
        radius=np.full(n, d / 2),
        mass=np.full(n, p["m"]),
        free=free,
        free_spin=np.full((n, 3), turning),
    )
    bonds = Bonds(block.bonds, d, kn, p["gamma"] * kn)  # type: ignore[arg-type]  # for all
    eta = 2 * p["m"] * lowest(p, block)
    return Scene((spheres,), Contact(kn, p["gamma"] * kn, 0.0), eta, bonds=bonds)


def seen_of(block: Lattice) -> tuple[Observable, ...]:
    """The observables of `observed`: displacements of the faces, and forces on the top."""
    return tuple(
        kind(int(i))
        for kind, rows in (
            (Displacement, [*(block.at(*side) for side in SIDES), block.at(2, 1)]),
            (Reaction, [block.at(2, 1)]),
        )
        for i in np.flatnonzero(np.any(rows, axis=0))
    )


def _declare(variant: str, p: Parameters) -> Trial:
    block, turning = _block(variant, p["d"]), variant.endswith("turning")
    interval = LOADING / lowest(p, block)
    settled = SETTLED[turning] * (2 if p["gamma"] < SOFT else 1)
    goal = History((settled + 1) * interval, interval)
    scene = held(p, block, goal.duration, turning)
    route = turning_lattice if turning else close_packed_lattice
    answer = functools.cache(lambda: route.static(block, p["kn"], p["gamma"] * p["kn"]))
    steps = COARSE if len(block.position) > LARGE else STEPS
    longer = slower_lattice(p["kn"], p["gamma"] * p["kn"], p["m"])
    rungs = {level: tuple(Knobs(dt * longer) for dt in own) for level, own in steps.items()}
    study = Ladder(scene, goal, seen_of(block), rungs, cpu_limit=PATIENCE)
    lean = np.radians(LEANS.get(variant, 0.0))
    return Trial(study, _measured(p, block, answer, turning, lean))


def _part(answer: Callable[[], Static], field: str) -> float:
    return float(getattr(answer(), field))


def _measured(
    p: Parameters, block: Lattice, answer: Callable[[], Static], turning: bool, lean: float
) -> tuple[Quantity, ...]:
    """E and nu of the block; nu along x and y differ as faces do, and all from the lattice's."""
    springs = {"kn": p["kn"], "ks": p["gamma"] * p["kn"], "d": p["d"]}
    along = lattice_directions.modulus([np.sin(lean), 0.0, np.cos(lean)], **springs)
    E = lattice_material.youngs_modulus(**springs)
    judge = _judge(p["strain"], turning)

    def of(name: str, unit: str, what: str, least: float = 0.0) -> Scalar:
        observe = functools.partial(observed, name, block)
        value = functools.partial(_part, answer, name)
        size = functools.partial(scale_of, value, least)
        return Scalar(name, name, unit, what, observe, value, size, judge)

    def excess(run: Run) -> float:
        return observed("E", block, run) / along - 1

    def share(run: Run) -> float:
        return observed("E", block, run) / E

    rows = "minus the ratio of strains, by the extreme rows along"
    return (
        of("E", "Pa", "Young's modulus, with the stress on the hull of the centres"),
        of("nu", "", "mean of nu_x and nu_y", LEAST_NU),
        of("nu_x", "", f"{rows} x", LEAST_NU),
        of("nu_y", "", f"{rows} y", LEAST_NU),
        Scalar("E-excess", "E/E_n - 1", "",
               "relative difference of E from that of the lattice along the load, which along c is "
               "Eq. 6", excess, None, 1.0, FACES),
        Scalar("share", "E/E_6", "", "E over that of the lattice along c, Eq. 6",
               share, None, 1.0, FACES),
    )  # fmt: skip


def scale_of(value: Callable[[], float], least: float) -> float:
    """The size of a value, or `least` where it is smaller: nu is zero where ks = kn."""
    return max(abs(value()), least)


def observed(name: str, block: Lattice, run: Run, since: int = -2, until: int = -1) -> float:
    """A quantity from the changes between two outputs."""
    change = functools.partial(_change, run, since, until)
    top = block.at(2, 1)
    strain = change(Displacement, top, 2).mean() / block.position[top, 2].mean()
    if name == "E":
        return float(change(Reaction, top, 2).sum() / block.area / strain)
    if name == "nu":
        return (observed("nu_x", block, run) + observed("nu_y", block, run)) / 2
    axis = "xy".index(name[-1])
    low, high = (change(Displacement, block.at(axis, side), axis).mean() for side in (0, 1))
    return float((low - high) / np.ptp(block.position[:, axis]) / strain)


def _change(
    run: Run, since: int, until: int, kind: type[Displacement] | type[Reaction], rows: Mask,
    axis: int,
) -> Vector:  # fmt: skip
    values = [run.values[kind(int(i))] for i in np.flatnonzero(rows)]
    return np.array([value[until, axis] - value[since, axis] for value in values])


def _judge(strain: float, turning: bool) -> Judge:
    left = LEFT_TURNING if turning else LEFT
    small = 2e-5 if turning else 1e-7
    tolerance = Tolerance(small + 5 * abs(strain), left)
    return Exact(dict.fromkeys((Method.SECOND_ORDER, Method.FIRST_ORDER), tolerance))


LEFT = (
    "at a constant rate the step has no effect, and up to 1e-7 of the modes that the start excites "
    "has not decayed; the rest is of first order in the strain, since bonds rotate with it. An "
    "error of nu is that of a ratio of strains, whatever nu is: nu is measured by 0.1, half of "
    "what it is without shear springs, if it is less, as where ks = kn"
)
LEFT_TURNING = (
    "rotation is damped through the centres only, and 1e-5 of it is left; bonds rotate as well"
)
FACES: Judge = Shown(
    "elements at the faces have fewer bonds, and the area of a block is a convention"
)
STEPS = {
    Level.QUICK: (1e-7, 5e-8),
    Level.DEFAULT: (1e-7, 5e-8),
    Level.PAPER: (1e-7, 5e-8, 2.5e-8),
}  # s
LEAST_NU = 0.1  # half of the lattice's nu without shear springs
LARGE, PATIENCE = 2166, 200.0  # elements, beyond which only one step runs; CPU time of a rung [s]
COARSE = dict.fromkeys(Level, (1e-7,))
BALANCE = "sum over bonds (kn n n + ks (1 - n n)) (u_j - u_i) = 0 between the platens"
NO_SIZE = {
    "d": "forces per displacement are those of the springs, whatever the size of the elements",
    "strain": "the answer is linear: E and nu do not change with the strain",
}
RUN_AT = {
    Level.QUICK: (82,),
    Level.DEFAULT: (255, 580, 1105),
    Level.PAPER: (2166, 5461, 10985, 18079, 37681),
}
VARIANTS = (
    *(
        Variant(
            f"{n}", f"{n} elements of quartzite, which do not rotate", BALANCE,
            inert=frozenset({"m"}), level=level, unseen=NO_SIZE,
        )
        for level, sizes in RUN_AT.items()
        for n in sizes
    ),
    *(
        Variant(
            name, f"a box of the lattice loaded along {what}", BALANCE, inert=frozenset({"m"}),
            level=Level.PAPER, unseen=NO_SIZE,
        )
        for name, what in (
            ("vertex", "another vertex of the unit, 70.5 degrees from c"),
            ("in-plane", "a row within the layers"),
            ("softest", "50 degrees from c, where it is softest"),
        )
    ),
    Variant(
        "82-turning", "82 elements that are free to rotate, unlike those of the paper",
        f"{BALANCE}, u less (d/2) (w_i + w_j) x n", inert=frozenset({"m"}), level=Level.DEFAULT,
        unseen=NO_SIZE,
    ),
)  # fmt: skip
CASE = Case(
    name="close-packed-lattice",
    title="Blocks of close-packed elements",
    source=Source(
        *LIU_2017,
        "The paper gives neither the area of its stress nor the way in which it measures lateral "
        "strain: here they are the hull of the centres, (n - 1) d x p sqrt3 d, and the extreme "
        "rows. E depends on the area by some per cent. The reference is the static answer of the "
        "same block, to first order. To reach it quickly the base is fixed and the top moves "
        "steadily: once the modes have decayed, drag only adds constants to force and widths, so "
        "that their changes between two outputs are the static answer. The viscosity is chosen: it "
        "is critical at the lowest frequency, about 1.4 times the wave speed over the size. Boxes "
        "along other directions are cut across layers: their faces are the elements within half a "
        "diameter of the outermost.",
    ),
    parameters=(
        *ELASTIC,
        Parameter("strain", 1e-6, "", "axial strain at the end"),
    ),
    variants=VARIANTS,
    declare=_declare,
    published={
        "mean error of nine blocks": "0.6 % in E and in nu (section 5.2)",
        "other directions": "the other vertices follow the formulas; E is 'a bit lower' along "
        "other directions (section 6)",
    },
)
