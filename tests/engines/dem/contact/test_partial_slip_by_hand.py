"""Claims about contacts that slip in part: their springs, by hand and by Cattaneo and Mindlin."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.engines.dem.contact.test_laws_by_hand import MASS, MU, RADIUS, UP, E, G
from tests.support.plain import plain
from vv.engines.dem.contact import micro_slip
from vv.engines.dem.contact.micro_slip import FIRST, SPRINGS, MicroSlip
from vv.engines.dem.contact.touch import Touch
from vv.scene import Vector


def touch(overlap: float, opened: float, slide: Vector, rates: tuple[float, float]) -> Touch:
    none = (0.0, 0.0, 0.0)
    return Touch(overlap, opened, UP, UP, UP, rates, tuple(slide), none, 0.0)


rubbed = plain(micro_slip.friction_force)
SLIPS = MicroSlip(E, (G, MU), None, (0.0, 0.0))


def kept() -> Vector:
    """The numbers of a contact that has not been touched."""
    return np.zeros((1, SLIPS.columns))


def cattaneo(overlap: float, shift: float) -> float:
    """The force [N] of a contact that was pressed and then sheared, its rim slipping.

    The force is mu (N - N_stuck), N = 4/3 E sqrt(R) U^1.5, the shift mu E/4G (U - U_stuck).
    """
    inner = max(overlap - 4.0 * G / (MU * E) * shift, 0.0)
    return MU * 4.0 / 3.0 * E * math.sqrt(RADIUS) * float(overlap**1.5 - inner**1.5)


@pytest.mark.parametrize("part", [0.1, 0.5, 0.95, 1.3])
def test_a_contact_that_is_sheared_slips_from_its_rim_as_cattaneo_says(part: float) -> None:
    """It all slips from part 1 on. Work is done by the mean of the forces before and after."""
    u, dt, store = 1e-4, 0.01, kept()
    rubbed(SLIPS, touch(u, 0.0, np.zeros(3), (0.0, -2.0)), RADIUS, MASS, store, 0, dt)
    full = 0.25 * MU * E / G * u
    slide = part * full * np.array([0.6, 0.8, 0.0]) + [0.0, 0.0, 0.3]
    force, held, taken = rubbed(
        SLIPS, touch(u, 0.0, slide / dt, (0.0, 0.0)), RADIUS, MASS, store, 0, dt
    )
    due = cattaneo(u, part * full)
    assert force == pytest.approx([-0.6 * due, -0.8 * due, 0.0], rel=2e-4)
    assert held + taken == pytest.approx(-0.5 * np.dot(force, slide))
    s = math.sqrt(u) * (np.arange(4000) + 0.5) / 4000
    stretch = np.minimum(part * full, 0.25 * MU * E / G * (u - s * s))
    stored = 0.5 * 8.0 * G * math.sqrt(RADIUS) * (stretch**2).mean() * math.sqrt(u)
    assert held == pytest.approx(stored, rel=1e-3)


TILT = np.array([0.48, -0.6, 0.64])
LEVEL, SIDE = np.array([0.8, 0.0, -0.6]), np.array([0.36, 0.8, 0.48])


def tilted(slide: Vector, midway: Vector = TILT) -> Touch:
    """A contact at an overlap of 1e-4 m whose plane is oblique, after a slide [m] in 10 ms."""
    n = tuple(TILT)
    given = touch(1e-4, 0.0, slide / 0.01, (0.0, -2.0))
    return given._replace(n=n, n_before=n, midway=tuple(midway))


def test_a_contact_that_is_sheared_back_slips_twice_as_mindlin_and_deresiewicz_say() -> None:
    """From full slip back by s the force falls by twice that of a slide of s/2."""
    u, store = 1e-4, kept()
    full = 0.25 * MU * E / G * u
    rubbed(SLIPS, tilted(np.zeros(3)), RADIUS, MASS, store, 0, 0.01)
    first = rubbed(SLIPS, tilted(1.2 * full * LEVEL + 0.1 * TILT), RADIUS, MASS, store, 0, 0.01)
    assert first[0] == pytest.approx(-cattaneo(u, full) * LEVEL, rel=2e-4, abs=1e-6)
    store[0, :3] = first[0]
    back = -0.9 * full * LEVEL
    force, held, taken = rubbed(SLIPS, tilted(back), RADIUS, MASS, store, 0, 0.01)
    due = cattaneo(u, full) - 2.0 * cattaneo(u, 0.45 * full)
    assert force == pytest.approx(-due * LEVEL, rel=2e-3, abs=1e-4 * abs(due))
    assert held - first[1] + taken == pytest.approx(-0.5 * (np.add(first[0], force) @ back))


def test_a_slide_counts_in_the_plane_amid_the_step_and_then_in_that_at_its_end() -> None:
    store, small = kept(), 1e-9
    rubbed(SLIPS, tilted(np.zeros(3)), RADIUS, MASS, store, 0, 0.01)
    midway = 0.8 * TILT + 0.6 * SIDE
    slide = small * (LEVEL + 3.0 * TILT)
    seen = tilted(slide, midway)
    force = rubbed(SLIPS, seen, RADIUS, MASS, store, 0, 0.01)[0]
    went = slide - (midway @ slide) * midway
    went = went - (TILT @ went) * TILT
    stiff = 8.0 * G * math.sqrt(RADIUS * 1e-4)
    assert force == pytest.approx(-stiff * went, rel=5e-3)


def test_springs_that_all_hold_take_nothing_and_give_their_work_back() -> None:
    """Spring k reaches mu E/4G (U - s^2), which is small at the rim alone."""
    u, dt, store = 1e-4, 0.01, kept()
    still, slide = np.zeros(3), 1e-9 * np.array([0.6, 0.8, 0.0])
    rubbed(SLIPS, touch(u, 0.0, still, (0.0, -2.0)), RADIUS, MASS, store, 0, dt)
    force, held, taken = rubbed(
        SLIPS, touch(u, 0.0, slide / dt, (0.0, 0.0)), RADIUS, MASS, store, 0, dt
    )
    stiff = 8.0 * G * math.sqrt(RADIUS * u)
    assert force == pytest.approx(-stiff * slide, rel=1e-3)
    assert held == pytest.approx(0.5 * stiff * 1e-18, rel=1e-3)
    assert abs(taken) < 1e-3 * held


def test_springs_that_close_within_a_step_are_stretched_in_their_part_of_it() -> None:
    """U grows from U/4 to U in the step: a spring at s has (U - s^2)/(3/4 U) of the slide."""
    u, dt, store = 1e-4, 0.01, kept()
    rubbed(SLIPS, touch(u / 4, 0.0, np.zeros(3), (0.0, -2.0)), RADIUS, MASS, store, 0, dt)
    slide = np.array([1e-9, 0.0, 0.0])
    rubbed(SLIPS, touch(u, -0.75 * u, slide / dt, (0.0, 0.0)), RADIUS, MASS, store, 0, dt)
    apart = store[0, 3]
    depth = (apart * np.arange(int(math.sqrt(u) / apart) + 1)) ** 2
    due = 1e-9 * np.where(depth <= u / 4, 1.0, (u - depth) / (0.75 * u))
    found = store[0, FIRST::3][: len(due)]
    assert found == pytest.approx(np.minimum(due, 0.25 * MU * E / G * (u - depth)), rel=1e-9)
    assert len(due) < SPRINGS


def test_stretches_turn_with_the_plane_and_about_it_and_the_slide_by_half() -> None:
    tilted = np.array([0.6, 0.0, 0.8])
    given = touch(1e-4, 0.0, np.zeros(3), (0.0, 0.0))._replace(n=tuple(tilted), twist=0.02)
    old, slide = plain(micro_slip.rotated_with_plane)((1.0, 2.0, 0.0), (0.5, 0.3, 0.1), given)
    across = np.array([0.8, 0.0, -0.6])  # to where x is taken
    level = np.array([0.0, 1.0, 0.0])
    turned = 1.0 * across + 2.0 * level
    turned = turned + 0.02 * np.cross(tilted, turned)
    assert old == pytest.approx(turned, rel=1e-3, abs=1e-3)
    assert np.linalg.norm(old) == pytest.approx(math.sqrt(5.0))
    before = np.array([0.5, 0.3, 0.1])
    went = before + 0.5 * 0.02 * np.cross(tilted, before)
    assert slide == pytest.approx(went - (went @ tilted) * tilted)


def test_a_stretch_is_limited_to_what_friction_allows() -> None:
    limited = plain(micro_slip.limited)
    assert limited((3.0, 4.0, 0.0), 5.0) == (3.0, 4.0, 0.0)
    assert limited((3.0, 4.0, 0.0), 4.0) == pytest.approx((2.4, 3.2, 0.0))
