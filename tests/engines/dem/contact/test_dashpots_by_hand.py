"""Claims about forces of several dashpots in one step: a linear system of equations, by numpy."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.dem.contact import dashpots
from vv.engines.dem.contact.dashpots import FORCE, RATE, SPRING, ViscousContacts
from vv.engines.dem.contact.hertz import Elastic
from vv.engines.dem.contact.linear import Linear
from vv.engines.dem.space.neighbours import DASHPOT_COLUMNS, OVERLAP
from vv.engines.dem.terms.drag import Drag
from vv.scene import Vector

DT, FAR = 0.01, 1e9  # s, N
MASS = np.array([2.0, 0.7, 5.0])  # of rows 0, 1 and 2; row 3 is the ground, row 4 a moving wall
ENDS = np.array([[0, 1], [1, 2], [0, 2], [3, 0], [4, 2]])
RATES = np.array([90.0, 20.0, 45.0, 150.0, 70.0])  # N s/m
LOCKED = np.array([0.6, 0.0, 0.8])
forces = plain(dashpots.add_viscous_forces)


class Several(NamedTuple):
    """Contacts between unlike bodies, and their velocities before and loads in a step."""

    contacts: ViscousContacts
    v: Vector
    push: Vector
    hold: Vector | None

    def split(self, k: int | None) -> tuple[ViscousContacts, ViscousContacts | None]:
        """The contacts in one group, or in two of which the first has k."""
        ends, kept = self.contacts
        if k is None:
            return self.contacts, None
        return (ends[:k], kept[:k]), (ends[k:], kept[k:])


def several(springs: float, held: bool = False) -> Several:
    """Contacts with springs that press so much [N]; held: body 2 has a locked direction."""
    random = np.random.default_rng(8)
    normals = random.normal(size=(5, 3))
    kept = np.zeros((5, DASHPOT_COLUMNS))
    kept[:, :3] = normals / np.linalg.norm(normals, axis=1)[:, None]
    kept[:, SPRING], kept[:, RATE], kept[:, FORCE] = springs, RATES, 77.0
    v, push = random.normal(size=(5, 3)), 50.0 * random.normal(size=(5, 3))
    v[3] = 0.0
    hold = np.array([np.eye(3), np.eye(3), np.eye(3) - np.outer(LOCKED, LOCKED)])
    return Several((ENDS.copy(), kept), v, push, hold if held else None)


def solved(one: Several, eta: float, lag: float, steady: Vector) -> tuple[Vector, Vector]:
    """The forces (5,) [N] and the new velocities (5, 3), from one system of equations."""
    n, v = one.contacts[1][:, :3], one.v.reshape(-1)
    hold = np.tile(np.eye(3), (3, 1, 1)) if one.hold is None else one.hold
    apart = np.zeros((5, 15))  # by which velocities bodies part along each normal
    for k, (i, j) in enumerate(ENDS):
        apart[k, 3 * i : 3 * i + 3], apart[k, 3 * j : 3 * j + 3] = n[k], -n[k]
    slow = MASS + (1.0 - lag) * eta * DT
    yielding = np.zeros((15, 15))
    new = v.copy()
    for i in range(3):
        part = slice(3 * i, 3 * i + 3)
        yielding[part, part] = DT / slow[i] * hold[i]
        acting = hold[i] @ one.push[i] + eta * (steady[i] - lag * v[part])
        new[part] = v[part] + DT / slow[i] * (acting - (1.0 - lag) * eta * v[part])
    wall = slice(12, 15)
    new[wall] = 1.5 * v[wall]
    rate = RATES[:, None]
    matrix = np.eye(5) + (1.0 - lag) * rate * (apart @ yielding @ apart.T)
    known = RATES * (lag * apart @ v + (1.0 - lag) * apart @ new)
    force = np.linalg.solve(matrix, known)
    return np.asarray(force), np.asarray(new - yielding @ apart.T @ force).reshape(5, 3)


@pytest.mark.parametrize("groups", [None, 0, 2, 5])
@pytest.mark.parametrize(
    ("eta", "lag", "held"),
    [(0.0, 0.5, False), (30.0, 0.5, True), (9.0, 0.25, True), (30.0, 1, False)],
)
def test_forces_balance_the_velocities_to_which_they_lead(
    eta: float, lag: float, held: bool, groups: int | None
) -> None:
    """They act on both ends, those on walls on the ground, and take what their powers say."""
    one, steady = several(FAR, held), np.zeros((3, 3))
    steady[1] = 0.3, -0.2, 0.6
    due, velocities = solved(one, eta, lag, steady)
    new, push = np.zeros((5, 3)), one.push[:4].copy()
    new[4] = 1.5 * one.v[4]
    drag = Drag(eta, steady) if eta else None
    taken = forces(one.split(groups), push, one.v, new, MASS, one.hold, DT, drag, lag)
    assert one.contacts[1][:, FORCE] == pytest.approx(due, rel=1e-12)
    assert new == pytest.approx(velocities, rel=1e-12)
    acting = due[:, None] * one.contacts[1][:, :3]
    whole = one.push[:4].copy()
    for (i, j), force in zip(ENDS, acting, strict=True):
        whole[min(i, 3)] -= force
        whole[j] += force
    assert push == pytest.approx(whole, rel=1e-12)
    i, j = ENDS.T
    powers = [float((acting * (w[i] - w[j])).sum()) for w in (one.v, velocities)]
    assert taken == pytest.approx(powers, rel=1e-12)
    plain(dashpots.apply_forces)(one.contacts, push, -1.0)
    assert push == pytest.approx(one.push[:4], rel=1e-12)


@pytest.mark.parametrize("size", [1e-9, 1e9])
def test_small_forces_are_as_accurate_as_large_ones(size: float) -> None:
    one = several(FAR * size)
    one = one._replace(v=size * one.v, push=size * one.push)
    due, _ = solved(one, 0.0, 0.5, np.zeros((3, 3)))
    new = np.zeros((5, 3))
    new[4] = 1.5 * one.v[4]
    forces((one.contacts, None), one.push[:4].copy(), one.v, new, MASS, None, DT, None, 0.5)
    assert one.contacts[1][:, FORCE] == pytest.approx(due, rel=1e-12, abs=0.0)


def test_a_contact_is_corrected_at_once_to_what_balances_it_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Two sweeps suffice for one contact, of which the second changes nothing."""
    names: Any = forces.__globals__
    original, done = names["sweep"], []

    def counted(contacts: Any, *others: Any) -> Any:
        done.append(contacts)
        return original(contacts, *others)

    monkeypatch.setitem(names, "sweep", counted)
    for size in (1.0, 1e6):
        done.clear()
        alone(2.0 * size, FAR * size)
        assert len(done) == 4  # one for each group of contacts


def test_a_contact_that_is_open_has_no_force_and_is_left_out() -> None:
    one = several(FAR)
    one.contacts[1][1:, RATE] = 0.0
    new, push = np.zeros((5, 3)), one.push[:4].copy()
    forces((one.contacts, None), push, one.v, new, MASS, None, DT, None, 0.5)
    assert one.contacts[1][0, FORCE] != 0.0
    assert not one.contacts[1][1:, FORCE].any()


def alone(speed: float, spring: float) -> tuple[float, Vector]:
    """The force between two bodies that approach at so much along x, and their new velocities."""
    kept = np.zeros((1, DASHPOT_COLUMNS))
    kept[0, [0, SPRING, RATE]] = 1.0, spring, 90.0
    contacts = np.array([[0, 1]]), kept
    v, new = np.zeros((3, 3)), np.zeros((3, 3))
    v[0, 0] = speed
    forces((contacts, None), np.zeros((3, 3)), v, new, MASS[:2], None, DT, None, 0.5)
    return float(kept[0, FORCE]), new


@pytest.mark.parametrize("speed", [-2.0, 2.0])
def test_a_dashpot_never_pulls_more_than_its_spring_pushes(speed: float) -> None:
    """It meets any approach, and of parting as much as leaves no pull."""
    reduced = MASS[0] * MASS[1] / (MASS[0] + MASS[1])
    due = 90.0 * speed / (1.0 + 0.5 * 90.0 * DT / reduced)
    for spring, force in ((1.01 * abs(due), due), (0.8 * abs(due), max(due, -0.8 * abs(due)))):
        found, new = alone(speed, spring)
        assert found == pytest.approx(force)
        assert new[:2, 0] == pytest.approx([speed - DT * force / MASS[0], DT * force / MASS[1]])


update = plain(dashpots.update_contact)
NORMAL = (0.0, 0.6, -0.8)


@pytest.mark.parametrize(
    ("ends", "reduced"), [((0, 1), 2.0 * 0.7 / 2.7), ((3, 2), 5.0), ((1, 3), 0.7)]
)
@pytest.mark.parametrize(
    ("before", "closing"), [(1e-3, 1.0), (np.inf, 1.0), (0.0, 1.5), (-3e-4, 0.5 + 4 / 7)]
)
def test_a_contact_knows_its_normal_its_push_and_its_viscosity(
    ends: tuple[int, int], reduced: float, before: float, closing: float
) -> None:
    """The viscosity of springs has a factor in the step in which they meet, 1/2 and its part."""
    kept = np.full((1, DASHPOT_COLUMNS), 9.0)
    kept[0, OVERLAP] = before
    contacts = np.array([ends]), kept
    update(contacts, 0, NORMAL, 4e-4, 0.03, Linear(1e4, None, 40.0), MASS)
    assert kept[0] == pytest.approx([*NORMAL, 4.0, 40.0 * closing, 9.0, 4e-4])
    update(contacts, 0, NORMAL, 4e-4, 0.03, Elastic(1e8, None, 0.2, (0.0, 0.0)), MASS)
    push = 4.0 / 3.0 * 1e8 * np.sqrt(0.03 * 4e-4) * 4e-4
    rate = 2.0 * 0.2 * np.sqrt(reduced * 2e8 * np.sqrt(0.03 * 4e-4))
    assert kept[0, SPRING:FORCE] == pytest.approx([push, rate])
    for apart in (0.0, -1e-4):
        update(contacts, 0, NORMAL, apart, 0.03, Linear(1e4, None, 40.0), MASS)
        assert kept[0] == pytest.approx([*NORMAL, 0.0, 0.0, 9.0, apart])


def test_all_contacts_are_brought_up_to_date_pairs_first_and_walls_at_where_they_are() -> None:
    """Spheres of 0.3 and 0.5 m that meet obliquely; one meets a wall that moves."""
    radii, gap, offset = np.array([[0.3, 0.5]]), np.array([-0.1]), np.array([[0.42, 0.0, 0.56]])
    pairs = np.array([[0, 1]]), offset, gap, radii
    n = np.array([[0.0, 0.6, -0.8]])
    walls: Any = np.array([1]), n, np.array([-0.02]), np.array([0.5])
    u = np.zeros((4, 3))
    u[0], u[1], u[3] = [0.01, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.1, 0.0]
    kept = np.zeros((2, DASHPOT_COLUMNS))
    kept[:, OVERLAP] = np.inf
    contacts = np.array([[0, 1], [3, 1]]), kept
    moving = np.array([3]), np.zeros((1, 3))
    law = Elastic(1e8, None, 0.2, (0.0, 0.0))
    plain(dashpots.update_contacts)(contacts, u, pairs, walls, moving, law, MASS[:2])
    d = offset[0] + u[1] - u[0]
    overlaps = 0.8 - np.linalg.norm(d), 0.02 - n[0] @ (u[1] - u[3])
    assert kept[:, OVERLAP] == pytest.approx(overlaps)
    assert kept[0, :3] == pytest.approx(d / np.linalg.norm(d))
    assert kept[1, :3] == pytest.approx(n[0])
    for line, radius, mass in zip(kept, (0.15 / 0.8, 0.5), (1.4 / 2.7, 0.7), strict=True):
        root = np.sqrt(radius * line[OVERLAP])
        assert line[SPRING] == pytest.approx(4.0 / 3.0 * 1e8 * root * line[OVERLAP])
        assert line[RATE] == pytest.approx(0.4 * np.sqrt(mass * 2e8 * root))
    plain(dashpots.update_contacts)(contacts, u, None, walls, None, law, MASS[:2])
    assert kept[0, OVERLAP] == pytest.approx(0.02 - n[0] @ u[1])
