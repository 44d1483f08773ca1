"""Claims about the choice among laws of an impact: the least of the largest errors is found.

No more errors are computed than the choice needs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from hypothesis import given
from hypothesis import strategies as st

from cases.impact.parts._oblique import least_of_largest

NUMBERS = st.lists(st.floats(0.0, 1.0), min_size=1, max_size=4)


@given(st.lists(NUMBERS, min_size=1, max_size=5))
def test_it_is_the_least_of_the_largest_numbers(rows: list[list[float]]) -> None:
    assert least_of_largest(rows) == min(max(row) for row in rows)


def test_a_row_that_is_beaten_is_not_asked_further() -> None:
    asked: list[int] = []

    def row(number: int, *values: float) -> Iterator[float]:
        for value in values:
            asked.append(number)
            yield value

    assert least_of_largest([row(0, 0.1, 0.2), row(1, 0.3, 0.0, 0.0), row(2, 0.0, 0.1)]) == 0.1
    assert asked == [0, 0, 1, 2, 2]


@given(NUMBERS, NUMBERS, st.integers(0, 4))
def test_what_is_no_number_is_seen_wherever_it_stands(
    before: list[float], after: list[float], place: int
) -> None:
    row = [*before[:place], math.nan, *before[place:]]
    assert math.isnan(least_of_largest([row, after]))
