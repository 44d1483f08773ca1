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
from vv.engines.dem.contact.micro_slip import MicroSlip
from vv.engines.dem.contact.touch import reduced_mass
from vv.scene import Contact, Hertz, Scene, Spheres, Wall

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


def test_rows_that_no_sphere_has_are_fixed() -> None:
    reduced, mass = plain(reduced_mass), np.array([2.0, 3.0])
    assert reduced(mass, 0, 1) == pytest.approx(1.2)
    assert reduced(mass, 2, 1) == reduced(mass, 1, 5) == pytest.approx(3.0)
