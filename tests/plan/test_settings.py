"""What a user types as a value is read at once, or refused at once."""

import time

import pytest

from vv.ask import Knobs
from vv.base.errors import UsageError
from vv.case import Case, Parameter, Sign, Source, Variant
from vv.plan.settings import parse_knobs, parse_value

COUNTED = Parameter("n", 6.0, "", "blocks", whole=True)
SPEED = Parameter("speed", 1.0, "m/s", "a speed")


def test_a_setting_may_have_units() -> None:
    assert parse_knobs("dt=50ms, kn=1GN/m") == Knobs(0.05, 1e9)
    assert parse_knobs("dt=1e-4,dd=0.9") == Knobs(1e-4, None, 0.9)
    with pytest.raises(UsageError, match=r"^--rung dt=1kg: dt = 1 'kg': not a unit"):
        parse_knobs("dt=1kg")


@pytest.mark.parametrize(
    "hostile", ["9**9**9**9", "m**9**9**9", "m**9" * 2000, "m" * 100_000, "(" * 5000, "__import__"]
)
def test_a_unit_that_would_have_to_be_calculated_is_refused_at_once(hostile: str) -> None:
    begun = time.process_time()
    with pytest.raises(UsageError, match=r"speed = 1 '.{1,60}': not a unit") as refused:
        parse_value(f"1 {hostile}", SPEED)
    assert time.process_time() - begun < 0.1
    assert len(str(refused.value)) < 150


@pytest.mark.parametrize("open_ended", ["1 (m", "1 m)", "1 (m/s))", "1 m/(s", "1 m/(s/(s"])
def test_brackets_that_do_not_pair_are_no_unit(open_ended: str) -> None:
    with pytest.raises(UsageError, match="not a unit"):
        parse_value(open_ended, SPEED)


@pytest.mark.parametrize(
    ("typed", "value"),
    [
        ("-36cm/s", -0.36),
        ("1 km/hour", 1 / 3.6),
        ("2", 2.0),
        ("3 m*s**-1", 3.0),
        ("1 (m/s)", 1.0),
        ("1 mm^1/ms", 1.0),
    ],
)
def test_units_are_converted(typed: str, value: float) -> None:
    assert parse_value(typed, SPEED) == pytest.approx(value)
    gravity = Parameter("g", 9.81, "m/s2", "gravity")
    assert parse_value("981cm/s2", gravity) == pytest.approx(9.81)
    assert parse_value("9.81 m/s^2", gravity) == pytest.approx(9.81)


@pytest.mark.parametrize(
    ("parameter", "typed", "rule"),
    [
        (Parameter("m", 1.0, "kg", "mass"), "-1", "m = -1.0 kg; it must be positive"),
        (Parameter("m", 1.0, "kg", "mass"), "-2 g", "m = -0.002 kg; it must be positive"),
        (Parameter("m", 1.0, "kg", "mass"), "0", "m = 0.0 kg; it must be positive"),
        (Parameter("E", 1.0, "Pa", "modulus"), "0", "E = 0.0 Pa; it must be positive"),
        (Parameter("ks", 1.0, "N/m", "spring"), "-1", "ks = -1.0 N/m; it must not be negative"),
        (Parameter("f", 1.0, "Hz", "frequency"), "-1", "f = -1.0 Hz; it must not be negative"),
        (Parameter("R", 1.0, "m", "size", Sign.POSITIVE), "0", "R = 0.0 m; it must be positive"),
        (
            Parameter("n", 6.0, "", "blocks", whole=True),
            "7.95",
            "n = 7.95; it must be a whole number",
        ),
        (COUNTED, "nan", "n = nan; it must be finite"),
        (SPEED, "1e308 km/s", "speed = inf m/s; it must be finite"),
        (SPEED, "nan", "speed = nan m/s; it must be finite"),
    ],
)
def test_a_value_that_breaks_a_rule_is_refused_by_it(
    parameter: Parameter, typed: str, rule: str
) -> None:
    with pytest.raises(UsageError) as refused:
        parse_value(typed, parameter)
    assert str(refused.value) == rule


def test_zero_and_either_sign_are_taken_where_they_may_be() -> None:
    assert parse_value("0", Parameter("ks", 1.0, "N/m", "spring")) == 0.0
    assert parse_value("-1", SPEED) == -1.0
    assert parse_value("-1", Parameter("m", 1.0, "kg", "change of mass", Sign.ANY)) == -1.0


def test_defaults_obey_the_rule() -> None:
    with pytest.raises(ValueError, match=r"m = -1.0 kg; it must be positive"):
        Parameter("m", -1.0, "kg", "mass")
    light = Variant("light", "", "", defaults={"m": 0.0})
    mass = Parameter("m", 1.0, "kg", "mass")
    with pytest.raises(ValueError, match=r"m = 0.0 kg; it must be positive"):
        Case("fall", "", Source("", ""), (mass,), (light,), lambda variant, p: None)  # type: ignore[arg-type,return-value]
