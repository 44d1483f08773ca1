"""Claims about single kernels of contacts in DEM, which have truths by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vv.engines.dem.contact import hertz
from vv.engines.dem.contact.hertz import Elastic
from vv.engines.dem.contact.linear import friction_limits
from vv.engines.dem.contact.micro_slip import FIRST, ROOM, SPRINGS, MicroSlip, spring_spacing
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import compiled
from vv.engines.kernels.triples import NOWHERE, Triple
from vv.scene import Vector

UP = (0.0, 0.0, 1.0)
KN, MU, ETA = 1e5, 0.3, 200.0  # N/m, N s/m


def touching(overlap: float, opened: float, rates: tuple[float, float]) -> Touch:
    return Touch(overlap, opened, UP, UP, UP, rates, NOWHERE, NOWHERE, 0.0)


@compiled
def limits(touch: Touch, eta: float | None, spring: Triple) -> tuple[float, float]:
    return friction_limits(KN, MU, eta, touch, spring)


def test_friction_is_limited_by_springs_and_dashpots_together() -> None:
    """The gap closes at 0.5 and then at 0.4 m/s: a dashpot presses by 100 N, then by 80 N."""
    touch = touching(2e-3, -1e-3, (-0.5, -0.4))
    assert limits(touch, ETA, NOWHERE) == pytest.approx((MU * 200.0, MU * 280.0))
    assert limits(touch, None, NOWHERE) == pytest.approx((MU * 100.0, MU * 200.0))


def test_friction_before_a_step_is_at_least_what_there_is_and_after_it_nothing_pulls() -> None:
    touch = touching(1e-3, 1e-3, (1.5, 1.0))
    assert limits(touch, ETA, (3.0, 4.0, 0.0)) == pytest.approx((5.0, 0.0))


@compiled
def spaced(law: MicroSlip, touch: Touch, radius: float, mass: float, kept: Vector) -> float:
    return spring_spacing(law, touch, radius, mass, kept, 0)


def test_springs_of_a_new_contact_reach_to_where_its_speed_can_press_it() -> None:
    """There, 8/15 E* sqrt(R) (U^5/2 - U0^5/2) is the energy m v^2/2; none is stretched yet."""
    modulus, radius, mass, overlap, speed = 1e9, 0.05, 0.3, 1e-6, 2.0
    law, touch = (
        MicroSlip(modulus, (1e9, MU), None, (0.0, 0.0)),
        touching(overlap, 0.0, (0, -speed)),
    )
    kept = np.zeros((1, law.columns))
    kept[0, FIRST:] = 1.0
    apart = spaced(law, touch, radius, mass, kept)
    pressed = 0.5 * mass * speed**2 / (8 / 15 * modulus * math.sqrt(radius))
    deepest = (overlap**2.5 + pressed) ** 0.4
    assert apart * (SPRINGS - 1) == pytest.approx(ROOM * math.sqrt(deepest))
    assert not kept[0, FIRST:].any()


@pytest.mark.parametrize(("reach", "times"), [(511.5, 1), (512.5, 2), (513.5, 2), (1025.0, 4)])
def test_springs_of_a_contact_that_outgrows_them_are_spread(reach: float, times: int) -> None:
    """The last of 513 springs is 512 spacings away; where all move apart, each second is kept."""
    apart, law = 1e-4, MicroSlip(1e9, (1e9, MU), None, (0.0, 0.0))
    kept = np.zeros((1, law.columns))
    kept[0, :FIRST] = 1.0, 0.0, 0.0, apart
    kept[0, FIRST::3] = np.arange(1.0, SPRINGS + 1.0)
    touch = touching((reach * apart) ** 2, 0.0, (0.0, 0.0))
    assert spaced(law, touch, 0.05, 0.3, kept) == pytest.approx(times * apart)
    stayed = np.arange(1.0, SPRINGS + 1.0, times)
    assert (kept[0, FIRST::3][: len(stayed)] == stayed).all()
    assert not kept[0, FIRST::3][len(stayed) :].any()


ELASTIC = Elastic(1e8, (8e7, MU), 0.2, (0.0, 0.0))
RADIUS, MASS = 0.04, 0.3  # m, kg


@compiled
def hertzian(
    law: Elastic, touch: Touch, spring: Triple
) -> tuple[tuple[float, float], float, float, tuple[float, float]]:
    ks, caps = hertz.shear_stiffness(law, touch, RADIUS, MASS, spring)
    seen = hertz.shear_energy(law, touch.overlap, RADIUS, spring)
    return hertz.normal_force(law, touch.overlap, RADIUS), ks, seen, caps


def damped(overlap: float) -> float:
    """2 z sqrt(m kn) [N s/m], with kn = 2 E sqrt(R U)."""
    return 2.0 * 0.2 * math.sqrt(MASS * 2.0 * 1e8 * math.sqrt(RADIUS * overlap))


def pushed(overlap: float) -> float:
    return 4.0 / 3.0 * 1e8 * math.sqrt(RADIUS * overlap) * overlap


@pytest.mark.parametrize("opened", [-6e-5, 3e-5])
def test_elastic_spheres_press_and_rub_as_hertz_and_mindlin_say(opened: float) -> None:
    """The shear stiffness is the mean of 8 G sqrt(R U), with U linear in time."""
    u, rates, spring = 1e-4, (-0.02, -0.03), (0.1, -0.2, 0.2)
    (push, held), ks, sprung, caps = hertzian(ELASTIC, touching(u, opened, rates), spring)
    assert (push, held) == pytest.approx((pushed(u), 0.4 * pushed(u) * u))
    parts = u + opened * (np.arange(10_000) + 0.5) / 10_000
    assert ks == pytest.approx(8.0 * 8e7 * math.sqrt(RADIUS) * np.mean(np.sqrt(parts)), rel=1e-7)
    assert sprung == pytest.approx(0.5 * 0.09 / (8.0 * 8e7 * math.sqrt(RADIUS * u)))
    due = [pushed(u + opened) + 0.02 * damped(u + opened), pushed(u) + 0.03 * damped(u)]
    assert caps == pytest.approx([MU * due[0], MU * due[1]])


def test_friction_of_elastic_spheres_is_never_pulled_nor_less_than_before() -> None:
    caps = hertzian(ELASTIC, touching(1e-4, 1e-5, (90.0, 90.0)), (1.0, -2.0, 2.0))[3]
    assert caps == pytest.approx((3.0, 0.0))
