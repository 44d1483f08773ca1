"""What a case says of itself is checked as it is said: tolerances that could judge nothing."""

from __future__ import annotations

import math
from typing import Any

import pytest

from tests.conftest import Tiny
from vv.ask import Knobs
from vv.case import LARGEST_TOLERANCE, Tolerance, error_scale
from vv.records.finding import Bit


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"value": 0.0}, r"Tolerance\.value = 0; the relative error that it allows must be posit"),
        ({"value": -1e-3}, r"Tolerance\.value = -0\.001"),
        ({"value": math.nan}, r"Tolerance\.value = nan; the relative error .* must be positive$"),
        ({"dt": 0.0}, r"Tolerance\.dt = 0\.0 s"),
        ({"kn": -1e9}, r"Tolerance\.kn = -1000000000\.0 N/m"),
        ({"order": 2}, r"Tolerance\.order = 2; .* needs the dt"),
        ({"dt": 1e-3, "order": -1}, r"Tolerance\.order = -1; it must not be negative"),
        ({"softness": 0.5}, r"Tolerance\.softness = 0\.5; .* needs the kn"),
        ({"floor": -1e-9}, r"Tolerance\.floor = -1e-09; it must be zero or more"),
        ({"floor": math.inf}, r"Tolerance\.floor = inf; it must be zero or more"),
    ],
)
def test_a_tolerance_that_makes_no_sense_is_named(given: dict[str, Any], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        Tolerance(**{"value": 1e-3, "reason": "why", **given})


def test_an_answer_is_not_asked_for_until_a_run_is_measured_unless_a_user_poses_it(
    tiny: Tiny,
) -> None:
    """It may take its time; but a parameter for which there is none is the user's mistake."""
    refuse = 'raise ValueError("no answer")'
    tiny.edit("reference_solutions/fall.py", "return", f"{refuse}\n    return")
    assert tiny.vv("run", "fall:up", "--dry-run").returncode == 0
    posed = tiny.vv("run", "fall:up", "--dry-run", "--set", "speed=4m/s")
    assert (posed.returncode, "fall:up: with speed = 4.0 m/s: no answer" in posed.stderr) == (
        Bit.USAGE,
        True,
    )


@pytest.mark.parametrize("scale", [0.0, -1.0, float("nan"), float("inf")])
def test_errors_are_relative_to_something_positive_whenever_that_is_found(scale: float) -> None:
    with pytest.raises(ValueError, match=r"quantity 'y' has scale = .*; it must be positive"):
        error_scale("y", scale)
    with pytest.raises(ValueError, match=r"quantity 'y' has scale = .*; it must be positive"):
        error_scale("y", lambda: scale)


def test_a_tolerance_grows_with_the_step_and_falls_with_the_stiffness_within_its_limits() -> None:
    one = Tolerance(1e-3, "why", 1e-3, 2, 1e-5, kn=1e8, softness=0.5)
    assert one.at(Knobs(2e-3, 1e8)) == pytest.approx(4e-3)
    assert one.at(Knobs(1e-3, 1e10)) == pytest.approx(1e-4)
    assert one.at(Knobs(1e-6, 1e8)) == 1e-5
    assert one.at(Knobs(1.0, 1e8)) == LARGEST_TOLERANCE
