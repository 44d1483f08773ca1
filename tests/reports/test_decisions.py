"""Claims about decisions in parts of pages: small truth tables, by hand."""

from __future__ import annotations

from typing import Any

import pytest

from reports import text
from reports.formula import MINUS, PRIME, typeset
from reports.outcomes import OUTCOMES
from reports.pages import coverage_map, front
from reports.variant import measurements
from tests.support.fabricated import some
from vv.records.outcomes import Outcome


@pytest.mark.parametrize(
    ("error", "band"),
    [
        (None, ""), (0.0, "e0"), (1e-20, "e0"), (9e-15, "e0"), (1.1e-14, "e1"), (1.1e-12, "e2"),
        (5e-3, "e6"), (0.02, "e7"), (10.0, "e7"), (1e9, "e7"),
    ],
)  # fmt: skip
def test_a_colour_is_two_decades_of_error(error: float | None, band: str) -> None:
    assert coverage_map.band(error) == band


def test_a_cell_of_the_map_has_medians_and_the_worst_outcome() -> None:
    passing, failing = OUTCOMES[Outcome.PASS], OUTCOMES[Outcome.FAIL]
    cells = [some(error=e, cpu=c, worst=w) for e, c, w in (
        (1e-4, 2.0, passing), (4e-4, 8.0, failing), (2e-4, None, passing), (None, 4.0, passing)
    )]  # fmt: skip
    for quiet, look in ((False, failing.look), (True, "known")):
        book = some(to_case=lambda *names: "#" + "-".join(names), quiet=lambda *names: quiet)  # noqa: B023
        said = coverage_map._cell(book, cells, ("c", "v", "a/a"), "a/a")
        assert 'class="e6"' in said
        assert 'data-c="4 s"' in said
        assert ">2e-4</a>" in said
        assert 'href="#c-v-a/a"' in said
        assert f'<i class="{look}">{failing.symbol}</i>' in said
    fine = coverage_map._cell(book, cells[:1], ("c",), "a/a")
    assert "<i" not in fine  # a record that passes has no sign, quiet or not
    assert coverage_map._cell(book, [], ("c",), "a/a") == "<td></td>"
    (lost,) = [coverage_map._cell(book, [some(error=None, cpu=None, worst=failing)], ("c",), "a/a")]
    assert f">{failing.symbol}</a>" in lost
    assert f'data-c="{text.NONE}"' in lost


@pytest.mark.parametrize(
    ("write", "value", "said"),
    [
        (text.ratio, 1.84, "1.8"), (text.ratio, 9.4, "9.4"), (text.ratio, 12.4, "12"),
        (text.ratio, 9999.0, "9999"), (text.ratio, 10001.0, "1e4"), (text.ratio, None, text.NONE),
        (text.short, 999.0, "999"), (text.short, 1001.0, "1.00e3"), (text.short, 0.0101, "0.0101"),
        (text.short, 9.9e-3, "9.90e-3"), (text.short, float("inf"), text.NONE),
        (text.brief, 99999.0, "99999"), (text.brief, 100000.0, "1e5"), (text.brief, 0.01, "0.01"),
        (text.brief, 9e-3, "9e-3"), (text.brief, 0.0, "0"), (text.brief, -0.5, "-0.5"),
        (text.brief, 120000.0, "1.2e5"), (text.brief, float("nan"), text.NONE),
        (text.seconds, 119.0, "119 s"), (text.seconds, 121.0, "2.02 min"),
        (text.seconds, 9.99e-4, "999 µs"), (text.seconds, 1.01e-3, "1.01 ms"),
        (text.seconds, 0.999, "999 ms"), (text.seconds, 1.01, "1.01 s"),
        (text.sci, 0.0, "0"), (text.sci, 2.234e-5, "2.23e-5"), (text.sci, None, text.NONE),
        (text.sort_key, None, ""), (text.sort_key, 0.00123456, "0.00123"),
    ],
)  # fmt: skip
def test_numbers_are_written_as_people_read_them(write: Any, value: Any, said: str) -> None:
    assert write(value) == said


def test_units_lists_and_what_is_alike() -> None:
    pairs = (("3", "m"), ("none", "m"), ("", "m"), ("3", ""))
    assert [text.with_unit(*pair) for pair in pairs] == ["3 m", "none", "", "3"]
    assert [text.listed([*"abc"[:n]]) for n in range(4)] == ["", "a", "a and b", "a, b and c"]
    assert text.alike({"a": 1, "b": 2, "c": 1}) == [(["a", "c"], 1), (["b"], 2)]
    assert text.slug("a" * 80) == "a" * 80
    assert text.slug("a" * 81) != "a" * 81
    assert text.slug("a--b") != "a--b"
    assert text.slug("a/b", "c") == "a~b--c"


@pytest.mark.parametrize(
    ("formula", "inner"),
    [
        ("x^-1", f"<msup><mi>x</mi><mrow><mo>{MINUS}</mo><mn>1</mn></mrow></msup>"),
        ("x^+2", "<msup><mi>x</mi><mrow><mo>+</mo><mn>2</mn></mrow></msup>"),
        ("x^*2", "<msup><mi>x</mi><mo>·</mo></msup><mn>2</mn>"),
        ("x^-k", f"<msup><mi>x</mi><mo>{MINUS}</mo></msup><mi>k</mi>"),
        ("x_i^2", "<msubsup><mi>x</mi><mi>i</mi><mn>2</mn></msubsup>"),
        ("2 k", '<mn>2</mn><mspace width=".2em"/><mi>k</mi>'),
        ("2 = k", "<mn>2</mn><mo>=</mo><mi>k</mi>"),
        ("sqrt2", "<msqrt><mn>2</mn></msqrt>"),
        ("k1'", f"<msup><msub><mi>k</mi><mn>1</mn></msub><mo>{PRIME}</mo></msup>"),
    ],
)
def test_signs_and_numbers_that_follow_are_scripts(formula: str, inner: str) -> None:
    assert str(typeset(formula)) == f"<math>{inner}</math>"


def test_a_share_is_of_what_has_a_finite_ratio_and_errors_are_of_ladders() -> None:
    assert front._share([1.0, float("inf"), 2.0, 3.0]) == 0.75
    assert front._share(None) is None
    assert front._share([]) is None
    cells = {"a": some(ladder=True, error=1.23456e-3), "b": some(ladder=False, error=1.0),
             "c": some(ladder=True, error=None)}  # fmt: skip
    seen = some(cells={("k", "v"): cells})
    found = [front._error(seen, ("k", "v"), label) for label in ("a", "b", "c", "d")]
    assert found == [1.23e-3, None, None, None]


def test_the_words_that_meanings_begin_with_are_their_title() -> None:
    assert measurements._common(["height of a ball", "height of a wall"]) == "Height of a"
    assert measurements._common(["height"]) == "Height"
    assert measurements._common(["one", "other"]) == "One"


def test_a_word_within_a_name_is_no_prose() -> None:
    assert str(typeset("k = 2while")) == (
        "<math><mi>k</mi><mo>=</mo><mn>2</mn><mi>while</mi></math>"
    )
