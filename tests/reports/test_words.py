"""Claims about the words and numbers of the report, and about texts told by their difference."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports import plain, text
from reports.variant.likeness import difference
from tests.support.fabricated import changed, entry, record
from vv.records.outcomes import Outcome


def test_laws_are_broken_in_plain_words() -> None:
    said = plain.breach(("energy created [J]", 1390.0, 2e-10))
    assert said == "Energy not conserved: created 1.39e3 J, allowed 2.00e-10 J"
    assert plain.breach(("negative drag dissipation [J]", 1.0, 0.1)).startswith("Drag dissipation")
    assert (
        plain.breach(("something [N]", 1.0, 0.1)) == "Law violated, something: 1 N, allowed 0.1 N"
    )


def test_a_command_shows_the_very_setting_again_and_is_safe_to_paste() -> None:
    one = record("a/a; rm x", "T1", 4e-3, modified=True)
    typed = "vv run bounce:T1 --codes 'a/a; rm x' --rung dt=0.004 --set m=1"
    assert plain.command(one) == typed


@given(st.floats(-1e300, 1e300).filter(lambda x: x == 0 or abs(x) > 1e-300))
def test_written_numbers_read_back(value: float) -> None:
    assert float(text.sci(value)) == pytest.approx(value, rel=6e-3)
    assert float(text.short(value)) == pytest.approx(value, rel=6e-3)
    assert float(text.brief(value)) == pytest.approx(value, rel=6e-6)


@given(st.lists(st.text(max_size=90), min_size=2, max_size=2, unique=True))
def test_identifiers_differ_and_are_safe(names: list[str]) -> None:
    made = [text.slug(name) for name in names]
    assert made[0] != made[1]
    assert all("/" not in one and len(one) < 100 and one.isascii() for one in made)
    pairs = itertools.permutations(names, 2)
    assert len({text.slug(*pair) for pair in pairs}) == 2


def test_a_table_has_columns_only_for_what_some_row_tells() -> None:
    rows: list[dict[str, float | None]] = [{"dem": 1.0, "yade": None}, {"exact": 2.0}]
    assert text.known_columns(["yade", "exact", "rigid", "dem"], rows) == ["exact", "dem"]


def test_a_time_has_a_unit() -> None:
    said = [text.seconds(value) for value in (9.16e-2, 2.03, 4e-6, 7200.0, None)]
    assert said == ["91.6 ms", "2.03 s", "4 µs", "120 min", "\N{EN DASH}"]


def test_an_xpass_says_so() -> None:
    one = changed(entry("xpass", {"max": 1e-9}))
    assert "passes although a disagreement is on record" in plain.excess(one)


def test_a_note_that_several_quantities_share_is_said_once() -> None:
    late = [entry("xfail", {"max": 1e-2}, name=name, note="drag is late") for name in "xy"]
    said = plain.reason(record("a/a", "T1", 1e-3, quantities=late), Outcome.XFAIL)
    parts = [f"Error of {name} 0.01, 10 times the tolerance 1.00e-3" for name in "xy"]
    assert said == "; ".join([*parts, "drag is late"])


def test_an_error_where_none_is_allowed_has_no_ratio() -> None:
    said = plain.excess(changed(entry("fail", {"max": 5.34e-3}), tolerance=0.0))
    assert said.endswith("5.34e-3, tolerance 0")


def test_how_many_times_a_tolerance_is_a_number_that_people_say() -> None:
    said = plain.excess(changed(entry("fail", {"max": 5.34e-3}), tolerance=2.79e-5))
    assert said.endswith(", 191 times the tolerance 2.79e-5")


def test_a_long_explanation_stands_once_on_a_page_and_is_referred_to() -> None:
    why, told = "a spring is charged for a whole step " * 2, dict[str, str]()
    assert plain.once(f"Error 1; {why}", "here", told) == f"Error 1; {why}"
    assert plain.once(f"Error 2; {why}", "there", told) == "Error 2; explained at here"
    assert plain.once(f"Error 1; {why}", "here", told) == f"Error 1; {why}"


def test_no_line_ends_within_a_small_number_and_tags_stay_text() -> None:
    said = text.unbroken("at dt = 2.5e-05 s <b>, at-will, 1e+09")
    assert said == 'at dt = <span class="n">2.5e-5</span> s &lt;b&gt;, at-will, 1e9'


@given(
    st.lists(st.sampled_from("abcdefgh"), max_size=30),
    st.lists(st.sampled_from("abc"), max_size=30),
)
def test_a_difference_makes_the_text_of_its_base(old: list[str], new: list[str]) -> None:
    base, text_ = ("".join(f"{line * 60}\n" for line in lines) for lines in (old, new))
    told = difference(base, text_)
    assert not told or patched(base, told) == text_


def patched(base: str, told: str) -> str:
    """The result of `patch` on a base."""
    made, at, lines = [], 0, base.splitlines(keepends=True)
    for line in told.splitlines(keepends=True):
        if line[0] == "@":
            start, _, count = line.split()[1][1:].partition(",")
            first = int(start) - (count != "0")
            made += lines[at:first]
            at = first + int(count or 1)
        elif line[0] == "+":
            made.append(line[1:])
    return "".join([*made, *lines[at:]])
