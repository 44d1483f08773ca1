"""Claims about the model with one unknown, step by step: the leapfrog, its sums, and its end."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.support.plain import plain
from vv.engines.dem.limits import BLOW_UP, GAIN
from vv.engines.dem.line.kernel import move_on_line
from vv.scene import Vector

DT, M, STEPS = 0.01, 3.0, 40  # s, kg
move = plain(move_on_line)


class One(NamedTuple):
    """A sphere on a line, with the arguments of the kernel; a term that is None is missing."""

    v: float
    force: float | None = None
    normal: tuple[float, float] | None = None
    friction: tuple[float, float] | None = None
    eta: float | None = None
    eta_n: float | None = None

    def moved(self, scheme: tuple[float, float], stride: int = 1) -> tuple[Vector, Vector]:
        """The path and the energies of the kernel."""
        rows = STEPS // stride + 1
        path, energy = np.full((2, rows, 2), np.nan)[0], np.full((rows, 6), np.nan)
        given = np.array([self.v]), M, *self[1:]
        assert move(path, energy, stride, DT, *given, *scheme) == rows
        return path, energy

    def pushed(self, overlap: float) -> float:
        return 0.0 if self.normal is None else self.normal[0] * max(overlap, 0.0)


def by_hand(one: One, scheme: tuple[float, float]) -> tuple[Vector, Vector]:
    """The same with each velocity found as a root of its balance of forces."""
    (lag, back), (kn, gap) = scheme, one.normal or (0.0, 1e9)
    (ks, cap), eta, force = one.friction or (1.0, 0.0), one.eta or 0.0, one.force or 0.0
    q = shear = rubbed = lost = kinks = 0.0
    start = force + one.pushed(-gap) - eta * one.v
    if gap < 0.0:
        start -= min((one.eta_n or 0.0) * one.v, one.pushed(-gap))
    old, held, drag = one.v - back * DT * start / M, -gap, 0.0
    path, energy = [], []

    def drags(new: float, old: float, pushed: float, viscous: float) -> float:
        mean = lag * old + (1.0 - lag) * new
        return eta * mean + min(viscous * mean, pushed)

    def balance(new: float, known: tuple[float, float, float], acting: float) -> float:
        return M * (new - known[0]) / DT - acting + drags(new, *known)

    for n in range(STEPS + 1):
        before, share, rubs = held, 1.0, shear
        if n:
            q += DT * old
            held = -(gap + q)
            if (held > 0.0) != (before > 0.0):
                kinks += old * old
                share = 0.5 + held / (held - before)
            shear = float(np.clip(rubs - ks * DT * old, -cap, cap))
            rubbed -= 0.5 * (rubs + shear) * (DT * old + (shear - rubs) / ks)
        pushed, viscous = one.pushed(held), share * (one.eta_n or 0.0) * (held > 0.0)

        known = old, pushed, viscous
        new = float(brentq(balance, -1e3, 1e3, (known, force + pushed + shear), xtol=1e-14))
        earlier, drag = drag, drags(new, *known)
        lost += 0.5 * (earlier + drag) * DT * old if n else 0.0
        path.append([q, 0.5 * (old + new)])
        spring = 0.5 * kn * max(held, 0.0) ** 2
        energy.append([0.5 * M * old * new, spring, 0.5 * shear**2 / ks, rubbed, lost,
                       kn * DT**2 * kinks / 8.0])  # fmt: skip
        old = new
    return np.array(path), np.array(energy)


SCHEMES = [(0.5, 0.5), (1.0, 0.0), (0.25, 0.75)]
SCENES = {
    "free, with drag": One(-2.0, force=4.0, eta=6.0),
    "nothing at all": One(-2.0),
    "meets a spring": One(-2.0, force=-1.5, normal=(700.0, 0.05)),
    "leaves a spring with drag": One(0.5, force=0.0, normal=(700.0, -0.1), eta=4.0),
    "meets a dashpot": One(-2.0, force=-1.5, normal=(700.0, 0.05), eta_n=40.0),
    "leaves a dashpot that would pull, with drag": One(
        0.7, force=2.0, normal=(700.0, -0.05), eta=9.0, eta_n=60.0
    ),
    "pressed on a dashpot, with drag": One(
        -0.7, force=-2.0, normal=(700.0, -0.01), eta=9.0, eta_n=60.0
    ),
    "rubs": One(1.5, force=-3.0, friction=(900.0, 20.0)),
    "rubs both ways, with drag": One(-1.5, force=30.0, friction=(900.0, 8.0), eta=3.0),
}


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("name", SCENES)
def test_each_step_balances_forces_and_books_their_works(
    name: str, scheme: tuple[float, float]
) -> None:
    path, energy = SCENES[name].moved(scheme)
    due, books = by_hand(SCENES[name], scheme)
    assert path == pytest.approx(due, rel=1e-9, abs=1e-12)
    assert energy == pytest.approx(books, rel=1e-9, abs=1e-11)


def test_outputs_are_those_of_every_so_many_steps() -> None:
    each, some = (SCENES["rubs"].moved(SCHEMES[0], stride) for stride in (1, 4))
    assert np.array_equal(each[0][::4], some[0])
    assert np.array_equal(each[1][::4], some[1])


GROWS = 1.002


def ended(one: One, rate: float) -> tuple[int, Vector, Vector]:
    """At which row a sphere stops that is driven: its velocity grows by a factor in each step."""
    path, energy = np.zeros((3000, 2)), np.zeros((3000, 6))
    driven = one._replace(eta=(1.0 - rate) * M / DT)
    given = np.array([driven.v]), M, *driven[1:]
    row = move(path, energy, 1, DT, *given, 1.0, 0.0)
    return row, path, energy


@pytest.mark.parametrize(
    ("one", "start"),
    [
        (One(0.5), 0.5 * M * 0.25),
        (One(0.5, normal=(80.0, -0.1), force=0.0), 0.5 * M * 0.25 + 0.5 * 80.0 * 0.01),
        (One(0.5, normal=(80.0, 0.1), force=0.0), 0.5 * M * 0.25),
        (One(0.5, force=0.8), 0.5 * M * 0.25),
        (One(-0.5, force=0.8), 0.5 * M * 0.25),
        (One(0.3, normal=(80.0, -0.1), force=-8.0), 0.5 * M * 0.09 + 0.5 * 80.0 * 0.01),
        (One(0.9, friction=(2e3, 0.4)), 0.5 * M * 0.81),
        (One(0.9, friction=(2.0, 0.4)), 0.5 * M * 0.81),
    ],
)
def test_a_run_ends_where_it_holds_four_times_what_was_put_in(one: One, start: float) -> None:
    """Put in are motion and springs at the start, and the most that the force has done since."""
    row, path, energy = ended(one, GROWS)
    work = np.maximum.accumulate((one.force or 0.0) * path[: row + 1, 0])
    limit = GAIN * (start + np.maximum(work, 0.0))
    held = energy[: row + 1, :3].sum(axis=1)
    assert 100 < row < 2999
    assert (held[:-1] <= limit[:-1]).all()
    assert held[-1] > limit[-1]


def test_a_run_ends_where_its_speed_alone_holds_a_million_times_that() -> None:
    """The velocity turns about in each step and grows: m v- v+/2 is never positive.

    After row n it is (-1.01)^(n + 1) times that at first.
    """
    row, _, energy = ended(One(0.5), -1.01)
    assert (energy[1:row, 0] < 0.0).all()
    assert 1.01 ** (2 * row) <= BLOW_UP < 1.01 ** (2 * (row + 1))
