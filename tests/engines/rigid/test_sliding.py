"""Claims about sliding blocks in `rigid`: the answers of the papers, at second order."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from reference_solutions.blocks import incline as slides
from reference_solutions.blocks import responding_block as responds
from tests.scenes.blocks.block_scenes import FREE, HELD, incline, responding, slope
from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.engines import rigid
from vv.engines.rigid import PreparedRigidBlocks, slip
from vv.engines.rigid.general import events
from vv.engines.rigid.general.model import Space
from vv.engines.rigid.limits import CLOSE
from vv.engines.rigid.point.model import Point
from vv.scene import Block, Harmonic, Scene, Vector, Wall

G = 9.81
SINE = Harmonic(np.array([5.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))


def ask(scene: Scene, dt: float, duration: float) -> Ask:
    return Ask(scene, History(duration, 0.01), (Displacement(1),), Knobs(dt))


def moved(run: Run) -> Vector:
    assert run.status is Status.RAN, run.reason
    return np.asarray(run.values[Displacement(1)])


def error(scene: Scene, dt: float, reference: Callable[[Vector], Vector], duration: float) -> float:
    """The largest distance from the reference over its largest displacement."""
    run = rigid.solve(ask(scene, dt, duration))
    exact = reference(run.times)
    off = np.linalg.norm(moved(run) - exact, axis=1)
    return float(off.max() / np.linalg.norm(exact, axis=1).max())


def order(errors: list[float]) -> float:
    return float(np.log2(errors[0] / errors[-1]) / (len(errors) - 1))


def down_dip(alpha: float, d: Vector) -> Vector:
    return np.outer(d, slope(alpha)[0][0])


@pytest.mark.parametrize(("alpha", "phi"), [(28, 5), (28, 25), (45, 10), (45, 30)])
@pytest.mark.parametrize("v0", [0.0, 0.01, 0.1, 1.0])
def test_gravity_on_a_slope_is_exact(alpha: float, phi: float, v0: float) -> None:
    def exact(t: Vector) -> Vector:
        return down_dip(alpha, slides.gravity(t, alpha=alpha, phi=phi, g=G, v0=v0))

    assert error(incline(alpha, phi, v0=v0, free_spin=HELD), 1e-3, exact, 1.0) <= 1e-12
    assert error(incline(alpha, phi, v0=v0), 1e-3, exact, 0.2) <= 1e-7


@pytest.mark.parametrize(
    ("alpha", "phi", "amplitude"), [(20, 22, 5.0), (20, 30, 5.0), (20, 35, 5.0), (45, 50, 2.0)]
)
def test_the_newmark_sine_is_second_order(alpha: float, phi: float, amplitude: float) -> None:
    shaking = Harmonic(np.array([amplitude, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))

    def exact(t: Vector) -> Vector:
        d = slides.newmark(t, alpha=alpha, phi=phi, g=G, A=amplitude, f=1.0, v0=0.0)
        return down_dip(alpha, d)

    scene = incline(alpha, phi, shaking, free_spin=HELD)
    steps = [8e-3, 4e-3, 2e-3, 1e-3, 5e-4]
    errors = [error(scene, dt, exact, 2.0) for dt in steps]
    assert errors[3] <= 2e-5
    assert order(errors) >= 1.8


def test_slip_in_two_directions_at_once() -> None:
    scene = incline(
        45, 50, Harmonic(np.array([2.0, 1.0, 0.0]), np.array([1.0, 2.0, 0.0])), free_spin=HELD
    )
    axes = slope(45)[0]

    def exact(t: Vector) -> Vector:
        drive = {"ax": 2.0, "fx": 1.0, "ay": 1.0, "fy": 2.0}
        return slides.two_directions(t, alpha=45, phi=50, g=G, **drive) @ axes[:2]

    errors = [error(scene, dt, exact, 6.0) for dt in (5e-3, 2.5e-3, 1.25e-3, 1e-3)]
    assert errors[-1] <= 2e-5


@pytest.mark.parametrize(
    ("D", "f", "mu", "most"),
    [(0.2, 2, 0.6, 2e-4), (0.2, 5, 0.6, 1e-3), (0.5, 1, 0.1, 2e-4), (0.5, 1, 1.0, 2e-4)],
)
def test_a_responding_block_in_one_direction(D: float, f: float, mu: float, most: float) -> None:
    scene = responding([D, 0.0, 0.0], [f, 0.0, 0.0], mu, free_spin=HELD)

    def exact(t: Vector) -> Vector:
        d = responds.one_direction(t, D=D, f=f, mu=mu, g=G)
        return np.outer(d, [1.0, 0.0, 0.0])

    assert error(scene, 1e-3, exact, 5.0) <= most


def test_a_responding_block_in_a_plane_and_in_space() -> None:
    plane = responding([0.3, 0.2, 0.0], [2.0, 4.0, 0.0], 0.6, free_spin=HELD)
    space = responding([0.1, 0.1, 0.1], [2.0, 4.0, 1.0], 0.6, free_spin=HELD)

    def two(t: Vector) -> Vector:
        drive = {"Dx": 0.3, "fx": 2.0, "Dy": 0.2, "fy": 4.0}
        return np.pad(responds.two_directions(t, **drive, mu=0.6, g=G), ((0, 0), (0, 1)))

    def three(t: Vector) -> Vector:
        drive = {"Dx": 0.1, "fx": 2.0, "Dy": 0.1, "fy": 4.0, "Dz": 0.1, "fz": 1.0}
        return responds.three_directions(t, **drive, mu=0.6, g=G)

    for scene, exact, most in ((plane, two, 5e-4), (space, three, 1e-3)):
        errors = [error(scene, dt, exact, 5.0) for dt in (2e-3, 1e-3, 5e-4)]
        assert errors[1] <= most / 2
        assert order(errors) >= 1.8


def weakened(scene: Scene, part: float) -> Scene:
    """The scene with gravity, shaking and motions of walls multiplied by a factor."""

    def less(motion: Harmonic | None) -> Harmonic | None:
        return motion and dataclasses.replace(motion, amplitude=part * motion.amplitude)

    bodies = tuple(
        dataclasses.replace(body, motion=less(body.motion)) if isinstance(body, Wall) else body
        for body in scene.bodies
    )
    gravity, shaking = part * scene.gravity, less(scene.wave)
    return dataclasses.replace(scene, bodies=bodies, gravity=gravity, shaking=shaking)


SCENES = {
    "gravity": incline(28, 15, free_spin=HELD),
    "sine": incline(20, 22, SINE, free_spin=HELD),
    "plane": responding([0.3, 0.2, 0.0], [2.0, 4.0, 0.0], 0.6, free_spin=HELD),
    "space": responding([0.1, 0.1, 0.1], [2.0, 4.0, 1.0], 0.6, free_spin=HELD),
}


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_a_point_mass_moves_as_the_general_model_does_and_costs_less(scene: Scene) -> None:
    question = ask(scene, 1e-3, 0.6)
    small, general = rigid.prepare(question), PreparedRigidBlocks(question, Space(scene))
    assert isinstance(small.system, Point)
    assert small.model.unknowns < general.model.unknowns
    runs = [program.run(program.solve()) for program in (small, general)]
    assert np.abs(moved(runs[0]) - moved(runs[1])).max() <= 1e-10
    for program, run in zip((small, general), runs, strict=True):
        assert run.ledger is not None
        assert run.ledger.bound is not None
        assert run.ledger.unaccounted <= run.ledger.bound
        assert np.diff(program.energies[:, 1]).min() >= -1e-12 * run.ledger.peak


@pytest.mark.parametrize("part", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_weak_fields_make_the_same_motion_so_many_times_as_small(scene: Scene, part: float) -> None:
    strong, weak = (
        moved(rigid.solve(ask(one, 1e-3, 2.0))) for one in (scene, weakened(scene, part))
    )
    assert np.abs(weak / part - strong).max() <= 1e-11 * np.abs(strong).max()


def sliding_down(t: Vector) -> Vector:
    return down_dip(20, slides.newmark(t, alpha=20, phi=22, g=G, A=5.0, f=1.0, v0=0.0))


def responding_in_a_plane(t: Vector) -> Vector:
    d = responds.two_directions(t, Dx=0.3, fx=2.0, Dy=0.2, fy=4.0, mu=0.6, g=G)
    return np.pad(d, ((0, 0), (0, 1)))


@pytest.mark.parametrize("part", [1.0, 1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize(
    ("name", "exact"), [("sine", sliding_down), ("plane", responding_in_a_plane)]
)
def test_the_general_model_is_of_second_order_in_weak_fields_too(
    name: str, exact: Callable[[Vector], Vector], part: float
) -> None:
    errors = []
    for dt in (1e-3, 5e-4, 2.5e-4):
        question = ask(weakened(SCENES[name], part), dt, 2.0)
        program = PreparedRigidBlocks(question, Space(question.scene))
        run = program.run(program.solve())
        off = moved(run) / part - exact(run.times)
        errors.append(float(np.linalg.norm(off, axis=1).max()))
    assert all(1.9 <= order(errors[i : i + 2]) <= 2.1 for i in range(2))


def loosened(scene: Scene) -> Scene:
    """The scene with free rotations."""
    bodies = tuple(
        dataclasses.replace(body, free_spin=FREE) if isinstance(body, Block) else body
        for body in scene.bodies
    )
    return dataclasses.replace(scene, bodies=bodies)


def test_a_block_that_may_turn_slides_as_one_that_may_not() -> None:
    scene = incline(20, 22, SINE, free_spin=HELD)
    runs = [rigid.solve(ask(s, 2e-3, 1.0)) for s in (scene, loosened(scene))]
    apart = np.abs(moved(runs[0]) - moved(runs[1])).max()
    assert apart <= 1e-7  # where slip begins is found to 1/256 of a step; dt itself costs 2e-6


@pytest.mark.parametrize("v0", [0.02, 1e-3, 1e-4])
@pytest.mark.parametrize(("alpha", "mu"), [(0, 0.003), (0, 0.018), (0, 0.6), (5, 0.088)])
def test_a_slip_ends_where_it_should_however_slow_it_is_and_however_little_friction_is_left(
    alpha: float, mu: float, v0: float
) -> None:
    """The velocity left 0.6 steps before the end of its step is that of CLOSE, and of residuals."""
    phi = np.degrees(np.arctan(mu))
    slows = G * (mu * np.cos(np.radians(alpha)) - np.sin(np.radians(alpha)))
    stop = v0 / slows
    dt = stop / 3.4
    scene = incline(alpha, phi, v0=v0, half=(0.5, 0.5, 0.1))
    run = rigid.solve(Ask(scene, History(5 * dt, dt), (Displacement(1),), Knobs(dt)))
    way = float(np.linalg.norm(moved(run)[-1]))
    most = CLOSE * (1.0 + 0.5 * mu * G / slows) if alpha else CLOSE
    assert abs(way / (0.5 * v0 * stop) - 1.0) <= most * 0.6 / 3.4**2


@pytest.mark.parametrize("bent", [0.0, 0.01, 0.2, -0.2, 1.0])
@pytest.mark.parametrize("ends", [0.13, 0.3, 0.8, 0.98])
@pytest.mark.parametrize("dt", [1e-4, 1e-2])
def test_where_a_slip_ends_is_found_in_few_trials_however_its_deceleration_changes(
    monkeypatch: pytest.MonkeyPatch, dt: float, ends: float, bent: float
) -> None:
    """Halving alone would take 28; trials that end too late have no speed to guess from."""
    tried: list[float] = []
    zero_after: Any = slip.zero_after
    first_root: Any = slip.first_root
    monkeypatch.setattr(slip, "first_root", first_root.py_func)

    def left(t: float) -> float:
        return ends - t + 0.5 * bent * (ends**2 - t**2)

    def attempt(*given: Any) -> Any:
        tried.append(given[3] / dt)
        speed = np.full((1, 3), left(tried[-1]))
        ended = speed <= 0.0
        stuck = np.where(ended, 0.0, speed)
        return SimpleNamespace(v=stuck, w=None, ended=ended, gaps=SimpleNamespace(slack=0))

    replaced = {
        "attempt": attempt,
        "marked": np.any,
        "rates": lambda *_: None,
        "zero_rows": lambda rows: np.full((rows, 3), left(0.0)),
        "slowest_slip": lambda trial, v, w: v[0, 0],
        "least_impact_speed": lambda *_: np.inf,
        "zero_after": zero_after.py_func,
    }
    for name, one in replaced.items():
        monkeypatch.setattr(events, name, one)
    search: Any = events.time_to_slip_end
    low = search.py_func(None, None, None, 0.0, dt, dt, None, attempt(0, 0, 0, dt)) / dt
    assert 0.0 <= ends - low <= CLOSE
    assert len(tried) <= (9 if bent == 0.0 else 14)
