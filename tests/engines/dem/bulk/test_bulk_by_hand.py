"""Claims about steps of the bulk model without friction, and about its parts: truths by hand."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.dem.bulk import advance, output, skin
from vv.engines.dem.bulk.grains import BEFORE, TURN, Given, Grains, V, W, initial_grains
from vv.engines.dem.bulk.kernel import move_in_bulk
from vv.engines.dem.bulk.skin import CHANGE, LEAST, MOST, SOUGHT
from vv.engines.dem.contact.linear import Linear
from vv.engines.dem.limits import BLOW_UP, GAIN
from vv.engines.dem.terms.drag import Drag
from vv.scene import Vector

DT, KN, STEPS = 1e-3, 2e3, 60  # s, N/m
move = plain(move_in_bulk)
PLACE = np.array([[0.0, 0.0, 1.0], [1.1, 0.1, 1.2], [0.3, 1.4, 0.9], [1.9, 1.2, 1.1]])  # m
CLOSE = PLACE + np.array([[0.35, 0.1, -0.1], [0, 0, 0], [0, 0, 0], [-0.75, 0, 0]])
SPEED = np.array([[5.0, 1.0, -4.0], [-3.0, 2.0, -9.0], [0.0, 0.0, 0.0], [-9.0, -8.0, 2.0]])
RADIUS, MASS = np.array([0.5, 0.35, 0.45, 0.4]), np.array([1.0, 3.0, np.inf, 0.6])
WALLS = np.array([[0.0, 0.6, 0.8, 0.4], [-1.0, 0.0, 0.0, -2.5]])
DOWN = (0.5, 0.0, -9.0)


class Few(NamedTuple):
    """A few spheres, the third of which is fixed, and what else acts on them."""

    place: Vector = PLACE
    speed: Vector = SPEED
    mass: Vector = MASS
    gravity: tuple[float, float, float] = DOWN
    eta: float = 0.0
    eta_n: float | None = None

    def moved(self, scheme: tuple[float, float], rows: int, stride: int = 1) -> Any:
        """How many rows the kernel fills, the paths (rows, n, 6) and the energies (rows, 7)."""
        n = len(self.mass)
        path, energy = np.zeros((rows, n, 6)), np.zeros((rows, 7))
        given = Given(self.place, self.speed, None, RADIUS[:n], self.mass, 0.4 * self.mass)
        dashpot = None if self.eta_n is None else (KN, self.eta_n)
        with np.errstate(all="ignore"):  # unused columns of scratch may be anything
            filled = move(
            path, energy, np.arange(n), stride, DT, given, WALLS, Linear(KN, None, self.eta_n),
            None, dashpot, self.gravity, Drag(self.eta, None), None, *scheme,
        )  # fmt: skip
        return filled, path, energy


Contact = tuple[int | None, int, Vector, float]


def contacts(x: Vector) -> dict[tuple[str, int, int], Contact]:
    """The closed contacts: first body (None for a wall), second one, normal, overlap."""
    found: dict[tuple[str, int, int], Contact] = {}
    for i in range(len(x)):
        for j in range(i + 1, len(x)):
            d = x[j] - x[i]
            found["pair", i, j] = (
                i,
                j,
                d / np.linalg.norm(d),
                float(RADIUS[i] + RADIUS[j] - np.linalg.norm(d)),
            )
        for k, (*n, away) in enumerate(WALLS):
            found["wall", k, i] = None, i, np.array(n), float(RADIUS[i] + away - x[i] @ n)
    return {key: one for key, one in found.items() if one[3] > 0.0}


def by_hand(few: Few, scheme: tuple[float, float]) -> tuple[Vector, Vector]:
    """The same with new velocities from rounds over all contacts until nothing changes."""
    (lag, back), eta, rate = scheme, few.eta, few.eta_n or 0.0
    free = np.isfinite(few.mass)[:, None]
    mass = np.where(np.isfinite(few.mass), few.mass, 1.0)[:, None]
    u, old, lost = np.zeros_like(few.place), few.speed.copy(), 0.0
    paths, energies, power = [], [], 0.0
    before: dict[tuple[str, int, int], Contact] = {}
    for n in range(STEPS + 1):
        u = u + DT * old if n else u
        closed = contacts(few.place + u)
        loads = mass * np.array(few.gravity) * free
        share = dict.fromkeys(closed, 1.0)
        for key, (i, j, normal, overlap) in closed.items():
            loads[j] += KN * overlap * normal
            if i is not None:
                loads[i] -= KN * overlap * normal
            if n and key not in before:
                was = gap_of(few.place + u - DT * old, key)
                share[key] = 0.5 + overlap / (overlap + was)
        before = closed

        def drags(low: Vector, high: Vector, weight: float) -> Vector:
            mean = weight * low + (1.0 - weight) * high
            force = -eta * mean
            for key, (i, j, normal, overlap) in closed.items():  # noqa: B023 - called at once
                apart = (mean[j] - (0.0 if i is None else mean[i])) @ normal
                pull = -min(share[key] * rate * apart, KN * overlap)  # noqa: B023
                force[j] += pull * normal
                if i is not None:
                    force[i] -= pull * normal
            return np.asarray(force * free)

        if not n:
            old = old - back * DT * (loads + drags(old, old, 1.0)) / mass * free
        new, slowed = old, np.zeros_like(old)
        for _ in range(200):
            slowed = drags(old, new, lag)
            new = old + DT * (loads + slowed) / mass * free
        lost -= 0.5 * DT * (power + float((slowed * old).sum())) if n else 0.0
        power = float((slowed * new).sum())
        paths.append(np.hstack([u, 0.5 * (old + new)]))
        springs = 0.5 * KN * sum(one[3] ** 2 for one in closed.values())
        moving = 0.5 * float((mass * free * old * new).sum())
        fallen = float((mass * free * u) @ np.array(few.gravity) @ np.ones(len(mass)))
        energies.append([moving, springs, 0.0, 0.0, lost, fallen, 0.0])
        old = new
    return np.array(paths), np.array(energies)


def gap_of(x: Vector, key: tuple[str, int, int]) -> float:
    """The gap of a contact that is open."""
    kind, i, j = key
    if kind == "wall":
        return float(x[j] @ WALLS[i, :3] - WALLS[i, 3] - RADIUS[j])
    return float(np.linalg.norm(x[j] - x[i]) - RADIUS[i] - RADIUS[j])


FEW = {
    "springs": Few(),
    "drag": Few(eta=3.0),
    "dashpots": Few(eta_n=6.0),
    "dashpots and drag, from where they overlap": Few(place=CLOSE, eta=3.0, eta_n=6.0),
}


@pytest.mark.parametrize("scheme", [(0.5, 0.5), (1.0, 0.0)])
@pytest.mark.parametrize("name", FEW)
def test_each_step_balances_forces_and_books_their_works(
    name: str, scheme: tuple[float, float]
) -> None:
    filled, path, energy = FEW[name].moved(scheme, STEPS + 1)
    paths, energies = by_hand(FEW[name], scheme)
    assert filled == STEPS + 1
    assert (energies[:, 1] > 0.0).any()
    assert path == pytest.approx(paths, rel=1e-9, abs=1e-11)
    assert energy == pytest.approx(energies, rel=1e-8, abs=1e-9)


def test_outputs_are_those_of_every_so_many_steps() -> None:
    """The sums of floats are taken in another order."""
    few = FEW["dashpots and drag, from where they overlap"]
    each, some = (few.moved((0.5, 0.5), STEPS // n + 1, n) for n in (1, 6))
    assert some[1] == pytest.approx(each[1][::6], rel=1e-10, abs=1e-13)
    assert some[2] == pytest.approx(each[2][::6], rel=1e-10, abs=1e-13)


FLYING = Few(np.array([[0.0, 9.0, 9.0]]), np.array([[0.3, 0.0, 0.4]]), np.array([2.0]))
START = 0.5 * 2.0 * 0.25


@pytest.mark.parametrize("gravity", [(0.0, 0.0, 0.0), (0.02, 0.0, 0.03), (-0.02, 0.0, -0.02)])
def test_a_run_ends_where_it_holds_four_times_what_was_put_in(gravity: Any) -> None:
    """Put in are the motion at the start, and the most that gravity has done since."""
    few = FLYING._replace(gravity=gravity, eta=-0.004 * 2.0 / DT)
    row, path, energy = few.moved((1.0, 0.0), 1500)
    work = 2.0 * path[: row + 1, 0, :3] @ np.array(gravity)
    limit = GAIN * (START + np.maximum(np.maximum.accumulate(work), 0.0))
    held = energy[: row + 1, :3].sum(axis=1)
    assert 100 < row < 1499
    assert (held[:-1] <= limit[:-1]).all()
    assert held[-1] > limit[-1]


def test_a_run_ends_where_its_speed_alone_holds_a_million_times_that() -> None:
    few = FLYING._replace(gravity=(0.0, 0.0, 0.0), eta=2.02 * 2.0 / DT)
    row, _, energy = few.moved((1.0, 0.0), 1500)
    assert (energy[1:row, 0] < 0.0).all()
    assert 1.02 ** (2 * row) <= BLOW_UP < 1.02 ** (2 * (row + 1))


def grains(place: Vector = PLACE, speed: Vector = SPEED) -> Grains:
    """Four spheres, the third fixed, with velocities and spins of this step and the last."""
    made: Grains = plain(initial_grains)(Given(place, speed, speed, RADIUS, MASS, 0.4 * MASS))
    random = np.random.default_rng(4)
    made.row[:4, V : V + 3] = speed
    made.row[:4, W:BEFORE] = random.normal(size=(4, 3))
    made.row[:4, BEFORE:] = random.normal(size=(4, 6))
    return made


def test_spheres_drift_and_tell_how_far_the_farthest_is_from_where_it_was() -> None:
    some = grains()
    some.since[:] = PLACE - [0.1, 0.0, 0.2]
    far = plain(advance.drift)(some, 0.01)
    went = 0.01 * SPEED + [0.1, 0.0, 0.2]
    assert some.row[:4, :3] == pytest.approx(PLACE + 0.01 * SPEED)
    assert far == pytest.approx(np.linalg.norm(went, axis=1).max())


def test_motions_start_half_a_step_before_under_forces_torques_and_drag() -> None:
    """Fixed spheres have neither weight nor energy."""
    some, random = grains(), np.random.default_rng(9)
    plain(advance.set_weights)(some, DOWN)
    weights = np.where(np.isfinite(MASS), MASS, 0.0)[:, None] * DOWN
    assert some.acting[:4, :3] == pytest.approx(weights)
    assert not some.acting[:, 3:].any()
    some.acting[:4, :6] = random.normal(size=(4, 6))
    kinetic = plain(advance.place)(some, SPEED, 0.02, Drag(0.7, None))
    due = SPEED - 0.02 * (some.acting[:4, :3] - 0.7 * SPEED) / MASS[:, None]
    assert some.row[:4, V:W] == pytest.approx(due)
    moving = np.isfinite(MASS)
    square = (SPEED**2).sum(axis=1)[moving]
    assert kinetic == pytest.approx(0.5 * MASS[moving] @ square)
    turning = plain(advance.place_spins)(some, SPEED, 0.02)
    spins = SPEED - 0.02 * some.acting[:4, TURN : TURN + 3] / (0.4 * MASS[:, None])
    assert some.row[:4, W:BEFORE] == pytest.approx(spins)
    assert turning == pytest.approx(0.2 * MASS[moving] @ square)
    assert plain(advance.place_spins)(some, None, 0.02) == 0.0
    after = plain(advance.kinetic_energy_after)
    fast = 0.5 * MASS[moving] @ (some.row[:4, V:W][moving] ** 2).sum(axis=1)
    round_ = 0.2 * MASS[moving] @ (some.row[:4, W:BEFORE][moving] ** 2).sum(axis=1)
    assert after(some, None) == pytest.approx(fast)
    assert after(some, SPEED) == pytest.approx(fast + round_)


def test_a_skin_is_made_such_that_what_it_lists_costs_as_much_as_its_search() -> None:
    """s per step for pairs in vain, SOUGHT/k for the search; k grows as s does."""
    adapted = plain(skin.adapted)
    for s, k in ((0.2, 100), (0.2, 150), (0.3, 90)):
        due = s * np.sqrt(SOUGHT / (k * s))
        assert 1 / CHANGE < due / s < CHANGE
        assert adapted(s * 0.01, 0.01, k) == pytest.approx(0.01 * due)
    assert adapted(0.2, 1.0, 10) == pytest.approx(CHANGE * 0.2)
    assert adapted(0.2, 1.0, 10**6) == pytest.approx(0.2 / CHANGE)
    assert adapted(0.5, 1.0, 0) == adapted(0.5, 1.0, 1) == MOST
    assert adapted(0.021, 1.0, 10**6) == LEAST
    assert (LEAST, MOST) == (0.02, 0.6)


def test_sizes_of_the_largest_and_the_smallest_sphere_are_found() -> None:
    assert plain(skin.widest)(grains()) == 0.5
    assert plain(skin.narrowest)(grains()) == 0.35
    turned = grains()
    turned.row[:4, 3] = RADIUS[::-1]
    assert (plain(skin.widest)(turned), plain(skin.narrowest)(turned)) == (0.5, 0.35)


def test_what_is_seen_is_the_way_and_the_means_of_velocities_and_spins() -> None:
    some, random = grains(), np.random.default_rng(2)
    some.original[:] = [2, 0, 3, 1]
    some.row[:4, :3] = random.normal(size=(4, 3))
    given = Given(PLACE, SPEED, SPEED, RADIUS, MASS, MASS)
    path = np.zeros((2, 2, 9))
    plain(output.observe)(path, 1, np.array([1, 2]), given, some)
    for k, (what, row) in enumerate(((1, some.row[3]), (2, some.row[0]))):
        means = 0.5 * (row[V : V + 6] + row[BEFORE : BEFORE + 6])
        assert path[1, k] == pytest.approx([*(row[:3] - PLACE[what]), *means])
