"""Rounds of timing: each solve over the calibration beside it, every batch as often, in turn."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from vv.ask import Cost, Run, Status
from vv.run import rounds
from vv.run.runner import Batch


def test_a_solve_is_told_over_the_faster_calibration_beside_it_and_failures_are_left_out(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    units = iter([2.0, 3.0, 5.0, 4.0, 1.0, 2.0, 8.0, 6.0])  # before and after each visit [s]
    visited = []

    def answered(
        batches: Sequence[str], workers: int, timeout: float, scratch: object
    ) -> Iterator[tuple[int, Run]]:
        (batch,) = batches
        visited.append((batch, workers, timeout))
        yield ord(batch), Run(Status.RAN, cost=Cost(solve_cpu=12.0))
        yield 0, Run(Status.ERROR, "lost", cost=Cost(solve_cpu=12.0))
        yield 1, Run(Status.RAN, cost=Cost())

    monkeypatch.setattr(rounds, "calibration", lambda: next(units))
    monkeypatch.setattr(rounds, "run_batches", answered)
    batches: list[Batch] = ["a", "b"]  # type: ignore[list-item]  # only handed on
    found = rounds.rounds(batches, 7.0, lambda: tmp_path)
    assert [(chr(number), over) for number, _, over in found] == [
        ("a", 6.0), ("b", 3.0), ("a", 12.0), ("b", 2.0)
    ]  # fmt: skip
    assert visited == [("a", 1, 7.0), ("b", 1, 7.0)] * 2
