"""Claims about the unit of four bonded elements and the material of its lattice."""

from collections.abc import Callable
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.bonds import lattice_material, tetrahedral_unit
from reference_solutions.bonds.lattice_material import QUARTZITE, Element, Material
from reference_solutions.bonds.tetrahedral_unit import State
from reference_solutions.checks.bonds import tetrahedral_unit as in_space
from tests.support.turned_signs import caught, signs, turned

D = 1e-3
ELEMENT = lattice_material.element(QUARTZITE, D)
KN, KS = ELEMENT.kn, ELEMENT.ks
GAMMAS = [0.0, 0.25, 0.5, 1.0, KS / KN]
STRAINS = [sign * size for size in (1e-6, 1e-4, 5e-3) for sign in (1.0, -1.0)]
FAILURES = ["tension", "opening", "sliding"]
AGREEMENT = 1e-11  # relative, the lateral displacement over dz; 1e-13 is reached


def apart(state: State, measured: dict[str, float], kn: float = KN) -> float:
    """The largest relative difference of the routes; nan where one has no solution."""
    x = state.x
    pairs = [
        (measured["strain"], state.strain),
        (measured["fz"] * kn * D, state.fz),
        (measured["xn1"] * D, x.xn1),
        (measured["xs1"] * D, abs(x.xs1)),
    ]
    off = [abs(a / b - 1.0) for a, b in pairs] + [abs(measured["xn2"] * D - x.xn2) / abs(x.dz)]
    return float(np.max(off))


def failure(route: ModuleType, kind: str) -> State:
    state: State = getattr(route, f"{kind}_failure")(ELEMENT, D)
    return state


def failure_in_space(kind: str) -> dict[str, float]:
    force = KN * D
    return in_space.failure(kind, KS / KN, ELEMENT.xb / D, ELEMENT.fs0 / force, ELEMENT.mu_p)


@pytest.mark.parametrize("gamma", GAMMAS)
@pytest.mark.parametrize("strain", STRAINS)
def test_the_path_is_that_of_rates_in_space(strain: float, gamma: float) -> None:
    state = tetrahedral_unit.equilibrium(strain, kn=KN, ks=gamma * KN, d=D)
    measured = in_space.equilibrium(strain, gamma)
    assert apart(state, measured) < AGREEMENT
    assert measured["unbalanced"] < 1e-13 * abs(measured["fz"])


@pytest.mark.parametrize("gamma", GAMMAS[1:])
@pytest.mark.parametrize("strain", STRAINS)
def test_the_path_of_the_other_spring_is_a_balance_in_space(strain: float, gamma: float) -> None:
    state = tetrahedral_unit.equilibrium(
        strain, kn=KN, ks=gamma * KN, d=D, spring=tetrahedral_unit.total
    )
    assert apart(state, in_space.equilibrium_total(strain, gamma)) < AGREEMENT


@pytest.mark.parametrize("strain", STRAINS)
def test_the_state_under_a_force_is_that_at_its_strain(strain: float) -> None:
    at_strain = tetrahedral_unit.equilibrium(strain, kn=KN, ks=KS, d=D)
    under = tetrahedral_unit.loaded(at_strain.fz, kn=KN, ks=KS, d=D)
    assert under.strain == pytest.approx(strain, rel=1e-13)


@pytest.mark.parametrize("kind", FAILURES)
def test_strengths_are_those_of_rates_in_space(kind: str) -> None:
    assert apart(failure(tetrahedral_unit, kind), failure_in_space(kind)) < AGREEMENT


@pytest.mark.parametrize(
    "sign",
    signs(
        tetrahedral_unit,
        ("incremental", "_bonded", "_open", "_state", "_widened", "sliding_failure"),
    ),
)
def test_no_sign_of_the_path_can_be_turned(sign: int) -> None:
    def agrees() -> bool:
        route = turned(tetrahedral_unit, sign)
        state = route.equilibrium(-5e-3, kn=KN, ks=KS, d=D)
        return (
            apart(state, in_space.equilibrium(-5e-3, KS / KN)) < AGREEMENT
            and apart(failure(route, "sliding"), SLIDING) < AGREEMENT
        )

    assert caught(agrees)


SLIDING = failure_in_space("sliding")


def test_table_1_to_every_printed_digit() -> None:
    kn, ks, xb, fs0, mu_p = ELEMENT
    printed = [f"{kn / 1e6:.3f}", f"{ks / 1e6:.3f}", f"{xb * 1e7:.3f}", f"{fs0:.3f}", f"{mu_p:.4f}"]
    assert printed == ["46.794", "8.068", "1.704", "18.452", "0.3964"]
    assert f"{lattice_material.element_mass(2650.0, D) * 1e6:.3f}" == "1.874"


def test_table_1_to_twelve_digits() -> None:
    exact = Element(46793831.1079, 8067901.91516, 1.7037037037e-7, 18.4522727852, 0.396446609407)
    assert np.allclose(ELEMENT, exact, rtol=1e-11, atol=0)


@given(
    st.builds(
        Material,
        E=st.floats(1e6, 1e12),
        nu=st.floats(0.0, 0.2),
        Tu=st.floats(1e3, 1e9),
        Cu=st.floats(1e3, 1e9),
        mu_i=st.floats(0.36, 5.0),
    ),
    st.floats(1e-4, 1.0),
)
def test_the_conversion_is_its_inverse_turned_round(material: Material, d: float) -> None:
    again = lattice_material.material(lattice_material.element(material, d), d)
    assert np.allclose(again, material, rtol=1e-12, atol=1e-15)


def test_the_printed_friction_relation_states_half_the_confinement() -> None:
    assert lattice_material.printed_internal_friction(ELEMENT.mu_p) == pytest.approx(1.0, abs=1e-14)
    assert lattice_material.internal_friction(ELEMENT.mu_p) == pytest.approx(1.5606601718, abs=1e-9)


def test_the_corrected_confinement_is_the_balance_of_eq_9_under_the_true_stress() -> None:
    """Eqs. 1 and 9 of a confined unit at sliding, with the horizontal stress (sqrt6/2) Fx/d^2."""
    mu_p, fs0, fx = ELEMENT.mu_p, ELEMENT.fs0, -7.0
    a = np.array([[np.sqrt(6) / 9, np.sqrt(3) / 3], [np.sqrt(3) / 9, -np.sqrt(6) / 3]])

    def axial(fx: float) -> float:
        """The axial force Fz < 0 at which -Fs1 = fs0 - mu_p Fn1."""
        (n_z, n_x), (s_z, s_x) = a
        return float((fs0 - mu_p * n_x * fx + s_x * fx) / (mu_p * n_z - s_z))

    rise = 2 / np.sqrt(3) * (axial(fx) - axial(0.0)) / (np.sqrt(6) / 2 * fx)
    mu_i = lattice_material.internal_friction(mu_p)
    assert (np.sqrt(1 + mu_i**2) + mu_i) ** 2 == pytest.approx(rise, rel=1e-12)


@given(st.floats(-60.0, 60.0).filter(lambda f: abs(f) > 1e-3), st.floats(0.0, 1.0))
def test_small_strains_are_the_limit_of_the_path(fz: float, gamma: float) -> None:
    """Eqs. 2a-d are that limit, and so are Eqs. 4 and 6, which follow from them."""
    small = tetrahedral_unit.small_strain(fz, KN, gamma * KN)
    strain = 1e-9 * np.sign(fz)
    state = tetrahedral_unit.equilibrium(strain, kn=KN, ks=gamma * KN, d=D)
    assert np.allclose(np.array(state.x) / state.fz, np.array(small) / fz, rtol=1e-8, atol=1e-17)
    height = D * np.sqrt(2 / 3)
    E = 2 * fz / (np.sqrt(3) * D * D) / (small.dz / height)
    nu = -(small.xn2 / D) / (small.dz / height)
    assert pytest.approx(E, rel=1e-13) == lattice_material.youngs_modulus(KN, gamma * KN, D)
    assert nu == pytest.approx(lattice_material.poissons_ratio(KN, gamma * KN), abs=1e-14)


def slopes_of_total(g: float) -> tuple[float, float]:
    """The slopes of the modulus over E and of Poisson's ratio for the spring `total`; g = ks/kn."""
    E = -2.0 * (g + 3.0) * (4.0 * g - 3.0) / ((g + 1.0) * (g + 5.0) ** 2)
    return E, 6.0 * (g * g - 2.0) / (g + 5.0) ** 3


def slopes_of_incremental(g: float) -> tuple[float, float]:
    return tetrahedral_unit.modulus_slope(g), tetrahedral_unit.poisson_slope(g)


SLOPES = {"incremental": slopes_of_incremental, "total": slopes_of_total}


@given(st.floats(0.0, 1.0), st.sampled_from(sorted(SLOPES)))
@settings(max_examples=30)
def test_secants_differ_to_first_order_as_stated(gamma: float, name: str) -> None:
    spring = getattr(tetrahedral_unit, name)
    states = [
        tetrahedral_unit.equilibrium(e, kn=KN, ks=gamma * KN, d=D, spring=spring)
        for e in (1e-5, -1e-5)
    ]
    E = lattice_material.youngs_modulus(KN, gamma * KN, D)
    slopes = [
        (getattr(states[0], of) - getattr(states[1], of)) / 2e-5 for of in ("modulus", "poisson")
    ]
    first = SLOPES[name](gamma)
    assert slopes[0] / E == pytest.approx(first[0], abs=1e-6)
    assert slopes[1] == pytest.approx(first[1], rel=1e-5, abs=1e-6)


@pytest.mark.parametrize(
    ("strain", "E", "nu"), [(-1e-3, -5.02589e-4, 6.08120e-4), (-5e-3, -2.520506e-3, 3.042308e-3)]
)
def test_quartzite_at_finite_strain(strain: float, E: float, nu: float) -> None:
    state = tetrahedral_unit.equilibrium(strain, kn=KN, ks=KS, d=D)
    assert state.modulus / 90e9 - 1 == pytest.approx(E, abs=1e-9)
    assert state.poisson / 0.16 - 1 == pytest.approx(nu, abs=1e-9)


@pytest.mark.parametrize(("spring", "share"), [("incremental", 1 / 12), ("total", 1 / 36)])
def test_equal_springs_widen_to_second_order_only(spring: str, share: float) -> None:
    state = tetrahedral_unit.equilibrium(
        1e-5, kn=KN, ks=KN, d=D, spring=getattr(tetrahedral_unit, spring)
    )
    assert state.lateral / 1e-10 == pytest.approx(share, rel=5e-5)


def test_strengths_fall_short_of_eqs_7_8_and_14_by_finite_strain() -> None:
    opening = lattice_material.opening_strength(KN, KS, ELEMENT.xb, D)
    of = {"tension": 25e6, "opening": -opening, "sliding": -252e6}
    short = [failure(tetrahedral_unit, kind).stress / of[kind] - 1 for kind in FAILURES]
    assert np.allclose(short, [5.70799e-5, -1.181202e-3, -2.0725006e-2], rtol=1e-5)


def test_no_other_bond_fails_first() -> None:
    kn, ks, xb, fs0, mu_p = ELEMENT
    for kind in FAILURES:
        x = failure(tetrahedral_unit, kind).x
        assert x.xn1 <= xb * (1 + 1e-12)
        assert ks * abs(x.xs1) <= (fs0 - mu_p * kn * x.xn1) * (1 + 1e-12)
    assert failure(tetrahedral_unit, "tension").x.xn2 < xb


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: tetrahedral_unit.equilibrium(0.03, kn=1.0, ks=0.1, d=1.0), "strain = 0.03"),
        (lambda: tetrahedral_unit.loaded(0.0, kn=1.0, ks=0.1, d=1.0), "fz = 0.0 N"),
        (lambda: tetrahedral_unit.small_strain(1.0, -2.0, 0.0), "kn = -2.0 N/m"),
        (lambda: lattice_material.element(QUARTZITE._replace(nu=0.3), D), "nu = 0.3"),
        (lambda: lattice_material.element(QUARTZITE._replace(mu_i=0.3), D), "mu_i = 0.3"),
        (lambda: lattice_material.sliding_strength(1.0, 0.8, D), "mu_p = 0.8"),
        (lambda: lattice_material.opening_strength(1.0, 2.0, 1e-7, D), "ks = 2.0 N/m"),
    ],
)
def test_what_no_formula_covers_is_refused_by_name(
    wrong: Callable[[], object], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        wrong()
