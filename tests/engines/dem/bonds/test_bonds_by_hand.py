"""Claims about the forces of bonds in one step, their blocks, and what breaks: truths by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.dem.bonds import all_forces, law
from vv.engines.dem.bonds.arrays import BREAKS, BROKEN, BondArrays, shares
from vv.engines.dem.bonds.blocks import (
    ALL,
    CHUNKS,
    FIRST,
    KN,
    LEAST,
    LIKE,
    OFFSET,
    RADII,
    SCRATCH,
    SLIP,
    STRAINED,
    WIDE,
    Blocks,
    bond_blocks,
)
from vv.engines.dem.contact.friction import rotated
from vv.engines.dem.space.bodies import Motion
from vv.engines.dem.space.neighbours import Slots
from vv.scene import Vector

DT, MU, GROUND = 0.01, 0.1, 5
INF = np.inf


class Several:
    """Bonds between five spheres that move and the ground, in a step of any motion."""

    def __init__(self, many: int, alike: bool, strength: float = INF) -> None:
        random = np.random.default_rng(11)
        self.rows = np.array([random.choice(GROUND + 1, 2, replace=False) for _ in range(many)])
        self.offset = random.normal(size=(many, 3))
        self.first = np.linalg.norm(self.offset, axis=1)
        self.strained = 0.01 * random.normal(size=many)
        self.radius = random.uniform(0.2, 0.6, (many, 2))
        shape = (2, 1) if alike else (2, many)
        self.kn, self.ks = np.ones((2, many)) * random.uniform(1e3, 2e3, shape)
        self.u, self.v, self.w = 0.1 * random.normal(size=(3, GROUND + 1, 3))
        self.u[-1] = self.v[-1] = self.w[-1] = 0.0
        self.slip = 0.02 * random.normal(size=(many, 3))
        self.strength = np.full((2, many), strength)

    @property
    def springs(self) -> law.Springs:
        return self.rows, self.offset, self.first, self.strained, self.kn, self.radius

    def blocks(self) -> Blocks:
        """The bonds in blocks, with shear displacements as after an earlier step."""
        found = bond_blocks(self.springs, np.vstack([self.kn, self.ks, self.strength]), GROUND)
        places = found.table.shape[1] // WIDE
        for p, slip in enumerate(self.slip):
            table = found.table[p // WIDE].reshape(places, WIDE)
            table[SLIP : SLIP + 3, p % WIDE] = slip
        return found

    def one(self, p: int, shears: bool, turns: bool) -> Any:
        """The vector of a bond, its normal, pull, shear displacement and arms after the step."""
        i, j = self.rows[p]
        now = self.offset[p] + self.u[j] - self.u[i]
        length = np.linalg.norm(now)
        n = now / length
        pull = self.kn[p] * (self.strained[p] + length - self.first[p])
        m, twist = DT * (self.v[j] - self.v[i]), 0.0
        half = now - 0.5 * m
        if turns:
            spins = tuple(self.w[i]), tuple(self.w[j])
            m, twist = plain(law.surface_motion)(tuple(m), tuple(half), DT, *spins, *self.radius[p])
        s = np.zeros(3)
        if shears:
            s = plain(law.sheared_by)(tuple(self.slip[p]), tuple(m), tuple(half))
            s = np.array(plain(rotated)(tuple(s), tuple(n), twist))
        arms = self.radius[p] + 0.5 * (length - self.radius[p].sum())
        return n, pull, s, arms, np.array(m)


def term_of(some: Several, shears: bool, frail: Any = None) -> BondArrays:
    """The bonds before a step."""
    found = some.blocks()
    state, chunks = np.zeros((len(found.ends), WIDE), np.uint8), len(found.window)
    assert len(some.rows) <= state.size
    each = shares(chunks, GROUND + 1)
    assert each[2].shape == (chunks, SCRATCH * WIDE)
    ks, torn = some.ks if shears else None, np.array([0.25, 0.5])
    return BondArrays(some.springs, ks, found, frail, found.table, *each, state, torn)


def moving(some: Several, turns: bool) -> Motion:
    """The motion in a step, with forces and torques of others."""
    push, turn = np.full((2, GROUND + 1, 3), 0.5)
    if turns:
        return Motion(some.u, some.v, some.v, push, some.w, some.w, turn)
    return Motion(some.u, some.v, some.v, push, None, None, None)


def pushed(
    some: Several, shears: bool, turns: bool, frail: Any = None
) -> tuple[BondArrays, Motion, Any]:
    """The bonds after a step, the motion with forces and torques, and what is returned."""
    term, motion = term_of(some, shears, frail), moving(some, turns)
    return term, motion, plain(all_forces.add_bond_forces)(term, motion, DT)


@pytest.mark.parametrize("alike", [True, False])
@pytest.mark.parametrize(("shears", "turns"), [(False, False), (True, False), (True, True)])
@pytest.mark.parametrize("many", [3, 70])
def test_bonds_pull_shear_and_turn_their_ends(
    many: int, shears: bool, turns: bool, alike: bool
) -> None:
    """Forces are opposite; the ground's are not asked for. Torques are those at the arms."""
    some = Several(many, alike)
    term, motion, told = pushed(some, shears, turns)
    force, torque = np.full((2, GROUND + 1, 3), 0.5)
    normal = sheared = 0.0
    for p, (i, j) in enumerate(some.rows):
        n, pull, s, arms, _ = some.one(p, shears, turns)
        acting = pull * n + some.ks[p] * s
        force[i] += acting
        force[j] -= acting
        if turns:
            torque[i] += arms[0] * np.cross(n, some.ks[p] * s)
            torque[j] += arms[1] * np.cross(n, some.ks[p] * s)
        normal += 0.5 * pull**2 / some.kn[p]
        sheared += 0.5 * some.ks[p] * s @ s
        if shears:
            places = term.table.shape[1] // WIDE
            kept = term.table[p // WIDE].reshape(places, WIDE)[SLIP : SLIP + 3, p % WIDE]
            assert kept == pytest.approx(s)
    check_forces(motion, force, torque)
    assert told == pytest.approx((normal, sheared, 0.0))


def check_forces(motion: Motion, force: Vector, torque: Vector) -> None:
    """Whether the spheres that move have these forces and torques."""
    assert motion.push[:GROUND] == pytest.approx(force[:GROUND])
    if motion.turn is not None:
        assert motion.turn[:GROUND] == pytest.approx(torque[:GROUND])


def test_blocks_hold_the_numbers_of_each_bond_or_once_those_of_all() -> None:
    for alike in (True, False):
        some = Several(150, alike)
        found = bond_blocks(some.springs, np.vstack([some.kn, some.ks, some.strength]), GROUND)
        places = LIKE if alike else ALL
        assert found.table.shape == (3, places * WIDE)
        assert found.ends.shape == (3, 2 * WIDE)
        assert (found.like is not None) == alike
        if found.like is not None:
            assert found.like == (some.kn[0], some.ks[0], INF, INF)
        table = found.table.reshape(3, places, WIDE).transpose(0, 2, 1).reshape(-1, places)
        ends = found.ends.reshape(3, 2, WIDE).transpose(0, 2, 1).reshape(-1, 2)
        assert (ends[:150] == some.rows).all()
        assert (table[:150, OFFSET : OFFSET + 3] == some.offset).all()
        assert not table[:150, SLIP : SLIP + 3].any()
        assert (table[:150, FIRST] == some.first).all()
        assert (table[:150, STRAINED] == some.strained).all()
        assert (table[:150, RADII:KN] == some.radius).all()
        if not alike:
            assert (table[:150, KN:] == np.vstack([some.kn, some.ks, some.strength]).T).all()
        assert not table[150:].any()


def test_bonds_without_shear_or_apart_have_each_its_own_numbers() -> None:
    some = Several(3, True)
    own = np.vstack([some.kn, some.ks, some.strength])
    assert bond_blocks(some.springs, own, GROUND, joined=False).like is None
    own[1] = 0.0
    assert bond_blocks(some.springs, own, GROUND).like is None


@pytest.mark.parametrize(
    ("blocks", "chunks"), [(1, 1), (31, 1), (32, 2), (8 * LEAST, CHUNKS), (200, CHUNKS)]
)
def test_chunks_share_blocks_evenly_and_know_the_rows_on_which_they_act(
    blocks: int, chunks: int
) -> None:
    many = blocks * WIDE - 5
    along = np.arange(many)
    rows = np.stack([along, along + 1], axis=1)
    rows[7, 1] = many + 1  # the ground
    ones, three = np.ones(many), np.ones((many, 3))
    springs = rows, three, ones, ones, ones, np.ones((many, 2))
    found = bond_blocks(springs, np.ones((4, many)), many + 1)
    assert len(found.share) == chunks + 1
    assert (found.share[0], found.share[-1]) == (0, blocks)
    assert np.ptp(np.diff(found.share)) <= 1
    for c, (a, b) in enumerate(zip(found.share[:-1], found.share[1:], strict=True)):
        assert found.window[c].tolist() == [WIDE * a, min(WIDE * b, many) + 1]


def frail_of(some: Several) -> law.Frail:
    both = np.sort(some.rows, axis=1)
    return some.strength[0], some.strength[1], MU, both


def slots(room: int) -> Slots:
    pair = np.zeros((room, 2), np.int64)
    three = np.zeros((room, 3))
    return Slots(
        pair, pair.copy(), three, np.zeros(room), np.zeros((room, 2)), three.copy(),
        np.zeros((0, 7)),
    )  # fmt: skip


def check_contact(left: Slots, k: int, some: Several, p: int) -> None:
    """Whether slot k holds the ends of bond p as a contact."""
    assert left.both[k].tolist() == sorted(some.rows[p].tolist())
    assert left.rows[k].tolist() == some.rows[p].tolist()
    assert left.offset[k] == pytest.approx(some.offset[p])
    assert left.gap[k] == pytest.approx(some.first[p] - some.radius[p].sum())
    assert left.radii[k] == pytest.approx(some.radius[p])


@pytest.mark.parametrize("turns", [True, False])
@pytest.mark.parametrize("shears", [True, False])
def test_bonds_that_break_become_contacts_that_keep_what_these_bear(
    shears: bool, turns: bool
) -> None:
    """They break amid the step: the energy there, less what remains, is lost."""
    some = Several(12, alike=False)
    turns = turns and shears
    pulls = np.array([some.one(p, shears, turns)[1] for p in range(12)])
    some.strength[0] = np.where(np.arange(12) % 2 == 0, 0.9, 1.1) * np.abs(pulls)
    some.strength[1] = 1e9
    pressed_one = int(pulls.argmin())
    some.strength[1, pressed_one] = -1e9
    term, motion, told = pushed(some, shears, turns, frail_of(some))
    state = term.state
    broken = [p for p in range(12) if pulls[p] > some.strength[0, p]]
    broken = sorted({*broken, pressed_one})
    assert pulls[pressed_one] < 0.0
    assert told[2] == len(broken) >= 2
    assert np.flatnonzero(state == BREAKS).tolist() == broken
    left = slots(20)
    many = np.array([3])
    kept = plain(all_forces.break_bonds)(term, motion, DT, frail_of(some), left, many)
    assert many[0] == 3 + len(broken)
    assert np.flatnonzero(state).tolist() == np.flatnonzero(state == BROKEN).tolist() == broken
    force, torque = np.full((2, GROUND + 1, 3), 0.5)
    due_lost, remains = np.array([0.25, 0.5]), np.zeros(2)
    for p, (i, j) in enumerate(some.rows):
        n, pull, s, arms, m = some.one(p, shears, turns)
        across = some.ks[p] * s
        if p in broken:
            stretch, whole = pull / some.kn[p], across
            pressed = min(pull, 0.0)
            size = float(np.linalg.norm(across))
            share = min(1.0, -MU * pressed / size) if size > 0.0 else 1.0
            step = DT * (some.v[j] - some.v[i])
            due_lost[0] += 0.5 * (pull - pressed) * (stretch - step @ n)
            due_lost[1] += 0.5 * (whole - share * whole) @ ((1.0 + share) * s - m)
            pull, across = pressed, share * across
            remains += [0.5 * pressed * stretch, 0.5 * across @ across / some.ks[p]]
            k = 3 + broken.index(p)
            check_contact(left, k, some, p)
            assert left.shear[k] == pytest.approx(-across)
        force[i] += pull * n + across
        force[j] -= pull * n + across
        if turns:
            torque[i] += arms[0] * np.cross(n, across)
            torque[j] += arms[1] * np.cross(n, across)
    check_forces(motion, force, torque)
    assert term.torn == pytest.approx(due_lost)
    assert kept == pytest.approx(tuple(remains))
    assert plain(all_forces.add_bond_forces)(term, moving(some, turns), 0.0)[2] == 0.0
