"""Claims about the parts of a step of the general model, and its search for neighbours: by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.dem.space import advance, neighbours, output, steps
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.neighbours import DASHPOT_COLUMNS, OVERLAP, Near, Slots
from vv.engines.dem.terms.drag import Drag
from vv.scene import Vector

DT, ETA = 0.02, 7.0
MASS, INERTIA = np.array([2.0, 0.7, 5.0]), np.array([0.3, 0.2, 0.9])
random = np.random.default_rng(6)
START, FORCE, STEADY = random.normal(size=(3, 4, 3))
LOCKS = random.normal(size=(3, 3))
HOLD = np.array([np.eye(3) - np.outer(n, n) / (n @ n) for n in LOCKS])
NONE = np.zeros((0, 3, 3))


def held(force: Vector, hold: Vector) -> Vector:
    """The parts of forces in free directions."""
    return np.einsum("mab,mb->ma", hold, force[:3]) if len(hold) else force[:3]


@pytest.mark.parametrize("hold", [HOLD, NONE])
def test_only_the_free_part_of_a_vector_remains(hold: Vector) -> None:
    found = [plain(advance.free_part)(tuple(FORCE[i]), hold, i) for i in range(3)]
    assert found == pytest.approx(held(FORCE, hold))
    assert plain(advance.free_part)((1.0, 2.0, 3.0), None, 0) == (1.0, 2.0, 3.0)


DRAGS = [None, Drag(ETA, None), Drag(ETA, np.zeros((0, 3))), Drag(ETA, STEADY[:3]), Drag(0.0, None)]


def of(drag: Drag | None) -> tuple[float, Vector]:
    """The coefficient of a drag, and the velocities relative to which it acts."""
    if drag is None:
        return 0.0, np.zeros((3, 3))
    some = drag.steady is not None and len(drag.steady) > 0
    return drag.eta, STEADY[:3] if some else np.zeros((3, 3))


@pytest.mark.parametrize("hold", [HOLD, NONE])
@pytest.mark.parametrize("drag", DRAGS)
def test_a_velocity_starts_before_its_time_under_forces_and_drag(
    drag: Drag | None, hold: Vector
) -> None:
    (eta, steady), v = of(drag), np.zeros((4, 3))
    kinetic = plain(advance.place)(v, START, FORCE, MASS, hold, 0.01, drag)
    rate = held(FORCE, hold) - eta * (START[:3] - steady)
    assert v[:3] == pytest.approx(START[:3] - 0.01 * rate / MASS[:, None])
    assert kinetic == pytest.approx(0.5 * MASS @ (START[:3] ** 2).sum(axis=1))


@pytest.mark.parametrize("lag", [0.5, 1.0, 0.25])
@pytest.mark.parametrize("hold", [HOLD, NONE])
@pytest.mark.parametrize("drag", DRAGS)
def test_a_kick_balances_forces_with_drag_on_both_velocities(
    drag: Drag | None, hold: Vector, lag: float
) -> None:
    """The powers returned are those of the whole drag, on top of what was lost before."""
    (eta, steady), v, before = of(drag), START.copy(), np.zeros((4, 3))
    powers = plain(advance.kick)(v, before, FORCE, MASS, hold, DT, drag, lag, (4.0, 5.0))
    old, new = START[:3], v[:3]
    mean = lag * old + (1.0 - lag) * new
    acting = held(FORCE, hold) - eta * (mean - steady)
    assert MASS[:, None] * (new - old) / DT == pytest.approx(acting)
    assert before[:3] == pytest.approx(old)
    lost = [eta * (mean * w).sum() for w in (old, new)]
    assert powers == pytest.approx((4.0 + lost[0], 5.0 + lost[1]))
    assert (v[3] == START[3]).all()


def bodies(turns: bool) -> Bodies:
    spin = STEADY[:3] if turns else None
    return Bodies(START[:3], spin, MASS, INERTIA if turns else np.zeros(0), HOLD, HOLD[::-1], 0)


def motion(turns: bool) -> Motion:
    rows = random.normal(size=(7, 4, 3))
    spins = (None, None, None) if not turns else (rows[4], rows[5], rows[6])
    return Motion(rows[0], rows[1], rows[2], rows[3], *spins)


def test_spins_start_and_are_kicked_as_velocities_are_but_without_drag() -> None:
    some, told = bodies(True), motion(True)
    assert told.w is not None
    assert told.spun is not None
    assert told.turn is not None
    kinetic = plain(steps.place_spins)(told.w, some.spin, told.turn, some, 0.01)
    rate = held(told.turn, HOLD[::-1]) / INERTIA[:, None]
    assert told.w[:3] == pytest.approx(STEADY[:3] - 0.01 * rate)
    assert kinetic == pytest.approx(0.5 * INERTIA @ (STEADY[:3] ** 2).sum(axis=1))
    old = told.w.copy()
    plain(steps.kick_spins)(told.w, told.spun, told.turn, some, DT)
    assert told.w[:3] == pytest.approx(old[:3] + DT * rate)
    assert (told.spun[:3] == old[:3]).all()
    assert plain(steps.place_spins)(None, None, None, bodies(False), 0.01) == 0.0


def test_spheres_drift_and_the_ground_stays() -> None:
    told = motion(False)
    u = told.u.copy()
    plain(steps.drift)(told, 3, DT)
    assert told.u[:3] == pytest.approx(u[:3] + DT * told.v[:3])
    assert (told.u[3] == u[3]).all()


@pytest.mark.parametrize("turns", [True, False])
def test_kinetic_energy_is_that_of_both_velocities_or_of_the_later_one(turns: bool) -> None:
    some, told = bodies(turns), motion(turns)
    both = 0.5 * MASS @ (told.before[:3] * told.v[:3]).sum(axis=1)
    after = 0.5 * MASS @ (told.v[:3] ** 2).sum(axis=1)
    if turns:
        assert told.w is not None
        assert told.spun is not None
        both += 0.5 * INERTIA @ (told.spun[:3] * told.w[:3]).sum(axis=1)
        after += 0.5 * INERTIA @ (told.w[:3] ** 2).sum(axis=1)
    assert plain(output.kinetic_energy)(some, told) == pytest.approx(both)
    assert plain(output.kinetic_energy_after)(some, told) == pytest.approx(after)


@pytest.mark.parametrize("drag", [None, Drag(ETA, STEADY[:3])])
def test_a_lock_bears_what_pushes_and_pays_for_a_steady_velocity(drag: Drag | None) -> None:
    path = np.zeros((2, 3, 12))
    plain(output.observe_lock)(path, 1, 2, tuple(FORCE[1]), HOLD, drag, 1)
    due = HOLD[1] @ FORCE[1] - FORCE[1] + (0.0 if drag is None else ETA * STEADY[1])
    assert path[1, 2, 9:] == pytest.approx(due)
    assert np.count_nonzero(path) == 3
    plain(output.observe_lock)(path, 0, 0, tuple(FORCE[1]), NONE, drag, 1)
    assert np.count_nonzero(path) == 3


def test_motion_is_seen_as_way_and_mean_velocity_also_that_of_the_ground(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The ground has no lock; its rows follow those of the spheres."""
    path, told, look = np.zeros((2, 2, 9)), motion(False), plain(output.observe)
    monkeypatch.setitem(look.__globals__, "resistance", lambda terms: None)
    look(path, 1, np.array([3, 1]), (), bodies(False), told)
    for k, i in enumerate((3, 1)):
        assert path[1, k, :3] == pytest.approx(told.u[i])
        assert path[1, k, 3:6] == pytest.approx(0.5 * (told.v[i] + told.before[i]))
    assert not path[1, 0, 6:].any()
    assert path[1, 1, 6:] == pytest.approx(HOLD[1] @ told.push[1] - told.push[1])


def test_energies_are_filled_and_works_added_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """The work of walls has a column where the table is wide enough."""
    fill: Any = plain(output.write_energies)
    monkeypatch.setitem(fill.__globals__, "book", lambda terms, *others: (terms,))
    held = 1.0, 2.0, 3.0, 4.0, 5.0
    for wide in (7, 9, 12):
        energy = np.zeros((2, wide))
        assert fill(energy, 1, 7.5, bodies(False), motion(False), held, 2.5) == 10.0
        assert energy[1, :5].tolist() == [1.0, 2.0, 3.0, 4.0, 5.0]
        assert energy[1, 8:9].tolist() == ([2.5] if wide > 7 else [])


def test_a_spin_is_seen_amid_its_kick_where_there_are_spins() -> None:
    path, told = np.zeros((2, 3, 9)), motion(True)
    plain(output.observe_spin)(path, 1, 2, 0, told.w, told.spun)
    assert told.w is not None
    assert told.spun is not None
    assert path[1, 2, 6:] == pytest.approx(0.5 * (told.w[0] + told.spun[0]))
    seen = np.count_nonzero(path)
    plain(output.observe_spin)(path, 0, 0, 0, told.w[:0], told.spun[:0])
    plain(output.observe_spin)(path, 0, 0, 0, None, None)
    assert np.count_nonzero(path) == seen == 3


COUNT = 40
PLACE = random.uniform(0.0, 3.0, (COUNT, 3))
RADIUS = random.uniform(0.2, 0.4, COUNT)
RIGID = np.arange(COUNT) % 5 == 0  # which of them are at rest
ROW = np.where(RIGID, (~RIGID).sum(), np.cumsum(~RIGID) - 1)


def near(start: Any = None, partner: Any = (), broken: Any = (), viscous: bool = False) -> Near:
    """Forty spheres, some of which are at rest, with bonds as given."""
    first = np.zeros(COUNT + 1, np.int64) if start is None else start
    bonds = np.array(partner, np.int64), np.array(broken, np.uint8)
    return Near(PLACE, RADIUS, ROW, 0.1, first, *bonds, viscous)


def close(u: Vector, skin: float = 0.1) -> set[tuple[int, int]]:
    """The pairs of spheres, not both at rest, whose gap is less than the skin."""
    x = PLACE + np.where(RIGID[:, None], 0.0, u[ROW])
    i, j = np.triu_indices(COUNT, 1)
    there = np.linalg.norm(x[i] - x[j], axis=1) < RADIUS[i] + RADIUS[j] + skin
    there &= ~(RIGID[i] & RIGID[j])
    return set(zip(i[there].tolist(), j[there].tolist(), strict=True))


def displaced() -> Vector:
    u = 0.2 * random.normal(size=(int((~RIGID).sum()) + 1, 3))
    u[-1] = 0.0
    return np.asarray(u)


def test_pairs_are_found_where_spheres_are_now_but_for_those_that_whole_bonds_join() -> None:
    u = displaced()
    due = sorted(close(u))
    bonded = due[::3]
    start = np.searchsorted([i for i, _ in bonded], np.arange(COUNT + 1))
    partner = [j for _, j in bonded]
    find = plain(neighbours.near_pairs)
    assert {(i, j) for i, j in find(near(), u).tolist()} == set(due)
    found = find(near(start, partner), u).tolist()
    assert {(i, j) for i, j in found} == set(due) - set(bonded)
    assert [i for i, _ in found] == sorted(i for i, _ in found)
    broken = [k % 2 for k in range(len(bonded))]
    again = {(i, j) for i, j in find(near(start, partner, broken), u).tolist()}
    assert again == set(due) - set(bonded[::2])


def searched(u: Vector, old: Slots | None, many: Any, bonds: int = 0) -> Slots:
    given = near(viscous=True)
    given = given._replace(partner=np.full(bonds, COUNT, np.int64))
    before = plain(neighbours.no_slots)() if old is None else old
    slots: Slots = plain(neighbours.search_pairs)(given, u, before, many)
    return slots


def test_slots_are_filled_with_what_contacts_need_and_keep_what_was_stored() -> None:
    """There are spare slots for bonds; a pair that is lost and found begins anew."""
    many, u = np.zeros(1, np.int64), displaced()
    slots = searched(u, None, many)
    k = int(many[0])
    i, j = slots.both[:k].T
    assert {(a, b) for a, b in zip(i.tolist(), j.tolist(), strict=True)} == close(u)
    assert (slots.rows[:k] == np.stack([ROW[i], ROW[j]], axis=1)).all()
    assert slots.offset[:k] == pytest.approx(PLACE[j] - PLACE[i])
    gaps = np.linalg.norm(PLACE[j] - PLACE[i], axis=1) - RADIUS[i] - RADIUS[j]
    assert slots.gap[:k] == pytest.approx(gaps)
    assert (slots.radii[:k] == np.stack([RADIUS[i], RADIUS[j]], axis=1)).all()
    assert not slots.shear.any()
    assert slots.dashpots.shape == (k, DASHPOT_COLUMNS)
    assert np.isinf(slots.dashpots).all()
    slots.shear[:] = np.arange(3 * k).reshape(-1, 3)
    slots.dashpots[:, OVERLAP] = np.arange(k)
    known = {(int(a), int(b)): n for n, (a, b) in enumerate(slots.both[:k])}
    u = displaced()
    later = searched(u, slots, many, bonds=4)
    new = int(many[0])
    assert new == len(close(u))
    assert [len(one) for one in later] == [new + 4] * 7
    kept = 0
    for n, (a, b) in enumerate(later.both[:new].tolist()):
        before = known.get((a, b))
        kept += before is not None
        there = np.zeros(3) if before is None else slots.shear[before]
        assert (later.shear[n] == there).all()
        assert later.dashpots[n, OVERLAP] == (np.inf if before is None else before)
    assert 0 < kept < min(k, new)


def test_a_search_is_due_where_a_sphere_has_gone_by_more_than_half_the_skin() -> None:
    told, since = motion(False), np.zeros((3, 3))
    plain(neighbours.store_displacements)(since, told.u)
    assert (since == told.u[:3]).all()
    far, given = plain(neighbours.moved_far), near()
    told.u[3] += 9.0  # the ground
    assert not far(told, since, given)
    for part, due in ((0.99, False), (1.01, True)):
        told.u[:3] = since
        told.u[1] += part * 0.05 * np.array([0.6, 0.0, -0.8])
        assert far(told, since, given) == due
