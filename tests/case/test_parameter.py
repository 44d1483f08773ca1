"""Claims about parameters: the signs and the units that they may have, and defaults of variants."""

from __future__ import annotations

import math
from typing import Any

import pytest

from vv.case import Case, Variant
from vv.case.parameter import Parameter, Sign


@pytest.mark.parametrize(
    ("unit", "sign", "value", "rule"),
    [
        ("kg", None, 1.0, ""),
        ("kg", None, 0.0, "must be positive"),
        ("kg", None, -1.0, "must be positive"),
        ("Pa s", None, 0.0, "must be positive"),
        ("N/m", None, 0.0, ""),
        ("N/m", None, -1.0, "must not be negative"),
        ("Hz", None, -1.0, "must not be negative"),
        ("m", None, -1.0, ""),
        ("m", Sign.POSITIVE, 0.0, "must be positive"),
        ("kg", Sign.ANY, -1.0, ""),
        ("m", None, math.inf, "must be finite"),
        ("kg", None, math.inf, "must be finite"),
        ("m", None, math.nan, "must be finite"),
        ("kg", None, -math.inf, "must be positive"),
    ],
)
def test_a_parameter_has_the_sign_of_its_unit_unless_it_says_otherwise(
    unit: str, sign: Sign | None, value: float, rule: str
) -> None:
    usual = -1.0 if sign is Sign.ANY else 1.0
    one = Parameter("p", usual, unit, "what", sign)
    if not rule:
        assert one.checked(value) == value
        return
    with pytest.raises(ValueError, match=rf"^p = .* {unit}; it {rule}$"):
        one.checked(value)


def test_units_of_parameters_are_those_of_mechanics_without_prefixes() -> None:
    for unit in ("", "m", "kg/m3", "N s/m", "1/s", "N/m3", "Pa s", "m2", "deg", "J/kg", "1/m s"):
        assert Parameter("p", 1.0, unit, "what").unit == unit
    for unit in (
        "lb",
        "mm",
        "kN/m",
        "m/",
        "/s",
        "1",
        "m/s/s",
        "m s-1",
        "metres",
        "m1",
        " m",
        "m\n",
    ):
        with pytest.raises(ValueError, match=r"^Parameter p: unit = '.*'; it must be made of kg,"):
            Parameter("p", 1.0, unit, "what")


def a_case(**defaults: float) -> Case:
    nothing: Any = None
    variants = tuple(
        Variant(name, "what", "y = 0", own) for name, own in (("usual", {}), ("own", defaults))
    )
    parameters = Parameter("m", 1.0, "kg", "mass"), Parameter("x", 2.0, "m", "way")
    return Case("c", "title", nothing, parameters, variants, nothing)


def test_a_variant_has_its_own_defaults_and_those_of_its_case_and_both_are_checked() -> None:
    case = a_case(m=3.0)
    assert case.defaults("usual") == {"m": 1.0, "x": 2.0}
    assert case.defaults("own") == {"m": 3.0, "x": 2.0}
    with pytest.raises(ValueError, match=r"m = -3\.0 kg; it must be positive"):
        a_case(m=-3.0)
