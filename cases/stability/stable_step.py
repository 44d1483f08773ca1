"""The largest stable step of codes on one contact: a sphere along a wall, a pair, a block."""

from __future__ import annotations

import math

import numpy as np

from cases._papers import LI_2018
from reference_solutions.contact import stability
from vv.ask import Bracket, Displacement, Method
from vv.case import (
    Case,
    Exact,
    Interval,
    Level,
    Parameter,
    Parameters,
    Search,
    Source,
    Tolerance,
    Trial,
    Variant,
    largest_step,
)
from vv.scene import (
    Block,
    Contact,
    Harmonic,
    Scene,
    Spheres,
    Wall,
    box_geometry,
    polyhedron_inertia,
)

RADIUS = 50.0  # m; does not enter the answer
FIRST, SECOND = Displacement(0), Displacement(1)
X, Y, Z = np.eye(3)


def _along_wall(p: Parameters) -> Scene:
    """A sphere pressed into a wall and free along it; its shear spring never slips."""
    sphere = Spheres(
        position=np.zeros((1, 3)),
        velocity=p["v"] * Y[None],
        radius=np.array([RADIUS]),
        mass=np.array([p["m"]]),
        free=np.array([[False, True, False]]),
    )
    wall = Wall((p["dx"] - RADIUS) * X, X)
    return Scene((wall, sphere), Contact(p["kn"], p["ks"], p["mu"]), p["eta"])


def _pair(p: Parameters) -> Scene:
    """Two spheres that dead loads press together so far that their contact never opens."""
    spheres = Spheres(
        position=np.array([np.zeros(3), (2 * RADIUS - p["dx"]) * X]),
        velocity=np.array([p["v"] * X, np.zeros(3)]),
        radius=np.full(2, RADIUS),
        mass=p["m"] * np.array([1.0, p["ratio"]]),
        free=np.array([[True, False, False]] * 2),
        load=p["kn"] * p["dx"] * np.array([X, -X]),
    )
    return Scene((spheres,), Contact(p["kn"]))


def _on_base(p: Parameters) -> Scene:
    """A cube on a base that starts to heave with the speed v; springs represent the contact."""
    vertices, faces = box_geometry(RADIUS * Z, np.full(3, RADIUS), np.eye(3))
    mass, inertia = polyhedron_inertia(vertices, faces, p["m"] / (2 * RADIUS) ** 3)
    block = Block(
        "block", vertices, faces, mass, inertia,
        velocity=np.zeros(3),
        free=np.array([False, False, True]),
        free_spin=np.zeros(3, bool),
    )  # fmt: skip
    rate = math.sqrt(p["kn"] / p["m"]) / SLOWER
    heave = Harmonic(p["v"] / rate * Z, rate / (2 * np.pi) * Z, np.full(3, -np.pi / 2))
    return Scene((Wall(np.zeros(3), Z, heave), block), Contact(np.inf), gravity=-p["g"] * Z)


def _declare(variant: str, p: Parameters) -> Trial:
    for name, unit in (("ks", " N/m"), ("mu", "")) if variant in ("undamped", "viscous") else ():
        if not p[name] > 0:
            raise ValueError(
                f"{name} = {p[name]!r}{unit}; it must be positive, since the shear spring "
                "oscillates"
            )
    return {"undamped": _undamped, "viscous": _viscous, "block": _block}.get(variant, _masses)(p)


def _undamped(p: Parameters) -> Trial:
    w = math.sqrt(p["ks"] / p["m"])
    theory, bracket = stability.centred(w), Bracket(SPAN, FAR * p["v"] / w)
    study = Search(_along_wall(p), (SECOND,), START * theory, SHORT, bracket)
    return Trial(study, (largest_step("limit", theory, TWO, bracket, EVERY),))


def _masses(p: Parameters) -> Trial:
    w = math.sqrt(p["kn"] * (1 + 1 / p["ratio"]) / p["m"])
    theory, bracket = stability.centred(w), Bracket(SPAN, FAR * p["v"] / w)
    study = Search(_pair(p), (FIRST, SECOND), START * theory, SHORT, bracket)
    return Trial(study, (largest_step("limit", theory, TWO, bracket, EVERY),))


def _viscous(p: Parameters) -> Trial:
    w, n = math.sqrt(p["ks"] / p["m"]), p["eta"] / (2 * p["m"])
    if not LIGHT <= n / w <= HEAVY:
        raise ValueError(
            f"eta = {p['eta']!r} N s/m; n/w = {n / w:.3g}; it must be from {LIGHT} to {HEAVY}: "
            "under less drag a stable oscillation does not die out in the run, and under more "
            "stable steps swing as far as unstable ones"
        )
    middle, late = stability.centred(w), stability.lagged(w, n)
    bracket = Bracket(max(SPAN, PAST * middle / (START * late)), NEAR * p["v"] / w)
    study = Search(_along_wall(p), (SECOND,), START * late, LONG, bracket)
    limit = largest_step("limit", middle, TWO, bracket, CENTRED)
    return Trial(study, (limit, largest_step("late", late, LATE_LIMIT, bracket, LATE)))


def _block(p: Parameters) -> Trial:
    w = math.sqrt(p["kn"] / p["m"])
    theory, bracket = stability.centred(w), Bracket(SPAN, FAR * p["v"] * SLOWER / w)
    study = Search(_on_base(p), (SECOND,), START * theory, SHORT, bracket, p["kn"])
    return Trial(study, (largest_step("limit", theory, TWO, bracket, AT_LEAST),))


START, SPAN = 0.45, 5.0  # where a search begins, over the lowest known limit, and how far it goes
LIGHT, HEAVY = 0.04, 1.5  # n/w at which the search tells stable steps from unstable ones
PAST = 1.4  # a search goes at least this far beyond the highest limit of a class
# steps of a run: with drag an unstable oscillation grows more slowly by that much
SHORT, LONG = 200, 1000
FAR, NEAR = 1e3, 3.0  # amplitudes; with drag a stable oscillation stays within one
SLOWER = 10.0  # the base heaves more slowly than the block oscillates on its spring, by this factor
TWO = "2/w"
LATE_LIMIT = "the limit of late drag"
SHARP = Tolerance(
    3e-3,
    "the search ends with an interval of 1.5e-3. Beyond the limit, by a relative excess d, an "
    "undamped oscillation grows by exp(2 sqrt(2 d)) a step; with drag it grows by exp(5 d), which "
    "shows from d = 5e-4 on",
)
OTHERS = dict.fromkeys(
    (Method.SECOND_ORDER, Method.FIRST_ORDER, Method.STRAIGHT),
    "the limit is that of a leapfrog; other methods have other limits",
)
AS_LEAPFROGS = [method for method in Method if method not in OTHERS]
EVERY = Exact(dict.fromkeys(AS_LEAPFROGS, SHARP), not_judged=OTHERS)
CENTRED = Exact(
    {method: SHARP for method in AS_LEAPFROGS if method is not Method.LATE_LEAPFROG},
    not_judged=OTHERS
    | {
        Method.LATE_LEAPFROG: "such a scheme uses drag at the earlier velocity; its limit is `late`"
    },
)
LATE = Exact(
    {Method.LATE_LEAPFROG: SHARP},
    not_judged=OTHERS
    | {
        method: "a scheme of this class uses drag in the middle of the step; its limit is `limit`"
        for method in AS_LEAPFROGS
        if method is not Method.LATE_LEAPFROG
    },
)
AT_LEAST = Interval(
    1 - SHARP.value,
    START * SPAN * (1 + 1e-9),
    "a spring of kn allows an explicit step of 2/w; an implicit step, or no spring at all, allows "
    "any, of which 2.25 times 2/w is the longest that is tried",
)
SWING = "m y'' = -k y - eta y', w^2 = k/m, n = eta/2m: a leapfrog is stable up to {}"
LIMIT = SWING.format("2/w")
HELD = frozenset({"kn", "mu", "dx", "v"})  # with enough friction, at any amplitude
ALONE, FREE = frozenset({"ratio", "g"}), {"eta": 0.0}
SPRUNG = frozenset({"ks", "mu", "eta"})  # of a normal spring, without drag
MASSES = {"m": 1.0, "kn": 1e6, "ks": 0.0, "mu": 0.0, "dx": 1e-2, **FREE}
CASE = Case(
    name="stable-step",
    title="Largest stable step",
    source=Source(
        *LI_2018,
        "The limits are not in the paper: 2/w, and 2 (sqrt(n^2 + w^2) - n)/w^2 for the drag of its "
        "Eqs. 9-12, 0.0822797 s with the numbers of T2. A step is unstable if within 200 steps the "
        "oscillation exceeds 1000 times that of the exact motion (with drag, 3 times within 1000 "
        "steps), or the code gives up. Steps that a code refuses are solved all the same. With "
        "drag, a scheme is judged by the limit of its class: 2/w if it claims second order, the "
        "limit of late drag, 0.6557 of 2/w at n/w = 0.43, if it claims first order.",
    ),
    parameters=(
        Parameter("m", 21650635.0946, "kg", "mass; of a pair, the smaller one"),
        Parameter("ratio", 1.0, "", "the other mass over the smaller one"),
        Parameter("kn", 5.5e9, "N/m", "normal contact stiffness"),
        Parameter("ks", 5.5e9, "N/m", "shear contact stiffness"),
        Parameter("mu", 0.1, "", "friction coefficient"),
        Parameter("dx", 0.5, "m", "overlap"),
        Parameter("eta", 3e8, "N s/m", "artificial viscosity"),
        Parameter("v", 1e-6, "m/s", "initial velocity, or velocity of the base"),
        Parameter("g", 9.81, "m/s2", "gravity, on the block alone"),
    ),
    variants=(
        Variant(
            "undamped",
            "a sphere oscillates along a wall on its shear spring",
            LIMIT,
            FREE,
            ALONE | HELD,
        ),
        Variant(
            "viscous",
            "the same with drag",
            SWING.format("2/w with drag at the middle, 2 (sqrt(n^2 + w^2) - n)/w^2 with drag late"),
            inert=ALONE | HELD,
        ),
        *(
            Variant(
                f"masses-{name}",
                f"two spheres pressed on each other, mass ratio {name}",
                LIMIT.replace("k/m", "k (1/m + 1/M)"),
                {**MASSES, "ratio": ratio},
                SPRUNG | {"dx", "v", "g"},
                level=Level.QUICK if ratio == 1e6 else Level.DEFAULT,
                unseen={
                    "ratio": "beside a much larger mass, the smaller one oscillates as if alone"
                },
            )
            for name, ratio in (("1e3", 1e3), ("1e6", 1e6))
        ),
        Variant(
            "block",
            "a block on a base that begins to move up and down; kn represents the rigid contact",
            LIMIT,
            {"m": 2500.0, "kn": 1e8, "ks": 0.0, "mu": 0.0, "dx": 0.0, **FREE},
            SPRUNG | {"ratio", "dx", "v", "g"},
        ),
    ),
    declare=_declare,
)
