"""Four bonded elements: at rest under an axial force, breathing, and turned as a whole."""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np

from reference_solutions import lattice_material, tetrahedral_unit
from reference_solutions.tetrahedral_unit import Displacements, State
from vv.ask import Displacement, History, Knobs, Method, Run
from vv.case import (
    Case,
    Exact,
    Judge,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Bonds, Contact, Scene, Spheres, Vector
from vv.study import Ladder, Level

CORNERS = np.array(
    [
        [0.0, 0.0, np.sqrt(2 / 3)],
        [1 / np.sqrt(3), 0.0, 0.0],
        [-0.5 / np.sqrt(3), 0.5, 0.0],
        [-0.5 / np.sqrt(3), -0.5, 0.0],
    ]
)  # of the top and of the base, in diameters
OUT = CORNERS - CORNERS.mean(axis=0)
ROUND = np.cross([0.0, 0.0, 1.0], OUT)
EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [2, 3], [3, 1]])
BASE = np.array([[True, True, True], *[[True, True, False]] * 3])
SEEN = tuple(Displacement(i) for i in range(4))
REST = History(duration=6e-5, interval=6e-6)
SWING = History(duration=2e-6, interval=2e-8)


def _scene(p: Parameters, eta: float, **motion: Vector) -> Scene:
    """The unit on unbreakable bonds; elements do not turn."""
    data = {"velocity": np.zeros((4, 3)), "free": np.ones((4, 3), bool), **motion}
    spheres = Spheres(
        p["d"] * CORNERS, radius=np.full(4, p["d"] / 2), mass=np.full(4, p["m"]), **data
    )
    bonds = Bonds(EDGES, p["d"], p["kn"], p["gamma"] * p["kn"])  # type: ignore[arg-type]  # for all
    return Scene((spheres,), Contact(p["kn"]), eta, bonds=bonds)


def _force(p: Parameters) -> float:
    """Fz [N] that Eqs. 5 and 6 give for the strain."""
    E = lattice_material.youngs_modulus(p["kn"], p["gamma"] * p["kn"], p["d"])
    return float(E * np.sqrt(3) / 2 * p["d"] ** 2 * p["strain"])


def _at_rest(p: Parameters) -> Trial:
    fz, d = _force(p), p["d"]
    load = np.zeros((4, 3))
    load[0, 2] = fz
    scene = _scene(p, p["eta"], free=BASE, load=load)
    state = tetrahedral_unit.loaded(fz, kn=p["kn"], ks=p["gamma"] * p["kn"], d=d)
    return Trial(Ladder(scene, REST, SEEN, _levels(2e-8)), _measured(state, fz, d))


def _measured(state: State, fz: float, d: float) -> tuple[Quantity, ...]:
    def of(name: str, symbol: str, unit: str, what: str, value: float, scale: float) -> Scalar:
        observe = functools.partial(_observed, name, fz, d)
        return Scalar(name, symbol, unit, what, observe, value, scale, AT_REST)

    x, size = state.x, abs(state.x.dz)
    return (
        of("E", "E", "Pa", "secant modulus, on the original area", state.modulus, state.modulus),
        of("nu", "nu", "", "secant ratio of strains, negated; over 1/5", state.poisson, 0.2),
        of("dz", "dz", "m", "displacement of the top", x.dz, size),
        of("X_n1", "X_n1", "m", "stretch of an inclined bond", x.xn1, size),
        of("X_s1", "X_s1", "m", "displacement across an inclined bond", _across(x, d), size),
        of("X_n2", "X_n2", "m", "stretch of a horizontal bond", x.xn2, size),
    )


def _across(x: Displacements, d: float) -> float:
    """The displacement [m] of the top against the base, across the inclined bond as it now is.

    The spring's own X_s1, which it has gathered on its way, is another to first order in strain.
    """
    out, up = x.xn2 / np.sqrt(3), x.dz
    angle = np.arctan2(d / np.sqrt(3) + out, d * np.sqrt(2 / 3) + up)
    return float(abs(up * np.sin(angle) - out * np.cos(angle)))


def _observed(name: str, fz: float, d: float, run: Run) -> float:
    """A quantity at the end of a run; bonds of a kind are averaged."""
    u = np.array([run.values[what][-1] for what in SEEN]) / d
    i, j = EDGES.T
    offset, moved = CORNERS[j] - CORNERS[i], u[j] - u[i]
    length = np.linalg.norm(offset + moved, axis=1)
    stretch = np.einsum("bk,bk->b", 2 * offset + moved, moved) / (length + 1)
    n = (offset + moved) / length[:, None]
    across = np.linalg.norm(moved - np.einsum("bk,bk->b", n, moved)[:, None] * n, axis=1)
    strain = u[0, 2] / np.sqrt(2 / 3)
    told = {
        "E": fz / (np.sqrt(3) / 2 * d * d * strain),
        "nu": -stretch[3:].mean() / strain,
        "dz": d * u[0, 2],
        "X_n1": d * stretch[:3].mean(),
        "X_s1": d * across[:3].mean(),
        "X_n2": d * stretch[3:].mean(),
    }
    return float(told[name])


def _swinging(p: Parameters, shape: Vector, stiffness: float) -> Trial:
    """Thrown in a shape (4, 3) in which it swings at 2 sqrt(stiffness/m), strain its size."""
    w = 2 * np.sqrt(stiffness / p["m"])
    scene = _scene(p, 0.0, velocity=p["d"] * p["strain"] * w * shape)
    sizes = p["d"] * p["strain"] * shape
    largest = np.abs(shape).argmax(axis=1)
    parts = tuple(
        _part(w, sizes, body, axis.item()) for body, axis in enumerate(largest) if sizes[body].any()
    )
    return Trial(Ladder(scene, SWING, SEEN, _levels(1e-8)), parts)


def _part(w: float, sizes: Vector, body: int, axis: int) -> Series:
    return Series(
        f"u{body}{'xyz'[axis]}",
        f"u_{body}{'xyz'[axis]}",
        "m",
        f"displacement of element {body} along {'xyz'[axis]}",
        _along(SEEN[body], axis),
        lambda t: sizes[body, axis] * np.sin(w * t),
        SWUNG,
    )


def _along(what: Displacement, axis: int) -> Callable[[Run], Vector]:
    return lambda run: np.asarray(run.values[what][:, axis])


def _declare(variant: str, p: Parameters) -> Trial:
    if variant == "breathing":
        return _swinging(p, OUT, p["kn"])
    if variant == "turning":
        return _swinging(p, ROUND, p["gamma"] * p["kn"])
    return _at_rest(p)


def _levels(coarsest: float) -> dict[Level, tuple[Knobs, ...]]:
    rungs = tuple(Knobs(dt=coarsest / 2**i) for i in range(4))
    return {Level.QUICK: rungs[:3:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}


SETTLED = (
    "at rest no step counts; on its way to rest the unit leaves the path of a slow load, which the "
    "incremental shear spring remembers to first order in the strain, a tenth of 1e-6 at most"
)
AT_REST: Judge = Exact({
    Method.EXACT: Tolerance(1e-12, "the equilibrium path is known to rounding of displacements"),
    Method.SECOND_ORDER: Tolerance(2e-7, SETTLED),
    Method.FIRST_ORDER: Tolerance(2e-7, SETTLED),
})  # fmt: skip
SWUNG: Judge = Exact({
    Method.EXACT: Tolerance(1e-12, "a sine, whose rate is known to rounding"),
    Method.SECOND_ORDER: Tolerance(
        1.5e-2, "the phase (w dt)^2/24 w t of a leapfrog after 20 radians at 0.1 radian a step is "
        "8.3e-3", dt=1e-8, order=2,
    ),
    Method.FIRST_ORDER: Tolerance(
        0.1, "a start half a step late shifts the phase by w dt/2", dt=1e-8, order=1
    ),
})  # fmt: skip

PATH = "3 (Fn1 cos a + Fs1 sin a) = Fz, Fn1 sin a - Fs1 cos a + sqrt3 Fn2 = 0, S' = -L a'"
IN_BALANCE = frozenset({"m", "eta"})
VARIANTS = (
    Variant("pulled", "quartzite, pulled to a strain of 1e-6", PATH, inert=IN_BALANCE),
    Variant("pressed", "quartzite, pressed", PATH, {"strain": -1e-6}, inert=IN_BALANCE),
    *(
        Variant(
            f"gamma-{gamma:g}", f"ks = {gamma:g} kn, pulled", PATH, {"gamma": gamma},
            inert=IN_BALANCE, quick=False,
        )
        for gamma in (0.0, 0.25, 0.5, 1.0)
    ),
    Variant(
        "breathing", "free in space, all bonds swing as one; no bond turns, at any amplitude",
        "L = d (1 + A sin 2 sqrt(kn/m) t)", {"strain": 0.01, "eta": 0.0},
        inert=frozenset({"gamma"}),
    ),
    Variant(
        "turning", "turned as a whole: elements that do not turn resist it, an artefact",
        "2 ks d^2 a^2 of energy at an angle a, which swings at 2 sqrt(ks/m)",
        {"eta": 0.0},
    ),
)  # fmt: skip
CASE = Case(
    name="tetrahedral-unit",
    title="Four bonded elements",
    source=Source(
        "Liu, Xu, Shi, Deng and Zhu (2017), Mechanical properties and energy conversion of 3D "
        "close-packed lattice model for brittle rocks, Computers and Geosciences 103",
        "10.1016/j.cageo.2017.03.003",
        "E and nu are judged by the equilibrium path of the incremental shear spring, not by the "
        "small-strain Eqs. 2 to 6, from which it differs by 5e-7 here. The paper moves the top in "
        "steps; here it bears a dead load. The viscosity that brings the unit to rest is chosen.",
    ),
    parameters=(
        Parameter("kn", 46793831.1079, "N/m", "normal stiffness of a bond (Table 1)"),
        Parameter("gamma", 5 / 29, "", "ks/kn of a bond (Table 1)"),
        Parameter("d", 1e-3, "m", "diameter of an element, length of a bond"),
        Parameter("m", 1.87383297e-6, "kg", "mass of an element (Eq. 27)"),
        Parameter("strain", 1e-6, "", "axial strain by Eqs. 5, 6; amplitude A of breathing"),
        Parameter("eta", 6.0, "N s/m", "viscosity on every element"),
    ),
    variants=VARIANTS,
    declare=_declare,
    published={
        "at a strain of -1e-6": "E and nu of a unit coincide with those of quartzite (section 5.2)"
    },
)
