"""Compares a run with the accepted results: what moved, and beyond which band.

Bands apply to figures relative to the accepted scale, and to errors, which are relative already: a
tiny error may multiply without leaving its band, since that is rounding.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass

from vv.ask import Status
from vv.gate.bands import LARGE, Band, band_of, shift_of, size_of, widened
from vv.gate.baseline import name_of
from vv.records.accepted import AcceptedQuantity, AcceptedResult, Baseline
from vv.records.finding import Aspect, Bit, Change, Finding
from vv.records.job_record import Record
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import ran, rung

SHOWN = 3  # digits of an error, where no more are needed to see that it changed


RED = (Change.WORSE, Change.MOVED, Change.GONE)


@dataclass(frozen=True)
class Strictness:
    """How strictly a change of a result is judged.

    external: codes that are programs of others. enforced: whether a change is red. demanded:
    whether a result without a baseline is red too.
    """

    external: Collection[str]
    enforced: bool
    demanded: bool


@dataclass(frozen=True)
class Moved:
    """A quantity that left its band: the kind of change, in words, and by how many bands."""

    quantity: str
    change: Change
    text: str
    size: float = 0.0


def compare(
    case: str, records: Sequence[Record], baseline: Baseline | None, strictness: Strictness
) -> list[Finding]:
    """What changed between the baseline of a case and its records, quantity by quantity."""
    given = [r for r in records if r.case == case and not r.modified]
    if baseline is None:
        bit = Bit.INCOMPLETE if strictness.demanded else Bit(0)
        text = f"no baseline; to accept one: vv accept {case} --reason ..."
        found = [Finding(Aspect.REGRESSION, Change.NO_BASELINE.value, text, case, bit=bit)]
        return found if any(map(ran, given)) else []
    others = _other_parameters(given, baseline)
    found = [_moved_parameters(case, variant, text) for variant, text in others.items()]
    for record in given:
        if record.variant not in others:
            found += _compared(record, baseline, strictness)
    return found


def _other_parameters(records: Iterable[Record], baseline: Baseline) -> dict[str, str]:
    """Variant -> how its parameters differ from those its baseline was taken with."""
    found = {}
    for record in records:
        now, then = record.parameters, baseline.parameters.get(record.variant)
        if then is not None and then != now:
            names = sorted(n for n in now.keys() | then.keys() if now.get(n) != then.get(n))
            found[record.variant] = ", ".join(
                f"{n} = {then.get(n)}, now {now.get(n)}" for n in names
            )
    return found


def _moved_parameters(case: str, variant: str, text: str) -> Finding:
    return Finding(
        check=Aspect.REGRESSION,
        kind=Change.OTHER_PARAMETERS.value,
        text=f"the baseline was taken with {text}",
        case=case,
        variant=variant,
        bit=Bit.INCOMPLETE,
    )


def _compared(record: Record, baseline: Baseline, strictness: Strictness) -> Iterator[Finding]:
    then = baseline.results.get(name_of(record))
    if then is None:
        if ran(record):
            bit = Bit.INCOMPLETE if strictness.demanded else Bit(0)
            place = f"{record.variant} {record.label}"
            known = any(name.partition(" dt=")[0] == place for name in baseline.results)
            text = "has no baseline at this setting" if known else "has no baseline yet"
            yield _finding(record, Moved("", Change.NEW, text), bit, True)
        return
    if record.status in (Status.REFUSED, Status.NOT_RUN, Status.TOO_LONG):
        text = f"has a baseline, but now: {record.status.value}: {record.reason}"
        moved = Moved("", Change.GONE, text)
        yield _finding(record, moved, Bit.ACCURACY, strictness.enforced)
    for moved in _changes(then, record, strictness.external) if ran(record) else ():
        bit = Bit.ACCURACY if moved.change in RED else Bit(0)
        yield _finding(record, moved, bit, strictness.enforced)


def _finding(record: Record, moved: Moved, bit: Bit, enforced: bool) -> Finding:
    return Finding(
        check=Aspect.REGRESSION,
        kind=moved.change.value,
        text=moved.text,
        case=record.case,
        variant=record.variant,
        label=record.label,
        rung=rung(record),
        quantity=moved.quantity,
        bit=bit,
        enforced=enforced,
        size=moved.size,
    )


def _changes(then: AcceptedResult, record: Record, external: Collection[str]) -> Iterator[Moved]:
    """Each quantity of a record that left its band."""
    band = band_of(record.code, external)
    now = {one.name: one for one in record.quantities}
    for name in sorted(then.quantities.keys() | now.keys()):
        moved = _change(name, then.quantities.get(name), now.get(name), band)
        if moved:
            yield moved


def _change(
    name: str, then: AcceptedQuantity | None, now: MeasuredQuantity | None, band: Band
) -> Moved | None:
    """How a quantity left its band; None within it."""
    if then is None:
        return Moved(name, Change.NEW, "has no baseline yet")
    if now is None:
        return Moved(name, Change.GONE, "has a baseline, but is no longer reported")
    before, error = then.error, now.error
    if (before is None) != (error is None):
        change = Change.WORSE if error is None else Change.BETTER
        return Moved(name, change, f"error {_in_words(before)}, now {_in_words(error)}")
    drift = (error or 0.0) - (before or 0.0)
    shift = shift_of(then, now)
    wide = widened(band, then, size_of(then) if error is None else max(before or 0.0, error))
    size = min(max(abs(drift), shift) / wide.width, LARGE)
    allowed = f"it may move by {wide.width:.2g}: {wide.reason}"
    if abs(drift) > wide.width:
        return _error_moved(name, before or 0.0, error or 0.0, size, allowed)
    if not shift <= wide.width:
        text = f"value moved by {shift:.3g} of its scale; {allowed}"
        return Moved(name, Change.MOVED, text, size)
    return None


def _error_moved(name: str, was: float, error: float, size: float, band: str) -> Moved | None:
    """An error that left its band, in digits that show it.

    None for one above its scale that is less wrong by an invisible amount: it is as wrong.
    """
    digits = next((n for n in range(SHOWN, 17) if f"{was:.{n}g}" != f"{error:.{n}g}"), 17)
    change = Change.WORSE if error > was else Change.BETTER
    if change is Change.BETTER and error > 1.0 and digits > SHOWN:
        return None
    text = f"error {was:.{digits}g}, now {error:.{digits}g}; {band}"
    return Moved(name, change, text, size)


def _in_words(error: float | None) -> str:
    return "none" if error is None else f"{error:.{SHOWN}g}"


def removed_results(
    case: str,
    baseline: Baseline | None,
    variants: Collection[str],
    labels: Collection[str],
    codes: Collection[str],
) -> list[Finding]:
    """Results in a baseline whose variant or scheme no longer exists.

    variants: those of the case. codes: those that were selected. labels: all of their schemes.
    """
    found = {}
    for name in baseline.results if baseline else ():
        variant, scheme = name.split(" ")[:2]
        lost = variant not in variants or scheme not in labels
        if lost and scheme.partition("/")[0] in codes:
            found[variant, scheme] = Finding(
                check=Aspect.REGRESSION,
                kind=Change.GONE.value,
                text="has a baseline, but is no longer there",
                case=case,
                variant=variant,
                label=scheme,
                bit=Bit.ACCURACY,
            )
    return list(found.values())


def within_bands(then: AcceptedResult, record: Record, external: Collection[str]) -> bool:
    """Whether no quantity of a record has left its band."""
    return next(_changes(then, record, external), None) is None
