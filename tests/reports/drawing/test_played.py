"""Claims about the data of a motion that is played: parts, scales and rotations, by hand."""

from __future__ import annotations

import dataclasses
import json
import math
from typing import Any

import numpy as np
import pytest

from reports.drawing.collect import History
from reports.drawing.playback import moving, playback
from reports.marks import Mark
from tests.support.fabricated import case, changed
from vv.records.case_facts import VariantFacts
from vv.scene.picture.moved import Moved
from vv.scene.picture.sketch import Sketch

T = np.linspace(0.0, 4.0, 5)
Y, Z = np.array([0.0, 1.0, -2.0, 1.0, 0.0]), np.array([0.0, 0.25, 0.5, 0.25, 0.125])
NAN = float("nan")


def facts(size: float | None) -> VariantFacts:
    """A variant in which y lifts a body, and z moves it along (0.6, 0.8) and rotates it.

    The rotation is half a radian per metre.
    """
    one = case().variants["T1"]
    (y,) = one.quantities
    z = changed(y, name="z", symbol="zeta", unit="")
    sketch = None if size is None else Sketch(size=size, axes=("x", "z"), bodies=2)
    moved = {"y": Moved((1, 1), (0, 0), along=(0.0, 1.0)),
             "z": Moved((0, 0), (2, 3), along=(0.6, 0.8), turn=0.5)}  # fmt: skip
    return dataclasses.replace(one, quantities=(y, z), sketch=sketch, moved=moved)


def history(label: str, value: np.ndarray, reference: np.ndarray | None) -> History:
    return History(Mark(label, len(label), (), ""), 0.1, T, value, reference)


def played(size: float | None, **off: Any) -> dict[str, Any]:
    over = {
        "y": [history("a/a", Y, Y), history("bb/b", Y + off.get("y", 0.0), Y)],
        "z": [history("a/a", Z, None), history("bb/b", Z, Z)],
    }
    found: dict[str, Any] = json.loads(playback(over, facts(size)))
    return found


def test_exact_motions_are_told_in_thousandths_of_their_size() -> None:
    found = played(2.0)
    assert found["ends"] == [0.0, 4.0]
    assert found["exact"] == [
        ["y [m]", 2.0, [0, 500, -1000, 500, 0]], ["zeta", 0.5, [0, 500, 1000, 500, 250]]
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("off", "told"),
    [
        (0.002, 0),  # one part of a thousand of 2 m
        (0.0041, [2, 502, -998, 502, 2]),
        (np.array([0, 0, 0, 1.0, 0]), [0, 500, -1000, 1000, 0]),
        (np.array([0, 0, -30.0, 30.0, 0]), [0, 500, -9000, 9000, 0]),  # nine times, at most
        (np.array([0, NAN, 0, 0, 0]), [0, None, -1000, 500, 0]),
    ],
)
def test_a_scheme_is_told_where_it_is_a_pixel_off(off: Any, told: Any) -> None:
    assert played(2.0, y=off)["codes"] == {"a/a": [3, [0, 0]], "bb/b": [4, [told, 0]]}


@pytest.mark.parametrize(
    ("size", "factor", "words"),
    [  # y goes 2 m, and a drawing is 150 px for `size`
        (300 / 13, 1.0, "motion to the scale of the drawing"),
        (300 / 11, 2.0, "motion magnified 2 times, bodies to scale"),  # 40/11 is 3.6
        (300 / 99, 1.0, "motion to the scale of the drawing"),
        (300 / 101, 0.5, "motion reduced 2 times, bodies to scale"),
        (200.0, 20.0, "motion magnified 20 times, bodies to scale"),
        (0.3, 0.1, "motion reduced 10 times, bodies to scale"),
        (375.0, 50.0, "motion magnified 50 times, bodies to scale"),
    ],
)
def test_moves_are_pixels_and_degrees_for_each_part(size: float, factor: float, words: str) -> None:
    found = played(size)
    assert found["drawn"] == words
    scale, turn = 150.0 / size * factor / 1000, -math.degrees(0.25 * max(factor, 1.0)) / 1000
    first, second = found["moves"]
    assert first[:5] == [0, 1, 1, 0, 0]
    assert first[5:] == pytest.approx([0.0, -2.0 * scale, 0.0], rel=1e-3)
    assert second[:5] == [1, 0, 0, 2, 3]
    assert second[5:] == pytest.approx([0.3 * scale, -0.4 * scale, turn], rel=1e-3)


def test_without_a_drawing_or_without_moves_nothing_is_scaled() -> None:
    without = played(None)
    assert [move[5:7] for move in without["moves"]] == [[0.0, 0.0]] * 2
    assert without["moves"][1][7] == pytest.approx(-math.degrees(0.25) / 1000, rel=1e-3)
    assert without["drawn"] == "motion to the scale of the drawing"
    still = dataclasses.replace(facts(2.0), moved={})
    found = json.loads(playback({"y": [history("a/a", Y, Y)]}, still))
    assert (found["moves"], found["drawn"]) == ([], "")


def test_what_has_no_exact_motion_is_not_played() -> None:
    short = dataclasses.replace(history("a/a", Y, Y), t=T[:3], value=Y[:3], reference=Y[:3])
    nothing: list[History] = [history("a/a", Y, None), history("a/a", 0 * Y, 0 * Y), short]
    infinite = history("a/a", Y, np.array([0.0, math.inf, 0.0, 0.0, 0.0]))
    for one in (*nothing, infinite):
        assert playback({"y": [one]}, facts(2.0)) == ""
    four = dataclasses.replace(history("a/a", Y, Y), t=T[:4], value=Y[:4], reference=Y[:4])
    assert json.loads(playback({"y": [four]}, facts(2.0)))["ends"] == [0.0, 3.0]


def test_frames_are_at_the_outputs_of_a_history_with_an_exact_one() -> None:
    inexact = dataclasses.replace(history("a/a", Y, None), t=T + 7.0)
    found = json.loads(playback({"y": [inexact, history("bb/b", Y, Y)]}, facts(2.0)))
    assert found["ends"] == [0.0, 4.0]


def test_a_motion_that_moves_a_body_half_as_far_is_magnified_twice_as_much() -> None:
    """y goes 2 m, by which the body moves 1 m: 7.5 pixels of a drawing of 20 m."""
    half = dataclasses.replace(facts(20.0), moved={"y": Moved((1, 1), (0, 0), along=(0.0, 0.5))})
    found = json.loads(playback({"y": [history("a/a", Y, Y)]}, half))
    assert found["drawn"] == "motion magnified 5 times, bodies to scale"  # 40/7.5 is 5.3


def test_forty_frames_of_the_first_quantity_and_a_dozen_that_move_bodies() -> None:
    t = np.linspace(0.0, 1.0, 101)
    long = dataclasses.replace(history("a/a", t, t), t=t)
    assert len(json.loads(playback({"y": [long]}, facts(2.0)))["exact"][0][2]) == 40
    many = {f"q{k}": Moved((0, 1), (0, 0)) for k in range(14)}
    assert moving(dataclasses.replace(facts(2.0), moved=many)) == ["y", *[*many][:12]]


def test_what_moves_is_counted_among_what_has_an_exact_motion() -> None:
    """A quantity without one stands before it, and is neither told nor counted."""
    over = {"y": [history("a/a", Y, None)], "z": [history("bb/b", Z + 1.0, Z)]}
    found = json.loads(playback(over, facts(2.0)))
    assert [name for name, _, _ in found["exact"]] == ["zeta"]
    assert [*found["codes"]] == ["bb/b"]
    assert len(found["codes"]["bb/b"][1]) == 1
    assert [move[0] for move in found["moves"]] == [0]
    first = {"y": [history("a/a", Y, Y)], "z": [history("bb/b", Z, Z)]}
    only = dataclasses.replace(facts(2.0), moved={"z": Moved((0, 0), (2, 3), along=(0.6, 0.8))})
    assert [move[0] for move in json.loads(playback(first, only))["moves"]] == [1]
