"""Claims about contact of elastic spheres as data: what it asks for, what it refuses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vv.scene import Contact, Hertz, Scene, Spheres, Term, Wall, initial_normal_forces


def _scene(contact: Contact, overlap: float = 0.0) -> Scene:
    sphere = Spheres(
        position=np.array([[0.5 - overlap, 0.0, 0.0]]),
        velocity=np.zeros((1, 3)),
        radius=np.array([0.5]),
        mass=np.array([1.0]),
        free=np.ones((1, 3), bool),
    )
    return Scene((sphere, Wall(np.zeros(3), np.array([1.0, 0.0, 0.0]))), contact)


def test_a_scene_says_that_its_spheres_are_elastic_and_what_of_it_they_have() -> None:
    smooth = _scene(Contact(0.0, mu=0.3, hertz=Hertz(1e9))).terms()
    assert Term.HERTZ in smooth
    assert Term.FRICTION not in smooth
    rough = _scene(Contact(0.0, mu=0.3, hertz=Hertz(1e9, 4e8, damping=0.1))).terms()
    assert {Term.HERTZ, Term.FRICTION, Term.HERTZ_VISCOSITY} <= rough
    assert not {Term.HERTZ, Term.HERTZ_VISCOSITY} & _scene(Contact(1e6)).terms()


def test_springs_beside_elastic_spheres_are_refused() -> None:
    with pytest.raises(ValueError, match="must be 0 beside Contact"):
        Contact(1e6, hertz=Hertz(1e9))


@pytest.mark.parametrize(
    ("given", "said"),
    [((-1.0,), "modulus = -1"), ((1.0, -2.0), "shear_modulus = -2"), ((1.0, 0.0, -3.0), "damping")],
)
def test_a_modulus_out_of_range_is_named(given: tuple[float, ...], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        Hertz(*given)


def test_an_overlap_at_the_start_pushes_with_4_3_e_sqrt_r_u_to_3_2() -> None:
    force = initial_normal_forces(_scene(Contact(0.0, hertz=Hertz(1e9)), overlap=1e-4))
    assert force[0, 0] == pytest.approx(4 / 3 * 1e9 * np.sqrt(0.5) * 1e-6, rel=1e-9)


def test_two_spheres_that_overlap_push_with_the_radius_of_their_curvatures_together() -> None:
    place = np.array([[0.0, 0.0, 0.0], [1.25 - 1e-4, 0.0, 0.0]])
    radius = np.array([1.0, 0.25])  # 1/R = 1 + 4
    pair = Spheres(place, np.zeros((2, 3)), radius, np.ones(2), np.ones((2, 3), bool))
    force = initial_normal_forces(Scene((pair,), Contact(0.0, hertz=Hertz(1e9))))
    push = 4 / 3 * 1e9 * np.sqrt(0.2) * 1e-6
    assert force[:, 0] == pytest.approx([-push, push], rel=1e-9)


def test_the_factors_of_force_and_shear_stiffness_are_these() -> None:
    law = Hertz(3.0, 5.0)
    assert law.normal_factor(np.array([4.0])) == pytest.approx(2.0)  # 4/3 E sqrt(R)
    assert law.shear_factor(np.array([4.0])) == pytest.approx(20.0)  # 8 G sqrt(R)


@given(st.floats(-0.99, 0.5), st.floats(1e3, 1e12))
def test_a_material_is_found_from_the_moduli_of_two_equal_bodies(
    poisson: float, young: float
) -> None:
    shear = young / (2 * (1 + poisson))
    law = Hertz(young / (2 * (1 - poisson**2)), shear / (2 * (2 - poisson)))
    assert law.why_no_material() is None or poisson in (-0.99, 0.5)  # at the border by rounding
    assert law.material() == pytest.approx((young, poisson), rel=1e-9, abs=1e-9)


def test_without_a_shear_modulus_the_material_has_no_poisson_s_ratio() -> None:
    assert Hertz(3.0).material() == (6.0, 0.0)


@pytest.mark.parametrize(
    ("shear", "there"), [(0.0, True), (0.9, False), (1.0, True), (1.9, True), (2.0, False)]
)
def test_moduli_that_no_material_has_are_told(shear: float, there: bool) -> None:
    why = Hertz(6.0, shear).why_no_material()
    assert (why is None) is there
    assert why is None or why.startswith(f"6 G/E = {shear:g}; this code makes moduli")


def test_slip_in_part_needs_a_shear_modulus_and_no_damping() -> None:
    assert Hertz(1.0, 1.0, micro_slip=True).micro_slip
    for shear, damping in ((0.0, 0.0), (1.0, 0.1), (0.0, 0.1)):
        with pytest.raises(ValueError, match=r"Hertz\.micro_slip with"):
            Hertz(1.0, shear, damping, micro_slip=True)


@pytest.mark.parametrize("value", [0.0, np.inf])
def test_a_modulus_is_positive_and_finite_and_a_shear_modulus_and_damping_finite(
    value: float,
) -> None:
    with pytest.raises(ValueError, match=r"Hertz\.modulus"):
        Hertz(value)
    if value:
        with pytest.raises(ValueError, match="shear_modulus = inf Pa"):
            Hertz(1.0, value)
        with pytest.raises(ValueError, match="damping = inf; it"):
            Hertz(1.0, 0.0, value)
