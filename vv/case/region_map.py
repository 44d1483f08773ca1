"""A plane of two parameters that borders divide into regions; quantities are points in it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class RegionMap:
    """Regions and their borders, and the quantities that say in which region a point lies.

    x, y: labels of the axes, with units. modes: the word for each value 0, 1, ... of the
    quantities. borders: exact curves, each through two or more points. points: name of a quantity
    -> its point. Raises ValueError for a border of fewer than two points or a point that is not
    finite.
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
