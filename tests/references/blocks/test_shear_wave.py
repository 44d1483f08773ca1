"""Claims about shear waves in a column: two routes agree on waves, on steps and on damping."""

from types import ModuleType
from typing import Any

import numpy as np
import pytest

from reference_solutions.blocks import shear_wave
from reference_solutions.checks.blocks import shear_wave as second
from tests.support.turned_signs import caught, signs, turned

T = np.linspace(0.0, 0.5, 21)
WAVES = [
    {"y": 13.0, "height": 20.0, "c": 316.0, "D": 1.0, "F": 5.0},
    {"y": 29.0, "height": 30.0, "c": 200.0, "D": 0.3, "F": 2.0},
]
STEPS: list[dict[str, Any]] = [
    {"F": F, "dt": 8e-3, "layers": layers, "height": 30.0, "c": 300.0}
    for F in (1.5, 2.5, 7.5) for layers in (1, 15)
]  # fmt: skip
DAMPED = [{"F": F, "height": 30.0, "c": 300.0, "damping": 0.023} for F in (2.5, 7.5)]
HEAVY = {"F": 3.1, "height": 30.0, "c": 300.0, "damping": 0.4}


def apart(first: ModuleType, other: ModuleType = second) -> float:
    """The largest difference of the two routes, over a bound for each."""
    off = [
        np.abs(first.displacement(T, **law) - other.displacement(T, **law)).max() / 1e-6
        for law in WAVES
    ]
    off += [abs(first.layered_ratio(**s) / other.layered_ratio(**s) - 1.0) / 1e-9 for s in STEPS]
    for law in (*DAMPED, HEAVY):
        ratio = first.continuous_ratio(y=law["height"], **law)
        off.append(abs(ratio / other.continuous_ratio(**law) - 1.0) / 2e-4)
    return float(max(off))


def test_the_two_routes_agree() -> None:
    assert apart(shear_wave) < 1.0


def test_shake_has_the_figures_that_were_seen_and_the_step_those_of_its_own() -> None:
    ratios = [shear_wave.continuous_ratio(y=30.0, **law) for law in DAMPED]
    assert ratios == pytest.approx([27.6713, 9.20773], rel=1e-5)
    assert abs(shear_wave.layered_ratio(**STEPS[3])) == pytest.approx(20.221, rel=1e-4)


@pytest.mark.parametrize(
    "sign",
    signs(
        shear_wave,
        ("displacement", "layered_ratio", "continuous_ratio"),
        (
            "ceil(c * float(t.max(initial=0.0)) / (2.0 * height)) + 1",
            "1.0 - 2.0 * z * z + 2j * z * sqrt(1.0 - z * z)",  # of either sign the size is one
        ),
    ),
)
def test_any_wrong_sign_is_caught(sign: int) -> None:
    assert caught(lambda: apart(turned(shear_wave, sign)) < 1.0)


@pytest.mark.parametrize("sign", signs(second, without=("-matrix[:, 0]",)))
def test_any_wrong_sign_in_the_second_routes_is_caught(sign: int) -> None:
    assert caught(lambda: apart(shear_wave, turned(second, sign)) < 1.0)


def test_what_is_not_covered_is_refused() -> None:
    with pytest.raises(ValueError, match=r"y = 21.0 m; it must lie between 0 and the height"):
        shear_wave.displacement(T, **{**WAVES[0], "y": 21.0})
    with pytest.raises(ValueError, match=r"F = 70.0 Hz; steps of 0.008 s tell no sine from 62.5"):
        shear_wave.layered_ratio(**{**STEPS[0], "F": 70.0})
    with pytest.raises(ValueError, match=r"damping = 1.0; a ratio of damping must be below 1"):
        shear_wave.continuous_ratio(y=1.0, **{**DAMPED[0], "damping": 1.0})
