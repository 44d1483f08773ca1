"""Claims about impacts with losses: closed form, integration and other solutions agree."""

import math

import pytest

from reference_solutions.checks.impact import viscous as second
from reference_solutions.contact import dashpot
from reference_solutions.impact import hertz, spring, viscous
from reference_solutions.impact.rebound import Law, Sphere, rebound

SCENES = [{"m": 2.6e-4, "K": 4.2e9, "v": 3.9}, {"m": 11.3, "K": 2.3e9, "v": 0.2}]


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("z", [0.0, 0.02, 0.3, 0.7])
def test_two_routes_agree(z: float, scene: dict[str, float]) -> None:
    again = second.impact(z, **scene)
    assert viscous.restitution(z) == pytest.approx(again.restitution, rel=1e-10)
    for name in ("deepest", "largest_force", "contact_time", "cleared"):
        first = getattr(viscous, name)(z, **scene)
        assert first == pytest.approx(getattr(again, name), rel=1e-10), name


@pytest.mark.parametrize("z", [0.0, 0.02, 0.3, 0.7])
def test_two_routes_agree_on_a_linear_spring(z: float) -> None:
    law, v = {"m": 2.6e-4, "kn": 1.7e7, "z": z}, 3.9
    again = second.on_a_spring(z, m=2.6e-4, kn=1.7e7, v=v)
    assert dashpot.restitution(z) == pytest.approx(again.restitution, rel=1e-10)
    assert spring.deepest(v=v, **law) == pytest.approx(again.deepest, rel=1e-10)
    assert spring.largest_force(v=v, **law) == pytest.approx(again.largest_force, rel=1e-10)
    assert dashpot.contact_time(**law) == pytest.approx(again.contact_time, rel=1e-10)
    assert spring.cleared(**law) == pytest.approx(again.cleared, rel=1e-10)


def test_without_losses_it_is_hertz() -> None:
    scene = SCENES[0]
    assert viscous.restitution(0.0) == 1.0
    for name in ("deepest", "largest_force", "contact_time"):
        assert getattr(viscous, name)(0.0, **scene) == pytest.approx(
            getattr(hertz, name)(**scene), rel=1e-12
        )


@pytest.mark.parametrize("z", [0.1, 0.5])
def test_it_ends_as_an_oblique_impact_along_the_normal_does(z: float) -> None:
    after = rebound(Law(1e9, 0.0, 0.0, 1.5, z), Sphere(1.0, 2.0), vn=3.0)
    assert after.normal / 3.0 == pytest.approx(viscous.restitution(z), rel=1e-11)
    assert after.lasting == pytest.approx(viscous.contact_time(z, m=2.0, K=1e9, v=3.0), rel=1e-11)
    assert after.cleared == pytest.approx(viscous.cleared(z, m=2.0, K=1e9, v=3.0), rel=1e-11)


@pytest.mark.parametrize("e", [0.2, 0.5, 0.98, 1.0])
def test_the_damping_of_a_restitution_gives_that_restitution(e: float) -> None:
    assert viscous.restitution(viscous.damping(e)) == pytest.approx(e, rel=1e-14)


def test_a_restitution_of_more_than_critical_damping_is_refused() -> None:
    with pytest.raises(ValueError, match=r"e = 0\.1;"):
        viscous.damping(0.1)
    with pytest.raises(ValueError, match="z = 1"):
        viscous.restitution(1.0)
    assert viscous.restitution(0.912) == pytest.approx(math.exp(-2.0), rel=0.05)
