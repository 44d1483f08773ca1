"""Claims about blocks that vibrate while they rest: a separate program slides as far as allowed."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest

from cases.blocks.parts._vibrating import Onset
from reference_solutions.blocks import incline
from tests.scenes.blocks.block_on_spring import frequency, slid, slope
from vv.ask import Knobs, Method
from vv.plan.project import find

CASE = find().load_case("incline")
TURNED = {"alpha": 22.28, "phi": 28.53, "A": 4.73, "f": 3.2, "Ay": 0.53, "fy": 0.53, "g": 6.65}
STEEP = {"alpha": 47.96, "phi": 51.94, "A": 3.78, "f": 1.04, "Ay": 2.15, "fy": 2.75}
FLAT = {"alpha": 11.98, "phi": 16.62, "A": 3.41, "f": 2.74, "Ay": 2.67, "fy": 1.07}
OPPOSED = {"alpha": 28.78, "phi": 42.48, "A": 5.94, "f": 0.51, "Ay": 0.34, "fy": 1.88, "g": 5.13}


def over_bound(given: dict[str, float], kn: float) -> float:
    """The error of the last place over the bound at a stiffness and a step of no length."""
    p = {**CASE.defaults("two-directions"), "duration": 4.0, **given}
    on, shaken = slope(p["alpha"], p["phi"], p["g"]), ((p["A"], p["f"]), (p["Ay"], p["fy"]))
    place = np.array(slid(frequency(kn), 0.0125, p["duration"], 0.0, on, *shaken))
    drive = {"ax": p["A"], "fx": p["f"], "ay": p["Ay"], "fy": p["fy"]}
    law = {name: p[name] for name in ("alpha", "phi", "g")}
    path = incline.two_directions(np.linspace(0.0, p["duration"], 401), **drive, **law)
    judge = CASE.declare("two-directions", p).quantities[2].judge
    bound = judge.tolerance(Method.PENALTY).uncut(Knobs(1e-15, kn))  # type: ignore[union-attr]
    size = np.linalg.norm(path, axis=1).max()
    return float(np.linalg.norm(place - path[-1]) / size / bound)


@pytest.mark.shows("the bound contains it")
@pytest.mark.parametrize("kn", [1e7, 1e8, 1e9, 1e10, 1e11])
@pytest.mark.parametrize(
    "given", [{}, TURNED, STEEP, FLAT, OPPOSED], ids=["own", "turned", "steep", "flat", "opposed"]
)
def test_an_undamped_block_slides_farther_by_what_the_bound_contains(
    given: dict[str, float], kn: float
) -> None:
    assert 0.04 < over_bound(given, kn) < 1.0


def test_on_the_stiffest_springs_the_vibration_is_most_of_the_bound() -> None:
    assert 0.6 < over_bound({"duration": 6.0}, 1e12) < 0.9


@pytest.mark.shows(
    "by an amount that falls as kn^(-1/3) while it is small, and as kn^(-2/3) at last"
)
def test_the_gain_falls_slowly_while_the_vibration_is_small() -> None:
    gentle = Onset(7.5, 18.0, 0.5, np.array([0.0, 1.0]), np.array([0.1, 0.1]))
    strong = Onset(7.5, 18.0, 0.5, np.array([0.0, 1.0]), np.array([4.0, 4.0]))
    for one, power in ((gentle, 1 / 3), (strong, 2 / 3)):
        assert one.gains(1e7) / one.gains(1e8) == pytest.approx(10**power)


def _onset(w: float, rate: float, across: float) -> float:
    """How fast a block on its spring is after T = F + T' t has passed F = 8, from far before."""
    t0 = (16.0 / (rate * w * w)) ** (1 / 3)
    dt, t, until = 0.05 / w, -min(0.3, 60 * t0), 40 * t0
    sx, sy, vx, vy = (8.0 + rate * t) / w**2, across / w**2, 0.0, 0.0
    while t < until:
        over = w * w * np.hypot(sx, sy) / 8.0
        if over > 1:
            sx, sy = sx / over, sy / over
        vx += dt * (8.0 + rate * t - w * w * sx)
        vy -= dt * w * w * sy
        sx, sy, t = sx + dt * vx, sy + dt * vy, t + dt
    return vx


onset: Any = numba.njit(_onset)


@pytest.mark.parametrize("w", [3e3, 3e4, 3e5])
@pytest.mark.parametrize(
    ("part", "least"), [(0.1, 0.9), (0.3, 0.9), (0.5, 0.9), (1.5, 0.9), (3.0, 0.8)]
)
def test_what_vibrates_across_a_slip_makes_it_faster_by_a_universal_amount(
    w: float, part: float, least: float
) -> None:
    """part: of the angle beyond which the slip itself takes what vibrates."""
    rate, held = 10.0, 8.0
    t0 = (2 * held / (rate * w * w)) ** (1 / 3)
    across = part * np.sqrt(4 * rate * t0 / held) * held
    faster = onset(w, rate, across) - onset(w, rate, 0.0)
    one = Onset(held, rate, 1.0, np.array([0.0, 1.0]), np.array([across, across]))
    assert least * one.gains(w * w) < faster < 1.02 * one.gains(w * w)
