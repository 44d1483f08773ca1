"""Claims about decisions in the parts on one variant: small truth tables, by hand."""

from __future__ import annotations

import dataclasses
from typing import Any

import pytest

from reports.marks import marks
from reports.outcomes import OUTCOMES
from reports.variant import (
    absences,
    inputs,
    measurements,
    models,
    other_codes,
    ranking,
    settings,
)
from reports.variant.reading import TARGET, judged_error
from reports.variant.region_figures import region_figures
from tests.support.fabricated import case, changed, cost, entry, record, some
from vv.case import RegionMap
from vv.insight.against_measurements import Compared
from vv.records.outcomes import Outcome
from vv.records.quantity import PrintedFacts


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


@pytest.mark.parametrize(
    ("computed", "within"), [(1.0, True), (1.19, True), (1.21, False), (0.79, False)]
)
def test_a_value_is_within_two_uncertainties_either_way(computed: float, within: bool) -> None:
    assert measurements._within(some(computed=computed, measured=1.0, uncertainty=0.1)) is within


def test_a_scheme_is_ranked_with_its_order_and_its_error_at_the_stiffest_springs() -> None:
    errors = {1e6: (1e-3, 1e-3, 1e-3), 1e7: (16e-5, 4e-5, 1e-5)}  # soft springs cost 1e-3
    pile = [
        record("a/a", "T1", dt, rung={"dt": dt, "kn": kn}, quantities=[entry("pass", {"max": e})])
        for kn, own in errors.items()
        for dt, e in zip((4e-3, 2e-3, 1e-3), own, strict=True)
    ]
    (row,) = ranking.ranked({"a/a": pile}, marks(["a/a"]))
    assert (row.error, row.setting) == (1e-5, "dt = 0.001 s, kn = 1e+07 N/m")
    assert row.order is not None
    assert row.order.points == 3
    assert row.order.order == pytest.approx(2.0, abs=1e-9)


def test_of_inputs_within_a_thousandth_that_of_the_least_cpu_time_is_shown() -> None:
    def made(label: str, cpu: float, wall: float) -> Any:
        spent = dataclasses.replace(cost(cpu=cpu), solve_wall=wall)
        known = [entry("pass", {"max": 0.5 * TARGET})]
        return record(label, "T1", 1e-3, quantities=known, cost=spent)

    cheap, quick = made("a/a", 1.0, 9.0), made("b/b", 2.0, 3.0)
    assert min([quick, cheap], key=inputs._order) is cheap


def test_a_value_in_an_interval_has_no_error_to_be_ranked_by() -> None:
    judged = entry("pass", {"max": 0.25})
    assert judged_error(judged) == 0.25
    assert judged_error(changed(judged, judge="interval")) is None
    assert judged_error(None) is None


def test_a_map_of_regions_is_of_the_finest_setting_and_counts_what_is_right() -> None:
    def run(dt: float, modes: dict[str, int]) -> Any:
        return record("a/a", "T1", dt, quantities=[
            entry("pass", {}, name=name, kind="count", unit="", value=mode, reference=1)
            for name, mode in modes.items()
        ])  # fmt: skip

    chart = RegionMap("x", "y", ("stays", "goes"), (((0.0, 0.0), (1.0, 1.0)),),
                      {"p": (0.5, 0.5), "q": (0.2, 0.5), "r": (0.8, 0.5)})  # fmt: skip
    facts = changed(case().variants["T1"], regions=chart)
    pile = [run(2e-3, {"p": 0, "q": 0, "r": 0}), run(1e-3, {"p": 1, "q": 1, "r": 0})]
    (figure,) = region_figures(facts, {"a/a": pile}, marks(["a/a"]))
    assert figure.alt.endswith("points found as the exact chart has them: a/a 2 of 3")


def test_an_answer_of_another_code_stands_beside_the_finest_value_of_each_scheme() -> None:
    printed = PrintedFacts(2.0, 0.05, "other", "Someone (2001)", 0.25)

    def run(label: str, dt: float, value: float, verdict: str) -> Any:
        seen = entry(verdict, {}, judge="code-to-code", kind="scalar", value=value, reference=9.0,
                     printed=printed)  # fmt: skip
        return record(label, "T1", dt, quantities=[seen])

    piles = {
        "a/a": [run("a/a", 1e-3, 2.1, "pass"), run("a/a", 2e-3, 3.2, "fail")],
        "b/b": [run("b/b", 2e-3, 2.3, "pass"), run("b/b", 1e-3, 3.4, "fail")],
        "c/c": [record("c/c", "T1", 1e-3, status="error")],
    }
    (quantity,) = case().variants["T1"].quantities
    assert other_codes.printed_rows(piles, [changed(quantity, name="none"), quantity]) == [
        other_codes.PrintedRow("height", "m", printed, {"a/a": 2.1, "b/b": 3.4}, frozenset({"b/b"}))
    ]


def test_measured_values_are_counted_within_two_uncertainties_whatever_their_bands(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    drawn: list[str] = []

    def draw(points: Any, shown: str) -> str:
        drawn.append(shown)
        return ""

    monkeypatch.setattr(measurements, "draw_scatter", draw)
    looks = marks(["a/a", "b/b"])

    def point(name: str, computed: float, within: bool) -> Compared:
        return Compared(name, "m", computed, 1.0, 0.1, 0.5, within)

    # apart by 0.1, 0.3 and 0.4, where 0.2 is two uncertainties; bands say otherwise
    first = [point("p", 1.1, False), point("q", 1.3, True), point("r", 1.4, True)]
    second = [point("q", 1.05, False)]
    (quantity,) = case().variants["T1"].quantities
    facts = [changed(quantity, name="p", unit="m"), changed(quantity, name="q", unit="m"),
             changed(quantity, name="r", unit="N", meaning="force")]  # fmt: skip
    group = [some(label="a/a", points=first), some(label="b/b", points=second)]
    book: Any = some(
        agreements={("c", "v"): group}, marks=looks,
        manifest=some(cases={"c": some(variants={"v": some(quantities=facts)})}),
    )  # fmt: skip
    metres, newtons = measurements.measured_figures(book, ("c", "v"))
    assert metres.alt.endswith("within 2 standard uncertainties: a/a 1 of 2 and b/b 1 of 1")
    assert newtons.alt.endswith("within 2 standard uncertainties: a/a 0 of 1")
    assert drawn == ["y [m]", "y [N]"]
    rows = measurements.measured_rows(book, ("c", "v"))
    assert [(row.quantity, row.unit, [*row.computed]) for row in rows] == [
        ("height", "m", ["a/a"]), ("height", "m", ["a/a", "b/b"]), ("force", "N", ["a/a"])
    ]  # fmt: skip


def test_settings_without_result_have_the_outcome_of_their_own_reason() -> None:
    pile = [record("a/a", "T1", 2e-3, status="refused", reason="it will not"),
            record("a/a", "T1", 1e-3, status="timeout", reason="it was slow")]  # fmt: skip
    found = absences.absent({"a/a": pile}, marks(["a/a"]))
    assert [(one.outcome.key, one.settings, one.reason) for one in found] == [
        (Outcome.REFUSED, ["dt = 0.002 s"], "it will not"),
        (Outcome.TIMEOUT, ["dt = 0.001 s"], "it was slow"),
    ]
