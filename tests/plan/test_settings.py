"""What a user types as a value is read at once, or refused at once."""

import time

import pytest

from vv.base.errors import UsageError
from vv.case import Parameter
from vv.plan.settings import parse_value

SPEED = Parameter("speed", 1.0, "m/s", "a speed")


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
