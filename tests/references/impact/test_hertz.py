"""Claims about Hertz's impact: known values, and three routes that agree to 1e-10."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.checks.impact import hertz as second
from reference_solutions.impact import hertz
from reference_solutions.impact.rebound import Law, Sphere, rebound

BALL = 4.0 / 3.0 * math.pi
positive = st.floats(1e-3, 1e3)


def test_two_limestone_spheres_meet_with_the_known_force_overlap_and_duration() -> None:
    modulus = hertz.effective_modulus(2e10, 0.25) / 2
    law = {"m": 2500 * BALL * 0.01**3 / 2, "v": 20.0}
    law["K"] = hertz.normal_factor(modulus=modulus, radius=0.005)
    assert hertz.largest_force(**law) == pytest.approx(7108.2413, abs=1e-4)
    assert hertz.deepest(**law) == pytest.approx(3.68304e-4, rel=1e-6)
    assert hertz.contact_time(**law) == pytest.approx(5.42009e-5, rel=3e-6)


def test_a_magnesium_sphere_meets_a_rigid_wall_with_the_known_force_and_duration() -> None:
    factor = hertz.normal_factor(modulus=hertz.effective_modulus(4e10, 0.35), radius=0.1)
    law = {"m": 1800 * BALL * 0.1**3, "K": factor, "v": 0.2}
    assert hertz.largest_force(**law) == pytest.approx(7232.6810, abs=1e-4)
    assert hertz.contact_time(**law) == pytest.approx(7.67065e-4, rel=3e-6)


@settings(max_examples=25)  # the first call includes imports
@given(m=positive, K=positive, v=positive)
def test_the_duration_is_the_quadrature_of_the_energy_integral(
    m: float, K: float, v: float
) -> None:
    closed = hertz.contact_time(m=m, K=K, v=v)
    assert second.contact_time(m=m, K=K, v=v) == pytest.approx(closed, rel=1e-12)
    assert rebound(Law(K, 0.0, 0.0), Sphere(1e9, m), vn=v).lasting == pytest.approx(
        closed, rel=1e-10
    )


@pytest.mark.parametrize("part", [0.05, 0.3, 0.5, 0.7])
def test_the_path_is_that_of_small_steps(part: float) -> None:
    law = {"m": 2.0, "K": 3e5, "v": 0.7}
    t = part * hertz.contact_time(**law)
    deep, _ = second.stepped(t, steps=3000, **law)
    assert deep == pytest.approx(float(hertz.overlap(np.array(t), **law)), rel=1e-10)


def test_they_part_with_the_speed_at_which_they_met() -> None:
    law = {"m": 2.0, "K": 3e5, "v": 0.7}
    end = hertz.contact_time(**law)
    later = hertz.overlap(np.array([end, 1.5 * end]), **law)
    assert later[1] - later[0] == pytest.approx(-0.7 * 0.5 * end, rel=1e-12)


def test_stiffness_across_over_that_along_is_what_mindlin_found() -> None:
    """At the same overlap the two are as 2 (1 - nu) to 2 - nu, for a body and for two alike."""
    young, nu, radius = 3e9, 0.3, 0.04
    normal, shear = hertz.effective_modulus(young, nu), hertz.effective_shear_modulus(young, nu)
    assert shear == pytest.approx(young / (2.0 * 1.3) / 1.7, rel=1e-14)
    along = 1.5 * hertz.normal_factor(modulus=normal, radius=radius)  # over sqrt(U)
    across = hertz.shear_factor(modulus=shear, radius=radius)
    assert across / along == pytest.approx(2.0 * 0.7 / 1.7, rel=1e-14)
    assert hertz.shear_factor(modulus=3.0, radius=4.0) == 48.0


def test_parameters_outside_their_range_are_named() -> None:
    with pytest.raises(ValueError, match="K = -1"):
        hertz.contact_time(m=1.0, K=-1.0, v=1.0)
