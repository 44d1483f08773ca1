"""Reads a rendered page back as a reader does: the cells of tables, the points of curves."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from html.parser import HTMLParser

VOID = {"meta", "link", "img", "br", "hr", "input", "use", "path", "polygon", "line", "rect"}
ENDS = {  # what a start tag ends that stands open, as HTML has it
    "td": {"td", "th"}, "th": {"td", "th"}, "tr": {"td", "th", "tr"}, "li": {"li"},
    "tbody": {"td", "th", "tr", "tbody", "thead"}, "option": {"option"}, "p": {"p"},
}  # fmt: skip
PAIR = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")
RAISED = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"
SUPERSCRIPTS = str.maketrans(RAISED, "-0123456789")


@dataclass(eq=False)
class Node:
    """An element of a page."""

    tag: str
    named: Mapping[str, str]
    inner: list[Node | str] = field(default_factory=list)

    @property
    def text(self) -> str:
        """What is read in it, but for what lies in drawings' titles."""
        parts = (one if isinstance(one, str) else one.text for one in self.inner)
        return " ".join(" ".join(parts).split())

    def every(self, tag: str = "", **named: str) -> Iterator[Node]:
        """The elements in it of a tag and with these attributes, in their order."""
        for one in self.inner:
            if isinstance(one, Node):
                fits = all(one.named.get(name.rstrip("_")) == named[name] for name in named)
                if tag in ("", one.tag) and fits:
                    yield one
                yield from one.every(tag, **named)


class _Builder(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.open = [Node("", {})]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        while self.open[-1].tag in ENDS.get(tag, ()):
            self.open.pop()
        made = Node(tag, {name: value or "" for name, value in attrs})
        self.open[-1].inner.append(made)
        if tag not in VOID:
            self.open.append(made)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.open[-1].inner.append(Node(tag, {name: value or "" for name, value in attrs}))

    def handle_endtag(self, tag: str) -> None:
        if any(node.tag == tag for node in self.open[1:]):
            while self.open.pop().tag != tag:
                pass

    def handle_data(self, data: str) -> None:
        self.open[-1].inner.append(data)


def page(text: str) -> Node:
    """The tree of a page."""
    builder = _Builder()
    builder.feed(text)
    builder.close()
    return builder.open[0]


def section(whole: Node, anchor: str) -> Node:
    """The part of a page that is headed by the element of this id."""
    return next(whole.every("section", **{"aria-labelledby": anchor}))


def table(part: Node, *headings: str) -> dict[str, list[str]]:
    """The first table with these headings: first cell of a row -> the cells under them.

    A row whose first cell spans all columns names a group: the rows below it are GROUP/cell.
    """
    for one in part.every("table"):
        rows = [[*row.every("th"), *row.every("td")] for row in one.every("tr")]
        names = [cell.text for cell in rows[0]]
        if set(headings) <= set(names):
            columns = [names.index(heading) for heading in headings]
            found: dict[str, list[str]] = {}
            group = ""
            for row in rows[1:]:
                if len(row) == 1:
                    group = f"{row[0].text.partition(' · order')[0]}/"
                else:
                    found[f"{group}{row[0].text}"] = [row[k].text for k in columns]
            return found
    raise AssertionError(f"no table with {headings}")


Points = list[tuple[float, float]]


def curves(figure: Node) -> dict[str, Points]:
    """Name of each curve of a drawing, and of the exact one '' -> its points as the axes say."""
    (drawing,) = (one for one in figure.every("svg") if one.named.get("class") == "chart")
    across, up = _axis(drawing, "mid", "x"), _axis(drawing, "end", "y")
    found = {}
    for group in drawing.every("g"):
        drawn = [p for kind in ("line", "dots", "holes") for p in group.every("path", class_=kind)]
        name = next((one.text for one in group.every("text")), "")
        if name and drawn:
            spots = _line(drawn[0].named["d"]) if drawn[0].named["class"] == "line" else []
            spots = spots or _places(drawn[0].named["d"])
            found[name] = [(across(x), up(y)) for x, y in spots]
    for one in drawing.every("path", class_="exact"):
        found[""] = [(across(x), up(y)) for x, y in _line(one.named["d"])]
    return found


def _axis(drawing: Node, kind: str, along: str) -> Callable[[float], float]:
    """From a place to a value, by the labels of an axis: their places say if it is logarithmic."""
    (labels,) = drawing.every("g", class_=kind)
    said = [(float(one.named[along]), _value(one.text)) for one in labels.every("text")]
    (a, low), (b, high), (c, middle) = said[0], said[-1], said[len(said) // 2]

    def linear(place: float) -> float:
        return low + (place - a) / (b - a) * (high - low)

    def logarithmic(place: float) -> float:
        return float(low * (high / low) ** ((place - a) / (b - a)))

    if min(low, high) > 0 and abs(logarithmic(c) - middle) < abs(linear(c) - middle):
        return logarithmic
    return linear


def _value(label: str) -> float:
    """The number that a label says: 0.5, 2e-3 or 10⁻³."""
    power = label.removeprefix("10").translate(SUPERSCRIPTS)
    return 10.0 ** int(power) if any(sign in label for sign in RAISED) else float(label)


def _places(path: str) -> Points:
    numbers = list(map(float, PAIR.findall(path.partition("h")[0])))
    return list(zip(numbers[::2], numbers[1::2], strict=True))


def _line(path: str) -> Points:
    """The points of a path of absolute beginnings, M, and steps, l."""
    found: Points = []
    for piece in filter(None, path.split("M")):
        numbers = list(map(float, PAIR.findall(piece)))
        x, y = numbers[0], numbers[1]
        found.append((x, y))
        for dx, dy in zip(numbers[2::2], numbers[3::2], strict=True):
            x, y = x + dx, y + dy
            found.append((x, y))
    return found
