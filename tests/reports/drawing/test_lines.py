"""Claims about lines of drawings: which points are kept, and how positions are written, by hand."""

from __future__ import annotations

import numpy as np
import pytest

from reports.drawing.svg import drawing, number, path, straightened, text, thinned

NAN = float("nan")


@pytest.mark.parametrize(
    ("value", "said"), [(12.34, "12.3"), (5.0, "5"), (-0.04, "0"), (-0.06, "-0.1"), (0.0, "0")]
)
def test_a_place_has_one_digit_after_the_point(value: float, said: str) -> None:
    assert number(value) == said


@pytest.mark.parametrize(
    ("x", "y", "said"),
    [
        ([1.0, 1.5, 1.6], [2.0, 2.5, 2.4], "M1 2l.5.5.1-.1"),
        ([0.0, 10.0, 10.0, 12.5], [0.0, 10.0, 10.0, 10.3], "M0 0l10 10 2.5.3"),
        ([0.0, 1.5, 3.0, 2.0], [0.5, 2.0, 3.5, 3.5], "M0 .5l1.5 1.5 1.5 1.5-1 0"),
        ([0.0, 1.0, NAN, 3.0, 4.0], [0.0, 1.0, 1.0, 0.0, 5.0], "M0 0l1 1M3 0l1 5"),
        ([0.0, NAN, 7.0], [0.0, 1.0, 0.25], "M0 0M7 .2"),
    ],
)
def test_a_path_is_written_with_no_sign_too_many(x: list[float], y: list[float], said: str) -> None:
    assert path(np.array(x), np.array(y)) == said


def test_points_within_a_third_of_a_pixel_of_a_line_are_left_out() -> None:
    x = np.array([10.0, 11.0, 12.0, 13.0, 14.0])
    kept, _ = straightened(x, np.array([0.0, 0.2, 0.0, 5.0, 10.0]))
    assert kept.tolist() == [10.0, 12.0, 14.0]  # the first bend lies 0.2 px off
    kept, _ = straightened(x, np.array([0.0, 0.7, 0.0, 5.0, 10.0]))
    assert kept.tolist() == [10.0, 11.0, 12.0, 14.0]
    kept, up = straightened(x, np.array([0.0, -0.2, 0.0, -5.0, -10.0]))
    assert (kept.tolist(), up.tolist()) == ([10.0, 12.0, 14.0], [0.0, 0.0, -10.0])
    gap, _ = straightened(x, np.array([0.0, 1.0, NAN, 3.0, 4.0]))
    assert gap.tolist() == x.tolist()
    back, _ = straightened(np.array([10.0, 11.0, 11.0, 12.0]), np.array([0.0, 1.0, 3.0, 4.0]))
    assert back.tolist() == [10.0, 11.0, 11.0, 12.0]


def test_slopes_are_narrowed_from_the_point_kept_last() -> None:
    x = np.arange(20.0, 26.0)
    # on a slope of 1 from (20, 0); from (22, 2) on one of -2
    kept, up = straightened(x, np.array([0.0, 1.1, 2.0, 0.0, -2.1, -4.0]))
    assert (kept.tolist(), up.tolist()) == ([20.0, 22.0, 25.0], [0.0, 2.0, -4.0])


@pytest.mark.parametrize(("count", "left"), [(20, 20), (21, 2), (96, 2)])
def test_twenty_points_are_all_kept_and_more_of_a_straight_line_are_two(
    count: int, left: int
) -> None:
    x = np.arange(float(count))
    assert len(thinned(x, 2.0 * x)[0]) == left
    assert len(thinned(-x, 2.0 * x)[0]) == count  # what turns back is drawn as it is
    saw = np.where(np.arange(count) == 3, 2.0, x)  # x goes back once
    assert len(thinned(saw, 2.0 * x)[0]) == count


def test_of_many_points_each_bucket_keeps_its_ends_up_and_down() -> None:
    x, y = np.arange(5.0), np.array([0.0, 5.0, 1.0, -3.0, 2.0])
    assert thinned(x, y, 2)[0].tolist() == [0.0, 1.0, 3.0, 4.0]
    assert len(thinned(x[:4], y[:4], 2)[0]) == 4
    holed = np.array([NAN, 5.0, 1.0, NAN, NAN])
    assert thinned(x, holed, 2)[0].tolist() == [0.0, 1.0, 2.0, 4.0]


def test_texts_and_drawings_are_escaped_and_as_large_as_they_say() -> None:
    assert text(1.25, -2.0, "<a>", "mid") == '<text x="1.2" y="-2" class="mid">&lt;a&gt;</text>'
    assert text(0, 0, "a") == '<text x="0" y="0">a</text>'
    assert str(drawing(3.0, 4.5, ["<g/>"])) == (
        '<svg class="chart" viewBox="0 0 3 4.5" aria-hidden="true"><g/></svg>'
    )
