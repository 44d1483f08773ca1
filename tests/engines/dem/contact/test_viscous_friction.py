"""Claims about dashpots with friction, moving walls and bonds: order, routes, energy balance."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from reference_solutions.contact.oblique_dashpot import Impact, motion
from tests.scenes.spheres.oblique_impact import oblique, on_moving_wall, seen_from_it
from vv.ask import Ask, Displacement, History, Knobs, Run, Status, Velocity
from vv.engines import dem
from vv.plan.project import find
from vv.scene import Bonds, Contact, Harmonic, Scene, Spheres, Term, Vector, Wall

STICKS, SLIPS, SLIDES = (Impact(2.0, 1e4, 8e3, 0.3, 0.4, 0.3, way) for way in (0.02, 0.1, 0.5))
LASTS, OUTPUTS = 0.06, 30
HALVED = (20, 40, 80, 160)  # steps between outputs
SCHEMES = [(dem.solve_default, 2), (dem.solve_published, 1)]
WAVE = Harmonic(np.array([0.002, 0.001, 0.0]), np.array([9.0, 7.0, 0.0]), np.array([0.3, 0.8, 0.0]))
BALL = Displacement(1)


def ran(run: Run) -> Run:
    assert run.status is Status.RAN, run.reason
    return run


def asked(scene: Scene, steps: int, bodies: range = range(1, 2), lasts: float = LASTS) -> Ask:
    seen = tuple(kind(body) for kind in (Displacement, Velocity) for body in bodies)
    every = lasts / OUTPUTS
    return Ask(scene, History(lasts, every), seen, Knobs(every / steps))


def off(run: Run, impact: Impact) -> float:
    """The error of the path over its largest displacement."""
    due = np.stack(motion(ran(run).times, impact), axis=1)
    return float(np.abs(run.values[BALL][:, :2] - due).max() / np.abs(due).max())


def unaccounted(run: Run) -> float:
    assert run.ledger is not None
    return run.ledger.unaccounted / run.ledger.peak


@pytest.mark.parametrize(("solve", "order"), SCHEMES)
@pytest.mark.parametrize("impact", [STICKS, SLIPS, SLIDES])
def test_an_oblique_impact_is_found_to_the_order_of_the_scheme(
    impact: Impact, solve: Callable[[Ask], Run], order: int
) -> None:
    errors = [off(solve(asked(oblique(impact), steps)), impact) for steps in HALVED]
    assert np.log2(errors[0] / errors[-1]) / 3 > order - 0.3
    assert errors[-1] < (1e-6, 2e-3)[2 - order]


@pytest.mark.parametrize("code", ["yade", "liggghts"])
def test_yade_and_liggghts_find_it_in_first_order(code: str, tmp_path: Path) -> None:
    """Both limit friction by the whole normal force too."""
    adapter = find().load_adapter(code)
    if not adapter.found().installed and code not in os.environ.get("VV_REQUIRE", "").split(","):
        pytest.skip(f"{code} is not installed")
    for number, impact in enumerate((SLIPS, SLIDES)):
        asks = [asked(oblique(impact), steps) for steps in HALVED[::3]]
        scratch = tmp_path / str(number)
        scratch.mkdir()
        errors = [off(run, impact) for run in adapter.run(asks, "default", scratch, 0.0)]
        assert errors[-1] < 2e-3
        assert np.log2(errors[0] / errors[-1]) / 3 == pytest.approx(1, abs=0.1)


@pytest.mark.parametrize("solve", [solve for solve, _ in SCHEMES])
@pytest.mark.parametrize("impact", [STICKS, SLIDES])
def test_friction_and_dashpot_are_booked_apart(impact: Impact, solve: Callable[[Ask], Run]) -> None:
    runs = [ran(solve(asked(oblique(impact), steps))) for steps in HALVED[::3]]
    assert unaccounted(runs[1]) < min(1e-6, unaccounted(runs[0]) / 16)
    assert runs[1].ledger is not None
    booked, peak = runs[1].ledger.terms, runs[1].ledger.peak
    assert booked["drag dissipation"] > 0.05 * peak
    assert booked["friction dissipation"] > (0.05 * peak if impact is SLIDES else 0)


def test_spheres_that_meet_obliquely_and_turn_close_the_books_in_second_order() -> None:
    spheres = Spheres(
        np.array([[0.0, 0.0, 0.0], [0.199, 0.01, 0.0]]),
        np.array([[0.2, 0.4, 0.1], [-0.3, -0.4, 0.2]]), np.full(2, 0.1), np.array([1.0, 3.0]),
        np.ones((2, 3), bool), free_spin=np.ones((2, 3), bool),
    )  # fmt: skip
    scene = Scene((spheres,), Contact(1e4, 8e3, 0.3, 80.0))
    runs = [ran(dem.solve_default(asked(scene, steps, range(2)))) for steps in HALVED]
    paths = [run.values[Displacement(0)] for run in runs]
    apart = [float(np.abs(path - paths[-1]).max()) for path in paths[:-1]]
    assert apart[0] > 12 * apart[-1]  # 4^2 = 16 and less the last one's own error: 21
    assert unaccounted(runs[-1]) < 1e-6
    momentum = [m * runs[-1].values[Velocity(i)] for i, m in enumerate((1.0, 3.0))]
    assert np.ptp(sum(momentum), axis=0).max() < 1e-12


@pytest.mark.parametrize("impact", [STICKS, SLIDES])
def test_a_wall_that_moves_is_a_wall_at_rest_to_one_who_moves_with_it(impact: Impact) -> None:
    errors, books = [], []
    for steps in HALVED[::3]:
        moved = ran(dem.solve_default(asked(on_moving_wall(oblique(impact), WAVE), steps)))
        seen = ran(dem.solve_default(asked(seen_from_it(oblique(impact), WAVE), steps)))
        phase = 2 * np.pi * WAVE.frequency * moved.times[:, None] + WAVE.phase
        wall = WAVE.amplitude * (np.sin(phase) - np.sin(WAVE.phase))
        path = seen.values[BALL]
        errors.append(float(np.abs(moved.values[BALL] - wall - path).max() / np.abs(path).max()))
        books.append(unaccounted(moved))
        assert moved.ledger is not None
        assert abs(moved.ledger.terms["less work of moving walls"]) > 0.005 * moved.ledger.peak
    assert errors[-1] < min(1e-6, errors[0] / 40)  # in second order: 64
    assert books[-1] < 1e-6


def thrown(bonds: Bonds | None, place: Vector, speed: float) -> Scene:
    """Two spheres with or without a bond, and a third one thrown at them; a wall below."""
    velocity = np.zeros((3, 3))
    velocity[2, 0] = -speed
    spheres = Spheres(place, velocity, np.full(3, 0.5), np.ones(3), np.ones((3, 3), bool))
    wall = Wall(np.array([0.0, -0.5, 0.0]), np.array([0.0, 1.0, 0.0]))
    return Scene((wall, spheres), Contact(1e4, 5e3, 0.4, 60.0), bonds=bonds)


ROW = np.array([[0.0, 0.0, 0.0], [1.2, 0.0, 0.0], [2.19, 0.1, 0.0]])


def test_beside_a_bond_contacts_are_damped_as_they_are_without() -> None:
    """The bond holds the first two, which would not touch before the end without it."""
    tie = Bonds(np.array([[1, 2]]), np.array([1.2]), np.array([1e-9]), np.zeros(1))
    runs = [
        ran(dem.solve_default(asked(thrown(bonds, ROW, 1.0), 40, range(1, 4), 0.06)))
        for bonds in (None, tie)
    ]
    for body in range(1, 4):
        free, tied = (run.values[Velocity(body)] for run in runs)
        assert np.abs(tied - free).max() < 1e-9
    assert runs[1].ledger is not None
    assert runs[1].ledger.terms["drag dissipation"] > 0.05 * runs[1].ledger.peak
    assert Term.VISCOUS_FRICTION in runs[1].model.terms  # type: ignore[union-attr]


def test_spheres_whose_bond_has_parted_meet_on_dashpots_and_close_the_books() -> None:
    """The bond fails in shear under compression, and they continue as a contact."""
    place = ROW - [[0, 0, 0], [0.2, 0, 0], [0.2, 0, 0]]
    tie = Bonds(
        np.array([[1, 2]]), np.array([1.0]), np.array([1e4]), np.array([5e3]),
        tension=np.array([5.0]), shear=np.array([5.0]),
    )  # fmt: skip
    scene = thrown(tie, place, 1.0)
    runs = [ran(dem.solve_default(asked(scene, s, range(1, 4), 0.12))) for s in HALVED[::3]]
    for run in runs:
        assert run.ledger is not None
        assert run.ledger.terms["drag dissipation"] > 0.05 * run.ledger.peak
        assert run.ledger.terms["breaking dissipation, shear"] != 0
    assert unaccounted(runs[1]) < 1e-3
