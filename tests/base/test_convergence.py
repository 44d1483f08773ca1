"""Claims about the limit of three resolutions: of power laws, as published, and where none is."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vv.base.metrics import GCI_SAFETY_FACTOR, Convergence, NoLimit, convergence


@given(st.floats(0.5, 4.0), st.floats(-3.0, 3.0), st.floats(0.01, 1.0), st.floats(1.2, 4.0))
def test_richardson_finds_the_limit_and_the_order_of_a_power_law(
    order: float, limit: float, size: float, ratio: float
) -> None:
    sizes = (size, ratio * size, ratio * ratio * size * 1.1)
    values = tuple(limit + 0.3 * h**order for h in sizes)
    found = convergence(sizes, values)
    assert isinstance(found, Convergence)
    assert found.order == pytest.approx(order, abs=1e-4)
    assert found.limit == pytest.approx(limit, abs=1e-5)


def test_the_grid_convergence_index_is_that_of_the_published_example() -> None:
    """Celik et al. (2008), Table 1: 18000, 8000 and 4500 cells in the plane."""
    sizes = tuple(cells**-0.5 for cells in (18000, 8000, 4500))
    found = convergence(sizes, (6.063, 5.972, 5.863))
    assert isinstance(found, Convergence)
    indices = [100 * GCI_SAFETY_FACTOR * abs(found.limit / value - 1) for value in (6.063, 5.972)]
    assert [round(index, 2) for index in indices] == [2.17, 4.11]
    assert found.order == pytest.approx(1.53, abs=0.005)
    assert found.limit == pytest.approx(6.1685, abs=5e-5)


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ((1.0, 1.1, 1.0), "oscillate"),
        ((1.0, 1.0, 1.0), "rounding"),
        ((1.0, 1.1, 1.15), "do not converge"),
        ((1.0, 1.1, 1.2), "do not converge"),
        ((1.0, 1.001, 2.0), "an order above 8"),
        ((0.0, 0.0, 0.3), "rounding"),
        ((0.0, 1e-13, 1.0), "rounding"),  # of the largest value, though the finest is zero
    ],
)
def test_values_without_a_law_have_no_limit_and_say_why(
    values: tuple[float, float, float], said: str
) -> None:
    found = convergence((1.0, 2.0, 4.0), values)
    assert isinstance(found, NoLimit)
    assert said in found.reason


@pytest.mark.parametrize("sizes", [(1.0, 4.0, 2.0), (2.0, 1.0, 4.0), (1.0, 1.0, 4.0)])
def test_sizes_that_do_not_increase_are_named(sizes: tuple[float, float, float]) -> None:
    found = convergence(sizes, (1.0, 1.1, 1.5))
    assert isinstance(found, NoLimit)
    assert "list them finest first" in found.reason


@pytest.mark.parametrize(("ratio", "converges"), [(1.9, False), (2.1, True)])
def test_values_converge_if_they_close_in_faster_than_the_logarithm_of_the_size(
    ratio: float, converges: bool
) -> None:
    """Sizes 1, 2 and 8: of order zero, differences are as ln 4 to ln 2, so as two to one."""
    found = convergence((1.0, 2.0, 8.0), (0.0, 1.0, 1.0 + ratio))
    assert isinstance(found, Convergence) == converges
