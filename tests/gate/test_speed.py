"""How speed is compared: what was timed, of which case, and by what factor it changed."""

import signal
from dataclasses import replace
from typing import Any

import pytest

from tests.support.fabricated import changed, entry, record
from vv.gate import acceptance, speed
from vv.records.accepted import Acceptance, Baseline, Place
from vv.records.finding import Finding
from vv.records.job_record import Record

ACCEPTANCE = Acceptance("c", False, Place("P", "S"), "r", "u", {})


def timed(relative: tuple[float, float] | None, **changes: Any) -> Record:
    made = record("dem/default", "T1", 1e-3, quantities=[entry("pass", {"max": 1e-4})])
    return changed(made, cost=changed(made.cost, relative=relative), **changes)


def baseline(relative: tuple[float, float] | None) -> Baseline:
    return acceptance.accepted("bounce", None, [timed(relative)], ACCEPTANCE, ())


def compared(now: Record, then: Baseline | None) -> list[Finding]:
    return speed.compare("bounce", [now], then, "P", True)


@pytest.mark.parametrize(
    ("then", "now"),
    [(None, (9.0, 9.0)), ((1.0, 1.0), None)],
)
def test_what_was_not_timed_on_both_sides_is_not_compared(
    then: tuple[float, float] | None, now: tuple[float, float] | None
) -> None:
    assert compared(timed(now), baseline(then)) == []


def test_other_cases_modified_runs_and_what_has_no_baseline_are_not_compared() -> None:
    then, slow = baseline((1.0, 1.0)), (9.0, 9.0)
    assert len(compared(timed(slow), then)) == 1
    assert compared(timed(slow), None) == []
    assert compared(timed(slow, case="other"), then) == []
    assert compared(timed(slow, modified=True), then) == []
    assert compared(timed(slow, variant="T9"), then) == []


@pytest.mark.parametrize(
    ("now", "kind", "size"),
    [
        ((3.2, 4.0), "slower", 1.6),  # its least over the largest before
        ((2.9, 4.0), None, 0.0),
        ((0.5, 0.625), "faster", 1.6),  # the least before over its largest
        ((0.5, 0.7), None, 0.0),
    ],
)
def test_the_factor_is_that_between_the_nearest_ends_of_the_intervals(
    now: tuple[float, float], kind: str | None, size: float
) -> None:
    found = compared(timed(now), baseline((1.0, 2.0)))
    assert [one.kind for one in found] == ([kind] if kind else [])
    assert all(one.size == pytest.approx(size) for one in found)


def test_the_calibration_kernel_takes_about_a_millisecond() -> None:
    """A thousandth to a thousand: a clock that ran backwards or summed would be far off."""
    assert 1e-5 < speed.calibration() < 1.0


def test_a_limit_of_cpu_time_leaves_the_calibration_kernel_its_time() -> None:
    """Under a timer of CPU time, as under `ulimit -t`, the clock of a process ticks."""
    free = speed.calibration()
    before = signal.setitimer(signal.ITIMER_PROF, 1e4)
    try:
        limited = speed.calibration()
    finally:
        signal.setitimer(signal.ITIMER_PROF, *before)
    assert free / 10 < limited < 10 * free


def test_the_calibration_kernel_takes_the_least_of_a_few(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = iter([10.0, 15.0, 20.0, 22.0, 30.0, 33.0, 40.0, 44.0, 50.0, 56.0])
    monkeypatch.setattr("vv.gate.speed.time.process_time", lambda: next(clock))
    assert speed.calibration() == 2.0


def test_a_change_is_told_with_both_intervals_and_by_the_processor_of_its_acceptance() -> None:
    """Results of T1 were accepted on P, those of T2 later on Q; this is P."""
    elsewhere = replace(ACCEPTANCE, machine=Place("Q", "S"))
    old = baseline((1.0, 2.0))
    both = acceptance.accepted(
        "bounce", old, [timed((1.0, 2.0)), timed((1.25, 2.25), variant="T2")], elsewhere, ()
    )
    assert {name: one.by for name, one in both.results.items()} == {
        "T1 dem/default dt=0.001": "1", "T2 dem/default dt=0.001": "2"
    }  # fmt: skip
    (found,) = compared(timed((8.0, 9.0)), both)
    assert found.text == (
        "solve takes 8 to 9 calibration kernels, accepted 1 to 2; factor 1.5 allowed on the same "
        "processor"
    )
    (found,) = compared(timed((8.0, 9.0), variant="T2"), both)
    assert found.text == (
        "solve takes 8 to 9 calibration kernels, accepted 1.25 to 2.25; factor 3 allowed on "
        "another processor"
    )
