"""Claims about the model with two unknowns, step by step: the leapfrog, its sums, and its end."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.dem.limits import BLOW_UP, GAIN
from vv.engines.dem.pressed.kernel import move_on_wall
from vv.engines.kernels.drive import drive
from vv.scene import Harmonic, Vector

DT, M, KN, STEPS = 0.01, 3.0, 700.0, 40  # s, kg, N/m
move = plain(move_on_wall)
SHAKEN = Harmonic(np.array([3.0, -2.0, 0.0]), np.array([2.0, 3.0, 1.0]), np.array([0.4, 1.0, 0.0]))
BASE = Harmonic(np.array([0.01, 0.02, 0.0]), np.array([4.0, 3.0, 1.0]), np.array([0.7, 0.2, 0.0]))


class Two(NamedTuple):
    """A sphere on a wall, with the arguments of the kernel; a term that is None is missing."""

    v: tuple[float, float]
    force: tuple[float, float]
    gap: float
    friction: tuple[float, float, float] | None = None
    eta: float | None = None
    shaking: Harmonic | None = None
    base: Harmonic | None = None

    def moved(self, scheme: tuple[float, float], rows: int, stride: int = 1) -> tuple[int, Vector]:
        """How many rows the kernel fills, and the path beside the energies."""
        path, energy = np.zeros((rows, 4)), np.zeros((rows, 8))
        drives = (None if one is None else drive(one) for one in (self.shaking, self.base))
        given = np.array(self.v), M, self.force, KN, self.gap, self.friction, self.eta, *drives
        filled = move(path, energy, stride, DT, *given, *scheme)
        return filled, np.hstack([path, energy])


def sines(motion: Harmonic | None, t: float) -> Vector:
    """The first two components of a motion."""
    if motion is None:
        return np.zeros(2)
    angle = 2.0 * np.pi * motion.frequency * t + motion.phase
    return np.asarray((motion.amplitude * np.sin(angle))[:2])


def by_hand(two: Two, scheme: tuple[float, float]) -> Vector:
    """The same from sums over steps of force times way; the wall's force acts on it reversed."""
    (lag, back), eta = scheme, two.eta or 0.0
    ks, mu, charge = two.friction or (1.0, 0.0, 0.0)
    u, wall, drag = np.zeros(2), np.zeros(2), np.zeros(2)
    held, sums, rows = -two.gap, np.zeros(5), []
    contact = np.array([KN * max(held, 0.0), 0.0])
    contact[1] = np.clip(charge, -mu * contact[0], mu * contact[0])
    shaking = sines(two.shaking, 0.0)
    start = np.array(two.force) + contact + M * shaking - eta * np.array(two.v)
    old = np.array(two.v) - back * DT / M * start
    for n in range(STEPS + 1):
        rubbed = work = moved = shook = changed = 0.0
        before = contact, held, shaking
        if n:
            u = u + DT * old
            went = sines(two.base, n * DT) - sines(two.base, 0.0) - wall
            wall = wall + went
            held = wall[0] - two.gap - u[0]
            contact = np.array([KN * max(held, 0.0), 0.0])
            if held > 0.0:
                closed = min(held / (held - before[1]), 1.0) if before[1] <= 0.0 else 1.0
                slid = (DT * old - went)[1]
                trial = before[0][1] - ks * closed * slid
                contact[1] = np.clip(trial, -mu * contact[0], mu * contact[0])
                slip = closed * slid + (contact[1] - before[0][1]) / ks
                rubbed = -0.5 * (contact[1] + before[0][1]) * slip
            shaking = sines(two.shaking, n * DT)
            shook = 0.5 * M * (before[2] + shaking) @ (DT * old)
            moved = 0.5 * (before[0] + contact) @ went
            changed = float((held > 0.0) != (before[1] > 0.0))
        acting = np.array(two.force) + contact + M * shaking
        share = 1.0 + (1.0 - lag) * eta * DT / M
        new = (old * (1.0 - lag * eta * DT / M) + DT / M * acting) / share
        slowed = eta * (lag * old + (1.0 - lag) * new)
        work = 0.5 * (drag + slowed) @ (DT * old) if n else 0.0
        drag = slowed
        sums = sums + np.array([rubbed, work, shook, moved, changed])
        springs = 0.5 * KN * max(held, 0.0) ** 2, 0.5 * contact[1] ** 2 / ks
        rows.append([*u, *(0.5 * (old + new)), 0.5 * M * old @ new, *springs, *sums])
        old = new
    return np.array(rows)


RUB = (900.0, 0.4, 0.0)
SCHEMES = [(0.5, 0.5), (1.0, 0.0), (0.25, 0.75)]
SCENES = {
    "smooth": Two((-2.0, 0.3), (-1.5, 4.0), 0.05),
    "smooth, with drag": Two((-2.0, 0.3), (-1.5, 4.0), -0.05, eta=8.0),
    "slides and leaves": Two((-1.0, 1.3), (-1.5, 4.0), -0.01, RUB),
    "slides the other way": Two((-1.0, -1.3), (-1.5, 4.0), 0.01, RUB, 3.0),
    "charged at the start": Two((0.0, 0.0), (-60.0, 9.0), -0.08, (900.0, 0.4, -9.0)),
    "charged beyond its limit": Two((0.0, 0.1), (-60.0, 9.0), -0.08, (900.0, 0.4, 90.0)),
    "shaken": Two((-1.0, 1.3), (-40.0, 4.0), -0.02, RUB, 3.0, SHAKEN),
    "dragged by its wall": Two((-1.0, 1.3), (-40.0, 4.0), -0.02, RUB, None, None, BASE),
    "both": Two((-1.0, 0.0), (-9.0, 4.0), 0.03, RUB, 3.0, SHAKEN, BASE),
}


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("name", SCENES)
def test_each_step_balances_forces_and_books_their_works(
    name: str, scheme: tuple[float, float]
) -> None:
    filled, found = SCENES[name].moved(scheme, STEPS + 1)
    assert filled == STEPS + 1
    assert found == pytest.approx(by_hand(SCENES[name], scheme), rel=1e-9, abs=1e-11)


def test_outputs_are_those_of_every_so_many_steps() -> None:
    each, some = (SCENES["both"].moved(SCHEMES[0], STEPS // n + 1, n)[1] for n in (1, 4))
    assert np.array_equal(each[::4], some)


CARRYING = Harmonic(np.array([0.05, 0.9, 0.0]), np.array([0.5, 0.5, 0.0]))
PUSHED = Harmonic(np.array([0.0, 0.5, 0.0]), np.array([0.0, 0.5, 0.0]))
MOVING = 0.5 * M * 0.25  # J
PRESSED = 0.5 * KN * 0.02**2
ENDING = {
    "free": (Two((0.0, 0.5), (0.0, 0.0), 0.1), MOVING),
    "along the normal": (Two((0.5, 0.0), (0.0, 0.0), 0.1), MOVING),
    "both ways": (Two((0.4, -0.3), (0.0, 0.0), 0.1), MOVING),
    "pressed": (Two((0.4, 0.3), (0.0, 0.0), -0.02), MOVING + PRESSED),
    "charged": (
        Two((0.4, 0.3), (0.0, 0.0), -0.02, (50.0, 0.4, 4.0)),
        MOVING + PRESSED + 0.5 * 4.0**2 / 50.0,
    ),
    "on soft springs": (
        Two((0.0, 0.5), (-KN * 0.02, 0.0), -0.02, (50.0, 100.0, 0.0)),
        MOVING + PRESSED,
    ),
    "loaded": (Two((0.4, 0.3), (0.5, 0.7), 0.1), MOVING),
    "loaded backwards": (Two((0.4, 0.3), (-0.1, -0.2), 0.5), MOVING),
    "shaken": (Two((0.0, 0.5), (0.0, 0.0), 0.1, shaking=PUSHED), MOVING),
    "dragged": (Two((0.3, 0.4), (0.0, 0.0), -0.02, RUB, base=CARRYING), MOVING + PRESSED),
}


@pytest.mark.parametrize("name", ENDING)
def test_a_run_ends_where_it_holds_four_times_what_was_put_in(name: str) -> None:
    """Put in are motion and springs at the start, and the most work that was done since."""
    two, start = ENDING[name]
    row, found = two._replace(eta=-0.002 * M / DT).moved((1.0, 0.0), 3000)
    path, energy = found[: row + 1, :4], found[: row + 1, 4:]
    work = energy[:, 5] + energy[:, 6] + path[:, :2] @ np.array(two.force)
    limit = GAIN * (start + np.maximum(np.maximum.accumulate(work), 0.0))
    held = energy[:, :3].sum(axis=1)
    assert 100 < row < 2999
    assert (held[:-1] <= limit[:-1]).all()
    assert held[-1] > limit[-1]


@pytest.mark.parametrize("way", [(0.0, 0.5), (0.5, 0.0), (0.3, 0.4)])
def test_a_run_ends_where_its_speed_alone_holds_a_million_times_that(
    way: tuple[float, float],
) -> None:
    """The velocity turns about in each step and grows: m v- v+/2 is never positive.

    After row n it is (-1.01)^(n + 1) times that at first.
    """
    turns = Two(way, (0.0, 0.0), 1e9, eta=2.01 * M / DT)
    row, found = turns.moved((1.0, 0.0), 3000)
    assert (found[1:row, 4] < 0.0).all()
    assert 1.01 ** (2 * row) <= BLOW_UP < 1.01 ** (2 * (row + 1))
