"""Claims about findings gathered for a page: their rows, order and wording."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from reports import plain
from reports.marks import marks
from reports.norms import NORM_NAMES
from reports.outcomes import OUTCOMES
from reports.pages.findings import findings, refused
from reports.pages.troubles import troubles
from tests.support.fabricated import changed, entry, record
from vv.case import Norm
from vv.records.finding import Aspect, Bit, Finding
from vv.records.outcomes import Outcome

LOOKS = marks(["a/a", "b/b"])


def book(*shown: tuple[Any, Outcome], variants: str = "T1 T2") -> Any:
    """A book of records with their outcomes, in a case that has these variants."""
    facts = SimpleNamespace(variants=variants.split())
    return SimpleNamespace(
        shown=[(one, OUTCOMES[came]) for one, came in shown],
        marks=LOOKS,
        manifest=SimpleNamespace(cases={"bounce": facts} if variants else {}),
        to_case=lambda *names: "#" + "-".join(names),
        by_setting={},
        patterns=[],
    )


def blown(label: str, variant: str, dt: float | None, why: str = "it blew up") -> Any:
    return record(label, variant, dt, status="diverged", reason=why), Outcome.DIVERGED


FINAL = NORM_NAMES[Norm.FINAL]
LOOK = OUTCOMES[Outcome.DIVERGED].look


@pytest.mark.parametrize(
    ("steps", "said"),
    [
        ([None], "T1"),
        ([1e-3], "T1 at dt = 1e-3 s"),
        ([2e-3, 1e-3], "T1 at dt = 2e-3, 1e-3 s"),
        ([4e-3, 2e-3, 1e-3], "T1 (3 steps)"),
    ],
)
def test_a_place_has_its_steps_or_their_number_from_three_on(
    steps: list[float | None], said: str
) -> None:
    (one,) = findings(book(*(blown("a/a", "T1", dt) for dt in steps)), [LOOK])
    assert one.where == {"bounce": [("#bounce-T1-a/a", said)]}


@pytest.mark.parametrize(
    ("variants", "hit", "dt", "said"),
    [
        ("T1 T2 T3", "T1 T2 T3", None, ["all 3 variants"]),
        ("T1 T2", "T1 T2", None, ["T1", "T2"]),
        ("T1 T2 T3", "T1 T2", None, ["T1", "T2"]),
        ("T1 T2 T3", "T1 T2 T3", 0.5, [f"T{n} at dt = 0.5 s" for n in (1, 2, 3)]),
    ],
)
def test_three_variants_that_are_all_of_a_case_are_the_case(
    variants: str, hit: str, dt: float | None, said: list[str]
) -> None:
    made = book(*(blown("a/a", name, dt) for name in hit.split()), variants=variants)
    (one,) = findings(made, [LOOK])
    assert [words for _, words in one.where["bounce"]] == said
    whole = said == ["all 3 variants"]
    assert (one.where["bounce"][0][0] == "#bounce") is whole


def test_one_reason_is_one_row_of_a_scheme_with_the_range_of_its_decimals() -> None:
    told = [("a/a", "T1", "v = 2.5 m/s"), ("a/a", "T2", "v = 0.5 m/s"),
            ("b/b", "T1", "v = 1.5 m/s"), ("a/a", "T1", "x = 1.5 m")]  # fmt: skip
    found = findings(book(*(blown(label, v, 1e-3, why) for label, v, why in told)), [LOOK])
    assert [(one.mark.label, one.text) for one in found] == [
        ("a/a", "v = 0.5 to 2.5 m/s"), ("a/a", "x = 1.5 m"), ("b/b", "v = 1.5 m/s")
    ]  # fmt: skip


def test_what_has_no_such_look_or_is_told_elsewhere_is_left_out() -> None:
    ill = record("a/a", "T1", 1e-3, quantities=[entry("fail", {"max": 0.5})]), Outcome.FAIL
    made = book(blown("a/a", "T1", 1e-3), ill)
    looks = [LOOK, OUTCOMES[Outcome.FAIL].look]
    both = {one.outcome.key for one in findings(made, looks)}
    assert both == {Outcome.FAIL, Outcome.DIVERGED}
    (kept,) = findings(made, looks, without=[Outcome.DIVERGED])
    assert kept.outcome.key is Outcome.FAIL
    assert findings(made, ["another look"]) == []


def test_refusals_of_a_code_are_counted_by_variant_and_by_reason() -> None:
    def no(label: str, variant: str, why: str) -> Any:
        return record(label, variant, 1e-3, status="refused", reason=why), Outcome.REFUSED

    made = book(no("b/b", "T1", "x"), no("a/a", "T1", "x"), no("a/a", "T1", "y"),
                no("a/c", "T2", "x"), blown("b/b", "T2", 1e-3))  # fmt: skip
    assert refused(made) == [("a", 2, 2), ("b", 1, 1)]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"tolerance": 0.1, "errors": {"max": 0.1}}, "Error of y 0.1, tolerance 0.1"),
        ({"tolerance": 0.1, "errors": {"max": 0.4}}, "Error of y 0.4, 4 times the tolerance 0.1"),
        (
            {"tolerance": 0.1, "errors": {"final": 0.4}, "norm": "final"},
            f"Error of y (norm {FINAL}) 0.4, 4 times the tolerance 0.1",
        ),
        ({"tolerance": None, "value": 2.5, "why": "from 3 to 4"}, "y = 2.5: from 3 to 4"),
        ({"tolerance": 0.1, "errors": {"max": None}}, "y is not finite"),
        ({"tolerance": None, "errors": {"max": 0.2}, "value": None}, "y is not finite"),
    ],
)  # fmt: skip
def test_a_quantity_outside_what_is_due_is_told_by_error_over_tolerance_or_by_its_value(
    changes: dict[str, Any], said: str
) -> None:
    assert plain.excess(changed(entry("fail", {"max": 0.5}), **changes)) == said


def found(kind: str, check: Aspect = Aspect.ACCURACY, **changes: Any) -> Finding:
    given = {"case": "bounce", "variant": "T1", "label": "a/a", "bit": Bit.ACCURACY, **changes}
    return Finding(check, kind, f"{kind} it is", **given)


def gathered(*every: Finding) -> list[tuple[str, str, int]]:
    """The place, kind and count of each row."""
    return [(one.where, one.kind, one.count) for one in troubles(book(variants=""), every)]


def test_findings_of_one_kind_on_a_scheme_and_case_are_one_and_told_by_the_worst() -> None:
    every = [found("off", size=2.0), found("off", variant="T2", size=5.0),
             found("off", label="b/b", size=1.0), found("late", size=3.0),
             found("off", case="other", size=0.5)]  # fmt: skip
    assert gathered(*every) == [
        ("bounce:T2", "accuracy: off", 2),
        ("bounce:T1", "accuracy: late", 1),
        ("bounce:T1", "accuracy: off", 1),
        ("other:T1", "accuracy: off", 1),
    ]
    (first, *_) = troubles(book(variants=""), every)
    assert first.others == [("#bounce-T1", "T1")]
    assert (first.mark, first.link) == (LOOKS["a/a"], "#bounce-T2-a/a")
    assert (first.red, first.command) == (True, "vv run bounce")


def test_one_leak_breaks_several_laws_and_is_one_trouble() -> None:
    laws = [found(kind, Aspect.CONSERVATION, bit=Bit.CONSERVATION) for kind in ("x", "y")]
    assert gathered(*laws) == [("bounce:T1", "conservation: x", 2)]
    assert len(gathered(found("x"), found("y"))) == 2


def test_what_is_red_stands_first_and_what_is_wrong_in_itself_before_what_changed() -> None:
    quiet = found("off", label="b/b", enforced=False, size=9.0)
    worse = found("worse", Aspect.REGRESSION, size=7.0)
    died = found("error", Aspect.RUN, bit=Bit.CRASH)
    assert [kind for _, kind, _ in gathered(quiet, worse, died)] == [
        "run: error", "regression: worse", "accuracy: off"
    ]  # fmt: skip
    assert [one.red for one in troubles(book(variants=""), [quiet, died])] == [True, False]


def test_a_notice_and_what_is_better_than_accepted_are_no_trouble() -> None:
    better = found("better", Aspect.REGRESSION)
    assert gathered(found("new", Aspect.REGRESSION, bit=Bit(0)), better) == []
    assert len(gathered(found("better"))) == 1


def test_a_change_is_told_with_what_would_be_none_beside_it() -> None:
    told = "moved by 3 %; it may move 1 %, as rounding does"
    one = Finding(Aspect.REGRESSION, "moved", told, "bounce", "", "", bit=Bit.ACCURACY)
    (shown,) = troubles(book(variants=""), [one])
    assert shown.text.lower().endswith("moved by 3 %")
    assert shown.bound == "It may move 1 %, as rounding does."
    assert (shown.where, shown.link, shown.mark) == ("bounce", "#bounce", None)
    of_all = Finding(Aspect.RUN, "missing", "no code is there", bit=Bit.INCOMPLETE)
    (whole,) = troubles(book(variants=""), [of_all])
    assert (whole.where, whole.link, whole.text, whole.bound) == ("all", "", "No code is there", "")


def test_a_row_has_the_range_of_numbers_in_any_order_and_counts_of_unlike_size() -> None:
    told = ["v = 1.5 of 7.25", "v = 0.5 of 7.25", "v = 2.5 of 7.25"]
    (one,) = findings(book(*(blown("a/a", "T1", 1e-3, why) for why in told)), [LOOK])
    assert one.text == "v = 0.5 to 2.5 of 7.25"
    made = book(*((record("a/a", variant, 1e-3, status="refused", reason=why), Outcome.REFUSED)
                  for variant, why in (("T1", "x"), ("T2", "x"), ("T3", "y"))))  # fmt: skip
    assert refused(made) == [("a", 3, 2)]


def test_the_other_places_of_a_trouble_are_those_besides_its_worst() -> None:
    every = [found("off", variant="T2", size=9.0, rung="dt=1"), found("off", size=5.0),
             found("off", variant="T2", size=3.0, rung="dt=2"), found("off", size=2.0)]  # fmt: skip
    (one,) = troubles(book(variants=""), every)
    assert (one.where, one.count, one.setting) == ("bounce:T2", 4, "dt=1")
    assert one.others == [("#bounce-T1", "T1")]
