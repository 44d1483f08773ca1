"""Claims about the laws of contact: stiffness, viscosity and springs of partial slip, by hand."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.dem.contact import hertz, linear, micro_slip
from vv.engines.dem.contact.hertz import DEEP, TOUCHES, Elastic
from vv.engines.dem.contact.law import NO_FRICTION, has_friction, law_of, spheres_rotate
from vv.engines.dem.contact.linear import Linear
from vv.engines.dem.contact.micro_slip import FIRST, SPRINGS, MicroSlip
from vv.engines.dem.contact.touch import Touch, reduced_mass
from vv.scene import Contact, Hertz, Scene, Spheres, Vector, Wall

E, G, Z, MU = 1e8, 8e7, 0.2, 0.3
UP = (0.0, 0.0, 1.0)
UPWARDS = np.array(UP)
RADIUS, MASS = 0.04, 0.3


def scene(contact: Contact) -> Scene:
    """Two unlike spheres that move and spin, above a wall."""
    spheres = Spheres(
        np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]]), np.array([[1.0, 2.0, -1.0], [0.0, 0.5, 0.0]]),
        np.array([0.04, 0.09]), np.array([0.3, 2.0]), np.ones((2, 3), bool),
        free_spin=np.ones((2, 3), bool), spin=np.array([[3.0, 0.0, 4.0], [0.0, 7.0, 0.0]]),
    )  # fmt: skip
    return Scene((Wall(np.zeros(3), UPWARDS), spheres), contact)


def test_elastic_spheres_are_as_stiff_as_all_energy_in_one_contact_makes_them() -> None:
    """8/15 E sqrt(R) U^2.5 = energy, and 1.2 U for what loads add; kn = 2 E and ks = 8 G times
    sqrt(R U)."""
    given = scene(Contact(0.0, mu=MU, hertz=Hertz(E, G, Z)))
    s = given.spheres
    energy = 0.5 * (0.3 * 6.0 + 2.0 * 0.25) + 0.5 * (s.inertia[0] * 25.0 + s.inertia[1] * 49.0)
    deep = (energy / (8.0 / 15.0 * E * math.sqrt(0.09))) ** 0.4
    root = math.sqrt(0.09 * DEEP * deep)
    assert law_of(given).stiffness == pytest.approx((2.0 * E * root, 8.0 * G * root))
    assert DEEP == 1.2


@pytest.mark.parametrize("mu", [0.0, MU])
@pytest.mark.parametrize("damping", [0.0, Z])
def test_a_law_has_what_its_scene_has(mu: float, damping: float) -> None:
    found = law_of(scene(Contact(0.0, mu=mu, hertz=Hertz(E, G, damping))))
    assert found.friction == ((G, MU) if mu else None)
    assert found.damping == (Z if damping else None)
    assert has_friction(found) == (mu > 0.0)
    springs = law_of(scene(Contact(1e4, 8e3, mu, eta_n=damping)))
    assert springs == Linear(1e4, (8e3, MU) if mu else None, Z if damping else None)
    assert springs.stiffness == (1e4, 8e3 if mu else 0.0)
    assert not has_friction(springs._replace(friction=NO_FRICTION))


def test_partial_slip_is_a_law_of_rough_elastic_spheres_alone() -> None:
    slips = Hertz(E, G, micro_slip=True)
    assert isinstance(law_of(scene(Contact(0.0, mu=MU, hertz=slips))), MicroSlip)
    whole = dataclasses.replace(slips, micro_slip=False)
    assert isinstance(law_of(scene(Contact(0.0, mu=MU, hertz=whole))), Elastic)


def test_spheres_rotate_where_torques_are_kept_or_have_rows() -> None:
    rotate = plain(spheres_rotate)
    some, none = np.zeros((2, 3)), np.zeros((0, 3))
    assert [rotate(turn, None) for turn in (None, some, none)] == [False, True, True]
    assert [rotate(turn, 0) for turn in (None, some, none)] == [False, True, False]


damped = plain(hertz.damping_at)


def viscosity(overlap: float) -> float:
    return 2.0 * Z * math.sqrt(MASS * 2.0 * E * math.sqrt(RADIUS * overlap))


@pytest.mark.parametrize("since", [0.2, 0.7, 1.0])
def test_the_first_step_of_an_elastic_contact_makes_up_for_where_in_it_it_closes(
    since: float,
) -> None:
    """In t^(1/4), the sum of steps and the integral agree from there on."""
    overlap, law = 1e-4, Elastic(E, None, Z, (0.0, 0.0))
    before = overlap * (1.0 - 1.0 / since)
    found = damped(law, before, overlap, RADIUS, MASS) / viscosity(overlap) * since**0.25
    count = 2000
    rest = ((since + np.arange(1, count)) ** 0.25).sum()
    far = since + count
    assert found + rest == pytest.approx(
        0.8 * far**1.25 - 0.5 * far**0.25 + far**-0.75 / 48.0, abs=2e-5
    )


@pytest.mark.parametrize(("part", "first"), [(0.9, True), (1.1, False), (1e9, False), (-1.0, True)])
def test_an_overlap_that_is_rounding_counts_as_none(part: float, first: bool) -> None:
    way = 1e-4
    before = part * TOUCHES * way
    law = Elastic(E, None, Z, (0.0, 0.0))
    found = damped(law, before, before + way, RADIUS, MASS)
    assert (found == pytest.approx(viscosity(before + way), rel=1e-3)) != first


def test_a_contact_closes_at_the_earliest_as_a_step_begins() -> None:
    """An overlap before it that is rounding changes nothing, nor does one that is not there."""
    way, law = 1e-4, Elastic(E, None, Z, (0.0, 0.0))
    overlap = way * (1.0 + 0.9 * TOUCHES)
    found = damped(law, 0.9 * TOUCHES * way, overlap, RADIUS, MASS)
    first = plain(hertz.first_step_factor)(1.0)
    assert found == pytest.approx(first * viscosity(overlap), rel=1e-12)
    assert plain(linear.closing_factor)(2e-4, 1e-4) == 1.5


def test_what_has_no_damping_has_no_viscosity() -> None:
    assert plain(hertz.viscosity)(E, None, 1e-4, RADIUS, MASS) == 0.0
    assert damped(Elastic(E, None, None, (0.0, 0.0)), 1e-5, 1e-4, RADIUS, MASS) == 0.0
    law = MicroSlip(E, (G, MU), None, (0.0, 0.0))
    assert plain(micro_slip.damping_at)(law, 1e-5, 1e-4, RADIUS, MASS) == 0.0
    smooth = Linear(1e4, None, None)
    assert plain(linear.damping_at)(smooth, -1e-5, 1e-4, RADIUS, MASS) == 0.0


@pytest.mark.parametrize(
    ("before", "share"), [(-3e-4, 0.75), (-1e-4, 1.0), (0.0, 1.5), (1e-9, 1.0), (2e-4, 1.0)]
)
def test_a_dashpot_that_closes_within_a_step_counts_for_half_a_step_and_what_is_left(
    before: float, share: float
) -> None:
    law = Linear(1e4, None, 40.0)
    found = plain(linear.damping_at)(law, before, 1e-4, RADIUS, MASS)
    assert found == pytest.approx(40.0 * share)


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


def test_rows_that_no_sphere_has_are_fixed() -> None:
    reduced, mass = plain(reduced_mass), np.array([2.0, 3.0])
    assert reduced(mass, 0, 1) == pytest.approx(1.2)
    assert reduced(mass, 2, 1) == reduced(mass, 1, 5) == pytest.approx(3.0)
