"""Claims about the laws among which the nearest is sought: arms differ on walls alone."""

import pytest

from cases.impact.oblique_impact import CASE, _impacts
from cases.impact.parts._oblique import ARMS


@pytest.mark.parametrize(
    ("variant", "arms"),
    [("spun-alloy", ARMS), ("pair-alloy", ARMS[:1]), ("large-alloy-linear", ARMS[:1])],
)
def test_between_spheres_arms_end_in_the_middle_of_the_overlap(
    variant: str, arms: tuple[tuple[float, float], ...]
) -> None:
    impacts = _impacts(variant, CASE.defaults(variant))
    assert {choice[0] for choice in impacts._laws()} == set(arms)
