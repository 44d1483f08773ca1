"""Claims about a gas of spheres: the theory agrees with event-driven hard spheres."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference_solutions.bulk import cooling
from reference_solutions.checks.bulk import cooling as hard
from reference_solutions.contact.dashpot import contact_time, restitution

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


def test_a_pair_in_a_box_is_kept_apart_by_its_share_of_faces_and_edges() -> None:
    """Pairs of places in a box of side L that overlap: (L - x)(L - y)(L - z), over a unit ball.

    The integral is 4 pi/3 L^3 - 3 pi/2 L^2 + 8/5 L, without what corners share. With z = n + 4 pi/3
    n^2 the number is z L^3 less z^2 times it, and its derivatives tell how often surfaces meet.
    """
    side = 8.0
    few = cooling.gas(1, **{**HARD, "kn": 1e16, "side": side + 1.0})
    n, near = 6.0 * few.filled / math.pi, (1 - few.filled / 2) / (1 - few.filled) ** 3
    held = n * side**3 + n**2 * (1.5 * math.pi * side**2 - 1.6 * side)
    touching = 2.0 * math.pi * side**3 - 3.0 * math.pi * side**2 + 4.0 * side
    pushed = 2.0 * math.pi * side**3 + 1.5 * math.pi * side**2 - 0.8 * side
    walls = math.sqrt(2.0 / math.pi) * (3.0 * n * side**2 + n**2 * near * pushed / side)
    assert held == pytest.approx(1.0, rel=1e-5)  # edges are 5e-5 of it, a third sphere 4e-6
    assert few.pairs == pytest.approx(n**2 * near * touching / math.sqrt(math.pi), rel=3e-3)
    assert few.walls == pytest.approx(walls, rel=2e-6)


def test_three_spheres_at_a_wall_give_the_next_term_of_its_tension() -> None:
    """Three spheres of which two or three pairs overlap count by the height that they take up.

    By clusters, the tension is -pi/8 n^2 + (S/12 - pi^2/3) n^3, S being the integral of the height,
    twice where all three overlap, three times where one overlaps the others.
    """
    random = np.random.default_rng(3)
    inside = random.uniform(-1.0, 1.0, (1_000_000, 3))
    inside = inside[(inside**2).sum(axis=1) < 1.0]
    one, other = inside[: len(inside) // 2], inside[-(len(inside) // 2) :]
    all_overlap = ((one - other) ** 2).sum(axis=1) < 1.0
    z = np.stack([0.0 * one[:, 2], one[:, 2], other[:, 2]])
    height = float((np.where(all_overlap, 2.0, 3.0) * np.ptp(z, axis=0)).mean())
    third = (4.0 * math.pi / 3.0) ** 2 * height / 12.0 - math.pi**2 / 3.0
    n = 1e-5
    found = cooling._tension(math.pi / 6.0 * n) / n**2
    assert found == pytest.approx(-math.pi / 8.0, rel=1e-4)
    assert (found + math.pi / 8.0) / n == pytest.approx(third, rel=0.02)


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


def test_rates_do_not_depend_on_units() -> None:
    length, mass, time = 2.0, 4.0, 0.5
    energy = mass * length**2 / time**2
    found = cooling.gas(50, side=9.0, d=1.0, m=1.0, kn=1e4, temperature=1.0)
    other = cooling.gas(
        50, side=9.0 * length, d=length, m=mass, kn=1e4 * mass / time**2, temperature=energy
    )
    assert other == pytest.approx((found.filled, found.pairs / time, found.walls / time))


def test_contacts_last_half_a_swing_and_lose_what_their_dashpot_takes() -> None:
    """A dashpot between two spheres acts on half their mass, so that it damps sqrt2 times more."""
    m, kn, z, e = 3.0, 1e4, 0.1, (restitution(0.1), restitution(0.1 / math.sqrt(2.0)))
    pairs, walls = cooling.Gas(0.1, 7.0, 0.0), cooling.Gas(0.1, 0.0, 5.0)
    lasting = (contact_time(m=m / 2.0, kn=kn, z=0.0), contact_time(m=m, kn=kn, z=0.0))
    assert cooling.touching(pairs, m=m, kn=kn) == pytest.approx(7.0 * lasting[0])
    assert cooling.touching(walls, m=m, kn=kn) == pytest.approx(5.0 * lasting[1])
    assert cooling.cooling(10, pairs, z) == pytest.approx(7.0 * (1.0 - e[0] ** 2) / 30.0)
    assert cooling.cooling(10, walls, z) == pytest.approx(5.0 * (1.0 - e[1] ** 2) / 30.0)


@pytest.mark.parametrize("filled", [0.1, 0.3, 0.5])
def test_the_stiffness_is_the_slope_of_the_pressure(filled: float) -> None:
    high, low = ((filled + d) * cooling._pressure(filled + d) for d in (1e-5, -1e-5))
    assert cooling._stiffness(filled) == pytest.approx((high - low) / 2e-5, rel=1e-7)


def test_the_tension_of_a_dense_gas_is_that_of_scaled_particles() -> None:
    """Theory of scaled particles: -9/2 pi f^2 (1 + f)/(1 - f)^3 (Reiss, Frisch, Helfand 1960)."""
    f = 0.4  # where the last term of the tension is a tenth of the first
    scaled = -4.5 / math.pi * f**2 * (1.0 + f) / (1.0 - f) ** 3
    assert cooling._tension(f) == pytest.approx(scaled, rel=0.03)
