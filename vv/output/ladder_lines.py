"""Prints what the settings of a program say together: its errors, its order, what it claims."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from vv.output.terminal import say
from vv.records.job_record import Record
from vv.records.outcomes import Verdict
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import by_fineness
from vv.records.rungs import Key, ladder, orders

Rung = tuple[Record, MeasuredQuantity]


def print_ladders(records: Iterable[Record], codes: Collection[str]) -> None:
    """For each scheme of these codes and each quantity, a line: errors, order, how many failed."""
    own = [record for record in records if record.code in codes]
    fitted = orders(own)
    claims: dict[str, dict[Key, list[Rung]]] = {}
    for record in own:
        claim = f"{record.label} claims to be {record.method.value}"
        for one in record.quantities:
            if one.error is not None:
                rungs = claims.setdefault(claim, {}).setdefault(ladder(record, one.name), [])
                rungs.append((record, one))
    for claim, ladders in claims.items():
        say(claim)
        for key, found in ladders.items():
            rungs = sorted(found, key=lambda rung: by_fineness(rung[0]))
            order = f"order in dt {fitted[key].order:.2f}" if key in fitted else ""
            say("  " + "; ".join(filter(None, (*_words(rungs), order, _failures(rungs)))))


def _words(rungs: Sequence[Rung]) -> Iterator[str]:
    """Where the errors are, and the errors of the coarsest and of the finest setting."""
    first, last = rungs[0], rungs[-1]
    yield f"{first[0].case}:{first[0].variant} {first[1].name}: error {_error(first)}"
    if last is not first:
        yield _error(last)


def _error(rung: Rung) -> str:
    record, one = rung
    at = f" at dt = {record.rung.dt:g} s" if record.rung.dt else ""
    return f"{one.error:.1e}{at}"


def _failures(rungs: Sequence[Rung]) -> str:
    """How many settings miss the tolerance, or that there is none."""
    failed = sum(one.verdict is Verdict.FAIL for _, one in rungs)
    if failed:
        return f"{failed} of {len(rungs)} outside the tolerance"
    shown = all(one.verdict is Verdict.NO_REFERENCE for _, one in rungs)
    return f"shown only: {rungs[0][1].why}" if shown else ""
