"""Writes an invocation as JUnit XML: a suite per case, a test per record and quantity."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from vv.base.files import write_output
from vv.base.printable import printable
from vv.records.codec import word
from vv.records.finding import Aspect, Bit, Finding
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.reading import rung, tried

CRASHES = Bit.CRASH | Bit.TIMEOUT
Place = tuple[str, str, str, str, str]  # case, variant, scheme, knobs, quantity


def write_junit(path: Path, manifest: Manifest, findings: Iterable[Finding]) -> None:
    """Write the file.

    Failure: out of tolerance or band. Error: crash, timeout or incomplete. Skipped: refused or not
    installed. A finding that is only reported is a property of its test.
    """
    import junitparser

    at: dict[Place, list[Finding]] = {}
    for finding in findings:
        at.setdefault(_place(finding), []).append(finding)
    tests: dict[str, list[Any]] = {}
    for record in manifest.records:
        tests.setdefault(record.case, []).extend(_tests_of(record, at))
    for place, others in at.items():  # what belongs to no record: a missing code, a lost result
        tests.setdefault(place[0], []).append(_test(place, others, {}))
    document: Any = junitparser.JUnitXml("vv")
    for name, cases in tests.items():
        suite: Any = junitparser.TestSuite(printable(name) or "vv")
        suite.add_testcases(cases)
        suite.timestamp = printable(manifest.provenance.utc)
        document.add_testsuite(suite)
    document.update_statistics()
    write_output(path, document.tostring())


def _tests_of(record: Record, at: dict[Place, list[Finding]]) -> Iterator[Any]:
    """A test for each quantity of a record; removes its findings from `at`."""
    import junitparser

    names = [one.name for one in record.quantities] or [""]
    for name in names:
        place = (record.case, record.variant, record.label, rung(record), name)
        own = at.pop(place, [])
        whole = at.pop((*place[:4], ""), []) if name == names[0] else []
        test = _test(place, [*own, *(whole if name else [])], _figures(record, name))
        if not tried(record) and not test.result:
            why = printable(f"{word(record.status)}: {record.reason}")
            test.result = [junitparser.Skipped(why)]
        test.time = record.cost.solve_wall
        yield test


def _place(finding: Finding) -> Place:
    return finding.case, finding.variant, finding.label, finding.rung, finding.quantity


def _test(place: Place, findings: Iterable[Finding], figures: Mapping[str, object]) -> Any:
    import junitparser

    case, variant, scheme, knobs, quantity = place
    given = list(findings)
    kinds = (
        {f.check.value for f in given if f.check is not Aspect.RUN}
        if not (scheme and quantity)
        else set()
    )
    words = (scheme, quantity, variant, knobs, *sorted(kinds))
    name = printable(" ".join(w for w in words if w))
    test: Any = junitparser.TestCase(name or "run", printable(case) or "vv")
    results: list[Any] = []
    for finding in (f for f in given if f.red):
        broken = finding.bit & (CRASHES | Bit.INCOMPLETE)
        kind = junitparser.Error if broken else junitparser.Failure
        what = printable(f"{finding.check.value}: {finding.kind}")
        results.append(kind(printable(finding.text), what))
    if results:
        test.result = results
    notes = {f"{f.check.value}: {f.kind}": f.text for f in given if not f.red}
    if shown := {**figures, **notes}:
        make: Any = junitparser.Properties
        properties = make()
        for label, value in shown.items():
            told = junitparser.Property(printable(label), printable(str(value)))
            properties.add_property(told)
        test.append(properties)
    return test


def _figures(record: Record, quantity: str) -> dict[str, object]:
    """The numbers of a quantity, and its verdict."""
    one = record.quantity(quantity)
    if one is None:
        return {}
    errors = {f"error {word(norm)}": value for norm, value in one.errors.items()}
    shown = {"verdict": one.verdict.value, "tolerance": one.tolerance, **errors, **one.figures}
    shown |= {"note": one.note, "cpu": record.cost.solve_cpu}
    return {name: value for name, value in shown.items() if value not in (None, "")}
