"""Claims about two stacked blocks on a moving base: they follow the event-located answer."""

from __future__ import annotations

import functools

import numpy as np
from scipy.integrate import solve_ivp

from tests.scenes.blocks import stacked_blocks
from vv.ask import Ask, Displacement, History, Knobs, Status
from vv.engines import rigid
from vv.scene import Vector

END = 1.0  # s


@functools.cache
def error(dt: float) -> float:
    """The largest distance from the located-event answer over its largest displacement."""
    shown = (Displacement(1), Displacement(2))
    run = rigid.solve(Ask(stacked_blocks.scene(), History(END, 0.01), shown, Knobs(dt)))
    assert run.status is Status.RAN, run.reason
    moved = np.array([run.values[what] for what in shown])
    exact = stacked_blocks.by_events(run.times).T
    assert np.abs(moved[:, :, 1:]).max() <= 1e-6  # it neither drifts sideways nor tips
    return float(np.abs(moved[:, :, 0] - exact).max() / np.abs(exact).max())


def test_stacked_blocks_slide_as_their_events_say() -> None:
    assert error(1e-3) <= 5e-4


def test_stacked_blocks_are_second_order() -> None:
    errors = [error(dt) for dt in (4e-3, 2e-3, 1e-3, 5e-4)]
    assert np.log2(errors[0] / errors[-1]) / 3 >= 1.8


def test_the_events_are_those_of_friction_smoothed_ever_so_little() -> None:
    def rate(t: float, y: Vector, width: float = 1e-6) -> Vector:
        v1, v2 = y[2:]
        m, most = stacked_blocks.masses(), stacked_blocks.caps()
        below = -most[0] * np.tanh((v1 - stacked_blocks.base(t, 1)) / width)
        above = -most[1] * np.tanh((v2 - v1) / width)
        return np.array([v1, v2, (below - above) / m[0], above / m[1]])

    times = np.linspace(0.0, END, 21)
    run = solve_ivp(rate, (0.0, END), np.zeros(4), "LSODA", times, rtol=1e-9, atol=1e-12)
    assert np.abs(run.y[:2].T - stacked_blocks.by_events(times)).max() <= 1e-6
