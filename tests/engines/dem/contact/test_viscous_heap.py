"""Claims about several spheres with dashpots, friction and a moving floor, all in one scene."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.engines import dem
from vv.plan.project import find
from vv.scene import Contact, Harmonic, Scene, Spheres, Vector, Wall

UP, ALONG, LASTS = np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0]), 0.1
SHAKES = Harmonic(np.array([0.02, 0.01, 0]), np.array([3.0, 4.0, 0.0]), np.array([0.3, 0.8, 0.0]))
WALLS = Wall(np.zeros(3), UP, SHAKES), Wall(np.zeros(3), ALONG)
COARSE, FINE, FINEST = 2e-4, 1.25e-5, 3.125e-6


def heap(turns: bool) -> Scene:
    """Three spheres thrown into a corner and at each other, in a plane."""
    place = np.array([[0.52, 0.5, 0.0], [1.51, 0.55, 0.0], [0.95, 1.42, 0.0]])
    thrown = np.array([[0.1, -0.6, 0.0], [-1.5, -0.3, 0.0], [0.2, -1.2, 0.0]])
    spheres = Spheres(
        place, thrown, np.array([0.5, 0.48, 0.5]), np.array([1.0, 2.0, 1.5]),
        np.tile([True, True, False], (3, 1)), free_spin=np.tile([False, False, turns], (3, 1)),
    )  # fmt: skip
    return Scene((*WALLS, spheres), Contact(1e4, 8e3, 0.4, 60.0), gravity=-9.81 * UP)


def crowd(side: int) -> Scene:
    """A cube of spheres that are thrown at random and at each other, on the floor."""
    random, n = np.random.default_rng(3), side**3
    grid = np.stack(np.meshgrid(*[np.arange(float(side))] * 3), axis=-1).reshape(-1, 3)
    thrown = 0.5 * random.normal(size=(n, 3)) - 0.3 * (grid - (side - 1) / 2)
    spheres = Spheres(
        1.02 * grid + 0.52, thrown, np.full(n, 0.5), np.ones(n), np.ones((n, 3), bool),
        free_spin=np.ones((n, 3), bool),
    )  # fmt: skip
    return Scene((*WALLS, spheres), Contact(1e4, 8e3, 0.4, 20.0), gravity=-9.81 * UP)


def asked(scene: Scene, dt: float) -> Ask:
    seen = tuple(Displacement(i) for i in range(len(WALLS), len(WALLS) + len(scene.spheres)))
    return Ask(scene, History(LASTS, 1e-3), seen, Knobs(dt))


def ran(run: Run) -> Run:
    assert run.status is Status.RAN, run.reason
    return run


def paths(run: Run) -> Vector:
    return np.stack([*ran(run).values.values()])


def off(run: Run, due: Vector) -> float:
    return float(np.abs(paths(run) - due).max() / np.abs(due).max())


def unaccounted(run: Run) -> float:
    """The energy without a term, over the peak; each effect must have its share of the rest."""
    ledger = ran(run).ledger
    assert ledger is not None
    for name in ("friction dissipation", "drag dissipation", "less work of moving walls"):
        assert abs(ledger.terms[name]) > 0.01 * ledger.peak
    return ledger.unaccounted / ledger.peak


@pytest.mark.parametrize(("solve", "order"), [(dem.solve_default, 2), (dem.solve_published, 1)])
@pytest.mark.parametrize("turns", [True, False])
def test_a_heap_on_a_moving_floor_converges_with_the_order_of_the_scheme(
    turns: bool, solve: Callable[[Ask], Run], order: int
) -> None:
    due = paths(dem.solve_default(asked(heap(turns), FINEST)))
    errors = [off(solve(asked(heap(turns), dt)), due) for dt in (COARSE, FINE)]
    assert np.log2(errors[0] / errors[1]) / np.log2(COARSE / FINE) > order - 0.2
    assert errors[1] < (5e-7, 5e-4)[2 - order]


@pytest.mark.parametrize("scene", [heap(True), crowd(3), crowd(6)], ids=["3", "27", "216"])
def test_every_joule_of_any_number_of_them_has_a_term_to_second_order(scene: Scene) -> None:
    left = [unaccounted(dem.solve_default(asked(scene, dt))) for dt in (1e-4, 1.25e-5)]
    assert left[0] < 1e-4
    assert left[0] / left[1] > 8.0**1.6


@pytest.mark.parametrize("code", ["yade", "liggghts"])
def test_yade_and_liggghts_find_the_same_in_first_order(code: str, tmp_path: Path) -> None:
    """With spins locked, since YADE has another lever arm at walls."""
    adapter = find().load_adapter(code)
    if not adapter.found().installed and code not in os.environ.get("VV_REQUIRE", "").split(","):
        pytest.skip(f"{code} is not installed")
    due = paths(dem.solve_default(asked(heap(False), FINEST)))
    asks = [asked(heap(False), dt) for dt in (1e-4, FINE)]
    errors = [off(run, due) for run in adapter.run(asks, "default", tmp_path, 0.0)]
    assert errors[1] < 2e-4
    assert 0.8 < np.log2(errors[0] / errors[1]) / 3 < 1.2
