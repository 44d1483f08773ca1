"""Claims about contacts with partial slip: second order, in any frame, and refused for many."""

import math

import numpy as np
import pytest

from reference_solutions.impact.micro_slip import rebound
from reference_solutions.impact.rebound import Law, Sphere
from vv.ask import Ask, History, Knobs, Velocity
from vv.engines import dem
from vv.engines.dem.contact.micro_slip import spring_weight
from vv.engines.dem.refusals import refuses
from vv.engines.dem.solve import solve
from vv.scene import Bonds, Contact, Hertz, Scene, Spheres, Vector, Wall

RADIUS, MASS, E, G, MU = 0.1, 11.0, 7e9, 1.5e9, 0.3
LAW = Law(4.0 / 3.0 * E * math.sqrt(RADIUS), 8.0 * G * math.sqrt(RADIUS), MU)
LASTS = 3e-3
X, Y, Z = np.eye(3)


def thrown(along: float, turn: Vector | None = None) -> Scene:
    """A sphere thrown at a wall that it touches at 1 m/s, and along it, all rotated by a matrix."""
    turn = np.eye(3) if turn is None else turn
    sphere = Spheres(
        position=RADIUS * Z[None] @ turn,
        velocity=(along * X - Z)[None] @ turn,
        radius=np.array([RADIUS]),
        mass=np.array([MASS]),
        free=np.ones((1, 3), bool),
        free_spin=np.ones((1, 3), bool),
    )
    law = Contact(0.0, mu=MU, hertz=Hertz(E, G, micro_slip=True))
    return Scene((Wall(np.zeros(3), Z @ turn), sphere), law)


def after(scene: Scene, steps: int) -> Vector:
    """The velocity after the impact, with a number of steps in 3 ms."""
    ask = Ask(scene, History(LASTS, LASTS), (Velocity(1),), Knobs(dt=LASTS / steps))
    run = solve(ask, dem.CENTRED)
    assert run.values, run.reason
    return np.asarray(run.values[Velocity(1)][-1])


@pytest.mark.parametrize("along", [0.05, 0.4, 0.8])
def test_it_is_of_second_order_down_to_what_its_springs_leave(along: float) -> None:
    due = rebound(LAW, Sphere(RADIUS, MASS), vn=1.0, vt=along).tangential
    errors = [abs(after(thrown(along), steps)[0] - due) for steps in (250, 1000, 4000)]
    assert errors[0] < 2e-4
    assert errors[1] < errors[0] / 8.0 + 1e-6
    assert errors[2] < 1e-6


def test_a_turned_scene_gives_turned_velocities() -> None:
    turn = np.linalg.qr(np.array([[1.0, 2.0, 0.5], [0.3, 1.0, -2.0], [2.0, 0.1, 1.0]]))[0]
    straight, turned = after(thrown(0.4), 1000), after(thrown(0.4, turn), 1000)
    assert turned @ turn.T == pytest.approx(straight, abs=1e-9)


def test_weights_of_springs_add_up_to_the_force_of_full_slip() -> None:
    apart, edge = 0.1, 0.537
    weights = [spring_weight.__wrapped__(k, 5, apart, edge) for k in range(6)]  # type: ignore[attr-defined]
    stretch = [edge**2 - (k * apart) ** 2 for k in range(6)]
    assert np.dot(weights, stretch) == pytest.approx(2.0 / 3.0 * edge**3, rel=1e-14)


def test_a_contact_that_closes_within_a_step_ends_as_one_that_touches_at_first() -> None:
    first = after(thrown(0.4), 2000)
    spheres = thrown(0.4).spheres
    away = Spheres(
        position=spheres.position + 1e-4 * Z, velocity=spheres.velocity, radius=spheres.radius,
        mass=spheres.mass, free=spheres.free, free_spin=spheres.free_spin,
    )  # fmt: skip
    scene = Scene((Wall(np.zeros(3), Z), away), thrown(0.4).contact)
    assert after(scene, 2000) == pytest.approx(first, abs=5e-6)


def test_contacts_of_bonded_spheres_are_refused() -> None:
    place = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 1.2], [0.0, 0.0, 1.4]])
    spheres = Spheres(
        place, np.zeros((3, 3)), np.full(3, RADIUS), np.full(3, MASS),
        free=np.ones((3, 3), bool), free_spin=np.ones((3, 3), bool),
    )  # fmt: skip
    bonds = Bonds(np.array([[0, 1]]), np.array([0.2]), np.array([1e6]), np.array([0.0]))
    scene = Scene((spheres,), thrown(0.4).contact, bonds=bonds)
    ask = Ask(scene, History(LASTS, LASTS), (Velocity(0),), Knobs(dt=1e-6))
    assert "slips in part" in (refuses(ask) or "")
