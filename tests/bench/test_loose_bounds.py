"""Bounds that are far above the errors that codes reach say why."""

import pytest

from bench.bounds.loose_bounds import EPS, FAR, ROUNDING, Bound, of_case
from tests.findings.figures import PROJECT
from vv.case import Tolerance


@pytest.mark.parametrize("case", PROJECT.case_names())
def test_a_bound_of_more_than_a_hundred_times_the_error_says_why(case: str) -> None:
    """Tighten it, by what the method can do, or give its `Tolerance` the reason as `slack`."""
    silent = [one for one in of_case(PROJECT, case) if one.loose and not one.tolerance.slack]
    assert {one.name: str(one) for one in silent} == {}


def test_bounds_are_compared_with_accepted_errors_of_every_code_at_the_closest_setting() -> None:
    found = {one.name: one for one in of_case(PROJECT, "shaken-wedge")}
    assert {"rigid/default", "dda/default", "lmgc90/default"} <= {n.split()[1] for n in found}
    one = found["shaken-wedge:along rigid/default s"]
    assert one.setting.startswith("dt=")
    assert one.bound > one.error > 0
    assert one.times == one.bound / one.error


@pytest.mark.parametrize(
    ("bound", "error", "loose"),
    [
        (1.01 * FAR * 1e-6, 1e-6, True),
        (0.99 * FAR * 1e-6, 1e-6, False),
        (1e-6, 0.0, True),
        (1.01 * ROUNDING, 0.0, True),
        (ROUNDING, 0.0, False),
    ],
)
def test_loose_is_a_bound_of_a_hundred_errors_that_is_not_one_of_rounding(
    bound: float, error: float, loose: bool
) -> None:
    assert Bound("", "", bound, error, Tolerance(0.1, "")).loose is loose
    assert Bound("", "", bound, 0.0, Tolerance(0.1, "")).times == bound / EPS
