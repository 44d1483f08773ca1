"""Each parameter of each case, 1 % off in an in-house code, fails a tolerance or is said not to."""

from pathlib import Path

import pytest

from bench.bounds import sensitivity
from vv.case import Case, Level, Shown
from vv.plan.project import find

PROJECT = find(Path(__file__))
CASES = [PROJECT.load_case(name) for name in PROJECT.case_names()]
ADAPTERS = sensitivity.in_house(PROJECT)


def judged(case: Case, variant: str) -> bool:
    """Whether anything of a variant is judged; of maps nothing is."""
    trial = case.declare(variant, case.defaults(variant))
    return not all(isinstance(one.judge, Shown) for one in trial.quantities)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_one_percent_off_is_seen(case: Case) -> None:
    quick = [one.name for one in case.variants if one.runs_at(Level.QUICK)]
    found = {
        name: sensitivity.unseen(case, name, ADAPTERS, Level.QUICK)
        for name in quick
        if judged(case, name)
    }
    assert {name: left for name, left in found.items() if left} == {}


# the level at which each variant of responding-block has springs that are stiff enough
STIFF = {
    "1d": Level.QUICK,
    "1d-mu-1": Level.DEFAULT,
    "2d": Level.DEFAULT,
    "3d": Level.DEFAULT,
    "3d-turning": Level.QUICK,
}


@pytest.mark.parametrize(
    ("variant", "code"),
    [("1d", "dem"), ("1d-mu-1", "dem"), ("2d", "dem"), ("3d", "dem"), ("3d-turning", "dda")],
)
def test_springs_see_friction_one_percent_off_on_a_shaken_base(variant: str, code: str) -> None:
    """So does any code on springs that has no baseline, such as one of a stranger."""
    case, adapter = PROJECT.load_case("responding-block"), PROJECT.load_adapter(code)
    right, scheme = case.declare(variant, case.defaults(variant)), adapter.schemes[0]
    for wrong in sensitivity.off(case, variant, "mu"):
        found = sensitivity.shows(right, [wrong], adapter, scheme, STIFF[variant])
        assert found is not None
        assert found[0] > 1


@pytest.mark.parametrize("name", ["mu", "g"])
@pytest.mark.parametrize("variant", STIFF)
@pytest.mark.parametrize("scheme", ["dda/published", "dda/lagged"])
def test_friction_that_lags_is_seen_one_percent_off_on_a_shaken_base(
    variant: str, scheme: str, name: str
) -> None:
    assert sees("responding-block", variant, scheme, name, STIFF[variant])


@pytest.mark.parametrize("name", ["Ay", "fy", "f", "g"])
@pytest.mark.parametrize(
    ("variant", "scheme"),
    [
        ("two-directions", "dem/default"),
        ("two-directions", "dda/default"),
        ("two-directions", "dda/generalised-alpha"),
        ("two-directions-turning", "dda/default"),
    ],
)
def test_springs_see_shaking_in_two_directions_one_percent_off(
    variant: str, scheme: str, name: str
) -> None:
    assert sees("incline", variant, scheme, name, Level.QUICK)


@pytest.mark.parametrize("variant", ["T3", "T3-mirrored", "T3-swapped", "T3-free", "T3-rotated"])
@pytest.mark.parametrize("scheme", ["dem/default", "dem/published"])
def test_a_leapfrog_sees_the_viscosity_of_a_grazing_contact_at_the_default_level(
    variant: str, scheme: str
) -> None:
    """At the quick level its own error is as large as what 1 % of it changes."""
    assert sees("single-contact", variant, scheme, "eta", Level.DEFAULT)


def sees(case_name: str, variant: str, named: str, name: str, level: Level) -> bool:
    """Whether a scheme with a parameter 1 % off, to one side or the other, fails a tolerance."""
    case, (code, scheme_name) = PROJECT.load_case(case_name), named.split("/")
    adapter = PROJECT.load_adapter(code)
    (scheme,) = (one for one in adapter.schemes if one.name == scheme_name)
    right = case.declare(variant, case.defaults(variant))
    wrongs = sensitivity.off(case, variant, name)
    found = sensitivity.shows(right, wrongs, adapter, scheme, level)
    return found is not None and found[0] > 1


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_what_is_said_to_be_unseen_has_a_reason_and_is_neither_inert_nor_unknown(
    case: Case,
) -> None:
    names = {parameter.name for parameter in case.parameters}
    for variant in case.variants:
        assert variant.unseen.keys() <= names - variant.inert
        assert all(len(reason) > 20 for reason in variant.unseen.values())
