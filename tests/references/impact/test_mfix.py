"""Claims about MFiX's DEM cases 01 to 04 and 06: two routes agree and explain printed values."""

import math

import numpy as np
import pytest

from reference_solutions.checks.impact import dropped as second
from reference_solutions.checks.impact import sinking as third
from reference_solutions.impact import pressed_pair, slip_to_roll, spring
from reference_solutions.impact.dropped import Drop, path
from reference_solutions.impact.sinking import Sinking, motion

G = 9.80665
MASS = 2600.0 * 4.0 / 3.0 * math.pi * 0.1**3
SMALL = 4.0 / 3.0 * math.pi * 0.0005**3
PAIR = {"masses": (2e4 * SMALL, 1e4 * SMALL), "k": 1e3, "R": 5e-4, "H": 1.8e-3, "g": G}
SLIDE = slip_to_roll.Sliding(m=1e4 * SMALL, ks=1e4, mu=0.2, g=G, v0=0.1)


def pulling(e: float) -> float:
    """The damping ratio of the restitution e if the contact force may become tensile."""
    return -math.log(e) / math.hypot(math.pi, math.log(e))


@pytest.mark.parametrize("pulls", [False, True])
@pytest.mark.parametrize("z", [0.0, 0.03, 0.5])
def test_two_routes_agree_on_a_dropped_sphere(z: float, pulls: bool) -> None:
    bounces = 5 if z < 0.5 else 1
    seen = Drop(MASS, 5e4, z, G, pulls).tops(0.4, bounces)
    again = second.tops(0.4, bounces, m=MASS, kn=5e4, z=z, g=G, pulls=pulls)
    assert seen == pytest.approx(again, rel=1e-10)


@pytest.mark.parametrize("t", [1e-5, 1.8e-4, 1e-3])
def test_two_routes_agree_on_a_pressed_pair(t: float) -> None:
    start = (4.5e-4, 1.35e-3)
    seen = pressed_pair.heights(t, start, **PAIR)  # type: ignore[arg-type]
    again = second.pressed(t, start, **PAIR)  # type: ignore[arg-type]
    assert seen == pytest.approx(again, rel=1e-10)


@pytest.mark.parametrize("t", [5e-9, 0.01, 0.03])
def test_two_routes_agree_on_a_sphere_set_down_sliding(t: float) -> None:
    speed, rolls = second.sliding(t, **SLIDE._asdict())
    assert slip_to_roll.speed(t, SLIDE) == pytest.approx(speed, rel=1e-10)
    if rolls:
        assert SLIDE.rolls == pytest.approx(rolls, rel=1e-10)


@pytest.mark.shows("DEM01 is a contact that exerts tension until the overlap ends, to 2e-8 m")
def test_mfix_prints_a_dropped_sphere_whose_contact_may_pull() -> None:
    times = [0.28607148, 0.31541214, 0.34621984, 0.37556050, 0.40490117, 0.49585723]
    printed = [0.09872776, 0.02559695, 0.00307841, 0.04630117, 0.11820900, 0.29614061]
    seen = path(times, 0.4, 1, Drop(MASS, 1e4, pulling(0.9), G, True)) + 0.1
    assert seen == pytest.approx(printed, abs=2e-8)


@pytest.mark.shows(
    "The heights of DEM02 are those of its springs to 0.21 %, whereas the manual compares them "
    "with rigid contact, which is 6.4 % off"
)
def test_what_mfix_computes_of_bounces_is_right_for_its_springs_and_not_for_rigid_contact() -> None:
    printed = [0.41930671, 0.35478084, 0.30210579, 0.26026070, 0.22626641, 0.19944300]
    seen = [0.1 + top for top in Drop(MASS, 5e4, pulling(0.9), G, True).tops(0.4, 6)]
    assert np.abs(seen / np.array(printed) - 1).max() == pytest.approx(2.1e-3, abs=5e-5)
    rigid = 0.1 + 0.4 * 0.9**12
    assert printed[-1] / rigid == pytest.approx(1 - 0.064, abs=5e-4)


@pytest.mark.shows("DEM03 is the two modes of the pair")
def test_mfix_prints_the_modes_of_a_pressed_pair() -> None:
    times = np.array([0.00001286, 0.00018003, 0.00027005])
    seen = pressed_pair.heights(times, (4.5e-4, 1.35e-3), **PAIR)  # type: ignore[arg-type]
    assert seen[:, 0] == pytest.approx([0.00044961, 0.00042344, 0.00043208], abs=1e-8)


@pytest.mark.shows("DEM04 rolls at 2/7 v0/(mu g) with 5/7 v0")
def test_mfix_prints_two_sevenths_and_five_sevenths_of_a_sliding_sphere() -> None:
    late = slip_to_roll.speed(np.linspace(0.04, 0.05, 2001), SLIDE).mean()
    assert SLIDE.rolls * SLIDE.mu * G / SLIDE.v0 == pytest.approx(0.28571429, rel=2e-6)
    assert late / SLIDE.v0 == pytest.approx(0.71428571, rel=1e-4)


PARTICLE = Sinking(d=1e-4, rho=2000.0, rho_f=1.2, mu=1.8e-5, g=G, v0=0.4)


@pytest.mark.parametrize(
    "sinking", [PARTICLE, PARTICLE._replace(v0=2.0), PARTICLE._replace(d=5e-3, rho=1100.0)]
)
def test_two_routes_agree_on_a_sphere_that_sinks(sinking: Sinking) -> None:
    times = np.linspace(0.0, 8.0 * min(sinking.time, 1.0), 7)
    depth, speed = motion(times, sinking)
    again = third.motion(times, **sinking._asdict())
    assert depth == pytest.approx(again[0], rel=1e-10)
    assert speed == pytest.approx(again[1], rel=1e-10)


def test_a_sphere_sinks_at_first_under_its_weight_and_in_the_end_evenly() -> None:
    depth, speed = motion([1e-7, 20.0], PARTICLE)
    start = float(PARTICLE.rate(0.4))
    assert speed[0] - 0.4 == pytest.approx(1e-7 * start, rel=1e-5)
    assert depth[0] == pytest.approx(0.4e-7, rel=1e-5)
    assert abs(float(PARTICLE.rate(speed[1]))) < 1e-12


@pytest.mark.parametrize("v0", [0.05, 2.0])
def test_speeds_converge_fastest_where_drag_is_steepest(v0: float) -> None:
    """Drag grows with speed: the rate is that at the greater of the first and the last speed."""
    particle = PARTICLE._replace(v0=v0)
    most, h = max(v0, particle.last), 1e-6
    steepest = float(particle.rate(most - h) - particle.rate(most + h)) / (2.0 * h)
    assert min(v0, particle.last) < 0.5 * most
    assert particle.quickest == pytest.approx(steepest, rel=1e-8)


@pytest.mark.shows(
    "exact to all 8 digits that MFiX prints of its own integration, and to 0.005 % of the velocity",
    "DEM06 is a particle that sinks in gas with the drag of Schiller and Naumann",
)
def test_mfix_prints_a_particle_that_sinks() -> None:
    """In the frame of MFiX the gas rises at 0.4 m/s; the initial position is 0.0925 m."""
    times = np.array([0.01, 0.05, 0.1, 0.2, 0.35])
    depth, speed = motion(times, PARTICLE)
    exact = [-0.01255261, -0.04078891, -0.05263133, -0.05701037, -0.05739251]
    assert 0.4 - speed == pytest.approx(exact, abs=1e-8)
    places = [0.09243469, 0.09127660, 0.08888122, 0.08331620, 0.07472123]
    assert 0.0925 + 0.4 * times - depth == pytest.approx(places, abs=1e-8)
    computed = [-0.01255313, -0.04078975, -0.05263160, -0.05701005, -0.05739209]
    assert 0.4 - speed == pytest.approx(computed, rel=5e-5)


@pytest.mark.shows("With Stokes' drag it would sink a third too fast")
def test_stokes_drag_would_have_the_particle_of_dem06_sink_a_third_too_fast() -> None:
    stokes = (1.0 - 1.2 / 2000.0) * G * PARTICLE.time
    assert stokes / PARTICLE.last > 1.3


def test_parameters_outside_their_ranges_are_refused() -> None:
    with pytest.raises(ValueError, match="z = 1"):
        Drop(1.0, 1.0, 1.0, 1.0).tops(1.0, 1)
    with pytest.raises(ValueError, match="a contact opens"):
        pressed_pair.heights(0.0, (3e-4, 1.35e-3), **PAIR)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="mu = 1000000"):
        slip_to_roll.speed(1.0, SLIDE._replace(mu=1e6))
    with pytest.raises(ValueError, match="heavier than the fluid"):
        motion([1.0], PARTICLE._replace(rho=1.0))
    assert spring.damping(1.0) == 0.0
