"""Claims about the kinematics of contacts and bonds in DEM: truths by hand and by numpy."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest

from vv.engines.dem.bonds.law import (
    arms,
    elongation,
    exceeds_strength,
    remaining_force,
    sheared_by,
    surface_motion,
)
from vv.engines.dem.contact.pairs import Pairs, normals_in_step, pair_overlap, pair_touch
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import compiled
from vv.engines.kernels.triples import Triple
from vv.scene import Vector

DT = 0.01  # s
FIRST, SECOND = 0.3, 0.5  # m, radii
OFFSET, GAP = np.array([0.6, -0.3, 0.2]), -0.1  # m
ALONG = float(np.linalg.norm(OFFSET))


@bundle
class Gone(NamedTuple):
    """Of the motion of spheres only what a contact sees of it."""

    v: Vector
    before: Vector


def pair() -> Pairs:
    """Two spheres whose gap at t = 0 says how far apart their centres were."""
    radii = np.array([[FIRST, ALONG - GAP - FIRST]])
    return np.array([[1, 0]]), OFFSET[None].copy(), np.array([GAP]), radii


@compiled
def overlapping(u: Vector, pairs: Pairs) -> tuple[float, Triple, float]:
    return pair_overlap(u, pairs, 0)


def test_spheres_overlap_by_what_their_centres_are_closer_than_their_radii() -> None:
    u = np.array([[-0.02, 0.05, 0.01], [0.03, -0.01, 0.04]])
    overlap, d, length = overlapping(u, pair())
    between = OFFSET + u[0] - u[1]
    assert d == pytest.approx(between)
    assert length == pytest.approx(np.linalg.norm(between))
    assert overlap == pytest.approx(ALONG - GAP - np.linalg.norm(between))


@compiled
def normals(d: Triple, length: float, relative: Triple) -> tuple[Triple, Triple, float]:
    return normals_in_step(d, length, relative, DT)


def test_normals_before_and_amid_a_step_are_those_of_where_centres_were() -> None:
    relative = np.array([3.0, -8.0, 5.0])
    back = OFFSET - DT * relative
    before, midway, opened = normals(tuple(OFFSET), ALONG, tuple(relative))
    both = back / np.linalg.norm(back) + OFFSET / ALONG
    assert before == pytest.approx(back / np.linalg.norm(back))
    assert midway == pytest.approx(both / np.linalg.norm(both))
    assert opened == pytest.approx(ALONG - np.linalg.norm(back))


@compiled
def touched(motion: Any, w: Vector, spun: Vector, turns: bool, pairs: Pairs, n: Triple) -> Touch:
    now = overlapping_now(pairs)
    return pair_touch(motion, w, spun, turns, pairs, 0, now, n, DT)


@compiled
def overlapping_now(pairs: Pairs) -> tuple[float, Triple, float]:
    return pair_overlap(np.zeros((2, 3)), pairs, 0)


@pytest.mark.parametrize("turns", [True, False])
def test_surfaces_move_with_centres_and_spins_at_the_middle_of_the_overlap(turns: bool) -> None:
    """Rates at both ends of the step follow from the mean rates of two steps."""
    random = np.random.default_rng(2)
    v, before, w, spun = random.normal(size=(4, 2, 3))
    n = OFFSET / ALONG
    found = touched(Gone(v, before), w, spun, turns, pair(), tuple(n))
    relative, earlier = v[0] - v[1], before[0] - before[1]
    first, midway, opened = normals(tuple(OFFSET), ALONG, tuple(relative))
    changed = relative - earlier
    assert found.rates == pytest.approx(
        (np.dot(first, relative - 0.5 * changed), n @ (relative + 0.5 * changed))
    )
    assert (found.overlap, found.opened) == pytest.approx((-GAP, opened))
    inside = 0.5 * (-GAP + 0.5 * opened)
    long, short = FIRST - inside, ALONG - GAP - FIRST - inside
    rolled, rolled_before = long * w[1] + short * w[0], long * spun[1] + short * spun[0]
    if turns:
        changed = changed - np.cross(rolled - rolled_before, midway)
        relative = relative - np.cross(rolled, midway)
    assert found.relative == pytest.approx(relative)
    assert found.changed == pytest.approx(changed)
    assert found.twist == pytest.approx(0.5 * DT * (w[0] + w[1]) @ midway if turns else 0.0)


@compiled
def stretched(r: Triple, moved: Triple) -> tuple[Triple, Triple, float, float]:
    return elongation(r, moved, 0.7, 0.002)


def test_a_bond_is_stretched_by_what_it_is_longer_than_at_first() -> None:
    moved = np.array([0.02, 0.1, -0.05])
    now, n, length, stretch = stretched(tuple(OFFSET), tuple(moved))
    assert now == pytest.approx(OFFSET + moved)
    assert length == pytest.approx(np.linalg.norm(OFFSET + moved))
    assert n == pytest.approx((OFFSET + moved) / length)
    assert stretch == pytest.approx(0.002 + length - ALONG)


@compiled
def reached(length: float) -> tuple[float, float]:
    return arms(FIRST, SECOND, length)


def test_arms_of_a_bond_meet_midway_between_the_surfaces() -> None:
    assert reached(1.0) == pytest.approx((0.4, 0.6))
    assert reached(0.7) == pytest.approx((0.25, 0.45))


@compiled
def moved_apart(step: Triple, half: Triple, a: Triple, b: Triple) -> tuple[Triple, float]:
    return surface_motion(step, half, DT, a, b, FIRST, SECOND)


@compiled
def sheared(s: Triple, m: Triple, half: Triple) -> Triple:
    return sheared_by(s, m, half)


def test_surfaces_of_bonded_spheres_move_with_their_spins_and_half_the_twist() -> None:
    step, half, a, b = np.random.default_rng(4).normal(size=(4, 3))
    middle = half / np.linalg.norm(half)
    one, two = reached(float(np.linalg.norm(half)))
    m = step - DT * np.cross(one * a + two * b, middle)
    turn = 0.5 * DT * (a + b) @ middle
    found, twist = moved_apart(*(tuple(x) for x in (step, half, a, b)))
    assert twist == pytest.approx(turn)
    assert found == pytest.approx(m - 0.5 * turn * np.cross(middle, m))


def test_shear_of_a_bond_turns_with_it_and_gains_what_moves_across() -> None:
    s, m, half = np.random.default_rng(5).normal(size=(3, 3))
    middle = half / np.linalg.norm(half)
    reflected = s - 2.0 * (s @ middle) * middle
    across = m - (m @ middle) * middle
    found = sheared(tuple(s), tuple(m), tuple(half))
    assert found == pytest.approx(reflected + across)


@compiled
def breaks(along: float, across: Triple) -> bool:
    return exceeds_strength(along, across, 10.0, 20.0, 0.5)


@pytest.mark.parametrize(
    ("along", "shear", "broken"),
    [
        (9.9, 15.0, False),
        (10.1, 0.0, True),
        (-40.0, 39.9, False),
        (-40.0, 40.1, True),
        (8.0, 15.9, False),
        (8.0, 16.1, True),
    ],
)
def test_a_bond_breaks_by_pull_or_by_shear_beyond_cohesion_and_friction(
    along: float, shear: float, broken: bool
) -> None:
    assert breaks(along, (0.6 * shear, 0.0, -0.8 * shear)) == broken


@compiled
def kept(along: float, across: Triple) -> tuple[float, float]:
    return remaining_force(along, across, 0.5)


def test_a_broken_bond_keeps_what_a_contact_bears() -> None:
    assert kept(5.0, (3.0, 4.0, 0.0)) == (0.0, 0.0)
    assert kept(-4.0, (3.0, 4.0, 0.0)) == pytest.approx((-4.0, 0.4))
    assert kept(-11.0, (3.0, 4.0, 0.0)) == (-11.0, 1.0)
