"""What may be accepted, how it is numbered and kept, one row a decision, by hand."""

import json
from pathlib import Path

import pytest

from tests.support.acceptances import accepted, ran
from tests.support.fabricated import changed, entry
from vv.base.errors import UsageError
from vv.gate import acceptance, baseline
from vv.records import codec
from vv.records.job_record import Record


@pytest.mark.parametrize(
    ("verdicts", "good"),
    [
        (["pass", "xfail", "no-reference"], True),
        (["pass", "fail"], False),
        (["fail", "pass"], False),
        (["pass", "xpass"], False),
    ],
)
def test_every_quantity_must_be_right_to_be_accepted(verdicts: list[str], good: bool) -> None:
    quantities = [entry(verdict, {"max": 1e-4}) for verdict in verdicts]
    assert acceptance.acceptable(changed(ran(), quantities=quantities)) is good


def test_an_acceptance_gets_the_number_after_the_largest() -> None:
    kept = accepted(ran(variant="T1"))
    for error, number in ((2e-4, "2"), (3e-4, "3"), (4e-4, "4")):
        kept = accepted(ran(), ran(error, variant="T2"), old=kept)
        assert {result.by for result in kept.results.values()} == {"1", number}
    assert set(kept.acceptances) == {"1", "4"}  # of 2 and 3 nothing is left


def test_a_baseline_reads_back_and_one_of_another_case_is_refused(tmp_path: Path) -> None:
    assert baseline.read(tmp_path, "bounce") is None
    kept = accepted(ran())
    for name in ("bounce", "fall"):
        (tmp_path / f"{name}.json").write_text(json.dumps(codec.to_data(kept)))
    assert baseline.read(tmp_path, "bounce") == kept
    with pytest.raises(UsageError, match="not a baseline of fall"):
        baseline.read(tmp_path, "fall")


def test_a_baseline_has_the_parameters_of_the_case_and_both_ends_of_a_cost() -> None:
    old = accepted(ran(parameters={"m": 1.0}), ran(variant="T2", parameters={"m": 4.0}))
    new = accepted(
        ran(parameters={"m": 2.0}, cost=changed(ran().cost, relative=(1.2345, 6.7891))),
        ran(parameters={"m": 3.0}, modified=True),
        ran(variant="T2", parameters={"m": 4.0}),
        old=old,
    )
    assert new.parameters == {"T1": {"m": 2.0}, "T2": {"m": 4.0}}
    assert {name: one.cost for name, one in new.results.items()} == {
        "T1 dem/default dt=0.001": (1.23, 6.79), "T2 dem/default dt=0.001": None
    }  # fmt: skip


def test_a_new_cost_is_accepted_in_place_of_the_old_and_without_one_the_old_stays() -> None:
    def of(relative: tuple[float, float] | None) -> Record:
        return ran(cost=changed(ran().cost, relative=relative))

    kept = accepted(of((1.0, 2.0)))
    for relative, cost in ((None, (1.0, 2.0)), ((3.0, 4.0), (3.0, 4.0))):
        kept = accepted(of(relative), old=kept)
        assert [one.cost for one in kept.results.values()] == [cost]
