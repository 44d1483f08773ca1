"""Claims about series of `exact` and the steps in which they converge, against closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

from vv.engines.exact.kernel import ORDER, _expand
from vv.engines.exact.line.glide import SHORT, forced_motion
from vv.engines.exact.line.model import Line
from vv.engines.exact.line.path import _series, forced_motions, oscillations, parts_of
from vv.engines.exact.modes import BACKWARD, FORWARD, OPEN, PARTED, STUCK, Equations, step
from vv.engines.exact.turn.rest import friction_margin, third_derivative_bound
from vv.engines.exact.turn.series import expand_drive
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
N, K = 0.7, 3.0  # 1/s


def sines() -> tuple[Vector, Vector]:
    """Rows (3, 3) of constants and two sines, and these: frequencies, phases and rates."""
    random = np.random.default_rng(4)
    hertz, phase = np.array([0.75, 2.0]), np.array([0.3, 1.9])
    table = np.column_stack([hertz, 1e-3 * hertz, phase, 2.0 * np.pi * 1.001 * hertz])
    return random.normal(size=(3, 3)), table


def driven(rows: Vector, table: Vector, t: float) -> Vector:
    """The three driving forces at a time."""
    return np.asarray(rows[:, 0] + rows[:, 1:] @ np.sin(table[:, 3] * t + table[:, 2]))


def test_a_drive_is_its_series_about_any_time() -> None:
    rows, table = sines()
    t, h, out = 3.7, 0.05, np.full((3, ORDER + 1), np.nan)
    expand_drive(rows, table, t, h, out)
    for x in (-1.0, 0.0, 0.4, 1.0):
        found = out @ x ** np.arange(ORDER + 1)
        assert found == pytest.approx(driven(rows, table, t + x * h), abs=1e-12)
    slope = (driven(rows, table, t + 1e-5) - driven(rows, table, t - 1e-5)) / 2e-5
    assert out[:, 1] / h == pytest.approx(slope, rel=1e-7)


def margin(rows: Vector, table: Vector, t: float) -> float:
    """F^2 - |T|^2."""
    x, y, limit = driven(rows, table, t)
    return float(limit**2 - x**2 - y**2)


def test_a_margin_of_friction_has_its_derivatives_and_a_bound_on_the_third() -> None:
    rows, table = sines()
    t, d, out = 3.7, 1e-4, np.full(3, np.nan)
    friction_margin(rows, table, t, out)
    near = [margin(rows, table, t + k * d) for k in (-1, 0, 1)]
    assert out[0] == pytest.approx(near[1])
    assert out[1] == pytest.approx((near[2] - near[0]) / (2 * d), rel=1e-3)
    assert out[2] == pytest.approx((near[2] - 2 * near[1] + near[0]) / d**2, rel=1e-3)
    parts = [abs(rows[:, 1:]) @ table[:, 3] ** k for k in range(4)]
    parts[0] = parts[0] + abs(rows[:, 0])
    due = 2 * (parts[0] @ parts[3] + 3 * parts[1] @ parts[2])
    assert third_derivative_bound(rows, table) == pytest.approx(due)


def equations(**changes: Any) -> Equations:
    """Three unknowns on three contacts, two of them with shear springs, and a bond."""
    random = np.random.default_rng(7)
    given: dict[str, Any] = {
        "mass": np.array([1.0, 2.5, 0.6]), "load": np.zeros(3),
        "normal": random.normal(size=(3, 3)), "tangent": random.normal(size=(2, 3)),
        "tied": random.normal(size=(1, 3)), "spring": np.array([0, -1, 1]), "depth": np.ones(3),
        "length": np.ones(1), "stiffness": np.array([11.0]), "kn": 30.0, "ks": 17.0, "mu": 0.4,
        "ratio": 0.4 * 30.0 / 17.0, "eta": 0.3, "eta_n": 0.8, **changes,
    }  # fmt: skip
    return Equations(**given)


def matrices(made: Equations, states: Any) -> tuple[Vector, Vector]:
    """Stiffness and drag of the contacts in their states, and of the bond."""
    stiff = made.stiffness[0] * np.outer(made.tied[0], made.tied[0])
    drag = made.eta * np.eye(3)
    for n, s, state in zip(made.normal, made.spring, states, strict=True):
        if state > PARTED:
            stiff = stiff + made.kn * np.outer(n, n)
            drag = drag + made.eta_n * np.outer(n, n)
            sign = {FORWARD: 1.0, BACKWARD: -1.0}.get(state, 0.0)
            if s >= 0 and state == STUCK:
                stiff = stiff + made.ks * np.outer(made.tangent[s], made.tangent[s])
            elif s >= 0:
                stiff = stiff - sign * made.mu * made.kn * np.outer(made.tangent[s], n)
    return stiff, drag


STATES = [(STUCK, OPEN, PARTED), (FORWARD, STUCK, BACKWARD), (OPEN, STUCK, STUCK)]


@pytest.mark.parametrize("states", STATES)
def test_a_step_is_as_long_as_stiffness_and_drag_allow(states: Any) -> None:
    made = equations()
    stiff, drag = matrices(made, states)
    found, lost = np.full((3, 3), 9.0), np.full((3, 3), 9.0)
    h = step(made, np.array(states), found, lost)
    assert found == pytest.approx(stiff)
    assert lost == pytest.approx(drag)
    largest = [(abs(m).sum(1) / made.mass).max() for m in (stiff, drag)]
    assert largest[0] * h**2 / 4 + largest[1] * h == pytest.approx(1.0)
    free = equations(eta=0.0, tied=np.zeros((1, 3)))
    assert step(free, np.array([OPEN] * 3), found, lost) == math.inf


@pytest.mark.parametrize("states", STATES)
def test_a_motion_is_its_series_within_a_step(states: Any) -> None:
    """Of m x'' + D x' + K x = f, by the exponential of its matrix."""
    made, random = equations(), np.random.default_rng(8)
    stiff, drag = matrices(made, states)
    v, a = random.normal(size=(2, 3))
    h, inverse = 0.05, np.diag(1.0 / made.mass)
    y = np.zeros((ORDER + 1, 3))
    y[1], y[2] = h * v, 0.5 * h**2 * a
    lengths = np.zeros((3 + 2 + 1, ORDER + 1))
    given: Any = (made, np.array(states), h, y, lengths, np.zeros(6), np.zeros(3), np.zeros(3))
    _expand(*given)
    whole = np.zeros((7, 7))
    whole[:3, 3:6], whole[3:6, :3], whole[3:6, 3:6] = np.eye(3), -inverse @ stiff, -inverse @ drag
    whole[3:6, 6] = a + inverse @ drag @ v
    start = np.array([0.0, 0.0, 0.0, *v, 1.0])
    for x in (0.3, 1.0):
        due = (expm(whole * x * h) @ start)[:3]
        assert x ** np.arange(ORDER + 1) @ y == pytest.approx(due, rel=1e-12)
        rows = np.vstack([made.normal, made.tangent, made.tied])
        assert lengths @ x ** np.arange(ORDER + 1) == pytest.approx(rows @ due, rel=1e-12)


def swung(k: float, n: float, a: float, start: Any, t: float) -> Vector:
    """Displacement and velocity of x'' + 2n x' + k^2 x = a."""
    whole = np.array([[0.0, 1.0, 0.0], [-(k**2), -2.0 * n, a], [0.0, 0.0, 0.0]])
    return np.asarray((expm(whole * t) @ [*start, 1.0])[:2])


def test_a_piece_on_a_line_is_its_series_whether_it_swings_or_slips() -> None:
    line = Line(True, 0.0, 0.0, N, K, 2.0, 1.0)
    swings, h = np.array([1.0, 0.0]), np.array([0.2, 0.3])
    x, v, a = np.array([0.4, -0.3]), np.array([-1.1, 0.7]), np.array([2.0, -5.0])
    found = _series(line, swings, x, v, a - swings * K**2 * x - 2 * N * v, h)
    for k in range(2):
        for part in (0.3, 1.0):
            due = swung(K * swings[k], N, a[k], (x[k], v[k]), part * h[k])
            assert found[k] @ part ** np.arange(found.shape[1]) == pytest.approx(due[0], rel=1e-12)


def test_a_piece_on_a_line_is_cut_into_as_few_parts_as_converge() -> None:
    line = Line(True, 0.0, 0.0, N, K, 2.0, 1.0)
    pieces = np.array([[0.0, STUCK], [2.3, FORWARD], [9.9, STUCK]])
    for k, (parts, span) in enumerate(zip(parts_of(line, pieces, 9.95), (2.3, 7.6, 0.05),
                                          strict=True)):  # fmt: skip
        stiff = K**2 if k != 1 else 0.0

        def used(parts: int, span: float = span, stiff: float = stiff) -> float:
            return stiff * (span / parts) ** 2 / 4 + 2 * N * span / parts

        assert used(parts) <= 1.0
        assert parts == 1 or used(parts - 1) > 1.0


def test_closed_forms_are_those_of_a_matrix_for_one_time_and_for_many() -> None:
    """On both sides of the time up to which forced motions are a series."""
    line, times = Line(True, 0.0, 0.0, N, K, 2.0, 1.0), np.array([0.01, 0.3, 0.4, 2.0])
    assert (2 * N * times < SHORT).sum() == 2
    y, v, a = np.array([0.4, -0.3, 0.1, 2.0]), np.array([-1.1, 0.7, 0.0, 3.0]), np.full(4, -5.0)
    moved, speed = oscillations(y, v, line, times)
    ways, rates = forced_motions(v, a, N, times)
    for k, t in enumerate(times):
        assert (moved[k], speed[k]) == pytest.approx(swung(K, N, 0.0, (y[k], v[k]), t), rel=1e-11)
        due = swung(0.0, N, a[k], (0.0, v[k]), t)
        assert (ways[k], rates[k]) == pytest.approx(due, rel=1e-11)
        assert forced_motion(v[k], a[k], N, t) == pytest.approx(due, rel=1e-11)
    ways, rates = forced_motions(v, a, 0.0, times)
    assert ways == pytest.approx(v * times + 0.5 * a * times**2)
    assert rates == pytest.approx(v + a * times)
    assert forced_motion(v[1], a[1], 0.0, 0.3) == pytest.approx((ways[1], rates[1]))
