"""Claims about single kernels of DDA, which have truths by hand."""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np
import pytest

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.assemble import contact_force
from vv.engines.dda.general.augmented.forces import gap_rounding, take_over_forces
from vv.engines.dda.general.augmented.multipliers import energy_of_fall
from vv.engines.dda.general.setting import Law, Trial
from vv.engines.dda.law import OPEN, SLIDE, STICK
from vv.engines.dda.limits import FIRM
from vv.scene import Vector

KN, KS, MU = 1e6, 4e5, 0.5  # N/m
GAP, FORCE = -2e-3, 3000.0  # m, N
SPRING, ALONG = (1e-4, -2e-4, 0.0), (0.0, 1.0, 0.0)
MOVED = (3e-4, 5e-4, -1e-3)  # m, of the wall


class Closed(NamedTuple):
    """Of contacts only what their forces depend on."""

    normal: Vector
    gap: Vector
    spring: Vector


class Corners(NamedTuple):
    """Of a motion only its vertices."""

    vertex: Vector


def _force(touch: Any, state: int) -> Any:
    return contact_force(0, touch, state, FORCE, ALONG, MOVED, Law(KN, KS, MU, 1.0))


@pytest.mark.parametrize(
    ("state", "rubs"),
    [
        (OPEN, None),
        (STICK, -KS * (np.array(SPRING) - [3e-4, 5e-4, 0.0])),
        (SLIDE, -MU * FORCE * np.array(ALONG)),
    ],
)
def test_a_contact_feels_the_way_of_its_wall(state: int, rubs: Vector | None) -> None:
    """What goes along the normal presses, what goes across it is taken from the stretch."""
    touch = Closed(np.array([[0.0, 0.0, 1.0]]), np.array([GAP]), np.array([SPRING]))
    kernel: Any = numba.njit(_force)
    pressed = -KN * (GAP + 1e-3) * np.array([0.0, 0.0, 1.0])
    due = np.zeros(3) if rubs is None else rubs + pressed
    assert kernel(touch, state) == pytest.approx(due)


def _blur(corners: Any) -> float:
    return gap_rounding(corners)


def test_a_gap_is_blurred_by_as_many_roundings_of_the_farthest_corner() -> None:
    corners = Corners(np.array([[0.3, 0.0, 0.0], [2.0, -3.0, 6.0], [1.0, 1.0, 1.0]]))
    kernel: Any = numba.njit(_blur)
    assert kernel(corners) == pytest.approx(7.0 * 1024 * 2.0**-52)


class Loaded(NamedTuple):
    """Of bodies only what acts on them."""

    mass: Vector
    weight: Vector
    load: Vector


def _gained(bodies: Any) -> float:
    return energy_of_fall(bodies, 0.1)


def test_the_energy_of_a_fall_is_the_way_times_all_loads() -> None:
    weight = np.array([[0.0, 0.0, -10.0], [0.0, 0.0, -5.0]])
    bodies = Loaded(np.ones(2), weight, np.array([[0.0, 0.0, 0.0], [12.0, 0.0, 0.0]]))
    kernel: Any = numba.njit(_gained)
    assert kernel(bodies) == pytest.approx(0.1 * (10.0 + 13.0))


class Borne(NamedTuple):
    """Of contacts only what multipliers take over."""

    key: Index
    normal: Vector
    gap: Vector
    push: Vector
    spring: Vector
    direction: Vector
    column: Index
    field: Vector
    columns: Index


def _taken_over(
    touch: Any, used: Index, rub: Vector, relative: Vector, gap: Vector, shut: Vector, u: Vector
) -> Any:
    trial = Trial(used, rub, shut, relative)
    return take_over_forces(touch, trial, gap, u, Law(KN, KS, MU, 1.0))


taken_over: Any = numba.njit(_taken_over)
USED = np.array([OPEN, STICK, SLIDE])


def three_contacts() -> dict[str, Any]:
    """An open one, one that sticks, one that slides; springs bear 1 N, multipliers all else."""
    touch = Borne(
        np.arange(3),
        np.tile([0.0, 0.0, 1.0], (3, 1)),
        np.array([1e-3, -3e-3, -1.5e-3]),
        np.zeros(3),
        np.array([[0.0, 0.0, 0.0], [1e-3, 2e-3, 0.0], [0.0, 1.875e-3, 0.0]]),
        np.array([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        np.zeros((3, 1), int),
        np.full((3, 1, 3), [0.0, -2.0, 0.0]),
        np.ones(3, int),
    )
    rub = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 750.0, 0.0]])
    relative = np.array([[0.0, 0.0, 1e-4], [0.0, 0.0, 1e-6], [1e-2, 0.0, 0.0]])
    shut = relative * [0.0, 0.0, -1.0]  # walls move away
    moves = {"relative": relative, "gap": np.zeros(3), "shut": shut, "u": np.zeros(1)}
    return {"touch": touch, "used": USED, "rub": rub, **moves}


def test_multipliers_take_over_what_springs_bear() -> None:
    """Forces of shifted gaps, stretches and slip: 2999 and 1500 N, nothing where it is open."""
    contacts = three_contacts()
    contacts["relative"][1, :2] = 1e-6, -2e-6
    most, off, turns = taken_over(*contacts.values())
    touch = contacts["touch"]
    assert (most, turns) == (pytest.approx(2999.0), False)
    assert off == pytest.approx(1.0)
    assert touch.push == pytest.approx([0.0, 2999.0, 1500.0])
    stretched = [[0.0, 0.0, 0.0], [1.001e-3, 1.998e-3, 0.0], [0.0, 1.875e-3, 0.0]]
    assert touch.spring == pytest.approx(np.array(stretched))


@pytest.mark.parametrize(
    ("what", "where", "value", "off"),
    [
        ("touch.gap", 0, -2e-4, 100.0),  # an open contact would press
        ("gap", 1, 4e-6, 5.0),  # a spring presses
        ("gap", 2, -7e-6, 7.0),
        ("touch.gap", 1, 3e-3, 3001.0),  # it pulls
        ("relative", (1, 0), 3e-5, KS * 3e-5),  # a spring is stretched
        ("touch.spring", (1, 0), 8e-3, KS * 68.0**0.5 * 1e-3 - 1499.5),  # more than friction bears
        ("touch.spring", (2, 0), 1e-4, KS * 1e-4),  # friction has turned
        ("touch.direction", (2, 1), 0.9, 75.0),  # or does not oppose the slip
    ],
)
def test_the_error_of_a_force_is_what_springs_bear_or_what_breaks_the_law(
    what: str, where: Any, value: float, off: float
) -> None:
    contacts = three_contacts()
    _, _, name = what.rpartition(".")
    array = getattr(contacts["touch"], name) if "." in what else contacts[name]
    array[where] = value
    assert taken_over(*contacts.values())[1] == pytest.approx(off)


@pytest.mark.parametrize(
    ("slip", "before", "turns"),
    [(3e-2, 1e-4, False), (1e-5, 1e-4, True), (1e-5, 0.0, False)],
)
def test_friction_turns_slowly_where_slip_is_faint(slip: float, before: float, turns: bool) -> None:
    """It does where a pass turns it by less than FIRM, and has not yet come to its direction."""
    contacts = three_contacts()
    opened = 2e-2
    contacts["relative"][2] = slip, 0.0, opened
    contacts["shut"][2, 2] = -opened
    contacts["touch"].gap[2] -= opened
    contacts["touch"].spring[2, 0] = before
    assert (KS * slip < FIRM * MU * 1500.0) == (slip < 1e-3)
    assert taken_over(*contacts.values())[2] is turns


@pytest.mark.parametrize(("share", "turns"), [(0.9, True), (1.1, False)])
@pytest.mark.parametrize("moved", ["u", "shut"])
def test_friction_that_turns_by_rounding_of_displacements_does_not_turn(
    moved: str, share: float, turns: bool
) -> None:
    """One unknown and a wall are two terms of a slip, whose sum is rounded by 2 eps of their size.

    Stiffer springs would only turn it farther.
    """
    contacts = three_contacts()
    contacts["touch"].spring[2, 0] = 1e-4
    contacts["relative"][2, 0] = 1e-5
    size = share * 1e-4 / (2 * 2.0**-52)
    contacts["u"][0], contacts["shut"][2, 1] = (size / 2, 0.0) if moved == "u" else (0.0, size)
    assert taken_over(*contacts.values())[2] is turns
