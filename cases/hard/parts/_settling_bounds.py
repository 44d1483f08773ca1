"""Bounds of a sphere that bounces to rest: of its path, and of the number of its bounces."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from reference_solutions.contact import settling
from vv.ask import Method
from vv.case import LARGEST_TOLERANCE, Exact, Parameters, Tolerance

STEP = 1e-4  # s, the coarsest
DURATION = 0.8  # s, the shortest
INTERVAL = 1e-4  # s, between outputs: six in the shortest flight of the case
PATH = {
    Method.EXACT: Tolerance(
        5e-13, "rounding errors of sixty events, each of which shifts the next"
    ),
    Method.SECOND_ORDER: Tolerance(
        4e-3,
        "a contact lasts 30 steps of 1e-4 s: an error of (k dt)^2/24 = 4e-4 for its oscillation, "
        "and as much at random for each of its ends. An error of the speed after a contact changes "
        "each flight that follows, so that errors grow with the square of the number of bounces",
        dt=1e-4,
        order=2,
    ),
    Method.FIRST_ORDER: Tolerance(
        1e-2,
        "drag that is half a step late changes its coefficient by n dt = 0.1 % at 1e-4 s, which "
        "adds up over thirty bounces; gravity that is half a step late changes the first speed by "
        "g dt/2v = 0.25 %",
        dt=1e-4,
        order=1,
    ),
}
RIGHT = "a number that is right has no error"
WHOLE = Tolerance(
    1e-6,
    "a number of bounces is right or wrong; the last that leaves the floor rises above it by 2 % "
    "of its depth, and the next one stays as much below it",
    slack=RIGHT,
)
COUNTED = Exact(dict.fromkeys(PATH, WHOLE))
LATE = (
    "an error of first order may decide whether the slowest bounce leaves the floor; that it does "
    "not is known at the case's own parameters only"
)
UNSEEN = f"a flight or a contact is shorter than two outputs, {2.0 * INTERVAL:g} s"


def path(p: Parameters, stages: Sequence[settling.Stage], own: bool) -> Exact:
    """The judge of the path; own: the parameters are the case's."""
    return Exact(PATH if own else PATH | _elsewhere(p, stages))


def count(
    p: Parameters, law: Mapping[str, float], stages: Sequence[settling.Stage], own: bool
) -> Exact:
    """The judge of the number of bounces."""
    return COUNTED if own else _counted_elsewhere(p, law, stages)


def bounces(stages: Sequence[settling.Stage]) -> int:
    """How often the sphere leaves the floor."""
    return sum(stage.flies for stage in stages) - 1


def _elsewhere(p: Parameters, stages: Sequence[settling.Stage]) -> dict[Method, Tolerance]:
    """The bounds at parameters other than the case's own."""
    divided = parts(p, stages)
    value, step = _error(p, stages) / divided**2, STEP / divided
    ends = (
        "a contact changes the speed by (k dt)^2/2 (b (1 - b) - a (1 - a)) of it, a and b the "
        "parts of a step after which it begins and ends, at random; each changes all flights that "
        "follow. Three standard deviations are allowed"
    )
    slows = p["eta"] / p["m"] / 20.0 * max(1.0, bounces(stages) / 30.0)
    starts = math.sqrt(p["g"] / p["height"] / (9.81 / 2e-3))
    rounded = PATH[Method.EXACT]
    more = max(1.0, len(stages) / 62) * max(1.0, 2.0 * stages[-1].begin / DURATION)
    return {
        Method.EXACT: Tolerance(
            rounded.value * more,
            f"{rounded.reason}, by as much as the times of events are rounded: as the number of "
            "events times the duration",
        ),
        Method.SECOND_ORDER: Tolerance(value, ends, dt=step, order=2),
        Method.FIRST_ORDER: Tolerance(
            value, f"{PATH[Method.FIRST_ORDER].reason}; {ends}",
            dt=step, order=2, late=100.0 * max(1.0, slows, starts),
        ),
    }  # fmt: skip


def parts(p: Parameters, stages: Sequence[settling.Stage]) -> int:
    """How many steps replace one, a power of two: so many that errors may be judged."""
    return 1 << max(0, math.ceil(math.log2(_error(p, stages) / LARGEST_TOLERANCE) / 2))


def _error(p: Parameters, stages: Sequence[settling.Stage]) -> float:
    """The error that methods of second order may make at the coarsest step, over the height."""
    return max(3.0 * _spread(p, stages), 0.4) * _swing(p)


def _spread(p: Parameters, stages: Sequence[settling.Stage]) -> float:
    """The standard deviation of the largest error over the height, for (k dt)^2 = 1."""
    flights = [(one.begin, abs(one.v)) for one in stages[1:] if one.flies]
    lags = [
        speed * math.sqrt(sum((begin - earlier) ** 2 for earlier, _ in flights[:i]))
        for i, (begin, speed) in enumerate(flights)
    ]
    return max(lags, default=0.0) / p["height"] / 2 / math.sqrt(90.0)


def _swing(p: Parameters) -> float:
    """The square of the oscillation's angle in the coarsest step."""
    return float(p["kn"] / p["m"] * STEP**2)


def _counted_elsewhere(
    p: Parameters, law: Mapping[str, float], stages: Sequence[settling.Stage]
) -> Exact:
    """The number of bounces is judged where it can be seen, and an error does not change it."""
    if min(np.diff([one.begin for one in stages])) < 2.0 * INTERVAL:
        return Exact({}, not_judged=dict.fromkeys(PATH, UNSEEN))
    off = 3.0 * math.sqrt(bounces(stages) / 90.0) / 2 * _swing(p)
    margin = _margin(p, law, stages)
    told = (
        f"a number of bounces is right or wrong; the swings before and after the last flight "
        f"differ by {margin:.2g} from those that just reach the floor"
    )
    judged = {Method.EXACT: Tolerance(1e-6, told, slack=RIGHT)}
    shown = {Method.FIRST_ORDER: LATE}
    if off < margin:
        judged[Method.SECOND_ORDER] = judged[Method.EXACT]
    else:
        shown[Method.SECOND_ORDER] = (
            f"{told}; contacts that end within a step change a swing by up to {off:.2g} (three "
            "standard deviations), which may add or remove a bounce"
        )
    return Exact(judged, not_judged=shown)


def _margin(p: Parameters, law: Mapping[str, float], stages: Sequence[settling.Stage]) -> float:
    """How far the slowest bounce and the oscillation that stays are from just reaching z = 0.

    It is the smaller of both differences of amplitude, over the amplitude m g/kn that reaches it.
    """
    flight, sunk = [one for one in stages if one.flies][-1], p["m"] * p["g"] / p["kn"]
    swing = flight.v / math.sqrt(p["kn"] / p["m"]) / sunk
    leaves = math.hypot(1.0, swing) - 1.0 if bounces(stages) else math.inf
    turn = 2.0 * np.pi / math.sqrt(p["kn"] / p["m"] - (p["eta"] / (2.0 * p["m"])) ** 2)
    z = settling.settling(stages[-1].begin + np.linspace(0.5, 1.25, 1501) * turn, **law)
    return min(leaves, -float(z.max() + p["height"]) / sunk)
