"""Visits of timing: each solve over the calibration beside it, and measured again where unsure."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import cast

import pytest

from vv.ask import Ask, Cost, Run, Status
from vv.codes import timing
from vv.codes.adapter import Adapter
from vv.run import rounds
from vv.run.process import Batch
from vv.run.rounds import ENOUGH, Timed

SURE, UNSURE = Cost(solve_cpu=12.0, repeats=ENOUGH), Cost(solve_cpu=12.0, repeats=ENOUGH - 1)
FAILED = Run(Status.ERROR, "lost", cost=SURE)
Visited = list[tuple[str, tuple[int, ...], int, float]]


@pytest.fixture
def session(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Session:
    return Session(monkeypatch, tmp_path)


class Session:
    """Timing of batches whose answers are given, beside calibrations that are given."""

    def __init__(self, patched: pytest.MonkeyPatch, scratch: Path) -> None:
        self.patched, self.scratch = patched, scratch
        self.visited: Visited = []

    def timed(
        self,
        batches: Mapping[str, Mapping[int, Run]],
        units: Sequence[float],
        late: Sequence[int] = (),
    ) -> list[Timed]:
        """units: [s] of the calibration, before and after each visit; late: answers that are."""
        left = iter(units)

        def answered(
            given: Sequence[Batch], workers: int, timeout: float, scratch: object
        ) -> Iterator[tuple[int, Run]]:
            for batch in given:
                self.visited.append((batch.scheme, batch.numbers, workers, timeout))
            pairs = [(number, batch.scheme) for batch in given for number in batch.numbers]
            for number, scheme in sorted(pairs, key=lambda pair: pair[0] in late):
                yield number, batches[scheme][number]

        self.patched.setattr(rounds, "calibration", lambda: next(left))
        self.patched.setattr(rounds, "run_batches", answered)
        found = rounds.rounds([_batch(*one) for one in batches.items()], 7.0, lambda: self.scratch)
        assert not [*left], "as many visits as calibrations were given for"
        return found


def _batch(scheme: str, runs: Mapping[int, Run]) -> Batch:
    asks = cast("tuple[Ask, ...]", tuple(f"ask {number}" for number in runs))
    return Batch(cast("Adapter", None), scheme, tuple(runs), asks)


def _ran(cost: Cost) -> Run:
    return Run(Status.RAN, cost=cost)


def test_a_solve_is_told_over_the_faster_calibration_beside_it_and_failures_are_left_out(
    session: Session,
) -> None:
    batches = {"a": {1: _ran(UNSURE), 2: FAILED, 3: _ran(Cost())}, "b": {4: _ran(UNSURE)}}
    found = session.timed(batches, [2.0, 3.0, 5.0, 4.0, 1.0, 2.0, 8.0, 6.0])
    assert [(number, over) for number, _, over in found] == [
        (1, 6.0),
        (4, 3.0),
        (1, 12.0),
        (4, 2.0),
    ]
    assert session.visited == [("a", (1, 2, 3), 1, 7.0), ("b", (4,), 1, 7.0)] * 2


def test_only_what_was_repeated_too_little_or_failed_is_measured_again(session: Session) -> None:
    batches = {
        "a": {1: _ran(SURE), 2: _ran(UNSURE), 3: _ran(SURE), 4: FAILED},
        "b": {5: _ran(SURE)},
        "c": {6: _ran(UNSURE)},
    }
    found = session.timed(batches, [1.0] * 10)
    assert [one[:2] for one in session.visited] == [
        ("a", (1, 2, 3, 4)), ("b", (5,)), ("c", (6,)), ("a", (2, 4)), ("c", (6,))
    ]  # fmt: skip
    assert [number for number, *_ in found] == [1, 2, 3, 5, 6, 2, 6]


@pytest.mark.parametrize("when", ["before", "after"])
def test_a_batch_beside_which_the_machine_was_slower_is_measured_again_as_a_whole(
    session: Session, when: str
) -> None:
    slow, fair = 1.11, 1.09  # a tenth is the limit
    beside = [slow, 1.0] if when == "before" else [1.0, slow]
    batches = {"a": {1: _ran(SURE), 2: _ran(SURE)}, "b": {3: _ran(SURE)}}
    session.timed(batches, [*beside, fair, 1.0, 1.0, 1.0])
    assert [one[:2] for one in session.visited] == [("a", (1, 2)), ("b", (3,)), ("a", (1, 2))]


def test_a_batch_whose_worker_died_is_told_beside_all_calibrations_since_it_began(
    session: Session,
) -> None:
    batches = {"a": {1: _ran(SURE), 2: _ran(SURE)}, "b": {3: _ran(SURE)}, "c": {4: _ran(SURE)}}
    units = [2.0 * 1.11, *[2.0] * 5, *[2.0] * 4]  # slow before a, and so before b
    found = session.timed(batches, units, late=[2])
    assert [one[:2] for one in session.visited[3:]] == [("b", (3,)), ("a", (1, 2))]
    assert [number for number, *_ in found] == [3, 4, 1, 2, 3, 1, 2]


def test_what_ran_while_the_machine_was_slower_than_later_or_earlier_is_measured_again(
    session: Session,
) -> None:
    """The least of all visits counts: b took place between calibrations of twice that."""
    batches = {"a": {1: _ran(SURE)}, "b": {2: _ran(SURE)}, "c": {3: _ran(SURE)}}
    session.timed(batches, [1.0, 1.0, 2.0, 2.0, 1.0, 1.0, 1.0, 1.0])
    assert [one[:2] for one in session.visited[3:]] == [("b", (2,))]


@pytest.mark.parametrize(("repeats", "visits"), [(2, 2), (3, 1), (4, 1)])
def test_three_repeats_are_enough(session: Session, repeats: int, visits: int) -> None:
    cost = Cost(solve_cpu=12.0, repeats=repeats)
    session.timed({"a": {1: _ran(cost)}}, [1.0] * (2 + visits))
    assert len(session.visited) == visits


def test_nothing_to_be_timed_takes_one_calibration_for_each_round(session: Session) -> None:
    assert session.timed({}, [1.0, 1.0]) == []
    assert session.visited == []


def test_a_solve_is_repeated_for_forty_blocks_of_a_millisecond() -> None:
    assert pytest.approx(40 * timing.BLOCK) == rounds.REPEAT
