"""Claims that parameters for which a case has no solution are refused with value and rule."""

from __future__ import annotations

import pytest

from vv.plan.project import find


@pytest.mark.parametrize(
    ("case", "variant", "given", "words"),
    [
        ("galperin", "31", {"ratio": 73.2}, "is 27.0005, so near a whole number"),
        ("galperin", "31", {"ratio": 233.0, "m": 0.418}, "is 48.0229, so near a whole number"),
        ("galperin", "31", {"m": 1.6}, "overlap the wall by 0.01 m; at most a tenth"),
        ("galperin", "31", {"m": 1.76}, "overlap the wall by 0.0105 m; at most a tenth"),
        ("long-swing", "bonded", {"v_a": 0.0}, "v_a = 0.0 m/s; the speed must not be 0"),
        ("slow-slide", "level", {"v0": 0.0}, "the block must move, and friction must stop it"),
        ("slow-slide", "slope", {"mu": 0.01}, "the block must move, and friction must stop it"),
        ("stable-step", "undamped", {"mu": 0.0}, "mu = 0.0; it must be positive"),
        ("stable-step", "viscous", {"ks": 0.0}, "ks = 0.0 N/m; it must be positive"),
        ("standing", "arch", {"part": 0.973}, "part = 0.973; it must be above 1"),
        ("standing", "arch-thin", {"part": 1.0}, "part = 1.0; it must be below 1"),
        ("standing", "arch", {"mu": 0.398}, "mu = 0.398; whatever the thrust of an arch"),
        ("standing", "arch-thin", {"mu": 0.4}, "mu = 0.4; whatever the thrust of an arch"),
        ("tetrahedral-unit", "pulled", {"kn": 1e4}, "the unit creeps to rest"),
        ("packing", "seed-1", {"eta": 0.0}, "eta = 0.0 N s/m; without drag nothing"),
        ("tetrahedral-path", "out", {"rate": 2000.0}, "rate = 2000.0 1/s; it must not exceed 250"),
    ],
)
def test_a_parameter_that_leaves_no_answer_is_refused(
    case: str, variant: str, given: dict[str, float], words: str
) -> None:
    made = find().load_case(case)
    with pytest.raises(ValueError, match=words):
        made.declare(variant, {**made.defaults(variant), **given})
