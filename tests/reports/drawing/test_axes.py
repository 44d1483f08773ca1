"""Claims about limits and ticks of axes, against numbers by hand."""

from __future__ import annotations

import numpy as np
import pytest

from reports.drawing.axes import Axis, linear_axis, log_axis


def limits(axis: Axis) -> tuple[float, float]:
    return axis.low, axis.high


def said(axis: Axis) -> list[str]:
    return [words for _, words in axis.ticks]


def number(words: str) -> float:
    """The number in a label, also in a power of ten such as 10⁻³."""
    power = words.removeprefix("10").translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
    return 10.0 ** int(power) if words.startswith("10") and power != "" else float(words)


@pytest.mark.parametrize(
    ("values", "low", "high", "ticks"),
    [
        ([0.0, 1000.0], -40.0, 1040.0, ["0", "500", "1000"]),  # 216 per label, rounded up to 500
        ([-3.0, 7.0], -3.4, 7.4, ["0", "5"]),
        ([4.0, 4.0], 1.84, 6.16, ["2", "3", "4", "5", "6"]),  # half of a constant either way
        ([-4.0, -4.0], -6.16, -1.84, ["-6", "-5", "-4", "-3", "-2"]),
        ([0.0, 0.0], -0.54, 0.54, ["-0.5", "0", "0.5"]),
        ([], -0.04, 1.04, ["0", "0.5", "1"]),
        ([1e-7, 2e-7], 0.96e-7, 2.04e-7, ["1e-7", "1.5e-7", "2e-7"]),
    ],
)
def test_a_linear_axis_has_round_numbers_and_four_per_cent_of_room(
    values: list[float], low: float, high: float, ticks: list[str]
) -> None:
    axis = linear_axis(np.array(values), 0.0, 1.0)
    assert limits(axis) == pytest.approx((low, high), rel=1e-12)
    assert said(axis) == ticks
    assert [place for place, _ in axis.ticks] == pytest.approx([float(one) for one in ticks])


def test_five_round_steps_fit_an_axis_without_room() -> None:
    assert said(linear_axis(np.array([0.0, 10.0]), 0.0, 1.0, 0.0)) == [
        "0",
        "2",
        "4",
        "6",
        "8",
        "10",
    ]


def test_values_are_constant_up_to_a_millionth_of_a_millionth() -> None:
    for spread, constant in ((0.8e-12, True), (1.2e-12, False)):
        axis = linear_axis(np.array([1.0, 1.0 + spread]), 0.0, 1.0)
        assert (axis.high - axis.low > 0.5) is constant


@pytest.mark.parametrize(
    ("values", "margin", "low", "high", "ticks"),
    [
        ([1e-3, 1e-1], 0.1, -3.2, -0.8, ["10⁻³", "10⁻²", "10⁻¹"]),
        ([1e-9, 1.0], 0.0, -9.12, 0.12, ["10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"]),
        ([1.0, 1.0], 0.1, -0.12, 0.12, ["1"]),
        ([2.0, 30.0], 0.0, 0.18103, 1.59712, ["2", "5", "10", "20"]),
        ([0.02, 0.3], 0.0, -1.81897, -0.40288, ["0.02", "0.05", "0.1", "0.2"]),
        ([], 0.0, -1.12, 0.12, ["0.1", "0.2", "0.5", "1"]),
    ],
)
def test_a_logarithmic_axis_has_decades_or_one_two_and_five(
    values: list[float], margin: float, low: float, high: float, ticks: list[str]
) -> None:
    axis = log_axis(np.array(values), margin, 0.0, 1.0)
    assert limits(axis) == pytest.approx((low, high), abs=1e-5)
    assert said(axis) == ticks
    assert [place for place, _ in axis.ticks] == pytest.approx([number(one) for one in ticks])


def test_places_and_values_are_each_other_s_inverse() -> None:
    linear = linear_axis(np.array([1.0, 3.0]), 10.0, 50.0, 0.5)  # 0 to 4
    assert (linear.place(3.0), linear.value(0.75)) == (40.0, 3.0)
    assert linear.at(np.array([1.0, 4.0])).tolist() == [20.0, 50.0]
    assert linear.limits() == "0 4"
    log = Axis(-1.0, 3.0, True, 40.0, 0.0, ())
    assert [log.place(100.0), log.value(0.75)] == pytest.approx([10.0, 100.0])
    assert log.at(np.array([0.1, 10.0])).tolist() == [40.0, 20.0]
    assert np.isnan(log.at(np.array([0.0, -1.0]))).all()
    assert log.limits() == "-1 3 1"


def test_an_axis_around_the_largest_and_the_least_number_ends_at_numbers() -> None:
    axis = log_axis(np.array([5e-324, 1e308]), 0.1, 0.0, 10.0)
    assert [axis.value(0.0), axis.value(1.0)] == pytest.approx([1e-307, 1e308])
    assert len(said(axis)) >= 3
