"""Claims about the lists of contacts in the bulk model, and what is kept in them: by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.dem.bulk.test_bulk_by_hand import (
    CLOSE,
    KN,
    MASS,
    PLACE,
    RADIUS,
    SPEED,
    WALLS,
    contacts,
    gap_of,
    grains,
)
from tests.support.plain import plain
from vv.engines.dem.bonds.block_forces import store_vector, vector_of
from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk import near, viscous
from vv.engines.dem.bulk.batches import NORMAL, PLACES, SUMS
from vv.engines.dem.bulk.cells import cells
from vv.engines.dem.bulk.contacts import pairs as pairs_of
from vv.engines.dem.bulk.contacts.gather import ARMS, FORCE, OFFSET, RADII
from vv.engines.dem.bulk.grains import Given, Grains, initial_grains
from vv.engines.dem.contact import dashpots
from vv.engines.dem.contact.dashpots import RATE, SPRING
from vv.engines.dem.contact.hertz import Elastic
from vv.scene import Vector


def searched(
    some: Grains, old: Any = None, width: float = 0.3, edge: float = 2.0
) -> tuple[Any, Any]:
    """The pairs and the walls near spheres, with friction."""
    sorted_into = plain(cells)(some, edge)
    before = (plain(near.no_contacts)(4),) * 2 if old is None else old
    pairs = plain(near.near_pairs)(some, sorted_into, width, before[0], True)
    return pairs, plain(near.near_walls)(some, WALLS, sorted_into, width, before[1], True)


def test_walls_are_listed_for_moving_spheres_that_are_within_the_skin() -> None:
    some = grains()
    _, edges = searched(some)
    told = {
        (int(some.original[i]), int(edges.other[k]))
        for i in range(4)
        for k in range(edges.start[i], edges.start[i + 1])
    }
    gaps = PLACE @ WALLS[:, :3].T - WALLS[:, 3] - RADIUS[:, None]
    due = {(i, k) for i, k in np.argwhere(gaps < 0.3).tolist() if np.isfinite(MASS[i])}
    assert told == due
    assert 0 < len(due) < 6
    assert [int(edges.one[k]) for k in range(edges.start[-1])] == sorted(edges.one.tolist())


def named(some: Grains, kind: str, one: Any, k: int) -> tuple[tuple[Any, ...], float]:
    """A contact by the numbers in the scene, and the sign of its force on the higher number."""
    a, b = int(some.original[one.one[k]]), int(one.other[k])
    if kind == "wall":
        return (kind, a, b), 1.0
    b = int(some.original[b])
    return (kind, min(a, b), max(a, b)), 1.0 if a < b else -1.0


def test_friction_stays_with_its_contact_and_turns_about_where_spheres_change_places() -> None:
    """Four in a row above a wall, which is then seen in a mirror: the order of cells turns."""
    row = np.array([[0.0, 0.0, 1.0], [1.2, 0.0, 1.0], [2.4, 0.0, 1.0], [3.6, 0.0, 1.0]])
    some = grains(row)
    old = searched(some, width=0.6, edge=1.2)
    force: dict[tuple[Any, ...], Vector] = {}
    for kind, one in zip(("pair", "wall"), old, strict=True):
        for k in range(len(one.other)):
            one.touching[k] = k != 1
            one.shear[k] = 1.0 + k, 2.0, 3.0
            key, sign = named(some, kind, one, k)
            force |= {key: sign * one.shear[k]} if one.touching[k] else {}
    some.row[:4, 0] *= -1.0
    again = searched(some, old, width=0.6, edge=1.2)
    assert some.original.tolist() == [3, 2, 0, 1]  # two share a cell
    found: dict[tuple[Any, ...], Vector] = {}
    for kind, one in zip(("pair", "wall"), again, strict=True):
        for k in range(len(one.other)):
            key, sign = named(some, kind, one, k)
            found |= {key: sign * one.shear[k]} if one.touching[k] else {}
            assert one.touching[k] or not one.shear[k].any()
    assert {key[0] for key in found} == {"pair", "wall"}
    left = {key for key in force if (key[0], key[2]) == ("wall", 1)}  # it is across the row
    assert set(found) == set(force) - left
    for key, one in found.items():
        assert one == pytest.approx(force[key])


def test_there_is_room_for_any_number_of_contacts() -> None:
    """At first for eight pairs of a sphere, and for as many walls as there are both together."""
    place, n = np.random.default_rng(1).uniform(0.0, 0.1, (40, 3)), 40
    planes = np.tile(WALLS[0], (4, 1))
    one = np.ones(n)
    some = plain(initial_grains)(Given(place, place, None, one, one, one))
    sorted_into, none = plain(cells)(some, 2.0), plain(near.no_contacts)(n)
    pairs = plain(near.near_pairs)(some, sorted_into, 0.1, none, False)
    assert len(pairs.other) == n * (n - 1) // 2
    assert (pairs.one < pairs.other).all()
    edges = plain(near.near_walls)(some, planes, sorted_into, 0.1, none, False)
    assert sorted(edges.other.tolist()) == sorted(n * [0, 1, 2, 3])


def test_closed_contacts_are_listed_with_their_normals_pushes_and_viscosities() -> None:
    """Contacts that closed in the step have half a step's viscosity and their part of it."""
    some, dt = grains(CLOSE), 0.02
    pairs, edges = searched(some)
    kept = plain(viscous.contact_arrays)(len(pairs.other) + len(edges.other))
    used = plain(viscous.list_closed)(some, pairs, edges, WALLS, kept, (KN, 6.0), dt)
    due = contacts(CLOSE)
    due = {key: one for key, one in due.items() if one[0] is not None or np.isfinite(MASS[one[1]])}
    assert used == len(due) >= 2
    closed_now = 0
    for k in range(used):
        i, j = kept[0][k]
        b = int(some.original[j])
        a = None if i == 4 else int(some.original[i])
        n = kept[1][k, :3]
        wall = int(np.abs(WALLS[:, :3] - n).sum(axis=1).argmin())
        key = ("wall", wall, b) if a is None else ("pair", min(a, b), max(a, b))
        _, second, normal, overlap = due[key]
        assert n == pytest.approx(normal if second == b else -normal)
        was = gap_of(CLOSE - dt * SPEED, key)
        share = 1.0 if was < 0.0 else 0.5 + overlap / (overlap + was)
        closed_now += was >= 0.0
        assert kept[1][k, SPRING] == pytest.approx(KN * overlap)
        assert kept[1][k, RATE] == pytest.approx(6.0 * share)
        assert kept[1][k, dashpots.FORCE] == 0.0
    assert 0 < closed_now < used


def test_smooth_elastic_spheres_press_by_their_reduced_radius() -> None:
    """4/3 E sqrt(R) U^1.5, R = r1 r2/(r1 + r2); the energy is 2/5 of it times U."""
    scratch, sums = np.zeros((1, PLACES * WIDE)), np.zeros((1, SUMS))
    offset, radii = np.array([0.48, -0.2, 0.36]), (0.4, 0.3)
    law = Elastic(1e8, None, None, (0.0, 0.0))
    plain(store_vector)(scratch, 0, OFFSET, 2, tuple(offset))
    scratch[0, RADII * WIDE + 2], scratch[0, (RADII + 1) * WIDE + 2] = radii
    with np.errstate(all="ignore"):  # the first two columns are empty
        plain(pairs_of.forces_without_friction)(scratch, 0, 3, law)
    length = float(np.linalg.norm(offset))
    overlap, reduced = 0.7 - length, 0.12 / 0.7
    push = 4.0 / 3.0 * 1e8 * np.sqrt(reduced * overlap) * overlap
    found = plain(vector_of)(scratch, 0, FORCE, 2)
    assert found == pytest.approx(push / length * offset)
    whole = np.zeros_like(scratch)
    for place in (RADII, RADII + 1, ARMS):  # the contact as the only one
        whole[0, place * WIDE] = scratch[0, place * WIDE + 2]
    plain(pairs_of.add_energies)(sums, whole, 0, 1, law, None)
    assert sums[0, NORMAL] == pytest.approx(0.4 * push * overlap)
