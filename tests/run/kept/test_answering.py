"""What becomes of each job: taken from the store, refused beforehand, or run, measured and kept."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from tests import ROOT
from vv.ask import Run, Status
from vv.plan.plan import Job, Options, Plan
from vv.plan.planning import make_plan
from vv.plan.project import find
from vv.records.job_record import Record
from vv.run.answering import StoredJobs, records_of
from vv.run.limits import Limits
from vv.run.process import Batch
from vv.store.store import Store

PROJECT = find(ROOT)
SELECTION = ["single-contact:T1", "single-contact:T2", "rocking:released"]
LIMITS, ONLY = Limits(1, 30.0), Options(codes=("exact",))


def unspoilt(run: Run) -> Run:
    """The run as it is."""
    return run


class Here:
    """An executor in this process, which notes what it was given; spoil: changes each run."""

    def __init__(self, scratch: Path, spoil: Any = unspoilt) -> None:
        self.scratch, self.spoil = scratch, spoil
        self.ran: list[int] = []
        self.timeouts: list[float] = []

    def shares(self, jobs: Sequence[Job], schemes: int) -> Iterator[tuple[int, ...]]:
        """All in one."""
        yield tuple(range(len(jobs)))

    def run(self, batches: Iterable[Batch], timeout: float) -> Iterator[tuple[int, Run]]:
        """Each ask by its adapter."""
        self.timeouts.append(timeout)
        for batch in batches:
            for number, ask in zip(batch.numbers, batch.asks, strict=True):
                self.ran.append(number)
                (run,) = batch.adapter.run([ask], batch.scheme, self.scratch, 0.0)
                yield number, self.spoil(run)


Told = tuple[dict[int, Record], Here]


class Session:
    """A plan of jobs in `exact`, some of which it refuses, with a store that is kept."""

    def __init__(self, scratch: Path) -> None:
        self.store, self.scratch = Store(scratch / ".vv"), scratch
        numbers = range(len(self.plan().jobs))
        self.runs = {n: f"a{n:x}".ljust(64, "0") for n in numbers}
        self.records = {n: f"b{n:x}".ljust(64, "0") for n in numbers}
        self.begun: list[int] = []

    def plan(self) -> Plan:
        """A plan of which no job is settled yet."""
        return make_plan(
            PROJECT, ["single-contact:T1", "single-contact:T2", "rocking:released"], ONLY
        )

    def told(self, limits: Limits = LIMITS, spoil: Any = unspoilt, plan: Any = None) -> Told:
        """The records of all jobs, and the executor that some of them were given to."""
        place: Any = Here(self.scratch, spoil)
        stored = StoredJobs(self.store, self.runs, self.records)
        found = records_of(plan or self.plan(), limits, stored, place, self.begun.append)
        return dict(found), place


@pytest.fixture
def session(tmp_path: Path) -> Session:
    return Session(tmp_path)


def by_name(found: dict[int, Record]) -> dict[str, Status]:
    return {f"{one.case}:{one.variant} {one.label}": one.status for one in found.values()}


FIRST = {
    "single-contact:T1 exact/default": Status.RAN,
    "single-contact:T2 exact/default": Status.RAN,
    "single-contact:T1 exact/linearised": Status.REFUSED,
    "single-contact:T1 exact/second-order": Status.REFUSED,
    "single-contact:T2 exact/linearised": Status.REFUSED,
    "single-contact:T2 exact/second-order": Status.REFUSED,
    "rocking:released exact/default": Status.REFUSED,
    "rocking:released exact/linearised": Status.REFUSED,
    "rocking:released exact/second-order": Status.REFUSED,
}


def test_what_is_refused_is_not_run_and_the_rest_is_within_its_time(session: Session) -> None:
    found, place = session.told()
    assert by_name(found) == FIRST
    assert sorted(place.ran) == sorted(n for n, one in found.items() if one.status is Status.RAN)
    assert (session.begun, place.timeouts) == ([2], [30.0])
    assert {n: one.key for n, one in found.items()} == session.records


def test_what_is_kept_is_not_run_again_unless_it_is_to_be_fresh(session: Session) -> None:
    first, _ = session.told()
    again, place = session.told()
    assert again == first
    assert place.ran == []
    _, place = session.told(Limits(1, 7.0, fresh=True))
    assert (len(place.ran), place.timeouts) == (2, [7.0])
    assert session.begun == [2, 0, 2]


def test_what_is_kept_of_a_code_that_is_gone_does_not_count(session: Session) -> None:
    """Its jobs are asked anew, and then say that it is not there."""
    session.told()
    plan = session.plan()
    gone = dataclasses.replace(plan.found["exact"], installed=False)
    _, place = session.told(plan=dataclasses.replace(plan, found={"exact": gone}))
    assert len(place.ran) == 2


@pytest.mark.parametrize("lost", ["json", "npz", "both"])
def test_a_run_that_is_kept_is_measured_again_where_its_record_is_lost(
    session: Session, lost: str
) -> None:
    first, _ = session.told()
    for kind in ("json", "npz") if lost == "both" else (lost,):
        for file in (session.store.root / "records").rglob(f"*.{kind}"):
            file.unlink()
    again, place = session.told()
    assert again == first
    assert place.ran == []
    measured = [one for one in again.values() if one.quantities]
    assert len(measured) == 2
    assert all(session.store.series(one.key, one.quantities) for one in measured)


@pytest.mark.parametrize("status", [Status.ERROR, Status.DIVERGED, Status.TIMEOUT])
def test_what_came_to_nothing_is_told_and_tried_again(session: Session, status: Status) -> None:
    found, _ = session.told(spoil=lambda run: Run(status, "alas"))
    ran = [one for one in found.values() if one.status is not Status.REFUSED]
    assert [(one.status, one.reason) for one in ran] == [(status, "alas")] * 2
    again, place = session.told()
    assert by_name(again) == FIRST
    assert len(place.ran) == 2


def test_an_answer_of_another_shape_is_an_error_and_is_not_kept(session: Session) -> None:
    def short(run: Run) -> Run:
        return dataclasses.replace(run, values={k: v[:-1] for k, v in run.values.items()})

    found, _ = session.told(spoil=short)
    ran = [one for one in found.values() if one.status is not Status.REFUSED]
    assert [one.status for one in ran] == [Status.ERROR] * 2
    assert all("shape" in one.reason and "Error:" not in one.reason for one in ran), ran[0].reason
    assert by_name(session.told()[0]) == FIRST


def test_a_run_whose_quantities_cannot_be_measured_has_failed(session: Session) -> None:
    def raises(run: Run) -> Any:
        raise ZeroDivisionError("by nought")

    def spoilt(trial: Any) -> Any:
        wrong = (dataclasses.replace(one, observe=raises) for one in trial.quantities)
        return dataclasses.replace(trial, quantities=tuple(wrong))

    plan = session.plan()
    own = ("single-contact", "T2")
    trials = {key: spoilt(one) if key == own else one for key, one in plan.trials.items()}
    bad = dataclasses.replace(plan, trials=trials)
    found, _ = session.told(plan=bad)
    (t2,) = (r for r in found.values() if (r.variant, r.scheme) == ("T2", "default"))
    assert (t2.status, t2.quantities) == (Status.ERROR, ())
    assert t2.reason.startswith("ZeroDivisionError: by nought (")
    again, place = session.told(plan=bad)
    assert by_name(again) == by_name(found)
    assert len(place.ran) == 1, "it is tried again, and only it"
    again, place = session.told()
    assert by_name(again) == FIRST
    assert place.ran == [], "the run itself was kept, and is measured by what is right now"
