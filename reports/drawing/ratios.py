"""Draws all measurements at once as SVG: computed over measured, and the bias of each scheme."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from markupsafe import Markup, escape

from reports.drawing.svg import drawing, number, text, title
from reports.marks import Mark
from vv.insight.against_measurements import Compared, Factor

SLOT, LEFT, RIGHT, TOP, TALL, FEET = 9.0, 120.0, 12.0, 12.0, 240.0, 110.0  # px
GAP = 2.5  # slots between kinds
ROW, WIDE = 22.0, 620.0  # px
NAMED = 190.0  # of it, for the names of schemes
APART = 30.0  # numbers along an axis [px]
TICKS = (0.25, 0.5, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0, 4.0)
Place = Callable[[float], float]


@dataclass(frozen=True)
class Kind:
    """Measured values of one symbol in one variant: what each scheme has for each quantity."""

    name: str
    symbol: str
    points: Mapping[Mark, Sequence[Compared]]

    @property
    def slots(self) -> dict[str, Compared]:
        """Quantity -> its measurement, the smallest first."""
        every = {one.quantity: one for own in self.points.values() for one in own}
        return dict(sorted(every.items(), key=lambda pair: pair[1].measured))


def draw_ratios(kinds: Sequence[Kind]) -> Markup:
    """Draw computed over measured values by kind; grey: two standard uncertainties."""
    at = _logarithmic(_range(kinds), TOP + TALL, TOP)
    starts, x = list[float](), LEFT
    for kind in kinds:
        starts.append(x)
        x += SLOT * (len(kind.slots) + GAP)
    parts = [*_levels(at, LEFT, x)]
    for start, kind in zip(starts, kinds, strict=True):
        parts += _measured(kind, start, at)
    for mark in dict.fromkeys(mark for kind in kinds for mark in kind.points):
        parts.append(f'<g class="c{mark.colour}" data-k="{escape(mark.label)}">')
        for start, kind in zip(starts, kinds, strict=True):
            parts += _dots(mark, kind, start, at)
        parts.append("</g>")
    return drawing(x + RIGHT, TOP + TALL + FEET, parts, "chart broad")


def _range(kinds: Sequence[Kind]) -> tuple[float, float]:
    """The least and the largest ratio to be drawn, bars included."""
    found = [1.0 / 1.1, 1.1]
    for kind in kinds:
        for own in kind.points.values():
            for one in own:
                sure = 2.0 * one.uncertainty / one.measured
                found += [one.computed / one.measured, 1.0 - sure, 1.0 + sure]
    return 0.95 * max(min(found), 0.25), 1.05 * min(max(found), 4.0)


def _logarithmic(ends: tuple[float, float], first: float, last: float) -> Place:
    """Places on a logarithmic axis, at its ends for what lies beyond."""
    low, high = ends

    def at(value: float) -> float:
        share = math.log(min(max(value, low), high) / low) / math.log(high / low)
        return first + (last - first) * share

    return at


def _levels(at: Place, left: float, right: float) -> Iterator[str]:
    """The frame, lines of constant ratio, and the line of equality."""
    low, high = number(TOP + TALL), number(TOP)
    yield f'<path class="frame" d="M{number(left)} {high}V{low}H{number(right)}"/>'
    for tick in TICKS:
        y = at(tick)
        if TOP < y < TOP + TALL:
            kind = "frame" if tick == 1.0 else "grid"
            yield f'<path class="{kind}" d="M{number(left)} {number(y)}H{number(right)}"/>'
            yield text(left - 6, y + 4, f"{tick:g}", "end")


def _measured(kind: Kind, start: float, at: Place) -> Iterator[str]:
    """Bars of two standard uncertainties about 1, and the name of the kind below."""
    for k, one in enumerate(kind.slots.values()):
        sure = 2.0 * one.uncertainty / one.measured
        x, ends = number(start + SLOT * (k + 0.5)), (1.0 - sure, 1.0 + sure)
        yield f'<path class="sure" d="M{x} {number(at(ends[0]))}V{number(at(ends[1]))}"/>'
    middle = start + 0.5 * SLOT * len(kind.slots)
    aside = f"translate({number(middle + 4)} {number(TOP + TALL + 14)}) rotate(-32)"
    yield f'<g transform="{aside}">{text(0, 0, f"{kind.symbol}, {kind.name}", "end")}</g>'


def _dots(mark: Mark, kind: Kind, start: float, at: Place) -> Iterator[str]:
    """The points: filled if a band judges them, hollow if they are only shown."""
    slots = list(kind.slots)
    for one in kind.points.get(mark, ()):
        x, y = start + SLOT * (slots.index(one.quantity) + 0.5), at(one.computed / one.measured)
        shape = "open" if one.band is None else "full"
        tip = (
            f"{mark.label}, {kind.name}, {one.quantity}: computed {one.computed:.4g}, measured "
            f"{one.measured:.4g} ± {one.uncertainty:.2g}, ratio {one.computed / one.measured:.3f}"
        )
        place = f'cx="{number(x)}" cy="{number(y)}" r="2.6"'
        yield f'<circle class="{shape}" {place}>{title(tip)}</circle>'


@dataclass(frozen=True)
class _Row:
    """A scheme on some measurements: bias, with two scatters either way, and what these allow."""

    mark: Mark
    of: str
    bias: float
    scatter: float
    sure: float

    @property
    def ends(self) -> tuple[float, float]:
        """Two scatters below the bias and above it."""
        either = 2.0 * self.scatter
        return self.bias * max(1.0 - either, 0.2), self.bias * (1.0 + either)


def draw_biases(rows: Sequence[tuple[Mark, str, Factor]]) -> Markup:
    """Bias of schemes with two scatters either way; grey: the uncertainty of the measurements."""
    known = [_Row(mark, of, one.bias, one.scatter, one.sure or 0.0) for mark, of, one in rows
             if one.bias is not None and one.scatter is not None]  # fmt: skip
    spread = [far for row in known for far in (row.ends[1], 1.0 / row.ends[0], 1 + 2 * row.sure)]
    most = 1.05 * max([1.02, *spread])
    at = _logarithmic((1.0 / most, most), NAMED, WIDE - RIGHT)
    low = TOP + ROW * len(known)
    named = [at(1.0)]
    parts = [f'<path class="frame" d="M{number(named[0])} {number(TOP)}V{number(low)}"/>',
             text(named[0], low + 16, "1", "mid")]  # fmt: skip
    for tick in (*TICKS, 0.95, 1.05, 0.98, 1.02):
        x = at(tick)
        if NAMED < x < WIDE - RIGHT and min(abs(x - other) for other in named) > APART:
            named.append(x)
            parts.append(text(x, low + 16, f"{tick:g}", "mid"))
    for k, row in enumerate(known):
        parts += _row(row, TOP + ROW * (k + 0.5), at)
    return drawing(WIDE, low + 24, parts)


def _row(row: _Row, y: float, at: Place) -> Iterator[str]:
    name = f"{row.mark.label}, {row.of}"
    yield text(0, y + 4, name)
    first, last = at(1.0 / (1.0 + 2.0 * row.sure)), at(1.0 + 2.0 * row.sure)
    yield (
        f'<rect class="sure" x="{number(first)}" y="{number(y - 7)}" '
        f'width="{number(last - first)}" height="14"/>'
    )
    left, right = map(at, row.ends)
    tip = f"{name}: bias {row.bias:.4f}, scatter {100 * row.scatter:.2f} %"
    yield f'<g class="c{row.mark.colour}" data-k="{escape(row.mark.label)}">'
    yield f'<path class="line" d="M{number(left)} {number(y)}H{number(right)}"/>'
    place = f'cx="{number(at(row.bias))}" cy="{number(y)}" r="4"'
    yield f'<circle class="full" {place}>{title(tip)}</circle></g>'
