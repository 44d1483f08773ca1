"""Claims about shear waves in a column: two routes agree on waves, on steps and on damping."""

from types import ModuleType
from typing import Any

import numpy as np
import pytest

from reference_solutions.blocks import shear_wave
from reference_solutions.checks.blocks import shear_wave as second
from tests.support.turned_signs import caught, signs, turned

SOILS = ((3.0, 3e8, 2200.0), (1.0, 5e7, 1800.0), (1.5, 2e8, 2000.0), (2.0, 1e8, 1900.0))
UNLIKE = [shear_wave.Layer(*soil) for soil in SOILS]
ALIKE = [shear_wave.Layer(2.0, 1.8e8, 2000.0)] * 15
T = np.linspace(0.0, 0.5, 21)
WAVES = [
    {"y": 13.0, "height": 20.0, "c": 316.0, "D": 1.0, "F": 5.0},
    {"y": 29.0, "height": 30.0, "c": 200.0, "D": 0.3, "F": 2.0},
]
CHAINS = [
    {"number": number, "layers": layers, "height": 13.0, "c": 254.0, "D": 1.0, "F": 3.1}
    for number, layers in ((1, 1), (3, 5), (20, 20))
]
STEPS: list[dict[str, Any]] = [
    {"F": F, "dt": 8e-3, "layers": layers, "height": 30.0, "c": 300.0}
    for F in (1.5, 2.5, 7.5) for layers in (1, 15)
]  # fmt: skip
DAMPED = [{"F": F, "height": 30.0, "c": 300.0, "damping": 0.023} for F in (2.5, 7.5)]
HEAVY = {"F": 3.1, "height": 30.0, "c": 300.0, "damping": 0.4}


def apart(first: ModuleType, other: ModuleType = second) -> float:
    """The largest difference of the two routes, each quantity over its own bound."""
    off = [
        np.abs(first.displacement(T, **law) - other.displacement(T, **law)).max() / 1e-6
        for law in WAVES
    ]
    off += [
        np.abs(first.layered_displacement(T, **law) - other.layered_displacement(T, **law)).max()
        / 1e-11
        for law in CHAINS
    ]
    off += [
        np.abs(
            first.stepped_displacement(80, dt=4e-3, **law)
            - other.stepped_displacement(80, dt=4e-3, **law)
        ).max()
        / 1e-11
        for law in CHAINS
    ]
    off += [abs(first.layered_ratio(**s) / other.layered_ratio(**s) - 1.0) / 1e-9 for s in STEPS]
    for law in (*DAMPED, HEAVY):
        ratio = first.continuous_ratio(y=law["height"], **law)
        off.append(abs(ratio / other.continuous_ratio(**law) - 1.0) / 2e-4)
    for F in (2.5, 7.5, 19.0):
        soils: dict[str, Any] = {"F": F, "dt": 8e-3, "layers": UNLIKE}
        off.append(abs(first.unlike_ratio(**soils) / other.unlike_ratio(**soils) - 1.0) / 1e-9)
        wave: dict[str, Any] = {"F": F, "layers": UNLIKE, "damping": 0.1}
        ratio = first.unlike_continuous_ratio(**wave) / other.unlike_continuous_ratio(**wave)
        off.append(abs(ratio - 1.0) / 2e-4)
    return float(max(off))


def test_layers_that_are_alike_are_those_of_one_material() -> None:
    law = {"F": 2.5, "dt": 8e-3}
    one = shear_wave.layered_ratio(**law, layers=15, height=30.0, c=300.0)
    assert shear_wave.unlike_ratio(**law, layers=ALIKE) == pytest.approx(one, rel=1e-12)
    damped = shear_wave.continuous_ratio(F=7.5, y=29.0, height=30.0, c=300.0, damping=0.023)
    many = shear_wave.unlike_continuous_ratio(F=7.5, layers=ALIKE, damping=0.023)
    assert many == pytest.approx(damped, rel=1e-12)


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
        (
            "displacement",
            "_chain",
            "layered_displacement",
            "stepped_displacement",
            "layered_ratio",
            "continuous_ratio",
            "unlike_ratio",
            "unlike_continuous_ratio",
            "_carried",
        ),
        (
            "ceil(c * float(t.max(initial=0.0)) / (2.0 * height)) + 1",
            "1.0 - 2.0 * z * z + 2j * z * sqrt(1.0 - z * z)",  # of either sign the size is one
        ),
    ),
)
def test_any_wrong_sign_is_caught(sign: int) -> None:
    assert caught(lambda: apart(turned(shear_wave, sign)) < 1.0)


def test_steps_tend_to_the_layers_and_layers_to_the_wave() -> None:
    law = {"height": 13.0, "c": 254.0, "D": 1.0, "F": 3.1}
    wave = shear_wave.displacement(T, y=12.75, **law)
    many = shear_wave.layered_displacement(T, number=26, layers=26, **law)
    assert np.abs(many - wave).max() < 3e-3 * np.abs(wave).max()
    exact = shear_wave.layered_displacement(T, number=5, layers=5, **law)

    def off(n: int) -> float:
        steps = shear_wave.stepped_displacement(20 * n, dt=0.025 / n, number=5, layers=5, **law)
        return float(np.abs(steps[::n] - exact).max())

    assert off(80) == pytest.approx(off(40) / 2.0, rel=0.05)


@pytest.mark.parametrize("sign", signs(second, without=("-matrix[:, 0]",)))
def test_any_wrong_sign_in_the_second_routes_is_caught(sign: int) -> None:
    assert caught(lambda: apart(shear_wave, turned(second, sign)) < 1.0)


def test_a_sine_of_two_steps_a_period_is_the_fastest_that_steps_resolve() -> None:
    """Below it both routes agree, whether layers are alike or not."""
    law: dict[str, Any] = {"F": 62.0, "dt": 8e-3}
    soils: dict[str, Any] = {"layers": 3, "height": 30.0, "c": 300.0}
    assert shear_wave.layered_ratio(**law, **soils) == pytest.approx(
        second.layered_ratio(**law, **soils), rel=1e-9
    )
    assert shear_wave.unlike_ratio(**law, layers=UNLIKE) == pytest.approx(
        second.unlike_ratio(**law, layers=SOILS), rel=1e-9
    )


def test_what_is_not_covered_is_refused() -> None:
    with pytest.raises(ValueError, match=r"y = 21.0 m; it must lie between 0 and the height"):
        shear_wave.displacement(T, **{**WAVES[0], "y": 21.0})
    with pytest.raises(
        ValueError, match=r"F = 70.0 Hz; steps of 0.008 s resolve no sine from 62.5"
    ):
        shear_wave.layered_ratio(**{**STEPS[0], "F": 70.0})
    with pytest.raises(
        ValueError, match=r"F = 70.0 Hz; steps of 0.008 s resolve no sine from 62.5"
    ):
        shear_wave.unlike_ratio(F=70.0, dt=0.008, layers=[shear_wave.Layer(1.0, 1e6, 2e3)])
    with pytest.raises(ValueError, match=r"damping = 1.0; a ratio of damping must be below 1"):
        shear_wave.continuous_ratio(y=1.0, **{**DAMPED[0], "damping": 1.0})
