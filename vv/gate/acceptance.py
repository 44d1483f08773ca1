"""Decides which results may be accepted, and makes the new baseline."""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Iterable

from vv.ask import Status
from vv.gate.baseline import name_of, result_of
from vv.gate.regression import within_bands
from vv.records.accepted import Acceptance, AcceptedResult, Baseline
from vv.records.job_record import Record
from vv.records.outcomes import Verdict
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
) -> Baseline:
    """The baseline with these records added, and with their acceptance.

    Results of codes that are not installed here are kept, and so are those of `later` variants,
    which only a higher level runs. Results of schemes that now refuse, or no longer exist, are
    removed. A result that did not leave its band is not replaced, so that small changes cannot
    accumulate unnoticed.
    """
    given = [r for r in records if r.case == case]
    old = baseline or Baseline(case)
    number = str(1 + max(map(int, old.acceptances), default=0))
    absent = {r.label for r in given if r.status is Status.NOT_INSTALLED}
    results = {
        name: result
        for name, result in old.results.items()
        if name.split(" ")[0] in later or name.split(" ")[1] in absent
    }
    for record in filter(acceptable, given):
        name = name_of(record)
        results[name] = _accepted_result(old.results.get(name), record, number, external)
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


def _accepted_result(
    before: AcceptedResult | None, record: Record, number: str, external: Collection[str]
) -> AcceptedResult:
    """The accepted result if the record is within its band, else the result of the record."""
    new = result_of(record, number)
    if before is None:
        return new
    cost = new.cost or before.cost
    same = within_bands(before, record, external) and before.cost == cost
    return before if same else dataclasses.replace(new, cost=cost)
