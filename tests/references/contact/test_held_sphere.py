"""Claims about a sphere held between walls by friction: two routes agree on its height."""

import numpy as np
import pytest

from reference_solutions.checks.contact import held_sphere as stepped
from reference_solutions.contact import held_sphere

LAW = {"m": 1.3, "ks": 8e5, "pressed": 42.7, "g": 9.81}


@pytest.mark.parametrize("mu", [0.0, 0.1, 0.16, 0.29, 0.3])
@pytest.mark.parametrize("t", [1e-3, 4e-3, 0.02])
def test_the_two_routes_agree_on_what_holds_slides_and_falls(mu: float, t: float) -> None:
    exact = float(held_sphere.height(np.array([t]), mu=mu, **LAW)[0])
    assert stepped.after(t, mu=mu, steps=20_000, **LAW) == pytest.approx(exact, abs=2e-8)


def test_without_friction_it_falls_and_with_enough_it_stays_within_its_springs() -> None:
    t = np.linspace(0.0, 0.1, 500)
    assert held_sphere.height(t, mu=0.0, **LAW)[-1] == pytest.approx(-9.81 * 0.1**2 / 2)
    sag = LAW["m"] * LAW["g"] / LAW["ks"]
    assert np.abs(held_sphere.height(t, mu=0.3, **LAW)).max() <= sag * (1 + 1e-12)


def test_a_mass_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="must be finite and positive"):
        held_sphere.height(np.zeros(1), mu=0.3, **{**LAW, "m": 0.0})
