"""Claims about batches, kicks and searches of the bulk model: truths by hand."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest

from tests.engines.dem.bulk.test_bulk_by_hand import DOWN, DT, MASS, RADIUS, grains, move
from tests.support.plain import plain
from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk import advance
from vv.engines.dem.bulk.batches import (
    AHEAD,
    BEHIND,
    CHUNKS,
    FAR,
    KINETIC,
    LEAST,
    PLACES,
    SUMS,
    Batches,
    batches,
)
from vv.engines.dem.bulk.crowd import Crowd, Rules
from vv.engines.dem.bulk.grains import BEFORE, SPUN, TURN, Given, V, W
from vv.engines.dem.bulk.near import Near
from vv.engines.dem.bulk.skin import CHANGE, FIRST, MOST, SOUGHT
from vv.engines.dem.contact.linear import Linear
from vv.engines.dem.limits import GAIN
from vv.engines.dem.terms.drag import Drag
from vv.scene import Vector


def listed(counts: list[int], reach: int = 1) -> Near:
    """So many pairs of each sphere, the first of which is `reach` ahead or the last sphere."""
    n = len(counts)
    start = np.cumsum([0, *counts]).astype(np.uint32)
    other = [min(i + max(reach - k, 1), n - 1) for i in range(n) for k in range(counts[i])]
    nothing = np.zeros(0, np.uint8), np.zeros((0, 3))
    return Near(start, start[:0], np.array(other, np.uint32), *nothing)


def made(counts: list[int], reach: int = 1) -> tuple[Batches, list[tuple[int, int]]]:
    """The batches for a list of pairs, and the spheres of each batch."""
    found: Batches = plain(batches)(listed(counts, reach))
    many = int(found.share[-1])
    first = found.first[: many + 1].tolist()
    return found, list(itertools.pairwise(first))


@pytest.mark.parametrize("most", [0, 1, 5, 30, 100])
def test_a_batch_is_as_long_as_pairs_and_spheres_allow(most: int) -> None:
    """It ends before a sphere that would make more than 64 pairs, and at 64 spheres."""
    counts = np.random.default_rng(1).integers(0, most + 1, 700).tolist()
    _, spans = made(counts)
    assert (spans[0][0], spans[-1][1]) == (0, 700)
    for a, b in spans:
        pairs = sum(counts[a:b])
        assert b - a == 1 or (pairs <= WIDE and b - a <= WIDE)
        if b < 700:
            assert pairs + counts[b] > WIDE or b - a == WIDE
    assert [a for a, _ in spans[1:]] == [b for _, b in spans[:-1]]


@pytest.mark.parametrize(
    ("spheres", "chunks"),
    [(64, 1), (1999, 1), (2000, 2), (4100, 4), (8 * LEAST, CHUNKS), (9500, 8)],
)
def test_chunks_have_a_thousand_spheres_or_more_and_are_eight_at_most(
    spheres: int, chunks: int
) -> None:
    found, spans = made([3] * spheres)
    assert len(found.head) == chunks
    assert found.share[0] == 0
    assert found.share[-1] == len(spans)
    assert np.ptp(np.diff(found.share.astype(int))) <= 1
    assert found.scratch.shape == (chunks, PLACES * WIDE)
    assert found.ends.shape == (chunks, 4 * WIDE)
    assert found.sums.shape == (chunks, SUMS)


@pytest.mark.parametrize(("reach", "chunks"), [(20, 4), (1024, 4), (1025, 3), (1400, 2), (2500, 2)])
def test_no_chunk_acts_beyond_the_next_one_and_each_head_ends_behind_what_is_listed(
    reach: int, chunks: int
) -> None:
    counts = [1] * 4096
    found, spans = made(counts, reach)
    assert len(found.head) == chunks
    bounds = [*(spans[k][0] for k in found.share[:-1]), 4096]
    for c in range(1, chunks):
        assert found.head[c] == min(bounds[c] - 1 + reach, 4095) + 1
        assert found.head[c] <= bounds[c + 1]
    assert found.head[0] == 0


def test_a_head_ends_at_its_chunk_where_nothing_is_listed() -> None:
    found, spans = made([0] * 2048)
    assert len(found.head) == 2
    assert found.head[1] == spans[found.share[1]][0]


@pytest.mark.parametrize("turns", [True, False])
@pytest.mark.parametrize("eta", [0.0, 3.0])
def test_a_kick_balances_forces_moves_by_its_span_and_adds_to_sums(eta: float, turns: bool) -> None:
    """Fixed spheres stay; of the others forces become weights, and torques zero."""
    some, random, lag, span = grains(), np.random.default_rng(3), 0.25, 0.03
    some.acting[:4, :6] = random.normal(size=(4, 6))
    some.since[:] = some.row[:4, :3] - 0.3
    before, acting = some.row[:4].copy(), some.acting[:4].copy()
    sums = np.full((2, SUMS), 0.1)
    none: Any = None
    work = Batches(none, none, none, none, none, sums)
    spin = np.zeros((4, 3)) if turns else None
    rules = Rules(none, none, None, None, spin, DT, Drag(eta, None), lag, DOWN)
    plain(advance.kick)(Crowd(some, none, none, work, rules), 1, 1, 4, span)
    kinetic = behind = ahead = 0.0
    far = [0.1]
    for i in (1, 3):
        old, new = before[i, V:W], some.row[i, V:W]
        mean = lag * old + (1.0 - lag) * new
        assert MASS[i] * (new - old) / DT == pytest.approx(acting[i, :3] - eta * mean)
        assert (some.row[i, BEFORE:SPUN] == old).all()
        assert some.row[i, :3] == pytest.approx(before[i, :3] + span * new)
        assert some.acting[i, :3] == pytest.approx(MASS[i] * np.array(DOWN))
        kinetic += 0.5 * MASS[i] * old @ new
        behind += float(eta * mean @ old)
        ahead += float(eta * mean @ new)
        far.append(float(((some.row[i, :3] - some.since[i]) ** 2).sum()))
        if turns:
            inertia = 0.4 * MASS[i]
            spun: Vector = before[i, W:BEFORE] + DT / inertia * acting[i, TURN : TURN + 3]
            assert some.row[i, W:BEFORE] == pytest.approx(spun)
            assert (some.row[i, SPUN:] == before[i, W:BEFORE]).all()
            assert not some.acting[i, TURN : TURN + 3].any()
            kinetic += 0.5 * inertia * before[i, W:BEFORE] @ spun
    assert (some.row[[0, 2]] == before[[0, 2]]).all()
    assert (some.acting[0] == np.pad(acting[0], (0, 8 - len(acting[0])))).all()
    assert not some.acting[2, :6].any()
    assert sums[1, KINETIC] == pytest.approx(0.1 + kinetic)
    assert sums[1, [BEHIND, AHEAD]] == pytest.approx([0.1 + behind, 0.1 + ahead])
    assert sums[1, FAR] == pytest.approx(max(far))
    assert (sums[0] == 0.1).all()


FLOOR = np.array([[0.0, 0.0, 1.0, 0.0]])


def run(
    speed: Vector, spin: Vector, deep: float, law: Linear, eta: float, rows: int, gravity: float
) -> tuple[int, Vector, Vector]:
    """A sphere of 2 kg and 0.5 m on a floor: the rows filled, the path and the energies."""
    place = np.array([[0.0, 0.0, 0.5 - deep]])
    given = Given(place, speed[None], spin[None], RADIUS[:1], np.array([2.0]), np.array([0.2]))
    path, energy = np.zeros((rows, 1, 9)), np.zeros((rows, 7))
    with np.errstate(all="ignore"):  # unused columns of scratch may be anything
        row = move(
            path, energy, np.array([0]), 1, DT, given, FLOOR, law, law.friction, None,
            (0.0, 0.0, -gravity), Drag(eta, None), None, 1.0, 0.0,
        )  # fmt: skip
    return row, path, energy


@pytest.mark.parametrize("pressed", [0.0, 4e-3])
def test_a_run_ends_where_motion_spin_and_springs_hold_four_times_what_was_put_in(
    pressed: float,
) -> None:
    """A sphere swings on its tangential spring, which is wound up by a drag that pushes."""
    law = Linear(2e3, (500.0, 1e3), None)
    weight = 2e3 * pressed if pressed else 0.0
    speed, spin = np.array([0.02, 0.01, 0.0]), np.array([0.0, 0.3, 0.1])
    row, path, energy = run(speed, spin, pressed, law, -0.02 * 2.0 / DT, 900, weight / 2.0)
    put_in = 0.5 * 2.0 * 5e-4 + 0.5 * 0.2 * 0.1 + 0.5 * 2e3 * pressed**2
    work = -weight * path[: row + 1, 0, 2]
    limit = GAIN * (put_in + np.maximum(np.maximum.accumulate(work), 0.0))
    held = energy[: row + 1, :3].sum(axis=1)
    assert 20 < row < 899
    assert (held[:-1] <= limit[:-1]).all()
    assert held[-1] > limit[-1]
    assert (energy[row, 2] > 0.02 * held[-1]) == (pressed > 0.0)


def test_neighbours_are_sought_when_half_the_skin_is_used_up(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Cells are as wide as two of the largest spheres and the skin, whose width is adapted."""
    edges: list[float] = []
    names: Any = move.__globals__
    original = names["cells"]

    def seen(bulk: Any, edge: float) -> Any:
        edges.append(edge)
        return original(bulk, edge)

    monkeypatch.setitem(names, "cells", seen)
    speed = 4.0
    run(np.array([speed, 0.0, 0.0]), np.zeros(3), -9.0, Linear(2e3, None, None), 0.0, 400, 0.0)
    skin, far, lasted, due = FIRST * 0.5, 0.0, 0, [2 * 0.5 + FIRST * 0.5]
    for _ in range(399):
        far, lasted = far + speed * DT, lasted + 1
        if 2.0 * far >= skin:
            factor = np.sqrt(SOUGHT * 0.5 / (skin * lasted))
            skin = min(skin * min(factor, CHANGE), MOST * 0.5)
            due.append(2 * 0.5 + skin)
            far, lasted = 0.0, 0
    assert edges == pytest.approx(due)
    assert len(due) > 5
