"""Claims about what Kratos is given of a scene of unlike spheres, against numbers by hand."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from adapters.kratos import ADAPTER
from adapters.kratos.plan import plan
from tests.adapters.kratos.test_kratos import struck
from vv.ask import Ask, Displacement, History, Knobs
from vv.scene import Contact, Hertz, Scene, Spheres, Wall

SPHERES = Spheres(
    position=np.array([[1.0, 2.0, 3.0], [1.0, 2.0, 4.0]]),
    velocity=np.array([[3.0, 0.0, 4.0], [0.0, 0.0, 0.0]]),
    radius=np.array([0.25, 0.5]),
    mass=np.array([2.0, 4.0]),
    free=np.ones((2, 3), bool),
    load=np.array([[8.0, 0.0, 0.0], [0.0, 0.0, 4.0]]),
)
WALL = Wall(np.array([0.0, 0.0, -3.0]), np.array([0.0, 0.6, 0.8]))
SCENE = Scene((SPHERES, WALL), Contact(1e6, 4e5, 0.5), gravity=np.array([0.0, -3.0, 0.0]))
ASK = Ask(SCENE, History(2.0, 0.5), (Displacement(1), Displacement(0)), Knobs(dt=0.25))


def changed(**changes: object) -> Ask:
    return dataclasses.replace(ASK, scene=dataclasses.replace(SCENE, **changes))  # type: ignore[arg-type]


def test_a_material_has_the_moduli_of_its_contacts() -> None:
    # G/E = 0.2: nu = (1 - 0.8)/(1 - 0.4) = 1/3, Young = 2 1e9 (1 - 1/9)
    law = plan(struck(Hertz(1e9, 0.2e9)))["law"]
    assert law == pytest.approx({"young": 2e9 * 8 / 9, "poisson": 1 / 3})
    assert plan(struck(Hertz(1e9)))["law"] == pytest.approx({"young": 2e9, "poisson": 0.0})


def test_each_number_of_a_sphere_stands_under_its_name() -> None:
    one = Spheres(
        np.array([[1.0, 2.0, 3.0]]), np.array([[4.0, 5.0, 6.0]]), np.array([0.5]), np.array([2.0]),
        np.array([[True, False, False]]), np.array([0.25]), np.array([[7.0, 8.0, 9.0]]),
        np.array([[False, True, True]]), np.array([[10.0, 11.0, 12.0]]),
    )  # fmt: skip
    ask = dataclasses.replace(changed(bodies=(one, WALL)), observables=(Displacement(0),))
    assert plan(ask)["spheres"] == [{
        "position": [1.0, 2.0, 3.0], "velocity": [4.0, 5.0, 6.0], "spin": [7.0, 8.0, 9.0],
        "radius": 0.5, "mass": 2.0, "inertia": 0.25,
        "force": [10.0, 5.0, 12.0], "start": [10.0, 5.0, 12.0],  # load and weight, no contact
        "free": [True, False, False], "free_spin": [False, True, True],
    }]  # fmt: skip


def test_steps_springs_and_forces_are_those_of_the_scene() -> None:
    given = plan(ASK)
    assert given["law"] == {"kn": 1e6, "ks": 4e5}
    assert (given["mu"], given["dt"], given["steps"], given["stride"]) == (0.5, 0.25, 8, 2)
    assert given["observe"] == [["displacement", 1], ["displacement", 0]]
    assert [one["force"] for one in given["spheres"]] == [[8.0, -6.0, 0.0], [0.0, -12.0, 4.0]]
    assert plan(changed(contact=Contact(1e6, 4e5)))["law"] == {"kn": 1e6, "ks": 1e6}
    touching = dataclasses.replace(SPHERES, radius=np.array([0.25, 0.75 + 1e-3]))
    for sign, one in zip((-1, 1), plan(changed(bodies=(touching, WALL)))["spheres"], strict=True):
        push = np.subtract(one["start"], one["force"])
        assert push == pytest.approx([0.0, 0.0, sign * 1e3], abs=1e-6)


def test_a_face_reaches_three_times_as_far_as_spheres_may_fly() -> None:
    # 1 m apart and 100 radii of 0.5 m, 5 m/s for 2 s, |(4, -3, 0)| m/s2: 3 (51 + 10 + 10)
    corners = np.array(plan(ASK)["walls"][0])
    assert np.linalg.norm(corners[1] - corners[0]) == pytest.approx(2 * 213.0)
    # about the foot of the middle (1, 2, 3.5), which is 0.6 2 + 0.8 6.5 = 6.4 above the wall
    assert corners.mean(axis=0) == pytest.approx([1.0, 2.0 - 3.84, 3.5 - 5.12])
    assert np.abs((corners - WALL.point) @ WALL.normal).max() < 1e-10


@pytest.mark.parametrize(
    ("pull", "load", "far"),
    [  # 3 (51 + 10 + 2 |pull + load/4 kg|)
        ([0.0, -3.0, 0.0], [0.0, -12.0, 0.0], 219.0),
        ([0.0, -3.0, 0.0], [0.0, 12.0, 0.0], 183.0),
        ([2.0, 0.0, 0.0], [4.0, 0.0, 0.0], 201.0),
    ],
)
def test_a_face_is_larger_where_weight_and_load_pull_alike(
    pull: list[float], load: list[float], far: float
) -> None:
    loads = np.array([-SPHERES.mass[0] * np.array(pull), load])  # the first is in balance
    drawn = dataclasses.replace(SPHERES, load=loads)
    corners = np.array(plan(changed(bodies=(drawn, WALL), gravity=np.array(pull)))["walls"][0])
    assert np.linalg.norm(corners[1] - corners[0]) == pytest.approx(2 * far)


@pytest.mark.parametrize(
    ("free_spin", "refused"), [((True, False, True), True), ((False, True, False), False)]
)
def test_a_spin_about_a_locked_axis_is_refused(free_spin: tuple[bool, ...], refused: bool) -> None:
    one = SPHERES.part(slice(0, 1))
    spinning = dataclasses.replace(
        one, spin=np.array([[0.0, 2.0, 0.0]]), free_spin=np.array([free_spin])
    )
    ask = dataclasses.replace(changed(bodies=(spinning, WALL)), observables=(Displacement(0),))
    reason = ADAPTER.refuses(ask, "default") or ""
    assert ("a spin in a locked freedom" in reason) is refused
