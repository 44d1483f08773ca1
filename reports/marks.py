"""How each code/scheme looks: colour, marker shape and dash, the same over the whole report."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

Polygon = tuple[tuple[float, float], ...]

# Okabe and Ito (2008), without the yellow that no one sees on white; black comes last
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
DASHES: tuple[tuple[float, ...], ...] = ((), (4.0, 1.5), (1.0, 1.2))


def _regular(corners: int, turn: float = 0.0, radius: float = 1.0) -> Polygon:
    angles = (2 * math.pi * i / corners + turn for i in range(corners))
    return tuple((radius * math.sin(a), radius * math.cos(a)) for a in angles)


def _star() -> Polygon:
    pairs = zip(_regular(5, 0.0, 1.1), _regular(5, math.pi / 5, 0.5), strict=True)
    return tuple(corner for pair in pairs for corner in pair)


def _cross() -> Polygon:
    a, b = 0.33, 0.95
    arm = ((-a, b), (a, b), (a, a))
    return tuple(
        point for turn in range(4) for x, y in arm for point in (_quarter_turns(x, y, turn),)
    )


def _quarter_turns(x: float, y: float, count: int) -> tuple[float, float]:
    for _ in range(count):
        x, y = y, -x
    return x, y


# As many shapes as have no divisor in common with the colours, so that pairs repeat late.
SHAPES: tuple[Polygon, ...] = (
    _regular(24, radius=0.9),
    _regular(4, math.pi / 4, 1.15),
    _regular(3, radius=1.1),
    _regular(4, radius=1.15),
    _regular(3, math.pi, 1.1),
    _cross(),
    _star(),
    _regular(3, math.pi / 2, 1.1),
    _regular(6),
    _regular(3, -math.pi / 2, 1.1),
    _regular(5),
)


@dataclass(frozen=True)
class Mark:
    """The look of one code/scheme. shape: corners within about the unit circle, y upwards."""

    label: str
    colour: str
    shape: Polygon
    dash: tuple[float, ...]

    @property
    def points(self) -> str:
        """The corners as an SVG polygon of radius 5, y downwards."""
        return " ".join(f"{5 * x:.2f},{-5 * y:.2f}" for x, y in self.shape)


def marks(labels: Iterable[str]) -> dict[str, Mark]:
    """A mark for each label, by its place in the sorted list of all."""
    return {
        label: Mark(
            label,
            COLOURS[i % len(COLOURS)],
            SHAPES[i % len(SHAPES)],
            DASHES[i // len(COLOURS) % len(DASHES)],
        )
        for i, label in enumerate(sorted(set(labels)))
    }
