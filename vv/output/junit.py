"""Writes an invocation as JUnit XML: a suite per case, a test per record and quantity."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from vv.base.files import write_whole
from vv.records.finding import Bit, Finding
from vv.records.reading import label, rung, tried

CRASHES = Bit.CRASH | Bit.TIMEOUT
Place = tuple[str, str, str, str, str]  # case, variant, scheme, knobs, quantity


def write_junit(path: Path, manifest: Mapping[str, Any], findings: Iterable[Finding]) -> None:
    """Write the file.

    Failure: out of tolerance or band. Error: crash, timeout or incomplete. Skipped: refused or not
    installed. What is reported only is a property of its test.
    """
    import junitparser

    at: dict[Place, list[Finding]] = {}
    for finding in findings:
        at.setdefault(_place(finding), []).append(finding)
    tests: dict[str, list[Any]] = {}
    for record in manifest["records"]:
        names = [entry["name"] for entry in record["quantities"]] or [""]
        for name in names:
            place = (record["case"], record["variant"], label(record), rung(record), name)
            told = at.pop(place, [])
            whole = at.pop((*place[:4], ""), []) if name == names[0] else []
            case = _test(place, [*told, *(whole if name else [])], _figures(record, name))
            if not tried(record) and not case.result:
                case.result = [junitparser.Skipped(f"{record['status']}: {record['reason']}")]
            case.time = record["cost"]["solve_wall"]
            tests.setdefault(record["case"], []).append(case)
    for place, told in at.items():  # what belongs to no record: a missing code, a lost result
        tests.setdefault(place[0], []).append(_test(place, told, {}))
    document: Any = junitparser.JUnitXml("vv")
    for name, cases in tests.items():
        suite: Any = junitparser.TestSuite(name or "vv")
        suite.add_testcases(cases)
        suite.timestamp = manifest["provenance"]["utc"]
        document.add_testsuite(suite)
    document.update_statistics()
    write_whole(path, document.tostring())


def _place(finding: Finding) -> Place:
    return finding.case, finding.variant, finding.label, finding.rung, finding.quantity


def _test(place: Place, findings: Iterable[Finding], figures: Mapping[str, Any]) -> Any:
    import junitparser

    case, variant, scheme, knobs, quantity = place
    given = list(findings)
    kinds = {f.check for f in given if f.check != "run"} if not (scheme and quantity) else set()
    words = (scheme, quantity, variant, knobs, *sorted(kinds))
    test: Any = junitparser.TestCase(" ".join(w for w in words if w) or "run", case or "vv")
    results: list[Any] = []
    for finding in (f for f in given if f.red):
        broken = finding.bit & (CRASHES | Bit.INCOMPLETE)
        kind = junitparser.Error if broken else junitparser.Failure
        results.append(kind(finding.text, f"{finding.check}: {finding.kind}"))
    if results:
        test.result = results
    notes = {f"{f.check}: {f.kind}": f.text for f in given if not f.red}
    if told := {**figures, **notes}:
        make: Any = junitparser.Properties
        properties = make()
        for name, value in told.items():
            properties.add_property(junitparser.Property(name, str(value)))
        test.append(properties)
    return test


def _figures(record: Mapping[str, Any], quantity: str) -> dict[str, Any]:
    """The numbers of a quantity, and the verdict that they came to."""
    for entry in record["quantities"]:
        if entry["name"] == quantity:
            errors = {f"error {name}": value for name, value in entry["errors"].items()}
            told = {"verdict": entry["verdict"], "tolerance": entry["tolerance"], **errors}
            told |= entry["figures"] | {"note": entry["note"], "cpu": record["cost"]["solve_cpu"]}
            return {name: value for name, value in told.items() if value not in (None, "")}
    return {}
