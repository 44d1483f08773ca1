"""Claims about agreement: which codes agree, which differ, and when a reference does."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from tests.support.fabricated import changed, entry, record, requantified
from vv.ask import Knobs
from vv.insight.agreement import agreements
from vv.records.job_record import Record
from vv.records.recorded import RecordedQuantity, RecordedResult

END, SCALE = 1.0, 1.0


def said(label: str, *values: float, **changes: object) -> list[Record]:
    """The records of a scheme that came to these values, from the coarsest step to the finest."""
    found = []
    for number, value in enumerate(values):
        measured = changed(entry("pass", {"max": 1e-4}), figures={"final": value}, end=END)
        found.append(record(label, "floor", 4e-3 / 2**number, quantities=[measured], **changes))
    return found


def records_of(answers: Mapping[str, tuple[float, ...]]) -> list[Record]:
    return [one for label, values in answers.items() for one in said(label, *values)]


def written_down(
    label: str, *values: float, **changes: object
) -> tuple[list[Record], list[RecordedResult]]:
    """A scheme whose code is not installed, and the results that were recorded of it."""
    code, _, scheme = label.partition("/")
    steps = [4e-3 / 2**number for number in range(len(values))]
    absent = [record(label, "floor", dt, status="not-installed", **changes) for dt in steps]
    kept = [
        RecordedResult(
            "bounce", "floor", code, scheme, Knobs(dt), "", "7", "2025", 12, None, {"y": said}
        )
        for dt, said in zip(steps, [RecordedQuantity({"final": v}) for v in values], strict=True)
    ]
    return absent, kept


AGREEING = {"a/x": (1.03, 1.01), "b/x": (0.97, 0.99), "c/x": (1.02, 1.005)}


def test_three_that_lie_within_their_errors_agree() -> None:
    (agreement,) = agreements(records_of(AGREEING))
    assert [answer.label for answer in agreement.agreeing] == ["a/x", "b/x", "c/x"]
    assert not agreement.odd
    assert not agreement.alone
    assert agreement.in_words() == (
        "y of bounce:floor (second order in dt): a/x, b/x, c/x agree within their errors"
    )


def test_the_code_that_differs_is_named_with_its_value() -> None:
    (agreement,) = agreements(records_of({**AGREEING, "d/x": (1.21, 1.2)}))
    assert [answer.label for answer in agreement.odd] == ["d/x"]
    assert agreement.in_words().endswith("d/x differs, 1.2")


def test_an_answer_is_off_by_its_last_refinement_of_the_step_and_of_the_stiffness() -> None:
    (agreement,) = agreements(records_of({**AGREEING, "a/x": (2.0, 1.25, 1.0)}))
    assert agreement.answers[0].error == pytest.approx(0.25)
    rungs = {(1e6, 2e-3): 9.0, (1e7, 2e-3): 3.0, (1e7, 1e-3): 2.5, (1e8, 1e-3): 2.0}
    stiffer = [
        changed(one, rung={"dt": dt, "kn": kn})
        for (kn, dt), value in rungs.items()
        for one in said("a/x", value)
    ]
    (agreement,) = agreements(
        [*stiffer, *records_of({"b/x": AGREEING["b/x"], "c/x": AGREEING["c/x"]})]
    )
    assert agreement.answers[0].error == pytest.approx(0.5)  # 1e8 has one step; 2.0 - 2.5


def judged(verdict: str, *errors: float, **answers: tuple[float, ...]) -> list[Record]:
    """Records of schemes whose errors are these, from the coarsest step to the finest."""
    made = []
    for code, values in answers.items():
        for one, error in zip(said(f"{code}/x", *values), errors, strict=True):
            made.append(requantified(one, errors={"max": error}, verdict=verdict))
    return made


SHARP = {"a": (1.0, 1.1), "b": (1.02, 1.11), "c": (1.03, 1.12)}


def test_a_reference_against_which_all_that_agree_stay_wrong_is_suspected() -> None:
    (agreement,) = agreements(judged("fail", 0.7, 0.69, **SHARP))
    assert agreement.alone
    assert agreement.in_words().endswith(
        "): all codes (a/x, b/x, c/x) agree with each other and not with the reference: suspect "
        "the reference"
    )
    (agreement,) = agreements(judged("fail", 0.7, 0.69, **SHARP, d=(2.01, 2.0)))
    assert agreement.in_words().endswith(
        "): a/x, b/x, c/x agree with each other and not with the reference; d/x differs, 2: "
        "suspect the reference"
    )


@pytest.mark.parametrize(
    ("verdict", "errors"),
    [("pass", (4.4e-6, 4.4e-6)), ("xfail", (0.7, 0.7)), ("fail", (0.2, 0.1))],
    ids=["within its tolerance", "known to be wrong", "too coarse, of first order"],
)
def test_a_reference_that_codes_meet_or_approach_is_not_suspected(
    verdict: str, errors: tuple[float, float]
) -> None:
    (agreement,) = agreements(judged(verdict, *errors, **SHARP))
    assert not agreement.alone
    assert agreement.in_words().endswith("a/x, b/x, c/x agree within their errors")


def test_series_that_end_alike_agree_only_if_their_means_do() -> None:
    def course(label: str, mean: float) -> list[Record]:
        figures = {"final": 1.0, "mean": mean}
        return [requantified(one, figures=figures) for one in said(label, 1.0, 1.0)]

    records = [*course("a/x", 0.5), *course("b/x", 0.5), *course("c/x", -0.5)]
    (agreement,) = agreements(records)
    assert [answer.label for answer in agreement.odd] == ["c/x"]


@pytest.mark.parametrize(
    "answers",
    [
        {"a/x": (1.0, 1.0), "b/x": (1.0, 1.0)},
        {"a/x": (1.0, 1.0), "a/y": (1.0, 1.0), "b/x": (1.0, 1.0)},
        {"lammps/x": (1.0, 1.0), "liggghts/x": (1.0, 1.0), "b/x": (1.0, 1.0)},
    ],
    ids=["two", "two schemes of a code", "two of a family"],
)
def test_codes_that_share_sources_count_as_one_and_two_are_too_few(
    answers: Mapping[str, tuple[float, ...]],
) -> None:
    assert agreements(records_of(answers)) == []


def test_a_code_answers_with_its_scheme_of_the_least_error() -> None:
    (agreement,) = agreements(records_of({**AGREEING, "a/sharp": (1.0001, 1.0)}))
    assert agreement.answers[0].label == "a/sharp"


def test_classes_of_method_are_compared_apart() -> None:
    records = records_of({"a/x": AGREEING["a/x"], "b/x": AGREEING["b/x"]})
    assert agreements([*records, *said("c/x", 1.02, 1.005, method="penalty")]) == []


def test_a_code_run_at_one_step_only_is_left_out_since_its_error_is_unknown() -> None:
    assert agreements(records_of({**AGREEING, "c/x": (1.005,)})) == []


def test_without_a_majority_no_code_is_named_as_differing() -> None:
    (agreement,) = agreements(records_of({"a/x": (1.0, 1.0), "b/x": (2.0, 2.0), "c/x": (3.0, 3.0)}))
    assert not agreement.odd
    assert not agreement.alone
    assert agreement.in_words().endswith("no majority of 3 answers agrees")


def test_a_code_that_is_not_installed_is_represented_by_recorded_results() -> None:
    live = records_of({"a/x": AGREEING["a/x"], "b/x": AGREEING["b/x"]})
    absent, kept = written_down("c/x", *AGREEING["c/x"])
    assert agreements([*live, *absent]) == []
    (agreement,) = agreements([*live, *absent], kept)
    assert agreement.in_words().endswith("a/x, b/x, c/x (recorded) agree within their errors")


def test_what_is_recorded_may_be_off_by_the_digits_that_were_kept() -> None:
    live = records_of({"a/x": (1.000003, 1.000003), "b/x": (1.000003, 1.000003)})
    absent, kept = written_down("c/x", 1.0, 1.0)
    (agreement,) = agreements([*live, *absent], kept)
    assert not agreement.odd


def test_a_recorded_result_counts_in_its_class_of_method_alone() -> None:
    live = records_of({"a/x": AGREEING["a/x"], "b/x": AGREEING["b/x"]})
    absent, kept = written_down("c/x", *AGREEING["c/x"], method="penalty")
    assert agreements([*live, *absent], kept) == []


def test_what_did_not_run_and_what_is_recorded_at_other_parameters_have_no_say() -> None:
    others = records_of({"a/x": AGREEING["a/x"], "b/x": AGREEING["b/x"]})
    assert agreements([*others, *said("c/x", *AGREEING["c/x"], status="error")]) == []
    live = records_of({"a/x": AGREEING["a/x"], "b/x": AGREEING["b/x"]})
    absent, kept = written_down("c/x", *AGREEING["c/x"], modified=True)
    assert agreements([*live, *absent], kept) == []


def beside_others(rungs: dict[tuple[float, float], float]) -> list[Record]:
    """Values of a/x at settings (kn, dt), beside two codes that agree with each other."""
    own = [
        changed(one, rung={"dt": dt, "kn": kn})
        for (kn, dt), value in rungs.items()
        for one in said("a/x", value)
    ]
    return [*own, *records_of({"b/x": AGREEING["b/x"], "c/x": AGREEING["c/x"]})]


def test_stiffness_is_refined_last_from_the_stiffest_of_the_softer_springs() -> None:
    rungs = {(1e6, 1e-3): 9.0, (1e7, 2e-3): 7.0, (1e7, 1e-3): 3.0, (1e8, 1e-3): 2.0}
    (agreement,) = agreements(beside_others(rungs))
    assert agreement.answers[0].error == pytest.approx(1.0)  # 2.0 - 3.0, at the finest step


def test_rounding_of_the_scale_is_no_disagreement() -> None:
    same = {name: (1.0 + k * 1e-13, 1.0 + k * 1e-13) for k, name in enumerate(("a/x", "b/x"))}
    (agreement,) = agreements(records_of({**same, "c/x": (1.0 + 1e-10, 1.0 + 1e-10)}))
    assert [one.label for one in agreement.agreeing] == ["a/x", "b/x"]
    assert [one.label for one in agreement.odd] == ["c/x"]


def test_a_reference_with_which_one_of_those_that_agree_does_is_not_disagreed_with() -> None:
    wide = {"a/x": (1.5, 1.1), "b/x": (1.1001, 1.1), "c/x": (1.1001, 1.1)}
    (agreement,) = agreements(records_of(wide))
    assert len(agreement.agreeing) == 3
    assert not agreement.alone
    wrong = {name: SHARP[name] for name in "ab"}
    (agreement,) = agreements(
        [*judged("fail", 0.7, 0.69, **wrong), *judged("pass", 4e-6, 4e-6, c=SHARP["c"])]
    )
    assert [one.against for one in agreement.agreeing] == [True, True, False]
    assert not agreement.alone


def test_what_the_last_step_and_the_last_stiffness_changed_add_up() -> None:
    rungs = {(1e7, 2e-3): 3.0, (1e8, 2e-3): 2.5, (1e8, 1e-3): 2.25}
    (agreement,) = agreements(beside_others(rungs))
    assert agreement.answers[0].error == pytest.approx(0.25 + 0.75)  # 2.5 - 2.25, 3.0 - 2.25


def test_of_two_groups_of_one_size_that_of_the_least_errors_agrees() -> None:
    # b agrees with both; a and c are 0.46 apart, and off by 0.28 and 0.165
    answers = {"a/x": (1.28, 1.0), "b/x": (1.30, 1.28), "c/x": (1.295, 1.46)}
    (agreement,) = agreements(records_of(answers))
    assert [answer.label for answer in agreement.agreeing] == ["b/x", "c/x"]
    assert agreement.in_words().endswith("; a/x differs, 1")


def test_rounding_is_that_of_the_largest_scale() -> None:
    off = {name: (1.0 + k * 1e-10,) * 2 for k, name in enumerate(("a/x", "b/x", "c/x"))}
    records = records_of(off)
    (small,) = agreements(records)
    assert small.in_words().endswith("no majority of 3 answers agrees")
    (large,) = agreements([requantified(records[0], scale=1e3), *records[1:]])
    assert len(large.agreeing) == 3
