"""Claims about the confined unit: two routes agree, also on the unit without confinement."""

from types import ModuleType

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.bonds import confined_unit, lattice_material, tetrahedral_unit
from reference_solutions.bonds.lattice_material import QUARTZITE, Element
from reference_solutions.checks.bonds import confined_unit as integrated
from tests.support.turned_signs import caught, signs, turned

D = 1e-3
LOADS = 4  # of what is found, which may be nil
STRAINS = 10.0  # loads are strains over 2e-4, of which lengths accurate to 1e-10 leave 1e-6
ELEMENT = lattice_material.element(QUARTZITE, D)


def apart(
    route: ModuleType,
    element: Element,
    fx: float,
    second: ModuleType = integrated,
    overshoot: float = 1.0,
) -> float:
    """The largest difference of the two routes: of loads over what bonds bear, else relative."""
    due = second.sliding_failure(**element._asdict(), d=D, fx=fx, overshoot=overshoot)
    found = route.sliding_failure(element, D, fx, overshoot)
    sizes = [*map(abs, due[:-LOADS]), *[STRAINS] * LOADS]
    off = (abs(one - other) / size for one, other, size in zip(found, due, sizes, strict=True))
    return float(max(off))


@given(st.floats(0.0, 30.0), st.floats(0.05, 0.6), st.floats(0.8, 1.5), st.floats(0.0, 1.0))
@settings(max_examples=15)
def test_the_two_routes_agree(fx: float, mu_p: float, stronger: float, overshoot: float) -> None:
    element = ELEMENT._replace(mu_p=mu_p, fs0=stronger * ELEMENT.fs0)
    assert apart(confined_unit, element, fx, overshoot=overshoot) < 1e-7


def test_they_agree_on_quartzite() -> None:
    assert apart(confined_unit, ELEMENT, 8.0) < 1e-7


def test_without_loads_it_is_the_unit() -> None:
    bare = tetrahedral_unit.sliding_failure(ELEMENT, D)
    opened = tetrahedral_unit.opening_failure(ELEMENT, D)
    assert confined_unit.sliding_failure(ELEMENT, D, 0.0)[:4] == pytest.approx(
        (-bare.stress, bare.strain, opened.strain, -opened.stress), rel=1e-11
    )


def test_small_strains_have_twice_the_printed_slope() -> None:
    """With elements 1000 times as stiff, which fail at a thousandth of the strain."""
    stiff = ELEMENT._replace(kn=1e3 * ELEMENT.kn, ks=1e3 * ELEMENT.ks, xb=1e-3 * ELEMENT.xb)
    free, held = (confined_unit.sliding_failure(stiff, D, fx).pressure for fx in (0.0, 8.0))
    slope = (held - free) / confined_unit.horizontal_stress(8.0, D)
    assert slope == pytest.approx(2.0 * lattice_material.printed_confinement(ELEMENT.mu_p), 1e-4)


@pytest.mark.parametrize(
    "sign", signs(confined_unit, without=("guess - 0.0001", "y - x", "y - guess"))
)
def test_any_wrong_sign_is_caught(sign: int) -> None:
    assert caught(lambda: apart(turned(confined_unit, sign), ELEMENT, 8.0) < 1e-7)


@pytest.mark.parametrize("sign", signs(integrated))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    wrong = turned(integrated, sign)
    assert caught(lambda: apart(confined_unit, ELEMENT, 8.0, wrong) < 1e-7)


def test_what_the_path_does_not_cover_is_refused() -> None:
    with pytest.raises(ValueError, match=r"fx = -1.0 N; it must be finite and at least 0"):
        confined_unit.sliding_failure(ELEMENT, D, -1.0)
    weak = ELEMENT._replace(fs0=5.0, mu_p=0.0)
    with pytest.raises(ValueError, match=r"fx = 40.0 N; inclined bonds slide before the base"):
        confined_unit.sliding_failure(weak, D, 40.0)
