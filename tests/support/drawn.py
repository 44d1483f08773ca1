"""Reads the elements of a drawing with their places, in the order in which they are drawn."""

from __future__ import annotations

import re
from typing import Any

import pytest

from tests.support.read_back import Node, page

NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")


def read(svg: object) -> Node:
    """The tree of a drawing."""
    return page(str(svg))


def texts(drawn: Node, kind: str | None = None) -> list[tuple[str, float, float]]:
    """(words, x, y) of what stands upright, or of all of a class."""
    every = drawn.every("text") if kind is None else drawn.every("text", class_=kind)
    return [(one.text, float(one.named["x"]), float(one.named["y"])) for one in every]


def numbers(path: str) -> list[float]:
    """The numbers of a path, in their order."""
    return [float(one) for one in NUMBER.findall(path)]


def paths(drawn: Node, kind: str) -> list[list[float]]:
    """The numbers of each path of a class."""
    return [numbers(one.named["d"]) for one in drawn.every("path", class_=kind)]


def dots(drawn: Node) -> list[tuple[str, float, float]]:
    """(class, x, y) of each circle."""
    return [
        (one.named["class"], float(one.named["cx"]), float(one.named["cy"]))
        for one in drawn.every("circle")
    ]


def near(*wanted: float) -> Any:
    """Positions for comparison: they are written to a tenth of a pixel."""
    return pytest.approx(list(wanted), abs=0.0501)


def placed(*wanted: tuple[object, ...]) -> list[Any]:
    """Words with places, to compare with."""
    return [(said, *(pytest.approx(one, abs=0.0501) for one in where)) for said, *where in wanted]
