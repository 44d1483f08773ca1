"""Claims about viscous contact of elastic spheres: second order, wherever in a step it begins."""

import math

import numpy as np
import pytest

from reference_solutions.impact import viscous
from reference_solutions.impact.rebound import Law, Sphere, rebound
from vv.ask import Ask, History, Knobs, Velocity
from vv.engines import dem
from vv.engines.dem.contact.hertz import first_step_factor
from vv.engines.dem.solve import solve
from vv.scene import Contact, Hertz, Scene, Spheres, Wall

RADIUS, MASS, E, G = 0.1, 11.0, 7e9, 1.5e9
K, S = 4.0 / 3.0 * E * math.sqrt(RADIUS), 8.0 * G * math.sqrt(RADIUS)
Z = np.array([0.0, 0.0, 1.0])


def thrown(z: float, gap: float, mu: float = 0.0, along: float = 0.0) -> Scene:
    """A sphere thrown at a wall from a gap [m]."""
    sphere = Spheres(
        position=(RADIUS + gap) * Z[None],
        velocity=np.array([[along, 0.0, -1.0]]),
        radius=np.array([RADIUS]),
        mass=np.array([MASS]),
        free=np.ones((1, 3), bool),
        free_spin=np.full((1, 3), mu > 0.0),
    )
    return Scene((Wall(np.zeros(3), Z), sphere), Contact(0.0, mu=mu, hertz=Hertz(E, G, z)))


def after(scene: Scene, steps: int) -> np.ndarray:
    """The velocity after the impact, with a number of steps in 3 ms."""
    goal = History(3e-3, 3e-3)
    run = solve(Ask(scene, goal, (Velocity(1),), Knobs(dt=3e-3 / steps)), dem.CENTRED)
    assert run.values, run.reason
    return np.asarray(run.values[Velocity(1)][-1])


@pytest.mark.parametrize("gap", [0.0, 1e-6, 2.1e-6, 2.9e-6])
def test_restitution_is_of_second_order_wherever_in_a_step_contact_begins(gap: float) -> None:
    errors = [
        abs(after(thrown(0.4, gap), steps)[2] - viscous.restitution(0.4)) for steps in (500, 2000)
    ]
    assert errors[0] < 1e-3
    assert errors[1] < 1e-4
    assert errors[1] < errors[0] / 6.0 + 1e-6


def test_friction_ends_with_the_force_that_would_pull() -> None:
    due = rebound(Law(K, S, 0.3, 1.5, 0.4), Sphere(RADIUS, MASS), vn=1.0, vt=0.5)
    seen = after(thrown(0.4, 0.0, mu=0.3, along=0.5), 4000)
    assert seen[0] == pytest.approx(due.tangential, abs=3e-6)
    assert seen[2] == pytest.approx(due.normal, abs=3e-6)


@pytest.mark.parametrize("since", [1e-9, 0.3, 1.0])
def test_the_first_step_makes_up_for_what_sums_of_fourth_roots_miss(since: float) -> None:
    """But for the first term of Euler and Maclaurin's formula that is left out, with B6/6!."""
    left_out = 0.25 * 0.75 * 1.75 * 2.75 * 3.75 / 30240.0 * (since + 2.0) ** -4.75
    count = 4000
    nodes = (since + np.arange(1, count)) ** 0.25
    far = since + count
    integral = 0.8 * far**1.25 - 0.5 * far**0.25 + far**-0.75 / 48.0
    seen = first_step_factor.__wrapped__(since)  # type: ignore[attr-defined]
    assert seen == pytest.approx(integral - nodes.sum(), abs=left_out)
