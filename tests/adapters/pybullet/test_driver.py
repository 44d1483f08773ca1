"""Claims about the driver of PyBullet, without it: what it is told, and how it is stepped.

The module in its place moves free bodies as semi-implicit Euler steps do; expected numbers are by
hand, for blocks whose masses, loads and speeds are unlike.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from tests.support.adapters.fake_modules import driver_with
from vv.codes.driver_protocol import RunError, Stopwatch

DT = 0.1
HALF = [0.5, 1.0, 1.5]
EYE = np.eye(3).tolist()


class Bullet:
    """Bodies that nothing touches: v += dt (g + F/m), then x += dt v, in each step."""

    DIRECT, GEOM_BOX, GEOM_MESH, WORLD_FRAME = "direct", "box", "mesh", "world"

    def __init__(self) -> None:
        self.told: list[tuple[str, Any]] = []
        self.bodies: list[dict[str, Any]] = []
        self.gravity = np.zeros(3)

    def connect(self, how: str) -> None:
        assert how == self.DIRECT

    def resetSimulation(self) -> None:  # noqa: N802
        self.bodies, self.told = [], []

    def setPhysicsEngineParameter(self, **given: Any) -> None:  # noqa: N802
        self.told.append(("engine", given))

    def createCollisionShape(self, kind: str, **given: Any) -> int:  # noqa: N802
        self.told.append((kind, given))
        return len(self.told) - 1

    def createMultiBody(self, mass: float, shape: int, **given: Any) -> int:  # noqa: N802
        start = np.array(given["basePosition"], float)
        body = {"mass": mass, "x": start, "v": np.zeros(3), "push": np.zeros(3), "shape": shape}
        self.bodies.append(body | {"turn": given["baseOrientation"], "told": {}})
        return len(self.bodies) - 1

    def changeDynamics(self, body: int, link: int, **given: Any) -> None:  # noqa: N802
        assert link == -1
        self.bodies[body]["told"].update(given)

    def resetBaseVelocity(self, body: int, v: list[float], spin: list[float]) -> None:  # noqa: N802
        self.bodies[body]["v"] = np.array(v)
        self.bodies[body]["spin"] = spin

    def setGravity(self, *field: float) -> None:  # noqa: N802
        self.gravity = np.array(field)

    def applyExternalForce(  # noqa: N802
        self, body: int, link: int, force: list[float], place: Any, frame: str
    ) -> None:
        assert (link, frame) == (-1, self.WORLD_FRAME)
        assert np.array_equal(place, self.bodies[body]["x"])  # at the centre: it turns nothing
        self.bodies[body]["push"] = np.array(force)

    def stepSimulation(self) -> None:  # noqa: N802
        for body in self.bodies:
            if body["mass"]:
                body["v"] = body["v"] + DT * (self.gravity + body["push"] / body["mass"])
                body["x"] = body["x"] + DT * body["v"]
            body["push"] = np.zeros(3)

    def getBasePositionAndOrientation(self, body: int) -> Any:  # noqa: N802
        return tuple(self.bodies[body]["x"]), (0.0, 0.0, 0.0, 1.0)

    def getBaseVelocity(self, body: int) -> Any:  # noqa: N802
        return tuple(self.bodies[body]["v"]), (0.0, 0.0, 0.0)


BULLET = Bullet()


@pytest.fixture
def driver() -> Iterator[Any]:
    names = [name for name in dir(Bullet) if not name.startswith("_")]
    yield from driver_with(
        "adapters.pybullet.driver", {"pybullet": {name: getattr(BULLET, name) for name in names}}
    )


def block(number: int, **changes: Any) -> dict[str, Any]:
    whole = {
        "body": number, "centre": [1.0, 2.0, 3.0], "half": HALF, "axes": EYE, "mass": 4.0,
        "moments": [1.0, 2.0, 3.0], "velocity": [1.5, 0.0, -2.0], "spin": [0.1, 0.2, 0.3],
        "load": [8.0, 0.0, 4.0], "free": [True, False, True], "free_spin": [True] * 3,
        "vertices": [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]],
    }  # fmt: skip
    return {**whole, **changes}


def asked(**changes: Any) -> dict[str, Any]:
    whole = {
        "dt": DT, "steps": 4, "stride": 2, "mu": 0.25, "size": 2.0, "unit": 1.0,
        "gravity": [1.0, 7.0, -5.0],
        "shaking": [], "until": None, "driven": [True, False, True], "walls": [],
        "blocks": [block(1)], "observe": [["displacement", 1], ["velocity", 1]],
    }  # fmt: skip
    return {**whole, **changes}


def wall(**changes: Any) -> dict[str, Any]:
    whole = {"body": 0, "half": [9.0, 9.0, 1.0], "centre": [0.0, 0.0, -1.0], "axes": EYE}
    return {**whole, "motion": [[[0.1, 0.0, 0.2], 2.0, 0.5]], **changes}


def test_free_flight_is_exact_at_outputs_with_half_a_step_of_forces_first(driver: Any) -> None:
    values, facts = driver.simulate(asked(), True, Stopwatch())
    assert facts == {}
    assert values.shape == (2, 3, 3)
    # x: 1 + 8/4 = 3 m/s2 from 1.5 m/s; z: -5 + 4/4 = -4 from -2; y is not driven
    for column, t in enumerate((0.0, 0.2, 0.4)):
        assert values[0, column] == pytest.approx(
            [1.5 * t + 1.5 * t**2, 0.0, -2.0 * t - 2.0 * t**2]
        )
        assert values[1, column] == pytest.approx([1.5 + 3 * t, 0.0, -2.0 - 4 * t])
    unwatched, _ = driver.simulate(asked(), False, Stopwatch())
    assert not unwatched[:, 1:].any()
    alone, _ = driver.simulate(asked(observe=[["displacement", 1]]), True, Stopwatch())
    assert alone[0] == pytest.approx(values[0])


def test_a_last_step_beyond_the_end_is_taken_for_velocities_only(
    driver: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    taken: list[float] = []
    push = driver.push

    def noted(ask: Any, base: Any, moving: Any, t: float, part: float) -> None:
        taken.append(t)
        push(ask, base, moving, t, part)

    monkeypatch.setattr(driver, "push", noted)
    for observe, steps in (([["velocity", 1]], 5), ([["displacement", 1]], 4)):
        taken.clear()
        driver.simulate(asked(observe=observe), True, Stopwatch())
        assert taken == pytest.approx([0.1 * k for k in range(steps)])


def test_blocks_are_seen_from_the_wall_that_moves_and_told_from_the_ground(driver: Any) -> None:
    ask = asked(walls=[wall()])
    values, _ = driver.simulate(ask, True, Stopwatch())
    a, w, phase = np.array([0.1, 0.0, 0.2]), 2.0, 0.5
    field, x, moved = np.array([3.0, 0.0, -4.0]), np.zeros(3), []
    v = np.array([1.5, 0.0, -2.0]) - a * w * math.cos(phase)
    for k in range(5):
        part = 0.5 if k == 0 else 1.0
        v_next = v + part * 0.1 * (field + a * w**2 * math.sin(w * 0.1 * k + phase))
        moved.append((x, (v + v_next) / 2))
        v, x = v_next, x + 0.1 * v_next
    for column, k in enumerate((0, 2, 4)):
        t = 0.1 * k
        base = a * (math.sin(w * t + phase) - math.sin(phase))
        assert values[0, column] == pytest.approx(moved[k][0] + base)
        if k:
            speed = a * w * math.cos(w * t + phase)
            assert values[1, column] == pytest.approx(moved[k][1] + speed)
    assert driver.Base(asked()).moved(1.0).tolist() == [0.0, 0.0, 0.0]


def test_shaking_ends_with_half_of_it_in_the_step_about_its_end(driver: Any) -> None:
    sines = [[[2.0, 0.0, 4.0], 3.0, 0.25]]
    for t, until, part in (
        (0.1, None, 1.0), (0.1, 0.22, 1.0), (0.15, 0.24, 1.0), (0.2, 0.22, 0.7),
        (0.25, 0.22, 0.2), (0.3, 0.22, 0.0)
    ):  # fmt: skip
        size = part * math.sin(3 * t + 0.25)
        found = driver.shaken(asked(shaking=sines, until=until), t)
        assert found == pytest.approx([2 * size, 0.0, 4 * size])
    driver.build(asked())
    driver.push(asked(shaking=sines), driver.Base(asked()), [], 0.1, 0.5)
    size = math.sin(0.55)
    assert BULLET.gravity == pytest.approx([0.5 * (1 + 2 * size), 0.0, 0.5 * (-5 + 4 * size)])


def test_what_the_engine_is_told_of_bodies_and_contacts(driver: Any) -> None:
    hull = block(2, half=[], free_spin=[False] * 3, axes=[[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    held = block(3, free=[False] * 3, free_spin=[False] * 3)
    assert block(1)["free"] == [True, False, True]  # in part free is not fixed
    turned = block(4, free=[False] * 3, free_spin=[False, True, False])
    ask = asked(walls=[wall()], blocks=[block(1), hull, held, turned])
    bodies = driver.build(ask)
    assert list(bodies) == [0, 1, 2, 3, 4]
    told = BULLET.told
    assert told[0] == ("engine", {
        "fixedTimeStep": 0.1, "numSolverIterations": 1000, "numSubSteps": 0,
        "enableConeFriction": 1, "solverResidualThreshold": 0, "contactSlop": 0, "erp": 0,
        "contactERP": 0, "contactBreakingThreshold": 0.4, "deterministicOverlappingPairs": 1,
    })  # fmt: skip
    assert [body["mass"] for body in BULLET.bodies] == [0.0, 4.0, 4.0, 0.0, 4.0]
    assert {body["told"]["lateralFriction"] for body in BULLET.bodies} == {0.5}
    assert {body["told"]["restitution"] for body in BULLET.bodies} == {0}
    speed = 0.2 * math.cos(0.5)
    assert BULLET.bodies[1]["v"] == pytest.approx([1.5 - speed, 0.0, -2.0 - 2 * speed])
    assert BULLET.bodies[1]["spin"] == [0.1, 0.2, 0.3]
    assert BULLET.bodies[1]["told"]["localInertiaDiagonal"] == [1.0, 2.0, 3.0]
    assert "localInertiaDiagonal" not in BULLET.bodies[3]["told"]
    assert BULLET.bodies[4]["told"]["localInertiaDiagonal"] == [1.0, 2.0, 3.0]
    assert told[BULLET.bodies[1]["shape"]] == ("box", {"halfExtents": HALF})
    # corners about the hull's own axes: the first is y, the second -x
    assert told[BULLET.bodies[2]["shape"]] == (
        "mesh", {"vertices": [[2.0, -1.0, 3.0], [5.0, -4.0, 6.0]]}
    )  # fmt: skip
    root = math.sqrt(0.5)
    assert BULLET.bodies[2]["turn"] == pytest.approx([0.0, 0.0, root, root])


@pytest.mark.parametrize(("blocks", "sweeps"), [(1, 200), (2, 1000)])
def test_more_than_two_bodies_have_more_sweeps(driver: Any, blocks: int, sweeps: int) -> None:
    driver.build(asked(walls=[wall()], blocks=[block(k + 1) for k in range(blocks)]))
    assert BULLET.told[0][1]["numSolverIterations"] == sweeps


@pytest.mark.parametrize("angle", [0.7, 2.5, 3.0, -3.0])
@pytest.mark.parametrize(
    "axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 2, 3), (-3, 1, 2), (2, 3, -1)]
)
def test_a_quaternion_is_half_the_angle_about_its_axis(
    driver: Any, axis: tuple[int, int, int], angle: float
) -> None:
    n = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    turn = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    found = np.array(driver.quaternion(turn))
    wanted = np.array([*(math.sin(angle / 2) * n), math.cos(angle / 2)])
    assert found * np.sign(found @ wanted) == pytest.approx(wanted, abs=1e-12)


@pytest.mark.parametrize(
    ("way", "said"), [(0.0019, ""), (0.0021, "moved 0.0021 m"), (-0.0021, "moved 0.0021 m")]
)
def test_a_body_that_leaves_its_lock_does_not_count(driver: Any, way: float, said: str) -> None:
    ask = asked()
    bodies = driver.build(ask)
    BULLET.bodies[0]["x"] = np.array([1.5, 2.0 + way, 3.25])
    row = np.zeros((1, 3))
    if said:
        with pytest.raises(RunError, match=f"body 1 {said} along a locked direction"):
            driver.read(ask, [("displacement", bodies[1])], row, driver.Base(ask), 0.0)
        return
    driver.read(ask, [("displacement", bodies[1])], row, driver.Base(ask), 0.0)
    assert row[0] == pytest.approx([0.5, way, 0.25])


def test_answers_are_in_metres_whatever_the_unit_of_the_plan(driver: Any) -> None:
    metres, _ = driver.simulate(asked(), True, Stopwatch())
    halves, _ = driver.simulate(asked(unit=0.5), True, Stopwatch())
    assert np.array_equal(halves, 0.5 * metres)
