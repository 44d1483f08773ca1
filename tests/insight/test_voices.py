"""Claims about voices: who agrees within the errors, who is odd, and when a reference is alone."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from tests.support.fabricated import changed, entry, record
from vv.ask import Knobs
from vv.insight.voices import votes
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


def heard(voices: Mapping[str, tuple[float, ...]]) -> list[Record]:
    return [one for label, values in voices.items() for one in said(label, *values)]


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


CHORUS = {"a/x": (1.03, 1.01), "b/x": (0.97, 0.99), "c/x": (1.02, 1.005)}


def test_three_that_lie_within_their_errors_agree() -> None:
    (vote,) = votes(heard(CHORUS))
    assert [voice.label for voice in vote.agreeing] == ["a/x", "b/x", "c/x"]
    assert not vote.odd
    assert not vote.alone
    assert vote.in_words() == (
        "y of bounce:floor (second order in dt): a/x, b/x, c/x agree within their errors"
    )


def test_the_odd_one_is_named_with_its_value() -> None:
    (vote,) = votes(heard({**CHORUS, "d/x": (1.21, 1.2)}))
    assert [voice.label for voice in vote.odd] == ["d/x"]
    assert vote.in_words().endswith("the odd one is d/x, 1.2")


def test_a_voice_is_off_by_its_last_refinement_of_the_step_and_of_the_stiffness() -> None:
    (vote,) = votes(heard({**CHORUS, "a/x": (2.0, 1.25, 1.0)}))
    assert vote.voices[0].error == pytest.approx(0.25)
    rungs = {(1e6, 2e-3): 9.0, (1e7, 2e-3): 3.0, (1e7, 1e-3): 2.5, (1e8, 1e-3): 2.0}
    stiffer = [
        changed(one, rung={"dt": dt, "kn": kn})
        for (kn, dt), value in rungs.items()
        for one in said("a/x", value)
    ]
    (vote,) = votes([*stiffer, *heard({"b/x": CHORUS["b/x"], "c/x": CHORUS["c/x"]})])
    assert vote.voices[0].error == pytest.approx(0.5)  # 1e8 has one step; 2.0 - 2.5


def test_a_reference_outside_of_all_errors_stands_alone() -> None:
    sharp = {name: (1.1 + 2e-4 * k, 1.1 + 1e-4 * k) for k, name in enumerate(("a/x", "b/x", "c/x"))}
    (vote,) = votes(heard(sharp))
    assert vote.alone
    assert "the reference, 1, stands alone" in vote.in_words()


@pytest.mark.parametrize(
    "voices",
    [
        {"a/x": (1.0, 1.0), "b/x": (1.0, 1.0)},
        {"a/x": (1.0, 1.0), "a/y": (1.0, 1.0), "b/x": (1.0, 1.0)},
        {"lammps/x": (1.0, 1.0), "liggghts/x": (1.0, 1.0), "b/x": (1.0, 1.0)},
    ],
    ids=["two", "two schemes of a code", "two of a family"],
)
def test_relatives_are_one_voice_and_two_are_too_few(
    voices: Mapping[str, tuple[float, ...]],
) -> None:
    assert votes(heard(voices)) == []


def test_a_code_speaks_with_its_scheme_of_the_least_error() -> None:
    (vote,) = votes(heard({**CHORUS, "a/sharp": (1.0001, 1.0)}))
    assert vote.voices[0].label == "a/sharp"


def test_classes_of_method_are_heard_apart() -> None:
    records = heard({"a/x": CHORUS["a/x"], "b/x": CHORUS["b/x"]})
    assert votes([*records, *said("c/x", 1.02, 1.005, method="penalty")]) == []


def test_who_ran_at_one_step_alone_has_no_voice_for_nobody_knows_how_far_it_is_off() -> None:
    assert votes(heard({**CHORUS, "c/x": (1.005,)})) == []


def test_without_a_majority_nobody_is_odd() -> None:
    (vote,) = votes(heard({"a/x": (1.0, 1.0), "b/x": (2.0, 2.0), "c/x": (3.0, 3.0)}))
    assert not vote.odd
    assert not vote.alone
    assert vote.in_words().endswith("no majority of 3 voices agrees")


def test_a_code_that_is_not_installed_speaks_by_what_was_recorded_of_it() -> None:
    live = heard({"a/x": CHORUS["a/x"], "b/x": CHORUS["b/x"]})
    absent, kept = written_down("c/x", *CHORUS["c/x"])
    assert votes([*live, *absent]) == []
    (vote,) = votes([*live, *absent], kept)
    assert vote.in_words().endswith("a/x, b/x, c/x (recorded) agree within their errors")


def test_what_is_recorded_may_be_off_by_the_digits_that_were_kept() -> None:
    live = heard({"a/x": (1.000003, 1.000003), "b/x": (1.000003, 1.000003)})
    absent, kept = written_down("c/x", 1.0, 1.0)
    (vote,) = votes([*live, *absent], kept)
    assert not vote.odd


def test_what_is_recorded_is_heard_in_its_class_of_method_alone() -> None:
    live = heard({"a/x": CHORUS["a/x"], "b/x": CHORUS["b/x"]})
    absent, kept = written_down("c/x", *CHORUS["c/x"], method="penalty")
    assert votes([*live, *absent], kept) == []
