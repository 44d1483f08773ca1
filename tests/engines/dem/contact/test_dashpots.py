"""Claims about viscous contacts of spheres in space: routes, order, energy balance, limits."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable
from math import sqrt
from pathlib import Path

import numpy as np
import pytest

from reference_solutions.contact import dashpot as closed
from tests.scenes.event_located import event_located
from vv.ask import Ask, Displacement, History, Knobs, Observable, Reaction, Run, Status, Velocity
from vv.engines import dem
from vv.plan.project import find
from vv.scene import Contact, Scene, Spheres, Vector, Wall

KN, Z, M = 1e4, 0.5, np.array([1.0, 3.0])
REDUCED = M.prod() / M.sum()
W = sqrt(KN / REDUCED)
LAW = Contact(KN, eta_n=2 * Z * sqrt(KN * REDUCED))
SPEED, N = 0.3, np.array([2.0, -1.0, 2.0]) / 3
UP, ALONG = np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])
HEAPED = range(2, 5)  # bodies
SCHEMES = [dem.solve_default, dem.solve_published]
Solve = Callable[[Ask], Run]


def ran(run: Run) -> Run:
    assert run.status is Status.RAN, run.reason
    return run


def asked(scene: Scene, dt: float, bodies: range, duration: float = 5 / W) -> Ask:
    seen: list[Observable] = [*map(Displacement, bodies), *map(Velocity, bodies)]
    return Ask(scene, History(duration, duration / 50), tuple(seen), Knobs(float(dt)))


def one(gap: float, eta: float) -> Scene:
    """The reduced mass on a line, against a wall: one unknown."""
    sphere = Spheres(
        (1 + gap) * N[None], -SPEED * N[None], np.ones(1), np.array([REDUCED]),
        np.array([[False, False, True]]),
    )  # fmt: skip
    axes = np.array([np.cross(UP, N), np.cross(N, np.cross(UP, N)), N])
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    return Scene((Wall(np.zeros(3), N), sphere), LAW, eta * REDUCED, axes=axes)


def two(gap: float, spinning: bool = False) -> Scene:
    """Both masses free in space, in a head-on collision in the frame of their centre of mass."""
    spheres = Spheres(
        np.array([0 * N, (2 + gap) * N]), SPEED * np.outer([0.75, -0.25], N), np.ones(2), M,
        np.ones((2, 3), bool), free_spin=np.full((2, 3), spinning),
    )  # fmt: skip
    return Scene((spheres,), LAW)


def moved(run: Run, bodies: tuple[int, ...]) -> Vector:
    """Displacement of the last body relative to the first, or to one at rest, along N."""
    u = [run.values[Displacement(body)] @ N for body in bodies]
    return np.asarray(u[-1] - u[0] if len(u) > 1 else u[0])


@pytest.mark.parametrize("solve", SCHEMES)
@pytest.mark.parametrize("gap", [-1e-12, 0.003, -1e-4])  # at 0 rounding decides if they touch
def test_two_free_spheres_meet_as_the_model_of_one_unknown_does(solve: Solve, gap: float) -> None:
    dt = 0.013 / W
    single = ran(solve(asked(one(gap, 0.0), dt, range(1, 2))))
    both = ran(solve(asked(two(gap, True), dt, range(2))))
    q, apart = moved(single, (1,)), moved(both, (0, 1))
    assert np.abs(apart - q).max() < 1e-12 * np.abs(q).max()
    assert single.ledger is not None
    assert both.ledger is not None
    taken = [run.ledger.terms["drag dissipation"] for run in (single, both) if run.ledger]
    assert taken[0] == pytest.approx(taken[1], rel=1e-12)
    assert taken[0] > 0.1 * REDUCED * SPEED**2 / 2


@pytest.mark.parametrize(("solve", "order"), [(SCHEMES[0], 2), (SCHEMES[1], 1)])
def test_they_part_at_the_restitution_of_the_formula(solve: Solve, order: int) -> None:
    errors = []
    for dt in (0.04 / W, 0.02 / W, 0.01 / W):
        run = ran(solve(asked(two(0.0), dt, range(2))))
        apart = (run.values[Velocity(1)][-1] - run.values[Velocity(0)][-1]) @ N
        errors.append(abs(apart / SPEED - closed.restitution(Z)))
    assert np.log2(errors[0] / errors[2]) / 2 == pytest.approx(order, abs=0.15)
    assert errors[2] < (2e-4, 2e-2)[2 - order]


def heap(eta: float) -> Scene:
    """Three spheres thrown into a corner and at each other: normals turn, dashpots share bodies."""
    place = np.array([[0.52, 0.5, 0.0], [1.51, 0.55, 0.0], [0.95, 1.42, 0.0]])
    thrown = np.array([[0.1, -0.6, 0.0], [-1.5, -0.3, 0.0], [0.2, -1.2, 0.0]])
    spheres = Spheres(
        place, thrown, np.array([0.5, 0.48, 0.5]), np.array([1.0, 2.0, 1.5]),
        np.tile([True, True, False], (3, 1)),
    )  # fmt: skip
    walls = Wall(np.zeros(3), UP), Wall(np.zeros(3), ALONG)
    return Scene((*walls, spheres), Contact(1e4, eta_n=60.0), eta, gravity=-9.81 * UP)


def off(run: Run, eta: float) -> float:
    """The difference of a run of the heap from that of scipy, over the largest displacement."""
    due = event_located(heap(eta), ran(run).times, 1e-3)
    u = np.stack([run.values[Displacement(body)][:, :2] for body in HEAPED], axis=1)
    return float(np.abs(u - due).max() / np.abs(due).max())


@pytest.mark.parametrize(("solve", "order"), [(SCHEMES[0], 2), (SCHEMES[1], 1)])
@pytest.mark.parametrize("eta", [0.0, 3.0])
def test_oblique_collisions_of_several_are_those_that_scipy_finds(
    solve: Solve, order: int, eta: float
) -> None:
    errors = [
        off(solve(asked(heap(eta), dt, HEAPED, 0.1)), eta) for dt in 2e-4 / 2.0 ** np.arange(5)
    ]
    assert np.log2(errors[0] / errors[-1]) / 4 > order - 0.25
    assert errors[-1] < (1e-6, 1e-3)[2 - order]


@pytest.mark.parametrize("solve", SCHEMES)
@pytest.mark.parametrize("eta", [0.0, 3.0])
def test_pairs_gathered_as_spheres_stray_are_damped_as_listed_ones(
    solve: Solve, eta: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    ask = asked(heap(eta), 5e-5, HEAPED, 0.1)
    listed = ran(solve(ask))
    monkeypatch.setattr("vv.engines.dem.bonds.layout.MANY", 1)
    near = ran(solve(ask))
    for what in ask.observables:
        a, b = near.values[what], listed.values[what]
        assert np.abs(a - b).max() <= 1e-12 * np.abs(b).max()
    assert near.ledger is not None
    assert listed.ledger is not None
    assert near.ledger.terms == pytest.approx(listed.ledger.terms, rel=1e-9, abs=1e-12)
    assert near.ledger.terms["drag dissipation"] > 0.1 * near.ledger.peak


def test_a_crowd_of_any_size_is_damped_and_keeps_its_momentum_and_its_books() -> None:
    random = np.random.default_rng(3)
    grid = np.stack(np.meshgrid(*[np.arange(5.0)] * 3), axis=-1).reshape(-1, 3)
    n = len(grid)
    thrown = random.normal(size=(n, 3)) - 0.5 * (grid - 2.0)  # inwards
    spheres = Spheres(1.05 * grid, thrown, np.full(n, 0.5), np.ones(n), np.ones((n, 3), bool))
    scene = Scene((spheres,), Contact(1e4, eta_n=20.0))
    run = ran(dem.solve_default(asked(scene, 5e-5, range(n), 0.2)))
    velocity = np.array([run.values[Velocity(body)] for body in range(n)])
    drift = velocity.sum(axis=0) - thrown.sum(axis=0)
    assert np.abs(drift).max() < 1e-12 * np.abs(thrown).sum()
    assert run.ledger is not None
    assert run.ledger.terms["drag dissipation"] > 0.1 * run.ledger.peak
    assert run.ledger.unaccounted < 1e-3 * run.ledger.peak


@pytest.mark.parametrize("code", ["yade", "liggghts"])
def test_yade_and_liggghts_find_them_in_first_order(code: str, tmp_path: Path) -> None:
    adapter = find().load_adapter(code)
    if not adapter.found().installed and code not in os.environ.get("VV_REQUIRE", "").split(","):
        pytest.skip(f"{code} is not installed")
    asks = [asked(heap(0.0), dt, HEAPED, 0.1) for dt in (1e-4, 1.25e-5)]
    errors = [off(run, 0.0) for run in adapter.run(asks, "default", tmp_path, 0.0)]
    assert errors[0] < 2e-3
    assert 0.8 < np.log2(errors[0] / errors[1]) / 3 < 1.5


@pytest.mark.parametrize("eta", [0.0, 3.0])
def test_what_dashpots_take_is_booked_and_momentum_is_kept(eta: float) -> None:
    run = ran(dem.solve_default(asked(heap(eta), 2.5e-5, HEAPED, 0.1)))
    assert run.ledger is not None
    assert run.ledger.unaccounted < 1e-4 * run.ledger.peak
    assert run.ledger.terms["drag dissipation"] > 0.1 * run.ledger.peak
    free = ran(dem.solve_default(asked(two(0.0), 0.01 / W, range(2))))
    total = sum(m * free.values[Velocity(body)] for body, m in enumerate(M))
    assert np.abs(total).max() < 1e-13 * M.sum() * SPEED


def test_a_lock_bears_what_the_dashpot_pushes() -> None:
    deep, free = 1e-4, np.array([[True, False, False], [True, True, True]])
    spheres = Spheres(
        np.array([0 * N, (2 - deep) * N]), np.array([0 * N, -SPEED * N]), np.ones(2), M, free
    )
    ask = Ask(Scene((spheres,), LAW), History(1e-3 / W, 1e-4 / W), (Reaction(0),), Knobs(1e-6 / W))
    borne = ran(dem.solve_default(ask)).values[Reaction(0)][0]
    push = (KN * deep + LAW.eta_n * SPEED) * N
    assert borne == pytest.approx(push * ~free[0], rel=1e-5)


def test_late_dashpots_lower_the_largest_stable_step_by_the_stiffness_of_the_whole() -> None:
    n = LAW.eta_n / KN * W**2 / 2
    assert dem.critical_step(two(-1e-3), dem.CENTRED) == pytest.approx(2 / W, rel=1e-12)
    due = 2 * (sqrt(n * n + W * W) - n) / W**2
    assert dem.critical_step(two(-1e-3), dem.LAGGED) == pytest.approx(due, rel=1e-12)


@pytest.mark.parametrize("z", [2.0, 5.0])
def test_a_step_in_half_of_which_a_dashpot_stops_what_approaches_is_the_longest(z: float) -> None:
    """Beyond it, a contact closed at t = 0 created energy: -1 became 1.6 at z = 5, w dt = 0.5."""
    scene = two(-1e-3)
    law = Contact(KN, eta_n=2 * z * sqrt(KN * REDUCED))
    stiff = dataclasses.replace(scene, contact=law)
    longest = 1 / (z * W)
    assert "stops an approach" in (dem.refuses(asked(stiff, 1.001 * longest, range(2))) or "")
    run = ran(dem.solve_default(asked(stiff, 0.999 * longest, range(2), 50 * longest)))
    closing = (run.values[Velocity(0)] - run.values[Velocity(1)]) @ N
    assert closing.min() > -0.2 * closing[0] < 0.0
