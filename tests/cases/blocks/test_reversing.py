"""Claims about what springs delay where a block slips uphill and downhill: each part integrated."""

from __future__ import annotations

import numpy as np
import pytest

from cases.blocks.parts import _reversing
from cases.blocks.parts._reversing import Phase, displaced, in_steps, on_springs, phases, turned
from vv.plan.project import find

CASE = find().load_case("incline")
USUAL = CASE.defaults("two-way")
W, DT = 1000.0, 1e-7  # 1/s, s


def on_a_spring(pull: float, friction: float, speed: float, duration: float) -> tuple[float, float]:
    """(place, speed) after a time of a mass that slips downhill, and the force T of size pull."""
    force, x = friction, 0.0
    for _ in range(round(duration / DT)):
        speed -= (pull + force) * DT
        x += speed * DT
        force = float(np.clip(force + W**2 * speed * DT, -friction, friction))
    return x, speed


@pytest.mark.parametrize(("pull", "friction"), [(30.0, 5.0), (12.0, 5.0), (6.0, 5.0)])
def test_a_reversal_on_a_spring_changes_the_speed_as_said(pull: float, friction: float) -> None:
    duration = 0.01
    bent = _reversing._bent(Phase(duration, -pull, friction, -1, 1), W)
    rigid = -(pull - friction) * duration
    assert rigid - on_a_spring(pull, friction, 0.0, duration)[1] == pytest.approx(bent, rel=1e-3)


@pytest.mark.parametrize("pull", [0.5, 2.5, 4.5])
def test_a_spring_throws_a_block_back_that_comes_to_rest(pull: float) -> None:
    friction = 5.0
    thrown = _reversing._thrown(Phase(1.0, -pull, friction, 0, 1), W)
    reached = np.arccos((pull - friction) / (pull + friction)) / W
    assert on_a_spring(pull, friction, 0.0, reached)[1] == pytest.approx(-thrown, rel=2e-3)
    assert _reversing._thrown(Phase(1.0, pull, friction, 0, 1), W) == 0.0


@pytest.mark.parametrize("error", [1e-3, -1e-3])
def test_a_reversal_leaves_a_part_of_an_error_of_the_speed(error: float) -> None:
    pull, friction, late = 12.0, 5.0, 0.1

    def after(speed: float) -> float:
        reversed_at = speed / (pull + friction)
        return -(pull - friction) * (late - reversed_at)

    left = _reversing._left(Phase(1.0, -pull, friction, -1, 1))
    assert after(0.5 + error) - after(0.5) == pytest.approx(left * error, rel=1e-9)
    assert _reversing._left(Phase(1.0, pull, friction, 1, 0)) == 1.0


def test_errors_add_up_over_slips_and_a_rest_ends_those_along_the_spring() -> None:
    down, up = Phase(2.0, 3.0, 1.0, 1, -1), Phase(2.0, -3.0, 1.0, -1, 1)
    assert in_steps((down,)) == pytest.approx(2.0)
    assert in_steps((down, up)) == pytest.approx(2.0 + 1.5 * 2.0)
    assert in_steps((down, Phase(1.0, 0.5, 1.0, 0, 1), Phase(2.0, 1.0, 1.0, 1, 0))) == 2.0
    bent = _reversing._bent(down, W)
    assert displaced((down,), W, 0.0) == pytest.approx(2.0 * bent)
    assert displaced((down, up), W, 0.0) == pytest.approx(2.0 * bent)  # the second is the other way
    assert displaced((down,), W, 1e-3) == pytest.approx(2.0 * (bent + 1e-3))


def test_a_block_that_vibrations_lift_off_has_no_bound() -> None:
    motion = phases({**USUAL, "f": 8.0})
    assert on_springs(motion, {**USUAL, "f": 8.0}, 4e4) < 0.2
    assert on_springs(motion, {**USUAL, "f": 9.0}, 4e4) == np.inf
    assert on_springs(motion, {**USUAL, "f": 40.0}, 4e4) == np.inf


def slid(p: dict[str, float], late: float, step: float) -> complex:
    """The displacement of a block that slides from the start, with friction that turns late [s]."""
    dip, mu, behind = np.radians(p["alpha"]), np.tan(np.radians(p["phi"])), round(late / step)
    speed, place, ways = 0j, 0j, []
    for k in range(round(p["duration"] / step)):
        along, aside = (
            p[size] * np.sin(2 * np.pi * p[often] * (k + 0.5) * step)
            for size, often in (("A", "f"), ("Ay", "fy"))
        )
        friction = mu * (p["g"] * np.cos(dip) - along * np.sin(dip))
        pull = complex(p["g"] * np.sin(dip) + along * np.cos(dip), aside)
        ways.append(speed / abs(speed) if speed else pull / abs(pull))
        speed += step * (pull - friction * ways[max(0, k - behind)])
        place += step * speed
    return place


def test_friction_that_turns_half_a_step_late_displaces_as_said() -> None:
    usual = CASE.defaults("two-directions")
    p = {**usual, "alpha": 50.0, "phi": 45.0, "Ay": 8.0, "duration": 2.0}  # it never rests
    late = 2e-4
    error = abs(slid(p, late / 2, 1e-5) - slid(p, 0.0, 1e-5)) / late
    assert turned(p) == pytest.approx(error, rel=0.05)
