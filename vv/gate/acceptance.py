"""Which results may be accepted, and what a baseline becomes by it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import Any

from vv.ask import Status
from vv.gate.baseline import Json, name_of, result_of
from vv.gate.regression import holds
from vv.records.reading import label, ran, status_of
from vv.records.record import Verdict

GOOD = (Verdict.PASS, Verdict.XFAIL, Verdict.NO_REFERENCE)


def acceptable(record: Mapping[str, Any]) -> bool:
    """Whether a record may enter a baseline: it ran, unmodified, and nothing in it fails."""
    whole = ran(record) and not record["modified"] and record["quantities"]
    return bool(whole) and all(Verdict(e["verdict"]) in GOOD for e in record["quantities"])


def accepted(
    case: str,
    baseline: Json | None,
    records: Iterable[Mapping[str, Any]],
    acceptance: Mapping[str, Any],
    external: Collection[str],
) -> Json:
    """The baseline with these records put in, and with the acceptance they came by.

    Results of codes that are not installed here stay; those of schemes that now refuse, or are
    no more, go. A result that did not leave its band stays as it was, so that small changes
    cannot add up unseen.
    """
    given = [r for r in records if r["case"] == case]
    old: Json = baseline or {"acceptances": {}, "results": {}, "parameters": {}}
    number = str(1 + max(map(int, old["acceptances"]), default=0))
    absent = {label(r) for r in given if status_of(r) is Status.NOT_INSTALLED}
    results = {n: v for n, v in old["results"].items() if n.split(" ")[1] in absent}
    for record in filter(acceptable, given):
        name, new = name_of(record), result_of(record)
        before = old["results"].get(name)
        fixed = before is not None and holds(before, record, external)
        if before and "cost" in before:
            new.setdefault("cost", before["cost"])
        same = fixed and before is not None and before.get("cost") == new.get("cost")
        results[name] = before if same else {**new, "by": number}
    used = {result["by"] for result in results.values()}
    given_by = {**old["acceptances"], number: dict(acceptance)}
    variants = {name.split(" ")[0] for name in results}
    taken = {r["variant"]: dict(r["parameters"]) for r in given if not r["modified"]}
    parameters = {**old["parameters"], **taken}
    return {
        "case": case,
        "acceptances": {n: a for n, a in given_by.items() if n in used},
        "parameters": {name: parameters[name] for name in sorted(variants)},
        "results": results,
    }
