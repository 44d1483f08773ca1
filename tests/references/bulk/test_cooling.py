"""Claims about a gas of spheres: the theory agrees with event-driven hard spheres."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference_solutions.bulk import cooling
from reference_solutions.checks.bulk import cooling as hard
from reference_solutions.contact.dashpot import restitution

COUNT, SIDE, PLACES, SEEDS = 100, 8.8, 7, 6
HARD = {"side": SIDE, "d": 1.0, "m": 1.0, "kn": 1e12, "temperature": 1.0}


def start(seed: int) -> tuple[hard.Array, hard.Array]:
    random = np.random.default_rng(seed)
    grid = np.stack(np.meshgrid(*[np.arange(PLACES)] * 3, indexing="ij"), 3).reshape(-1, 3)
    place = grid[random.choice(len(grid), COUNT, replace=False)]
    v = random.normal(size=(COUNT, 3))
    v *= math.sqrt(3 * COUNT / (v**2).sum())
    return (place + 0.5) * SIDE / PLACES, v


def test_spheres_meet_each_other_and_walls_as_often_as_theory_says() -> None:
    flights = [hard.flight(*start(seed), SIDE, (1.0, 1.0), 2000) for seed in range(SEEDS)]
    found, spent = cooling.gas(COUNT, **HARD), sum(one.times[-1] for one in flights)
    pairs, walls = sum(one.pairs for one in flights), sum(one.walls for one in flights)
    assert pairs / spent == pytest.approx(found.pairs, rel=0.03)  # 1.1 % of 7600 contacts
    assert walls / spent == pytest.approx(found.walls, rel=0.03)
    assert flights[0].energy[-1] == pytest.approx(1.5 * COUNT)


def test_it_cools_as_theory_says_with_walls_that_take_a_third() -> None:
    z, last = 0.035, 900
    e, found = (restitution(z), restitution(z / math.sqrt(2))), cooling.gas(COUNT, **HARD)
    grown, spent = 0.0, 0.0
    for seed in range(SEEDS):
        one = hard.flight(*start(seed), SIDE, e, last)
        grown += math.sqrt(one.energy[0] / one.energy[-1]) - 1.0
        spent += one.times[-1] - one.times[0]
    assert found.walls * (1 - e[1] ** 2) > 0.25 * 3 * COUNT * cooling.cooling(COUNT, found, z)
    assert grown / spent == pytest.approx(cooling.cooling(COUNT, found, z), rel=0.05)


def test_dilute_spheres_meet_as_if_there_were_no_others() -> None:
    """Boltzmann's rates: 2 n^2 d^2 sqrt(pi T/m) per volume, n sqrt(T/2 pi m) per area of wall."""
    few = cooling.gas(1000, side=1001.0, d=1.0, m=2.0, kn=1e12, temperature=3.0)
    n = 1000 / 1000.0**3
    assert few.pairs == pytest.approx(2 * n**2 * 1e9 * math.sqrt(math.pi * 1.5), rel=5e-3)
    assert few.walls == pytest.approx(6e6 * n * math.sqrt(3 / (4 * math.pi)), rel=1e-4)


def test_a_wide_box_has_enskogs_rate_with_carnahan_and_starlings_correlation() -> None:
    wide = cooling.gas(10**12, side=2e4, d=1.0, m=1.0, kn=1e12, temperature=1.0)
    f, n = wide.filled, 6 * wide.filled / math.pi
    correlation = (1 - f / 2) / (1 - f) ** 3
    enskog = 2 * n**2 * correlation * math.sqrt(math.pi) * (2e4 - 1) ** 3
    assert wide.pairs == pytest.approx(enskog, rel=1e-3)


def test_softer_spheres_count_as_smaller_ones() -> None:
    soft = cooling.gas(COUNT, **{**HARD, "kn": 1e4})
    gap = math.sqrt(math.pi / 2e4)
    smaller = cooling.gas(
        COUNT, side=SIDE - 1 + 2 * gap + (1 - gap), d=1 - gap, m=1.0, kn=1e14, temperature=1.0
    )
    assert soft.pairs == pytest.approx(smaller.pairs, rel=1e-5)


def test_contacts_at_a_time_are_those_of_a_gibbs_ensemble() -> None:
    """For a dilute gas: n^2 V/2 4 pi d^2 g times the integral of exp(-kn u^2/2 T) over overlaps."""
    few = cooling.gas(1000, side=1001.0, d=1.0, m=2.0, kn=1e8, temperature=3.0)
    n, width = 1000 / 1000.0**3, math.sqrt(math.pi * 3.0 / 2e8)
    pairs, walls = 2 * math.pi * n**2 * 1e9 * width, 6e6 * n * width
    told = cooling.touching(few, m=2.0, kn=1e8)
    assert told == pytest.approx(pairs + walls, rel=5e-3)


@pytest.mark.parametrize("count", [2, 500])
def test_the_flatness_is_that_of_random_points_on_a_sphere(count: int) -> None:
    random = np.random.default_rng(1)
    v = random.normal(size=(200_000 // count, count, 3))
    squares = (v**2).sum(axis=2) / (v**2).sum(axis=(1, 2))[:, None]
    flat = (squares**2).mean() / squares.mean() ** 2
    assert flat == pytest.approx(cooling.flatness(count), rel=0.01)
