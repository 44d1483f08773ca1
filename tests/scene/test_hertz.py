"""Claims about contact of elastic spheres as data: what it asks for, what it refuses."""

import numpy as np
import pytest

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
