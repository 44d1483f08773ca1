"""Claims about the picture of error against cost: which points, in which look, named where."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.support.records.priced import one
from vv.insight.effort import Effort
from vv.output.gallery.error_cost import COLOURS, MARKERS, picture


class Spines:
    """Those of a frame; none is looked at."""

    def __getitem__(self, names: list[str]) -> Any:
        return SimpleNamespace(set_visible=lambda seen: None)


class Axes:
    """Notes what is drawn."""

    def __init__(self) -> None:
        self.curves: list[tuple[Any, ...]] = []
        self.names: list[tuple[Any, ...]] = []
        self.limits: dict[str, Any] = {}
        self.words: dict[str, str] = {}
        self.spines = Spines()

    def loglog(self, x: Any, y: Any, **look: Any) -> None:
        self.curves.append((x, y, look["color"], look["marker"]))

    def annotate(self, text: str, place: Any, *rest: Any, **look: Any) -> None:
        self.names.append((text, place, look["color"]))

    def set(self, **words: str) -> None:
        self.words = words

    def get_xlim(self) -> tuple[float, float]:
        return 2.0, 5.0

    def get_ylim(self) -> tuple[float, float]:
        return 4.0, 9.0

    def set_xlim(self, *limits: float) -> None:
        self.limits["x"] = limits

    def set_ylim(self, *limits: float) -> None:
        self.limits["y"] = limits

    def set_title(self, text: str, loc: str) -> None:
        self.words["title"] = text

    def grid(self, *_: Any, **__: Any) -> None:
        """Not looked at."""

    def margins(self, **__: Any) -> None:
        """Not looked at."""


def drawn(monkeypatch: pytest.MonkeyPatch, every: list[Effort]) -> tuple[Axes, dict[str, Any]]:
    axes, kept = Axes(), dict[str, Any]()
    figure = SimpleNamespace(
        add_subplot=lambda: axes, savefig=lambda file, **how: kept.update(how, file=file)
    )
    monkeypatch.setattr("matplotlib.figure.Figure", lambda **_: figure)
    picture(every, "the title", Path("a.svg"))
    return axes, kept


def scheme(label: str, *rows: tuple[float | None, float | None, float | None, float | None]) -> Any:
    return dataclasses.replace(one(rows), label=label)


def test_a_curve_is_of_what_was_timed_and_has_an_error_by_cost_and_named_at_its_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    both = scheme("a/b", (4e-3, None, 16e-4, 1.0), (2e-3, None, 4e-4, 2.0), (1e-3, None, None, 9.0))
    fewer = scheme("c/d", (None, None, 1e-9, 0.5), (5e-4, None, 1e-5, None))
    axes, _ = drawn(monkeypatch, [both, fewer])
    assert axes.curves == [((1.0, 2.0), (16e-4, 4e-4), COLOURS[0], MARKERS[0]),
                           ((0.5,), (1e-9,), COLOURS[1], MARKERS[1])]  # fmt: skip
    assert axes.names == [("a\nb\norder 2.0", (2.0, 4e-4), COLOURS[0]),
                          ("c\nd", (0.5, 1e-9), COLOURS[1])]  # fmt: skip
    assert axes.words["title"] == "the title"
    assert axes.limits == {"x": (2.0, 30.0), "y": (0.5,)}


def test_a_curve_joins_its_points_in_the_order_of_cost(monkeypatch: pytest.MonkeyPatch) -> None:
    dear = scheme("a/b", (4e-3, None, 16e-4, 3.0), (2e-3, None, 4e-4, 1.0), (1e-3, None, 1e-4, 2.0))
    axes, _ = drawn(monkeypatch, [dear])
    ((cpu, error, *_),) = axes.curves
    assert (cpu, error) == ((1.0, 2.0, 3.0), (4e-4, 1e-4, 16e-4))
    assert [place for _, place, _ in axes.names] == [(3.0, 16e-4)]


def test_a_scheme_without_points_has_no_curve_and_looks_begin_again_after_the_last(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    none = scheme("a/b", (1e-3, None, 1e-4, 1.0), (2e-3, None, None, 1.0))
    lost = dataclasses.replace(none, rows=())
    fine = scheme("c/d", (1e-3, None, 1e-4, 1.0))
    axes, _ = drawn(monkeypatch, [lost, *[fine] * (len(COLOURS) + 1)])
    looks = [look for _, _, *look in axes.curves]
    pairs = [*zip(COLOURS, MARKERS, strict=True)]
    assert looks == [list(pair) for pair in (*pairs[1:], *pairs[:2])]


@pytest.mark.parametrize(("name", "dated"), [("a.svg", {"Date": None}), ("a.png", None)])
def test_a_drawing_is_not_dated(
    name: str, dated: object, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    kept: dict[str, Any] = {}
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", lambda _, file, **how: kept.update(how))
    picture([scheme("a/b", (1e-3, None, 1e-4, 1.0))], "t", tmp_path / name)
    assert kept["metadata"] == dated


def test_a_drawing_is_605_by_331_points(tmp_path: Path) -> None:
    picture([scheme("a/b", (1e-3, None, 1e-4, 1.0))], "t", tmp_path / "a.svg")
    assert 'width="604.8pt" height="331.2pt"' in (tmp_path / "a.svg").read_text()
