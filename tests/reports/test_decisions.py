"""Claims about decisions in parts of pages: small truth tables, by hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

import reports.pages.case as case_page
import reports.pages.code as code_page
from reports import environment, text
from reports.formula import MINUS, PRIME, typeset
from reports.marks import marks
from reports.outcomes import OUTCOMES
from reports.pages import coverage_map, front, troubles
from reports.variant import absences, inputs, measurements, models, ranking, settings
from reports.variant.reading import TARGET
from reports.variant.region_figures import region_figures
from tests.support.fabricated import case, changed, cost, entry, record
from vv.case import RegionMap
from vv.gate.judgement import breaches
from vv.records.finding import Aspect
from vv.records.outcomes import Outcome


def some(**named: Any) -> Any:
    """A stand-in that has only these attributes."""
    return SimpleNamespace(**named)


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


@pytest.mark.parametrize(
    ("outcome", "quiet", "known"),
    [(Outcome.FAIL, True, True), (Outcome.FAIL, False, False), (Outcome.PASS, True, False),
     (Outcome.PASS, False, False)],
)  # fmt: skip
def test_what_the_gate_is_not_red_for_is_reported_only(
    outcome: Outcome, quiet: bool, known: bool
) -> None:
    said = str(environment.tag(OUTCOMES[outcome], 3, quiet))
    assert ("reported only" in said) is known
    assert ('class="tag known"' in said) is known
    assert " 3" in said
    assert " 3" not in str(environment.tag(OUTCOMES[outcome]))


def test_new_findings_count_as_without_a_baseline_unless_they_are_red(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name in ("troubles", "findings", "refused", "sections"):
        monkeypatch.setattr(environment, name, lambda *given: [])
    every = [
        some(case=name, kind=kind, red=red, compares=compares)
        for name, kind, red, compares in (
            ("a", "new", False, True), ("b", "new", True, True), ("c", "worse", False, True),
            ("a", "new", False, True), ("d", "worse", True, False),
        )
    ]  # fmt: skip
    monkeypatch.setattr(environment, "worst_first", lambda found: found)
    seen = environment._attention(some(manifest=some(findings=every)))
    assert (seen["without"], seen["unheld"]) == (["a"], 2)
    assert [one.case for one in seen["moved"]] == ["b", "c"]


def test_a_code_has_its_own_records_schemes_findings_and_refusals(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    noted: list[Any] = []

    def note(book: Any, found: list[Any]) -> list[Any]:
        noted.extend(found)
        return []

    monkeypatch.setattr(code_page, "troubles", note)
    monkeypatch.setattr(code_page, "heads", lambda book: {"a": "head"})
    looks = marks(["a/one", "a/two", "b/one"])
    rows = [some(mark=looks[label]) for label in looks]
    refused = [
        record("a/one", variant, 1e-3, status="refused", reason=reason)
        for variant, reason in (("T1", "seldom"), ("T1", "often"), ("T2", "often"))
    ]
    runs = [record("b/one", "T1", 1e-3, code_version="9"), record("a/two", "T1", 1e-3)]
    book = some(
        shown=[(one, OUTCOMES[Outcome.PASS]) for one in (*runs, runs[1])],
        findings=[some(label="a/one"), some(label="b/one"), some(label="aa/one")],
        manifest=some(records=[*runs, *refused], external=lambda: {"b"}),
        to_case=lambda *names: "-".join(names),
    )
    ranks = [some(mark=looks[label], error=e, why="") for label, e in
             (("b/one", 1e-3), ("a/two", 2e-3), ("a/one", None))]  # fmt: skip
    made = code_page.code(book, "a", some(rows=rows), {("bounce", "T1"): ranks})
    assert (made.version, made.in_house, made.head) == ("1.2", True, "head")
    assert [one.label for one in made.marks] == ["a/one", "a/two"]
    assert [one.label for one in noted] == ["a/one"]
    assert [count for _, count in made.counts] == [2]
    assert [(one.row.mark.label, one.rank, one.of) for one in made.lines] == [
        ("a/two", 2, 2), ("a/one", 3, 2)
    ]  # fmt: skip
    assert made.refusals == [
        ("one", "often", [("bounce", ["T1", "T2"])]), ("one", "seldom", [("bounce", ["T1"])])
    ]  # fmt: skip
    other = code_page.code(book, "b", some(rows=rows), {})
    assert (other.version, other.in_house, other.head) == ("9", False, "")


def test_what_gave_nothing_is_anchored_once_and_whole_if_nothing_of_it_ran() -> None:
    looks = marks(["a/a", "b/b"])
    blown = {"status": "diverged", "reason": "it blew up"}
    piles = {
        "a/a": [record("a/a", "T1", dt, **blown) for dt in (2e-3, 1e-3)],
        "b/b": [record("b/b", "T1", 1e-3, quantities=[entry("pass", {"max": 1e-3})]),
                record("b/b", "T1", 2e-3, status="refused", reason="it will not")],
    }  # fmt: skip
    part = [record("b/b", "T1", 1e-3, **blown), record("b/b", "T1", 2e-3, status="refused")]
    assert [one.anchor for one in absences.absent({"b/b": part}, looks)] == ["", ""]
    first, second = absences.absent(piles, looks)
    assert (first.mark.label, first.reason, first.whole) == ("a/a", "it blew up", False)
    assert len(first.settings) == 2
    assert (second.reason, second.whole, second.anchor) == ("it will not", False, "")
    none = {"a/a": [record("a/a", "T1", 1e-3, status="refused", reason="no")]}
    (whole,) = absences.absent(none, looks)
    assert whole.whole
    assert whole.anchor == ""


@pytest.mark.parametrize(("long", "like"), [(50, ""), (51, "T0")])
def test_a_reason_of_more_than_fifty_letters_is_told_once_on_a_page(long: int, like: str) -> None:
    look = marks(["a/a"])["a/a"]
    reason = "x" * long
    row = absences.Absent("", look, OUTCOMES[Outcome.REFUSED], [], reason, True)
    (told,) = absences.silent([row], "T1", {reason: "T0"})
    assert (told.reason, told.like) == (reason, like)
    (fresh,) = absences.silent([row], "T1", {})
    assert fresh.like == ""
    part = absences.Absent("", look, OUTCOMES[Outcome.REFUSED], [], reason, False)
    assert absences.silent([part], "T1", {}) == []


def test_a_heading_is_left_out_only_where_it_stands_above_and_tells_no_order() -> None:
    def group(quantity: str, order: float | None) -> Any:
        return some(mark="m", quantity=quantity, notes=[], order=order)

    one, same, ordered, other = (
        group("q", None),
        group("q", None),
        group("q", 2.0),
        group("r", None),
    )
    goes_on: Any = settings._goes_on
    table = [(None, one, False), (one, same, True), (one, ordered, False), (one, other, False),
             (other, ordered, False)]  # fmt: skip
    assert [bool(goes_on(before, now)) for before, now, _ in table] == [due for *_, due in table]


def test_an_order_between_two_settings_needs_both_and_unlike_steps() -> None:
    between = settings._between
    assert between((0.2, 0.04), (0.1, 0.01)) == pytest.approx(2.0)
    for coarse, fine in (
        ((0.2, 0.0), (0.1, 0.01)), ((0.2, 0.04), (0.2, 0.01)), ((None, 0.04), (0.1, 0.01)),
        ((0.2, 0.04), (0.1, None)), ((0.2, float("inf")), (0.1, 0.01)),
        ((0.2, 0.04), (0.1, float("inf"))),
    ):  # fmt: skip
        assert between(coarse, fine) is None


def test_the_colour_of_a_pile_is_explained_by_what_is_farthest_outside() -> None:
    def failing(error: float) -> Any:
        known = entry("fail", {"max": error}, tolerance=1e-3)
        return record("a/a", "T1", error, quantities=[known])

    near: Any = failing(2e-3)
    far: Any = failing(8e-3)
    fine = record("a/a", "T1", 1e-3, quantities=[entry("pass", {"max": 1e-4})])
    fail, passing = OUTCOMES[Outcome.FAIL], OUTCOMES[Outcome.PASS]
    assert ranking._worst_of([near, fine, far], fail) is far
    swapped: list[Any] = [far, near, fine]
    assert ranking._worst_of(swapped, fail) is far
    assert not ranking._worst_of([fine], passing)


def test_a_breach_of_conservation_is_told_by_its_own_law() -> None:
    energy = {"terms": {}, "unaccounted": 2.0, "peak": 9.0, "bound": 1.0, "audits": {}}
    judged = record("a/a", "T1", 1e-3, quantities=[entry("fail", {"max": 1.0})])
    one = changed(judged, ledger=energy)
    (kind,) = (found[0] for found in breaches(one.ledger))

    def told(check: Aspect, known: Any) -> str:
        return troubles._text(some(check=check, kind=kind, text="slow", quantity="y"), known)

    assert told(Aspect.CONSERVATION, one).startswith("Energy not accounted for: 2 J")
    assert not told(Aspect.ACCURACY, one).startswith("Energy not")
    assert told(Aspect.SPEED, None).endswith("low")


def test_what_all_schemes_of_a_code_have_in_common_stands_once() -> None:
    rows = [some(mark=some(code="a")) for _ in range(3)]
    pile: Any = list(zip([["p", "q"], ["p", "r"], ["p", "q"]], rows, strict=True))
    assert [(m.note, len(m.rows)) for m in models._models(pile)] == [("p", 0), ("q", 2), ("r", 1)]
    assert [m.note for m in models._models(pile[:1])] == ["p; q"]
    alike = [pile[0], pile[2]]
    assert [(m.note, len(m.rows)) for m in models._models(alike)] == [("p; q", 2)]
    assert [m.note for m in models._models([(["p"], rows[0]), (["p", "r"], rows[1])])] == [
        "p", "nothing else", "r"
    ]  # fmt: skip


def test_inputs_are_the_cheapest_within_a_thousandth_or_the_most_accurate() -> None:
    def made(label: str, error: float | None, cpu: float) -> Any:
        known = [] if error is None else [entry("pass", {"max": error})]
        return record(label, "T1", 1e-3, quantities=known, cost=cost(cpu=cpu))

    cheap, dear = made("a/a", 0.9 * TARGET, 1.0), made("b/b", 1e-9, 5.0)
    rough, worse = made("c/c", 2 * TARGET, 0.1), made("d/d", 9 * TARGET, 0.01)
    none = made("e/e", None, 0.001)
    every = [none, worse, rough, dear, cheap]
    assert sorted(every, key=inputs._order) == [cheap, dear, rough, worse, none]


def test_each_program_shows_one_input_except_in_scenes_of_more_than_sixty_bodies() -> None:
    def made(label: str, error: float | None) -> Any:
        known = [] if error is None else [entry("pass", {"max": error})]
        return record(label, "T1", 1e-3, quantities=known)

    rough, sharp, silent, own = (
        made(label, error)
        for label, error in (("c/a", 0.1), ("c/b", 0.01), ("d/a", None), ("own/a", 1e-9))
    )
    place = "bounce", "T1"
    ran = {place: {one.label: [one] for one in (rough, sharp, silent, own)}}
    for bodies, shown in ((None, [sharp]), (1, [sharp]), (60, [sharp]), (61, [])):
        drawn = some(sketch=some(bodies=bodies) if bodies else None)
        whole = some(cases={"bounce": some(variants={"T1": drawn})}, external=lambda: {"c", "d"})
        assert inputs.chosen(some(manifest=whole, ran=ran), place) == shown
        assert inputs.chosen(some(manifest=whole, ran={}), place) == []


def test_a_map_of_regions_is_drawn_where_there_is_one_and_something_is_found() -> None:
    facts, looks = case().variants["T1"], marks(["a/a"])
    seen = record("a/a", "T1", 1e-3, quantities=[
        entry("pass", {}, name="p", kind="count", unit="", value=0, reference=0)
    ])  # fmt: skip
    chart = RegionMap("x", "y", ("stays",), (((0.0, 0.0), (1.0, 1.0)),), {"p": (0.5, 0.5)})
    mapped = changed(facts, regions=chart)
    assert len(region_figures(mapped, {"a/a": [seen]}, looks)) == 1
    assert region_figures(mapped, {"a/a": []}, looks) == []
    assert region_figures(facts, {"a/a": [seen]}, looks) == []


def test_quantities_that_are_judged_alike_stand_together() -> None:
    facts = case()
    (one,) = facts.variants["T1"].quantities
    (bound,) = (one.tolerances or {}).values()
    wide = changed(one, name="w", tolerances={"second order in dt": changed(bound, value=0.5)})
    alike, free = changed(one, name="z"), changed(one, name="v", norm="final")
    piles = case_page._judged_alike([(q, ["T1"]) for q in (one, wide, alike, free)])
    assert [[q.name for q, _ in pile] for pile in piles] == [["y", "z"], ["w"], ["v"]]
    assert [(q.name, names) for q, names in case_page._quantities(facts)] == [("y", ["T1", "T2"])]
    assert case_page._stated_step(facts) == 1e-3
    bare = changed(one, tolerances={"exact": changed(bound, dt=None)})
    variants = {name: changed(v, quantities=[bare]) for name, v in facts.variants.items()}
    assert case_page._stated_step(changed(facts, variants=variants)) is None
    runs = [record("a/a", "T1", dt, quantities=[entry("pass", {"pointwise": e})]) for dt, e in
            ((2e-3, 0.5), (1e-3, 0.25))]  # fmt: skip
    runs.append(record("b/b", "T1", None, quantities=[entry("pass", {"pointwise": 0.125})]))
    assert case_page._pointwise(runs, 2e-3) == {"a/a": 0.5, "b/b": 0.125}


@pytest.mark.parametrize(
    ("computed", "within"), [(1.0, True), (1.19, True), (1.21, False), (0.79, False)]
)
def test_a_value_is_within_two_uncertainties_either_way(computed: float, within: bool) -> None:
    assert measurements._within(some(computed=computed, measured=1.0, uncertainty=0.1)) is within


def test_the_words_that_meanings_begin_with_are_their_title() -> None:
    assert measurements._common(["height of a ball", "height of a wall"]) == "Height of a"
    assert measurements._common(["height"]) == "Height"
    assert measurements._common(["one", "other"]) == "One"


def test_a_word_within_a_name_is_no_prose() -> None:
    assert str(typeset("k = 2while")) == (
        "<math><mi>k</mi><mo>=</mo><mn>2</mn><mi>while</mi></math>"
    )
