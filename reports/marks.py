"""The look of each code/scheme: colour, marker and dash, the same in every report."""

from __future__ import annotations

import dataclasses
import math
import zlib
from collections.abc import Iterable
from dataclasses import dataclass

Polygon = tuple[tuple[float, float], ...]

# light and dark: at least 3:1 on white and on the dark paper; after Okabe and Ito (2008)
COLOURS = (
    ("#0072b2", "#56b4e9"),
    ("#d55e00", "#f08a4b"),
    ("#00875f", "#3fc79a"),
    ("#2b3138", "#dfe4ea"),
    ("#b04a86", "#e691c2"),
    ("#6f51b8", "#ab92f2"),
    ("#8f6a00", "#dcb23a"),
    ("#007f8f", "#4fc6d6"),
    ("#8a5528", "#cf9f70"),
    ("#5f7200", "#a9bf3f"),
)
DASHES = (
    "",
    "6 2.5",
    "2 2",
    "8 2.5 2 2.5",
    "4 1.5",
    "1.2 1.6",
    "10 3",
    "3 1.5 1 1.5",
    "5 1 1 1 1 1",
    "1 3",
)
# the schemes of vv, all with different marks; marks of others follow from digests of names
CODES = ("dem", "yade", "liggghts", "exact", "rigid", "dda", "lmgc90", "pybullet", "kratos")
SCHEMES = (
    "default",
    "half-step-mass",
    "published",
    "linearised",
    "lagged",
    "clump",
    "pre-overlapped",
    "polyhedra",
    "generalised-alpha",
    "augmented-lagrangian",
)


def _regular(corners: int, turn: float = 0.0, radius: float = 1.0) -> Polygon:
    angles = (2 * math.pi * i / corners + turn for i in range(corners))
    return tuple((radius * math.sin(a), radius * math.cos(a)) for a in angles)


def _star() -> Polygon:
    pairs = zip(_regular(5, 0.0, 1.1), _regular(5, math.pi / 5, 0.5), strict=True)
    return tuple(corner for pair in pairs for corner in pair)


def _cross() -> Polygon:
    a, b = 0.33, 0.95
    arm = ((-a, b), (a, b), (a, a))
    return tuple(_quarter_turns(x, y, turn) for turn in range(4) for x, y in arm)


def _quarter_turns(x: float, y: float, count: int) -> tuple[float, float]:
    for _ in range(count):
        x, y = y, -x
    return x, y


ROUND = _regular(12, radius=0.9)
SHAPES: tuple[Polygon, ...] = (
    ROUND,
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


UNNUMBERED = -1  # the number of curves that are not of a scheme


@dataclass(frozen=True)
class Mark:
    """The look of one code/scheme. colour: index of COLOURS; shape: corners within about the
    unit circle, y upwards; dash: as SVG has it, empty for a full line; number: its place among
    those of a report, by which drawings name it."""

    label: str
    colour: int
    shape: Polygon
    dash: str
    number: int = dataclasses.field(default=0, compare=False)

    @property
    def code(self) -> str:
        """The code, without its scheme."""
        return self.label.partition("/")[0]

    @property
    def scheme(self) -> str:
        """The scheme, without its code."""
        return self.label.partition("/")[2]

    @property
    def points(self) -> str:
        """The corners as an SVG polygon, y downwards."""
        return " ".join(f"{x:.2g},{-y:.2g}" for x, y in self.shape)


def mark(label: str) -> Mark:
    """The mark of a label: the colour by its code, the dash by its scheme, the shape by both."""
    code, _, scheme = label.partition("/")
    hue, kind = _place(code, CODES), _place(scheme, SCHEMES)
    shape = SHAPES[(3 * hue + 4 * kind) % len(SHAPES)]
    return Mark(label, hue % len(COLOURS), shape, DASHES[kind % len(DASHES)])


def _place(name: str, known: tuple[str, ...]) -> int:
    """The index of a known name, or a larger one from a digest of the name."""
    if name in known:
        return known.index(name)
    return len(known) + zlib.crc32(name.encode("utf-8", "surrogatepass")) % 997


def marks(labels: Iterable[str]) -> dict[str, Mark]:
    """A mark for each label, sorted."""
    found = enumerate(sorted(set(labels)))
    return {label: dataclasses.replace(mark(label), number=n) for n, label in found}
