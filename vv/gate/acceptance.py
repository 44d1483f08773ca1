"""Decides which results may be accepted, and makes the new baseline."""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Iterable

from vv.ask import Status
from vv.gate.bands import band_of, shared, with_rounding, with_wider_rounding
from vv.gate.baseline import name_of, result_of
from vv.gate.regression import within_bands
from vv.records.accepted import Acceptance, AcceptedResult, Baseline
from vv.records.job_record import Record
from vv.records.outcomes import QuantityKind, Verdict
from vv.records.reading import ran

GOOD = (Verdict.PASS, Verdict.XFAIL, Verdict.NO_REFERENCE)


def acceptable(record: Record) -> bool:
    """Whether a record may enter a baseline: it ran, unmodified, and nothing in it fails."""
    whole = ran(record) and not record.modified and record.quantities
    return bool(whole) and all(one.verdict in GOOD for one in record.quantities)


def accepted(
    case: str,
    baseline: Baseline | None,
    records: Iterable[Record],
    acceptance: Acceptance,
    external: Collection[str],
    later: Collection[str] = (),
    nudged: Iterable[Record] = (),
) -> Baseline:
    """The baseline with these records added, and with their acceptance.

    Results of codes that are not installed here are kept, and so are those named in `later`, which
    only a higher level runs. Results of schemes that now refuse, or no longer exist, are removed. A
    result that did not leave its band is not replaced, so that small changes cannot accumulate
    unnoticed. nudged: records of the same jobs with the last digits of the scene changed, from
    which follows how far rounding may move a result.
    """
    given = [r for r in records if r.case == case]
    old = baseline or Baseline(case)
    number = str(1 + max(map(int, old.acceptances), default=0))
    results = _kept(old, given, later)
    again: dict[str, list[AcceptedResult]] = {}
    for record in (r for r in nudged if r.case == case):
        again.setdefault(name_of(record), []).append(result_of(record, number))
    for record in filter(acceptable, given):
        name, now = name_of(record), result_of(record, number)
        now = with_rounding(now, again.get(name, []), band_of(record.code, external))
        results[name] = _accepted_result(old.results.get(name), now, record, external)
    results = shared(results, _counts_of(given))
    used = {result.by for result in results.values()}
    given_by = {**old.acceptances, number: acceptance}
    variants = {name.split(" ")[0] for name in results}
    parameters = {**old.parameters, **{r.variant: r.parameters for r in given if not r.modified}}
    return Baseline(
        case,
        {n: a for n, a in given_by.items() if n in used},
        {name: parameters[name] for name in sorted(variants)},
        results,
    )


def _kept(old: Baseline, given: list[Record], later: Collection[str]) -> dict[str, AcceptedResult]:
    """Accepted results of codes that are not installed, and those that only a higher level runs."""
    absent = {record.label for record in given if record.status is Status.NOT_INSTALLED}
    return {
        name: result
        for name, result in old.results.items()
        if name in later or name.split(" ")[1] in absent
    }


def _counts_of(records: Iterable[Record]) -> set[tuple[str, str]]:
    """The results and quantities that are whole numbers."""
    return {
        (name_of(record), one.name)
        for record in records
        for one in record.quantities
        if one.kind is QuantityKind.COUNT
    }


def _accepted_result(
    before: AcceptedResult | None, now: AcceptedResult, record: Record, external: Collection[str]
) -> AcceptedResult:
    """The accepted result if the record is within its band, else that of the record, `now`."""
    if before is None:
        return now
    kept = with_wider_rounding(before, now)
    cost = now.cost or before.cost
    same = within_bands(kept, record, external) and before.cost == cost
    return kept if same else dataclasses.replace(now, cost=cost)
