"""Claims about the driver of LMGC90, without it: what it is told, and what is made of its places.

Expected numbers are by hand, for a block and a wall whose sizes, speeds and forces are unlike.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.support.adapters.fake_modules import driver_with
from vv.codes.driver_protocol import RunError, Stopwatch

DT, MASS = 0.1, 4.0
STILL = [0.0] * 6
FACE = [[0, 1, 2, 3]]
CORNERS = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 2.0, 0.0], [0.0, 2.0, 0.0]]


class Solver:
    """Notes all that it is told; its bodies begin at rest where they are put.

    In each step a body's velocity becomes the next of those it is given, and its place moves by
    the mean of both.
    """

    speeds: tuple[tuple[float, ...], ...] = ()

    def __init__(self) -> None:
        self.told: list[tuple[Any, ...]] = []
        self.places: list[list[float]] = []
        self.step = 0

    def __getattr__(self, name: str) -> Any:
        return lambda *given: self.told.append((name, *given))

    def set_one_polyr(self, kind: str, place: list[float], *more: Any) -> None:
        self.told.append(("polyr", kind, place, *more))
        self.places.append([*place])

    def get_initial_state(self) -> Any:
        return SimpleNamespace(init_bodies=[[*place, 0.0] for place in self.places])

    def compute_one_step(self) -> Any:
        self.step += 1
        for place, row in zip(self.places, self.speeds, strict=True):
            before = row[self.step - 2] if self.step > 1 else 0.0
            place[0] += DT * (row[self.step - 1] + before) / 2
        return SimpleNamespace(bodies=[[*place, 0.0] for place in self.places])


@pytest.fixture
def driver() -> Iterator[Any]:
    held = SimpleNamespace(LMGC90Solver=Solver)
    yield from driver_with(
        "adapters.lmgc90.driver",
        {"compas_lmgc90": {"_lmgc90": held}, "compas_lmgc90._lmgc90": vars(held)},
    )


def asked(**changes: Any) -> dict[str, Any]:
    """A block of 4 kg that moves and is pushed, on a wall that swings along x."""
    wall = {
        "body": 0, "centre": [0.0, 0.0, -1.0], "vertices": CORNERS, "faces": FACE,
        "motion": [[[0.1, 0.0, 0.0], 2.0, 0.5]],
    }  # fmt: skip
    block = {
        "body": 1, "name": "b", "centre": [0.0, 0.0, 2.0], "vertices": CORNERS, "faces": FACE,
        "mass": MASS, "velocity": [1.5, 0.0, -2.0], "load": [8.0, 6.0, 4.0],
        "free": [True, False, True], "free_spin": [False, True, False],
    }  # fmt: skip
    whole = {
        "dt": DT, "steps": 4, "stride": 2, "mu": 0.5, "density": 2000.0, "size": 2.0,
        "held": [True, True, False], "gravity": [1.0, 0.0, -5.0], "shaking": [], "until": None,
        "walls": [wall], "blocks": [block], "observe": [["displacement", 1], ["velocity", 1],
                                                        ["displacement", 0], ["velocity", 0]],
    }  # fmt: skip
    return {**whole, **changes}


def test_a_face_is_a_fan_of_triangles(driver: Any) -> None:
    assert driver.triangles([3, 5, 7, 9, 2]) == [3, 5, 7, 3, 7, 9, 3, 9, 2]


def test_one_steady_drive_or_one_sine_is_six_numbers(driver: Any) -> None:
    for sines, wanted in (
        ([], [2.0, 0.0, 0.0, -math.pi / 2, 1.0, 0.0]),
        ([(3.0, 5.0, 0.25)], [2.0, 3.0, 5.0, 0.25 - math.pi / 2, 1.0, 0.0]),
        ([(0.0, 9.0, 1.0), (3.0, 5.0, 0.25)], [2.0, 3.0, 5.0, 0.25 - math.pi / 2, 1.0, 0.0]),
    ):
        assert driver.drive(asked(), 2.0, sines) == pytest.approx(wanted)
    assert len(driver.drive(asked(), 2.0, [], 0.0, 0.3)) == 6


def test_an_impulse_is_a_force_that_falls_within_the_first_step(driver: Any) -> None:
    found = driver.drive(asked(), 2.0, [], 0.5)
    assert found == pytest.approx([0.0, 0.1, 0.5, 2.0 + 0.5 / 0.1, 2.0, 2.0])


def test_several_sines_are_a_table_of_every_step_and_one_more(driver: Any) -> None:
    found = driver.drive(asked(), 2.0, [(3.0, 5.0, 0.25), (1.0, 2.0, -0.5)])
    times = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]
    sums = [2 + 3 * math.sin(5 * t + 0.25) + math.sin(2 * t - 0.5) for t in times]
    assert found == pytest.approx([*times, *sums])


def test_sines_that_end_are_half_there_half_a_step_about_their_end(driver: Any) -> None:
    found = driver.drive(asked(), 2.0, [(3.0, 5.0, 0.25)], 0.0, 0.22)
    parts = [1.0, 1.0, 0.7, 0.0, 0.0, 0.0]  # (0.22 - t)/0.1 + 1/2 between 0 and 1
    sums = [2 + p * 3 * math.sin(0.5 * k + 0.25) for k, p in enumerate(parts)]
    assert found[6:] == pytest.approx(sums)


def test_a_wall_moves_at_its_speed_and_starts_half_a_step_ahead(driver: Any) -> None:
    ask = asked()
    made = driver.wall_drives(ask, ask["walls"][0])
    assert made["velocities"][1] == pytest.approx([0.0, 0.2, 2.0, 0.5, 1.0, 0.0])  # A w cos
    nothing = [0.0, 0.0, 0.0, -math.pi / 2, 1.0, 0.0]
    assert [made["velocities"][k] for k in (2, 3)] == [nothing] * 2
    assert [made["velocities"][k] for k in (4, 5, 6)] == [STILL] * 3
    speed = 0.2 * math.cos(0.5)
    assert made["velocity"] == pytest.approx([speed, 0.0, 0.0])
    assert made["ahead"] == pytest.approx([speed * 0.05, 0.0, 0.0])
    assert made["forces"] == {}


def test_a_block_is_pushed_by_weight_beside_9_81_loads_and_its_first_impulse(driver: Any) -> None:
    ask = asked()
    made = driver.block_drives(ask, ask["blocks"][0])
    assert made["velocities"] == {2: STILL}  # locked, and held; its turns are partly free
    # x: 4 (1) + 8 N, 4 1.5/(1/2) = 12 N s in a step; z: 4 (-5 + 9.81) + 4 N, -16 N s
    assert set(made["forces"]) == {1, 3}
    assert made["forces"][1] == pytest.approx([0.0, 0.1, 0.5, 12.0 + 120.0, 12.0, 12.0])
    assert made["forces"][3] == pytest.approx([0.0, 0.1, 0.5, 23.24 - 160.0, 23.24, 23.24])
    assert made["ahead"] == pytest.approx([0.075, 0.0, -0.1])


@pytest.mark.shows(
    "LMGC90 imposes a lock across the plane as a further constraint",
    "Its adapter omits such locks where nothing pushes in their direction",
)
def test_locks_that_nothing_pushes_on_are_left_free_and_shaking_acts_on_mass(driver: Any) -> None:
    shaking = [[[0.5, 0.25, 0.0], 3.0, 0.1]]
    ask = asked(held=[True, False, False], shaking=shaking)
    block = {**ask["blocks"][0], "free_spin": [False] * 3, "velocity": [0.0] * 3}
    made = driver.block_drives(ask, block)
    assert made["velocities"] == dict.fromkeys((4, 5, 6), STILL)
    assert made["forces"][1] == pytest.approx([12.0, 2.0, 3.0, 0.1 - math.pi / 2, 1.0, 0.0])
    assert made["forces"][2] == pytest.approx([6.0, 1.0, 3.0, 0.1 - math.pi / 2, 1.0, 0.0])
    ends = driver.block_drives({**ask, "until": 0.22}, block)
    assert ends["forces"][1] == pytest.approx(driver.drive(ask, 12.0, [(2.0, 3.0, 0.1)], 0.0, 0.22))


def test_what_the_solver_is_told_of_the_scene(driver: Any) -> None:
    solver, bodies = driver.build(asked())
    told = solver.told
    assert told[:5] == [
        ("initialize", 0.1, 0.5, False), ("add_one_tact_behav", "iqsc0", "IQS_CLB", [0.5]),
        ("set_materials", [2000.0]), ("set_see_tables", 0.02), ("set_nb_bodies", 2),
    ]  # fmt: skip
    wall, block = (row for row in told if row[0] == "polyr")
    flat = [x for corner in CORNERS for x in corner]
    assert wall[2] == pytest.approx([0.01 * math.cos(0.5), 0.0, -1.0])
    assert wall[3:] == ([1, 2, 3, 1, 3, 4], flat, 6, 0)
    assert block[2] == pytest.approx([0.075, 0.0, 1.9])
    assert block[3:] == ([1, 2, 3, 1, 3, 4], flat, 1, 2)
    drives = [row[1:3] + row[4:] for row in told if row[0] == "set_drvdof"]
    kept = [(1, k, True, False) for k in range(1, 7)]  # six numbers each
    assert drives == [*kept, (2, 2, True, False), (2, 1, False, True), (2, 3, False, True)]
    assert told[-1] == ("close_before_computing",)
    assert [body["body"] for body in bodies] == [0, 1]


def test_displacements_are_from_the_start_and_velocities_from_places(
    driver: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    wall, block = (0.5, 0.25, -0.5, 1.0), (1.5, 2.0, 3.0, -1.0)
    monkeypatch.setattr(Solver, "speeds", (wall, block))
    values, facts = driver.simulate(asked(size=20.0), True, Stopwatch())
    assert (values.shape, facts) == ((4, 3, 3), {})
    # they begin ahead by v dt/2; a step from rest adds half of the first speed
    moved = [0.1 * (2 * 1.5 + 2.0) / 2 + 0.075, 0.1 * (2 * (1.5 + 2 + 3) - 1.0) / 2 + 0.075]
    assert values[0, :, 0] == pytest.approx([0.0, *moved])
    assert values[1, :, 0] == pytest.approx([1.5, 2.0, -1.0])
    ahead = 0.01 * math.cos(0.5)
    moved = [0.1 * (2 * 0.5 + 0.25) / 2 + ahead, 0.1 * (2 * (0.5 + 0.25 - 0.5) + 1.0) / 2 + ahead]
    assert values[2, :, 0] == pytest.approx([0.0, *moved])
    assert values[3, :, 0] == pytest.approx([0.2 * math.cos(0.5), 0.25, 1.0])
    assert values[1, 0].tolist() == [1.5, 0.0, -2.0]
    unwatched, _ = driver.simulate(asked(), False, Stopwatch())
    assert not unwatched[:, 1:].any()


@pytest.mark.shows(
    "a plate that may rotate and slips by more than a quarter of its size would be wrong at any "
    "step"
)
@pytest.mark.parametrize(
    ("way", "said"),
    [
        ([0.0, 0.0019, 0.0], ""),  # a thousandth of 2 m, along y, which is locked
        ([0.0, 0.0021, 0.0], "block 'b' moved 0.0021 m along a locked direction"),
        ([0.0, -0.0021, 0.0], "block 'b' moved 0.0021 m along a locked direction"),
        ([0.59, 0.0, 0.0], ""),  # a quarter of 2 m from the wall, which is 0.1 m on
        ([0.61, 0.0, 0.0], "block 'b' can rotate and moved by more than a quarter"),
        ([-0.41, 0.0, 0.0], "block 'b' can rotate and moved by more than a quarter"),
        ([-0.39, 0.0, 0.0], ""),
    ],
)
def test_a_block_that_leaves_its_lock_or_its_place_does_not_count(
    driver: Any, way: list[float], said: str
) -> None:
    ask = asked()
    bodies, moved = [*ask["walls"], *ask["blocks"]], np.array([[0.1, 0.0, 0.0], way])
    if not said:
        driver.check(ask, bodies, moved)
        return
    with pytest.raises(RunError, match=said):
        driver.check(ask, bodies, moved)


def test_what_may_not_turn_or_has_no_wall_may_go_far_and_what_is_fixed_drifts(driver: Any) -> None:
    ask = asked()
    far = np.array([[0.0, 0.0, 0.0], [9.0, 0.0, 0.0]])
    straight = {**ask["blocks"][0], "free_spin": [False] * 3}
    driver.check(ask, [*ask["walls"], straight], far)
    driver.check({**ask, "walls": []}, [*ask["walls"], *ask["blocks"]], far)
    fixed = {**straight, "free": [False] * 3}
    driver.check(ask, [*ask["walls"], fixed], far)
