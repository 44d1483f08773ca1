"""Claims about steps of second order for a body whose slip changes direction on a rigid wall."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from adapters.exact import ADAPTER
from tests.engines.exact.test_turning import shaken_slope
from tests.scenes.blocks.exact_slides import BOX, DOWN, apart, ran
from tests.scenes.blocks.sliding_blocks import Frame, block, incline, wall
from vv.ask import Ask, History, Knobs, Run, Status
from vv.engines.exact import solve_second_order
from vv.engines.exact.steps.flow import phases
from vv.engines.exact.steps.frozen import frozen_slip, slowly_turned
from vv.engines.exact.steps.kernel import follow_steps
from vv.engines.kernels.compiled import compiled
from vv.scene import Contact, Scene, Vector

DURATION = 4.0  # s; up to twelve periods of the shaking
DECLARED = 0.25  # of (w h)^2: a mean over a step is off by 1/24 of it; six times that is allowed
QUICKEST = 2 * np.pi * 3.0  # rad/s, w of `shaken_slope`
SEEDS = range(12)


def stepped(scene: Scene, h: float, interval: float = 0.1) -> Run:
    return solve_second_order(Ask(scene, History(DURATION, interval), (BOX,), Knobs(h)))


def error(seed: int, h: float) -> float:
    scene = shaken_slope(seed)
    run = stepped(scene, h)
    due = ran(scene, DURATION, 0.1).values[BOX]
    return apart(run.values[BOX], due[: len(run.times)])


@pytest.mark.parametrize("seed", SEEDS)
def test_errors_are_below_what_the_step_declares(seed: int) -> None:
    for h in (0.02, 0.01, 0.005, 0.001):
        assert error(seed, h) <= DECLARED * (QUICKEST * h) ** 2


def test_errors_fall_as_the_square_of_the_step() -> None:
    steps = np.array([4e-3, 1e-3, 2.5e-4])
    found = np.array([[error(seed, h) for seed in SEEDS] for h in steps])
    mean = np.log(found).mean(axis=1)
    assert np.polyfit(np.log(steps), mean, 1)[0] == pytest.approx(2.0, abs=0.15)


def slid(h: float) -> float:
    """Where steps leave a body that 5 sin 2t [m/s2] drags once, against a friction of 3 m/s2."""
    rows = np.array([[0.0, 5.0], [0.0, 0.0], [3.0, 0.0]])
    steps, turn = round(1.85 / h), np.array([2.0 * h])
    out = np.empty((2, 4))
    start = np.array([0.0, 0.0, h, 1.0, 0.0, 0.0])
    follow_steps(rows, phases(np.zeros(1), turn), np.empty((1, 2)), start, steps, out)
    assert not out[1, 1:].any()
    return float(out[1, 0])


def test_a_slip_that_begins_and_ends_within_steps_is_off_by_their_third_power() -> None:
    """Without its start, or its last step, or the rest of the trapezoidal rule: by the second."""
    begins = np.arcsin(0.6) / 2

    def speed(t: float) -> float:
        return float(2.5 * (np.cos(2 * begins) - np.cos(2 * t)) - 3 * (t - begins))

    ends = brentq(speed, 1.0, 1.85, xtol=1e-15)
    due = 2.5 * np.cos(2 * begins) * (ends - begins) - 1.5 * (ends - begins) ** 2
    due -= 1.25 * (np.sin(2 * ends) - np.sin(2 * begins))
    steps = np.geomspace(0.05, 0.005, 21)
    steps = 1.85 / np.round(1.85 / steps)
    errors = np.abs([slid(h) - due for h in steps]) / due
    assert (errors < 3.0 * steps**3).all()
    assert errors.max() > 0.3 * steps.max() ** 3


@compiled
def after(start: Vector, forces: Vector, times: Vector, close: bool, out: Vector) -> int:
    """Slips under constant forces after times; whether by the closed form, else by the series."""
    for k in range(len(times)):
        u, v, x, y, f = start[0], start[1], forces[0], forces[1], forces[2]
        if close:
            out[k, 0], out[k, 1], _ = frozen_slip(u, v, x, y, f, times[k])
        else:
            out[k, 0], out[k, 1] = slowly_turned(u, v, x, y, f, times[k])
    return len(times)


def slips(start: Vector, forces: Vector, times: Vector, close: bool = True) -> Vector:
    out = np.empty((len(times), 2))
    after(start, forces, times, close, out)
    return out


@pytest.mark.parametrize("seed", range(20))
def test_the_closed_form_is_that_of_the_equation_of_motion(seed: int) -> None:
    r = np.random.default_rng(seed)
    start, forces = r.uniform(-1, 1, 2), np.array([*r.uniform(-2, 2, 2), r.uniform(0, 2)])
    times = np.linspace(0.05, 2.0, 40)

    def rate(_: float, w: Vector) -> Vector:
        return np.asarray(forces[:2] - forces[2] * w / np.linalg.norm(w))

    def slow(_: float, w: Vector) -> float:
        return float(np.linalg.norm(w)) - 1e-4

    slow.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(rate, (0, 2), start, t_eval=times, rtol=1e-10, atol=1e-12, events=slow)
    due = slips(start, forces, times)
    assert np.abs(due[: len(found.t)] - found.y.T).max() < 1e-7
    if found.t_events[0].size and np.hypot(*forces[:2]) < forces[2]:
        assert not due[times > found.t_events[0][0] + 0.01].any()


def test_a_slip_against_the_pull_stops_and_turns_back_unless_friction_holds_it() -> None:
    times, back = np.array([0.5, 1.0, 3.0]), np.array([-3.0, 0.0])
    strong, weak = np.array([2.0, 0.0, 1.0]), np.array([1.0, 0.0, 2.0])
    assert slips(back, strong, times)[:, 0] == pytest.approx([-1.5, 0.0, 2.0], abs=1e-11)
    assert slips(back, weak, times)[:, 0] == pytest.approx([-1.5, 0.0, 0.0], abs=1e-11)
    for forces in (weak, weak * np.array([-1.0, 0.0, 1.0])):
        assert not slips(0 * back, forces, times).any()
    assert slips(0 * back, strong, times)[:, 0] == pytest.approx([0.5, 1.0, 3.0])


def test_a_slip_without_forces_goes_on_and_friction_alone_stops_it() -> None:
    times, start = np.array([0.5, 1.0, 3.0]), np.array([3.0, 4.0])
    assert slips(start, np.zeros(3), times) == pytest.approx(np.tile(start, (3, 1)), rel=1e-12)
    speeds = np.linalg.norm(slips(start, np.array([0.0, 0.0, 2.5]), times), axis=1)
    assert speeds == pytest.approx([3.75, 2.5, 0.0], abs=1e-11)


def test_the_series_leaves_the_fourth_power_of_the_angle() -> None:
    """The next term is F h (k h)^4/120 times a number of the size of one."""
    start, forces = np.array([2.0, 1.0]), np.array([-1.0, 3.0, 1.5])
    times = np.array([0.04, 0.02, 0.01])
    missed = np.linalg.norm(
        slips(start, forces, times) - slips(start, forces, times, False), axis=1
    )
    orders = np.log2(missed[:-1] / missed[1:])
    assert orders == pytest.approx([5.0, 5.0], abs=0.2)


def test_constant_forces_are_exact_at_any_step() -> None:
    frame = Frame(30.0)
    bodies = (wall(frame), block(frame, 0.8 * frame.axes[1]))
    scene = Scene(bodies, Contact(np.inf, mu=0.3), gravity=DOWN)
    speeds = [stepped(scene, h, 0.4).values[BOX] for h in (0.4, 0.01)]
    exact = ran(scene, DURATION, 0.4).values[BOX]
    assert apart(speeds[1], exact) < 1e-4  # of the trapezoidal rule for positions
    assert apart(speeds[0], exact) < 0.02


def test_what_steps_are_not_for_is_refused(tmp_path: Path) -> None:
    slope = incline(Frame(20), 22.0, 5.0)
    turning = shaken_slope(0)
    soft = dataclasses.replace(turning, contact=Contact(1e9, 1e9, 0.4))
    asks = {
        "the slip keeps its line; `default` solves it exactly": slope,
        "Contact.kn = 1000000000.0 N/m; steps are for rigid contact": soft,
    }
    for reason, scene in asks.items():
        ask = Ask(scene, History(1.0, 0.1), (BOX,), Knobs(1e-2))
        assert ADAPTER.refuses(ask, "second-order") == reason
        assert solve_second_order(ask).status is Status.REFUSED
    endless = Ask(turning, History(1.0, 0.1), (BOX,))
    assert ADAPTER.refuses(endless, "second-order") == "Knobs.dt is None; steps need a length"


def test_a_solve_is_repeated_alike_and_takes_some_ten_nanoseconds_a_step(tmp_path: Path) -> None:
    ask = Ask(shaken_slope(1), History(DURATION, 0.1), (BOX,), Knobs(1e-3))
    once, timed = (next(ADAPTER.run([ask], "second-order", tmp_path, s)) for s in (0.0, 0.02))
    assert np.array_equal(once.values[BOX], timed.values[BOX])
    assert timed.cost.solve_cpu < 2e-7 * timed.steps
