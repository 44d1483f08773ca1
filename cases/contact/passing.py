"""Rows of unlike contacts are sheared back and forth while another sphere passes."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np

from reference_solutions.bonds import unlike_row
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    LARGEST_TOLERANCE,
    Case,
    Exact,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Vector

ROWS, APART = 21, 1.5  # m between them: so many spheres that codes list neighbours only
RADIUS = np.array([0.3, 0.5, 0.4])  # m: in the middle, held, and at the end of each row
MASS = np.array([1.0, 4.0, 2.5])  # of m
THROWN = np.array([1.0, 0.0, -0.6])  # times v, falling from row to row by LESS
LESS = np.linspace(1.0, 0.5, ROWS)
# m: radius of the sphere that passes, its distance and how far it goes
PASSING, FAR, LONG = 0.2, 3.5, 8.0
X, Y, Z = np.eye(3)
MIDDLE, HELD, END = range(3)
PAIRS = np.array([[MIDDLE, HELD], [MIDDLE, END]])
# of the middle sphere, on which HELD and END are: the higher number lies at lower x
SIDES = np.array([1.0, -1.0])


def _declare(variant: str, p: Parameters) -> Trial:
    _require_shallow(p)
    reach = RADIUS[MIDDLE] + RADIUS[[HELD, END]] - p["overlap"]
    path, goal = _path(p, reach), History(p["duration"], p["duration"] / 40)
    _require_stick(p, path)
    unit, error = math.sqrt(p["m"] / p["ks"]), _error(p)
    parts = 1 << max(0, math.ceil(math.log2(error / LARGEST_TOLERANCE) / 2))
    coarsest = min(
        COARSEST / parts * unit, COARSEST * math.sqrt(STIFFER * p["m"] / p["kn"]), goal.interval
    )
    _require_few(p["duration"] / coarsest, p["duration"])
    judge = _judge(error * (coarsest / (COARSEST * unit)) ** 2, coarsest)
    rungs = tuple(Knobs(coarsest / 2**i) for i in range(4))
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}
    seen = tuple(Displacement(3 * k + body) for k in (0, ROWS - 1) for body in (MIDDLE, END))
    study = Ladder(_scene(p, reach), goal, seen, levels)
    return Trial(study, _quantities(path, goal.times(None), judge))


def _scene(p: Parameters, reach: Vector) -> Scene:
    """The rows, whose outer spheres lie at distances `reach` from the middle, and the passer."""
    row = np.outer([0.0, *(SIDES * reach)], X)
    place = np.concatenate([row + k * APART * Z for k in range(ROWS)])
    thrown = np.append(np.outer(LESS, p["v"] * THROWN), LONG / p["duration"])
    spheres = Spheres(
        np.vstack([place, FAR * X]), np.outer(thrown, Y), np.append(np.tile(RADIUS, ROWS), PASSING),
        p["m"] * np.append(np.tile(MASS, ROWS), 1.0),
        np.outer([*[True, False, True] * ROWS, True], Y > 0),
    )  # fmt: skip
    return Scene((spheres,), Contact(p["kn"], p["ks"], p["mu"]))


def _require_stick(p: Parameters, path: Callable[[Vector], Vector]) -> None:
    """Raise ValueError where contacts come near to slip."""
    swings = np.abs(np.diff(path(np.linspace(0.0, p["duration"], 500)), axis=1)).max()
    if p["ks"] * swings > 0.5 * p["mu"] * p["kn"] * p["overlap"]:
        raise ValueError(f"v = {p['v']!r} m/s; it is so large that the contacts nearly slip")


def _error(p: Parameters) -> float:
    """The error of a leapfrog whose step is COARSEST in units of sqrt(m/ks)."""
    return EARLY + 2.8e-4 * float(np.sqrt(p["ks"] / p["m"]) * p["duration"])


def _judge(error: float, coarsest: float) -> Exact:
    """A leapfrog may be off by `error` at the longest step, `coarsest` [s]."""
    second = Tolerance(max(error, ROUNDED), AHEAD, dt=coarsest, order=2, floor=ROUNDED)
    return Exact(
        {Method.LEAPFROG: second, Method.LATE_LEAPFROG: second},
        not_judged=dict.fromkeys((Method.SECOND_ORDER, Method.FIRST_ORDER), OTHERS),
    )


def _quantities(
    path: Callable[[Vector], Vector], times: Vector, judge: Exact
) -> tuple[Series, ...]:
    """The displacements of two spheres in the first row and in the last."""

    def one(body: int, less: float) -> Callable[[Vector], Vector]:
        return lambda t: less * path(t)[:, body, None]

    return tuple(
        Motion(Displacement(3 * k + body), Y[None], one(body, LESS[k]), times, "m").component(
            0, f"{name}{k}", f"displacement of the sphere {where} of row {k}", judge
        )
        for k in (0, ROWS - 1)
        for body, name, where in ((MIDDLE, "middle", "in the middle"), (END, "end", "at the end"))
    )


def _require_shallow(p: Parameters) -> None:
    """Raise ValueError where contacts are deep, turn over, or nothing moves."""
    if not p["v"]:
        raise ValueError(f"v = {p['v']!r} m/s; it must not be 0, or nothing moves")
    if not p["overlap"] < PASSING / 10:
        raise ValueError(
            f"overlap = {p['overlap']!r} m; it must be below a tenth of the smallest radius, "
            f"{PASSING / 10:g} m"
        )
    least = float(p["kn"] * p["overlap"] / (RADIUS[MIDDLE] + RADIUS[END] - p["overlap"]))
    if not p["ks"] > least:
        raise ValueError(
            f"ks = {p['ks']!r} N/m; it must exceed kn d/L = {least:.4g} N/m, by which normal "
            "forces reduce it"
        )


def _require_few(steps: float, duration: float) -> None:
    if not steps <= MOST:
        raise ValueError(
            f"duration = {duration!r} s; it takes {steps:.3g} steps that are so short that phases "
            f"can be judged; at most {MOST:g} are run"
        )


def _path(p: Parameters, reach: Vector) -> Callable[[Vector], Vector]:
    """Displacements (k, 3) of the middle sphere, the one held and the one at the end.

    The spheres move like a row on springs, whose stiffness the normal force of the contacts
    reduces.
    """
    order = [HELD, MIDDLE, END]
    stiffness = p["ks"] - p["kn"] * p["overlap"] / reach
    row = unlike_row.Row(
        p["m"] * MASS[order], np.arange(3.0), np.array([[0, 1], [1, 2]]), stiffness
    )
    swings = functools.partial(
        unlike_row.along, row=row, length=np.ones(2), v=p["v"] * THROWN[order], g=0.0, held=True
    )
    return lambda t: np.asarray(swings(t)[0][:, [1, 0, 2]])


COARSEST = 0.05  # of sqrt(m/ks)
ROUNDED = 1e-6  # of the displacement: rounding of places of metres, and what passes
STIFFER = 100  # normal over shear stiffness, above which normal springs decide the step
OTHERS = "the bound is that of the phase of a leapfrog"
EARLY = 0.05**2 * 2.65 / 6  # (w dt)^2/6; u'' = -w^2 v t at the start, w^2 = (2 + 0.6) ks/m
MOST = 1e6  # steps, some ten seconds of calculation
AHEAD = (
    "the phase of a leapfrog is ahead by (w dt)^2/24 of the angle, some 40 radians by default; it "
    "grows with sqrt(ks/m) and the duration. Amplitudes are (w dt)^2/8 too large, and a motion "
    "that has hardly begun is (w dt)^2/6 off"
)
CASE = Case(
    name="passing",
    title="Contacts sheared while another sphere passes",
    source=Source(
        "Cundall and Strack (1979), A discrete numerical model for granular assemblies, "
        "Geotechnique 29(1), 47-65",
        "10.1680/geot.1979.29.1.47",
        "The shear springs are theirs, and do not slip here. The sphere that passes touches "
        "nothing. It goes so far that codes update their neighbour lists many times, and each "
        "contact must keep its own shear displacement. Across the springs the normal force kn d of "
        "a contact of length L reduces ks by kn d/L.",
    ),
    parameters=(
        Parameter("m", 1.0, "kg", "mass of a middle sphere, and of the one that passes"),
        Parameter("kn", 2e4, "N/m", "normal contact stiffness"),
        Parameter("ks", 1e4, "N/m", "shear contact stiffness"),
        Parameter("mu", 1.0, "", "friction coefficient"),
        Parameter("overlap", 1e-4, "m", "overlap of both contacts"),
        Parameter("v", 1e-3, "m/s", "initial speed of the first middle sphere"),
        Parameter("duration", 0.25, "s", "time simulated"),
    ),
    variants=(
        Variant(
            "sheared", "rows of three spheres, one of which is held; no sphere can rotate",
            "M u'' + K u = 0 across the contacts, exactly in its modes", inert=frozenset({"mu"}),
            unseen=dict.fromkeys(("kn", "overlap"), "normal forces reduce the stiffness of the "
                                 "shear springs by 3e-4 only"),
        ),
    ),
    declare=_declare,
)  # fmt: skip
