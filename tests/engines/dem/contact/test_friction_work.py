"""Claims about friction in the DEM engine: in no step does it add energy to the motion."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from cases.hard.resting import CASE
from tests.engines.dem.test_momentum import falling
from tests.engines.dem.test_space import colliding
from tests.support.plain import plain
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import dem
from vv.engines.dem.contact.friction import at_limit, slip_force
from vv.engines.dem.leapfrog import Leapfrog
from vv.scene import Contact, Form, Harmonic, Scene, Spheres, Vector, Wall

SCHEMES = st.sampled_from([dem.CENTRED, dem.LAGGED])
KN = 1e4


def rubbed(seed: int) -> Scene:
    """A sphere pressed into a shaken plane by a fixed amount, thrown and pulled along it."""
    random = np.random.default_rng(seed)
    amplitude = 10 ** random.uniform(-3, 0, 3) * [1, 1, 0]
    shaken = Harmonic(amplitude, random.uniform(0.5, 5.0, 3), random.uniform(0, 6, 3))
    sphere = Spheres(
        np.array([[0.0, 0.0, 0.49]]), np.array([[*random.normal(size=2), 0.0]]),
        np.array([0.5]), np.ones(1), np.array([[True, True, False]]),
        load=np.array([[*(30 * random.normal(size=2)), 0.0]]),
    )  # fmt: skip
    plane = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]), shaken)
    return Scene((plane, sphere), Contact(KN, 10 ** random.uniform(2, 4), random.uniform(0.05, 1)))


def lost(scene: Scene, leapfrog: Leapfrog, dt: float) -> tuple[Vector, Vector]:
    """The work of friction up to each step [J], and the largest velocity of slip in it [m/s]."""
    spheres = scene.spheres
    first = next(i for i, group in enumerate(scene.bodies) if isinstance(group, Spheres))
    seen = tuple(Displacement(first + i) for i in range(len(spheres)))
    program = dem.prepare(Ask(scene, History(1.0, dt), seen, Knobs(dt)), leapfrog)
    program.solve()
    path, energy = program.arguments[:2]
    spin = path[..., 6:9] if path.shape[2] > 6 else 0.0 * path[..., 3:6]
    speed = np.linalg.norm(path[..., 3:6], axis=2)
    speed = speed + spheres.radius * np.linalg.norm(spin, axis=2)
    return energy[:, 3], 2 * speed.max(axis=1)


@given(st.integers(0, 10**6), SCHEMES, st.sampled_from([1e-3, 5e-3]))
@example(1587, dem.CENTRED, 5e-3)  # the slide turns back while the force turns
@settings(max_examples=60)
def test_under_a_steady_load_no_step_gains(seed: int, leapfrog: Leapfrog, dt: float) -> None:
    taken, _ = lost(rubbed(seed), leapfrog, dt)
    assume(taken[-1] > 0)  # it slipped
    assert np.diff(taken).min() >= -1e-14 * taken[-1]


@pytest.mark.shows(
    "9e-7 of the energy put in for a sheet of 33 spheres, mu kn (v dt)^2/8 at most, and none at "
    "half the step"
)
@given(
    st.sampled_from([colliding, falling]), st.integers(0, 10**4), SCHEMES,
    st.sampled_from([1e-3, 2.5e-3, 5e-3]),
)  # fmt: skip
@example(falling, 543, dem.CENTRED, 5e-3)
@settings(max_examples=40)
def test_in_collisions_a_step_gains_no_more_than_the_end_of_a_contact_in_it(
    kind: object, seed: int, leapfrog: Leapfrog, dt: float
) -> None:
    """If the limit decreases within a step, the mean of its ends is not the mean of the force.

    The difference is mu kn (v dt)^2/8 at most, mu times the gain of a normal spring that ends so.
    """
    scene: Scene = kind(seed)  # type: ignore[operator]
    taken, speed = lost(scene, leapfrog, dt)
    most = scene.contact.mu * scene.contact.kn * (dt * speed.max()) ** 2 / 8
    assert np.diff(taken).min() >= -most
    assert taken[-1] >= 0


def test_a_contact_that_ends_within_a_step_does_give_some() -> None:
    """So the bound above is relevant: the gain is 8 % of it in a coarse step of this motion."""
    scene = falling(523)
    taken, speed = lost(scene, dem.CENTRED, 5e-3)
    most = scene.contact.mu * scene.contact.kn * (5e-3 * speed.max()) ** 2 / 8
    assert -0.2 * most < np.diff(taken).min() < -0.02 * most


@pytest.mark.shows(
    "9e-7 of the energy put in for a sheet of 33 spheres, mu kn (v dt)^2/8 at most, and none at "
    "half the step"
)
def test_in_a_sheet_knocked_so_that_contacts_open_a_coarse_step_gives_a_millionth() -> None:
    """The longest step of the case does so once, half of it never."""
    given = CASE.defaults("knocked") | {"v": 3e-3}
    study = CASE.declare("knocked", given).study
    brought = 0.5 * given["m"] * given["v"] ** 2 * len(study.scene.spheres)

    def falls(dt: float) -> float:
        ask = study.ask(Knobs(dt))
        every = dataclasses.replace(ask, goal=History(0.1, 2e-4), energies=(Form.FRICTION,))
        taken = dem.solve_default(every).energies[Form.FRICTION]
        assert taken[-1] > 0.6 * brought
        return float((np.maximum.accumulate(taken) - taken).max()) / brought

    assert 8e-7 < falls(2e-4) < 1e-6
    assert falls(1e-4) == 0.0


@pytest.mark.shows("that mean is along the slip, whatever force is chosen within the limit")
def test_where_slip_turns_and_the_limit_falls_no_force_within_it_would_take_energy() -> None:
    """The force before exceeds the limit after, so its mean with any new force is along the slip.

    Along the line a force f takes -(old + f)/2 (f - trial)/ks, and trial < -limit <= f.
    """
    old, ks, limit, trial = 1.0, 50.0, 0.4, -0.7
    slide = (old - trial) / ks
    before, moved = (old, 0.0, 0.0), (slide, 0.0, 0.0)
    _, taken = plain(slip_force)(
        before, (trial, 0.0, 0.0), moved, (0.0, 0.0, 0.0), ks, (1.2, limit)
    )
    assert taken == pytest.approx(-0.5 * (old - limit) * (-limit - trial) / ks)
    for cap in np.linspace(0.01, limit, 9):
        for way in (1.0, -1.0):
            _, other = plain(at_limit)(before, (way, 0.0, 0.0), moved, ks, float(cap))
            assert other <= taken < 0.0
