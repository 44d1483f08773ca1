"""Claims about a sphere that slides down a groove on springs: two routes agree on its path."""

import numpy as np
import pytest

from reference_solutions.checks.hard import wedge_on_springs as stepped
from reference_solutions.hard import wedge, wedge_on_springs

LAW = {"dip": 30.0, "xi": 1.0, "g": 9.81, "m": 1000.0, "ks": 1e9}


@pytest.mark.shows(
    "On springs a wedge sinks into a narrow groove",
    "The depth W/(4 kn sin^2(xi/2)) holds for any springs",
)
@pytest.mark.parametrize("mu", [0.0, 0.14, 0.26, 0.7])
@pytest.mark.parametrize("t", [5e-4, 2e-3, 0.02])
def test_the_two_routes_agree_on_what_swings_and_slides(mu: float, t: float) -> None:
    exact = float(wedge_on_springs.slid(np.array([t]), mu=mu, **LAW)[0])
    assert stepped.after(t, mu=mu, steps=40_000, **LAW) == pytest.approx(exact, rel=1e-5)


def test_stiff_springs_hardly_change_the_way_and_what_slips_to_a_stop_is_refused() -> None:
    t = np.array([1.0])
    rigid = {name: LAW[name] for name in ("dip", "xi", "g")}
    sprung = wedge_on_springs.slid(t, mu=0.14, **{**LAW, "ks": 1e14})
    assert sprung == pytest.approx(wedge.slid(t, mu=0.14, **rigid), rel=1e-5)
    with pytest.raises(ValueError, match="slips and stops"):
        wedge_on_springs.slid(t, mu=0.4, **LAW)
