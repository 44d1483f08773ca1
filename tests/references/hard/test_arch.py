"""Claims about arches of voussoirs: which of them the limit of thrust covers."""

import pytest

from reference_solutions.hard.arch import stands


@pytest.mark.parametrize(
    ("n", "t", "mu"),
    [(5, 0.2, 0.5), (8, 0.0, 0.5), (8, 2.0, 0.5), (8, 2.5, 0.5), (8, 0.2, -0.1)],
)
def test_an_arch_of_few_blocks_without_an_inside_or_with_negative_friction_is_refused(
    n: int, t: float, mu: float
) -> None:
    """At two mean radii the inner radius is zero."""
    with pytest.raises(ValueError, match="covered"):
        stands(n, t, mu)


def test_the_thickest_arch_stands_on_much_friction_and_not_without() -> None:
    assert stands(6, 1.99, 10.0)
    assert not stands(6, 1.99, 0.0)
