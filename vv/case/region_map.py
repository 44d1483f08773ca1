"""A plane of two parameters, divided by borders into regions, in which quantities are points."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class RegionMap:
    """Regions and their borders, and which quantity says in which region a point is found.

    x, y: what lies along the axes, with units. modes: the word for each value 0, 1, ... that the
    quantities take. borders: exact lines, each through two places or more. points: name of a
    quantity -> the point that it asks. Raises ValueError for a border of less than two places or a
    place that is not finite.
    """

    x: str
    y: str
    modes: tuple[str, ...]
    borders: tuple[tuple[Place, ...], ...]
    points: Mapping[str, Place]

    def __post_init__(self) -> None:
        for number, border in enumerate(self.borders):
            if len(border) < 2:
                raise ValueError(f"borders[{number}] = {border}; a border has two places or more")
        lines = (place for border in self.borders for place in border)
        for place in (*lines, *self.points.values()):
            if not all(map(math.isfinite, place)):
                raise ValueError(f"place {place} of a map of regions; places must be finite")
