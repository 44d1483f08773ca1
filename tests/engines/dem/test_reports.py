"""Claims about what a run of `dem` reports beside its motion: laws, by hand, and divergence."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from tests.engines.dem.bulk.test_bulk import crowd
from tests.scenes.small_scenes import ball
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines.dem.bulk.model import bulk
from vv.engines.dem.leapfrog import CENTRED, LAGGED, Leapfrog
from vv.engines.dem.line.model import line
from vv.engines.dem.pressed.model import pressed as on_a_wall
from vv.engines.dem.solve import COULOMB, DEPTH, SOFT, PreparedSpheres, _audits, prepare
from vv.engines.dem.space.model import space
from vv.scene import Contact, Hertz, Scene, Spheres, Wall

UP, ALONG = np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])
LAW = Contact(800.0, 200.0, 0.5)
FRICTION = "Coulomb: friction beyond mu N [N]"


def pressed(law: Contact = LAW) -> Scene:
    """A ball of 2 m that is 1 mm deep in a floor."""
    body = ball(1.999 * UP, 0.1 * ALONG, radius=np.array([2.0]))
    return Scene((Wall(np.zeros(3), UP), body), law)


def prepared() -> PreparedSpheres:
    goal = History(0.1, 0.02)
    return prepare(Ask(pressed(), goal, (Displacement(1),), Knobs(1e-3)), CENTRED)


def test_overlap_and_friction_are_told_by_the_energies_of_springs() -> None:
    """4 J in 800 N/m is 0.1 m and 80 N; 0.64 J in 200 N/m is 16 N, where nothing presses."""
    terms = np.zeros((3, 4))
    terms[:, 1], terms[:, 2] = [4.0, 1.0, 0.0], [4.0, 1.0, 0.64]
    found = dict(_audits(pressed(), terms))
    assert found[DEPTH] == pytest.approx((0.1, SOFT * 2.0))
    assert found[FRICTION] == pytest.approx((16.0, COULOMB * 80.0))
    within = terms * [1.0, 1.0, 0.0, 1.0]
    assert dict(_audits(pressed(), within))[FRICTION][0] == 0.0


@pytest.mark.parametrize(
    ("scene", "laws"),
    [
        (pressed(), {DEPTH, FRICTION}),
        (pressed(dataclasses.replace(LAW, eta_n=1.0)), {DEPTH}),
        (pressed(Contact(0.0, mu=0.5, hertz=Hertz(1e6, 1e6))), set()),
        (Scene((*pressed().bodies, Wall(9.0 * UP, -UP)), LAW), {DEPTH}),
    ],
)
def test_a_law_is_checked_where_energies_tell_of_it(scene: Scene, laws: set[str]) -> None:
    assert {name for name, _ in _audits(scene, np.zeros((2, 4)))} == laws


def test_a_divergence_is_told_by_its_step_its_time_and_its_energies() -> None:
    program = prepared()
    energy = np.zeros_like(program.arguments[1])
    energy[2, :3] = 1.0, 2.0, 4.0
    why = program._why(energy, 2)
    assert why.startswith("by step 40, t = 0.04 s: energy 7 J, kinetic and elastic, from 0.005 J")
    energy[2, 1] = np.nan
    assert program._why(energy, 2) == "by step 40, t = 0.04 s: the state is not finite"
    assert program.run(2).steps == 40


def falling(eta: float = 0.0, eta_n: float = 0.0, deep: float = 0.0) -> Scene:
    """A ball of 3 kg that moves down at 2 m/s under 12 N, `deep` in a floor."""
    one = np.array([[False, True, False]])
    size, mass, load = np.array([2.0]), np.array([3.0]), -12.0 * UP[None]
    body = ball((2.0 - deep) * UP, -2.0 * UP, radius=size, mass=mass, free=one, load=load)
    return Scene((Wall(np.zeros(3), UP), body), Contact(800.0, eta_n=eta_n), eta=eta)


def in_a_plane() -> Scene:
    """The pressed ball, free along the normal and along the floor, without rotation."""
    (sphere,) = (body for body in pressed().bodies if isinstance(body, Spheres))
    free, mass = np.array([[True, True, False]]), np.array([5.0])
    held = dataclasses.replace(sphere, free=free, mass=mass)
    return dataclasses.replace(pressed(), bodies=(pressed().bodies[0], held))


def test_energy_put_in_is_that_of_motion_spin_and_springs_at_the_start() -> None:
    """Springs hold 7 and 11 J; where there is one unknown they are one."""
    energy = np.zeros((2, 12))
    energy[0, 1:3], energy[0, 11] = [7.0, 11.0], 13.0
    moving = 0.5 * 3.0 * 2.0**2
    single, general = line(falling()), space(falling())
    assert single is not None
    assert single.put_in(energy) == pytest.approx(moving + 7.0)
    assert general.put_in(energy) == pytest.approx(moving + 18.0 + 13.0)
    sphere, beside = in_a_plane().spheres, on_a_wall(in_a_plane())
    assert beside is not None
    along = 0.5 * float(sphere.mass[0]) * 0.1**2
    assert beside.put_in(energy) == pytest.approx(along + 18.0)
    scene = crowd(Contact(1e5, 2e4, 0.5))
    many, spheres = bulk(scene), scene.spheres
    assert many is not None
    whole = 0.5 * float(spheres.mass @ (spheres.velocity**2).sum(1))
    whole += 0.5 * float(spheres.inertia @ (spheres.spin**2).sum(1))
    assert many.put_in(energy) == pytest.approx(whole + 18.0)


@pytest.mark.parametrize("leapfrog", [CENTRED, LAGGED])
def test_a_bound_of_energy_is_what_the_first_kick_of_a_leapfrog_misses(leapfrog: Leapfrog) -> None:
    """m (v- v+ - v^2)/2 with v- = v - back dt a, v+ = v + (1 - back) dt a, and what is lost."""
    dt, energy = 1e-3, np.zeros((4, 12))
    energy[-1, 5] = 1e-4
    deep, eta, eta_n = 5e-3, 2.0, 7.0
    found = line(falling(eta, eta_n, deep))
    assert found is not None
    force = -12.0 + eta * 2.0 + 800.0 * deep + eta_n * 2.0
    v, a = -2.0, force / 3.0
    kicked = (v - leapfrog.back * dt * a) * (v + (1.0 - leapfrog.back) * dt * a)
    due = 0.5 * 3.0 * abs(kicked - v * v) + 1e-4
    assert found.bound(energy, leapfrog, dt) == pytest.approx(due)
    beside = on_a_wall(in_a_plane())
    assert beside is not None
    energy[0, 0] = 5.0
    still = 0.5 * float(in_a_plane().spheres.mass[0]) * 0.1**2
    assert beside.bound(energy, leapfrog, dt) == pytest.approx(abs(5.0 - still))
    energy[-1, 7] = 1.0
    assert beside.bound(energy, leapfrog, dt) is None
