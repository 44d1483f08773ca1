"""Whether a wall of stones slides on its bed as one block, and the bounds where it does."""

from __future__ import annotations

import functools
import math

import numpy as np

from reference_solutions.blocks import facade, responding_block
from reference_solutions.blocks.equilibrium import Stone, stands
from vv.ask import Method
from vv.case import Exact, Parameters, Tolerance
from vv.scene import Vector

LENGTH, HEIGHT, DEEP, DENSITY = 0.4, 0.2, 0.15, 2000.0  # m, of a block; half depth; kg/m3


def alone(p: Parameters) -> bool:
    """Whether no other motion is at hand; raises ValueError if the wall cannot slide as one block.

    A wall that sticks or slides as one block gives each stone at most the acceleration mu g, or
    that of the base. Forces that are linear in it balance any smaller one, and the wall is
    symmetric, so that the largest to one side decides.
    """
    thrust, far = _thrust(p), float(np.abs(slid(np.linspace(0.0, p["duration"], 501), p)).max())
    if far > LENGTH / 2:
        raise ValueError(
            f"D = {p['D']!r} m; the wall slides by {far:.4g} m, and beyond {LENGTH / 2:g} m its "
            "bed, which is as long as the wall, no longer bears its last stone"
        )
    if not (_bears(p, 1.0) or _balanced(*_size(p), p["mu"], thrust, upright=True)):
        raise ValueError(
            f"mu = {p['mu']!r}; the wall does not move as one block: where it slides, or is shaken "
            f"hardest, its stones need a thrust of {thrust:.4g} times their weight, and no forces "
            "that press and obey Coulomb's law balance them"
        )
    return _bears(p, SURE)


def _size(p: Parameters) -> tuple[int, int]:
    return int(p["columns"]), int(p["courses"])


def _thrust(p: Parameters) -> float:
    """The largest thrust on a stone that moves with the wall or with the base, over its weight."""
    hardest = p["D"] * (2 * math.pi * p["f"]) ** 2
    return min(p["mu"], hardest / p["g"]) if p["g"] else 0.0


def _bears(p: Parameters, times: float) -> bool:
    """Whether bed joints alone balance the stones under so many times the thrust and friction."""
    return _balanced(*_size(p), times * p["mu"], times * _thrust(p), upright=False)


@functools.lru_cache
def _balanced(columns: int, courses: int, mu: float, thrust: float, upright: bool) -> bool:
    """Whether the stones of a wall are in equilibrium, with or without forces in upright joints."""
    laid = facade.courses(columns, courses, LENGTH)
    stones = [Stone(left, right, n * HEIGHT, (n + 1) * HEIGHT) for n, left, right in laid]
    return stands(stones, mu, thrust, upright=upright)


def bounds(p: Parameters, own: bool) -> Exact:
    """The bounds of a wall that slides, by its courses on springs and by the step.

    own: the parameters are the case's, at which the wall is known to slide as one block, on springs
    too. At others runs are shown and not judged where another motion is at hand.
    """
    if not (own or alone(p)):
        return Exact({}, not_judged=dict.fromkeys(CLASSES, MAY_PART) | {Method.LAGGING: SLIPS})
    whole = (
        "the step in which slip reverses is not cut: the speed gets an error of up to 2 mu g dt, f "
        "times a second; the error of the displacement is that times the time that is left, over D"
    )
    turns = max(1.0, p["mu"] * p["g"] * p["f"] * p["duration"] ** 2 / p["D"] / 20.0)
    second = Tolerance(2e-2 * turns, whole, dt=2e-3, order=1)
    first = Tolerance(
        2e-2 * turns,
        whole,
        dt=2e-3,
        order=1,
        slack="where in a step slip reverses is a matter of chance",
    )
    judged, shown = (
        {Method.SECOND_ORDER: second, Method.FIRST_ORDER: first},
        {Method.LAGGING: SLIPS},
    )
    if not (own or _bears(p, SWINGS)):
        return Exact(judged, not_judged={**shown, Method.PENALTY: EXCITED})
    penalty = Tolerance(
        max(_walk(p), ROUNDING),
        "a block on its springs vibrates with the frequency w, w^2 = kn/m; at Coulomb's limit with "
        "the amplitude mu m g/kn, so that a course walks on the next at up to mu g/w, and the "
        "highest of n courses at n times that, for the whole duration; and " + whole,
        kn=1e9, softness=0.5, late=10.0 * turns,
        slack="courses walk at half of that speed, and not always",
    )  # fmt: skip
    return Exact({**judged, Method.PENALTY: penalty}, not_judged=shown)


def _walk(p: Parameters) -> float:
    """How far the highest course may walk on springs of 1e9 N/m, over the largest displacement."""
    w = math.sqrt(1e9 / (LENGTH * HEIGHT * 2 * DEEP * DENSITY))
    moved = np.abs(slid(np.linspace(0.0, p["duration"], 11), p)).max()
    return float(p["courses"] * p["mu"] * p["g"] / w * p["duration"] / (moved or 2 * p["D"]))


def slid(t: Vector, p: Parameters) -> Vector:
    """The displacement [m] of a block that slides on the base, along it."""
    moved = responding_block.one_direction(t, D=p["D"], f=p["f"], mu=p["mu"], g=p["g"])
    return np.asarray(moved - responding_block.base(t, D=p["D"], f=p["f"]))


ROUNDING = 1e-11  # of positions
CLASSES = (Method.SECOND_ORDER, Method.FIRST_ORDER, Method.PENALTY)
# Of the thrust, by trial: of fifteen walls of 6 to 12 columns none parted at up to 0.96 of the
# thrust at which equilibrium ends, and six with doors seven courses high did at 0.98 or 0.99. It
# decides only where runs are shown and not judged.
SURE = 1.1
MAY_PART = (
    "forces balance the stones, but not if thrust and friction are a tenth larger and upright "
    "joints bear nothing: with friction more than one motion may then obey all laws, and stones "
    "that may stay may also move"
)
# Of the thrust: friction that begins to press a wall on springs without damping swings it twice as
# far, and where friction then changes sign, from there about its other place of rest, three times.
SWINGS = 3.0
SLIPS = "with lagging friction, courses slip on one another by a quarter of the displacement"
EXCITED = (
    "springs without damping swing three times as far as friction presses when it changes its "
    "sign. Under that thrust no forces in bed joints balance the stones, so that joints may open, "
    "and courses, all of which are at Coulomb's limit, walk by up to half of the displacement. "
    "This is how these springs move; only long steps damp it"
)
