"""The timing phase: solves are measured one at a time on one core, alternating between codes."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Collection, Mapping, Sequence

from vv.ask import Cost
from vv.base.digest import digest
from vv.plan.plan import Plan
from vv.records.job_record import JobCost, Record
from vv.records.manifest import TimedRun
from vv.records.outcomes import CostKind
from vv.records.reading import ran
from vv.run.executor import Executor
from vv.run.process import Batch
from vv.run.rounds import DRIFT, ENOUGH, REPEAT
from vv.store.store import Session, Store


def timed_costs(
    plan: Plan,
    records: Sequence[Record],
    run_keys: Mapping[int, str],
    store: Store,
    timeout: float,
    fresh: bool,
    place: Executor,
    begin: Callable[[int], None] = lambda count: None,
) -> dict[int, JobCost]:
    """Job number -> cost, for the jobs to be timed that ran; all from one session.

    A stored session is used if it timed the same runs on the machine on which `place` times.
    Otherwise `begin` receives the number of settings that will be timed. `relative` is solve_cpu
    over the CPU time of the calibration kernel, the smallest and the largest of the visits.
    """
    numbers = _due(plan, records)
    keys = {run_keys[n]: n for n in numbers}
    session = digest(sorted(keys), place.timer().fingerprint, REPEAT, ENOUGH, DRIFT)
    stored = None if fresh else store.timings(session)
    if stored is None and numbers:
        begin(len(numbers))
        stored = _measure(plan, numbers, run_keys, timeout, place)
        if set(stored) == set(keys):  # costs cannot be compared within a session with gaps
            store.keep_timings(session, stored)
    costs = stored or {}
    return {
        n: _cost(_with_output(costs[run_keys[n]], records[n]), session)
        for n in numbers
        if run_keys[n] in costs
    }


def gaps(plan: Plan, records: Sequence[Record], costs: Collection[int]) -> tuple[str, ...]:
    """The jobs that were to be timed and ran, but could not be timed."""
    return tuple(plan.jobs[n].label for n in _due(plan, records) if n not in costs)


def _due(plan: Plan, records: Sequence[Record]) -> list[int]:
    return [n for n, job in enumerate(plan.jobs) if job.timed and ran(records[n])]


def last_costs(plan: Plan, run_keys: Mapping[int, str], store: Store) -> dict[int, JobCost]:
    """Job number -> cost of the last timing session, for runs with the same key."""
    session = store.last_session()
    costs = (store.timings(session) if session else None) or {}
    jobs = range(len(plan.jobs))
    return {n: _cost(costs[run_keys[n]], session) for n in jobs if run_keys[n] in costs}


def _cost(timed: TimedRun, session: str) -> JobCost:
    return JobCost(**dataclasses.asdict(timed), session=session, kind=CostKind.TIMED)


def _with_output(timed: TimedRun, record: Record) -> TimedRun:
    """The cost, with the output time of the judged run if the timed run wrote less."""
    return dataclasses.replace(timed, output=max(timed.output, record.cost.output))


def _measure(
    plan: Plan, numbers: Sequence[int], run_keys: Mapping[int, str], timeout: float, place: Executor
) -> Session:
    groups: dict[tuple[str, str], list[int]] = {}
    for number in numbers:
        job = plan.jobs[number]
        groups.setdefault((job.code, job.scheme), []).append(number)
    batches = [
        Batch(
            plan.adapters[code],
            scheme,
            tuple(members),
            tuple(plan.jobs[n].ask for n in members),
            REPEAT,
            plan.found[code].worker_stays,
        )
        for (code, scheme), members in sorted(groups.items())
    ]
    seen: dict[int, list[Cost]] = {}
    ratios: dict[int, list[float]] = {}
    for number, cost, ratio in place.timed(batches, timeout):
        seen.setdefault(number, []).append(cost)
        ratios.setdefault(number, []).append(ratio)
    return {run_keys[n]: _timed(costs, ratios[n]) for n, costs in seen.items()}


def _timed(costs: Sequence[Cost], ratios: Sequence[float]) -> TimedRun:
    best = dataclasses.asdict(_best(costs))
    return TimedRun(**best, relative=(min(ratios), max(ratios)))


def _best(costs: Sequence[Cost]) -> Cost:
    """The cheapest visit, with the repeats and the spread of all visits."""
    best = min(costs, key=lambda cost: cost.solve_cpu)
    most = max(cost.solve_cpu * (1 + cost.spread) for cost in costs)
    spread = (most - best.solve_cpu) / best.solve_cpu if best.solve_cpu > 0 else 0.0
    repeats = sum(cost.repeats for cost in costs)
    return dataclasses.replace(best, repeats=repeats, spread=spread)
