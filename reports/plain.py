"""Describes faults of a result in words, and gives the command to rerun it."""

from __future__ import annotations

import shlex
from collections.abc import Iterable

from reports.norms import NORM_NAMES
from reports.text import ratio, short
from vv.case import Norm
from vv.gate.judgement import Breach, breaches
from vv.records.job_record import Record
from vv.records.outcomes import Outcome, Verdict
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import rung, settings

LONG = 60  # explanations longer than this appear once on a page
LAWS = {  # law of a ledger -> description of its violation, before the number
    "energy that no term explains": "Energy not accounted for:",
    "energy created": "Energy not conserved: created",
    "error of the momentum balance": "Momentum not conserved: error",
    "penetration": "Bodies penetrate each other: by",
    "residual of contact": "Contact not converged: residual",
    "Coulomb: friction beyond mu N": "Coulomb's law violated: friction exceeds mu N by",
}


def breach(found: Breach) -> str:
    """A law that a run violates, with the value and its bound."""
    law, seen, allowed = found
    name, _, unit = law.partition(" [")
    unit = f" {unit.removesuffix(']')}" if unit else ""
    start = LAWS.get(name)
    if start is None and name.startswith("negative "):
        form = name.removeprefix("negative ").capitalize()
        start = f"{form} is negative, which creates energy: by"
    if start is None:
        start = f"Law violated, {name}:"
    return f"{start} {short(seen)}{unit}, allowed {short(allowed)}{unit}"


def excess(one: MeasuredQuantity) -> str:
    """A quantity beyond its bound, with its value and the bound."""
    if one.verdict is Verdict.XPASS:
        return f"{one.name} passes although a disagreement is on record: error {short(one.error)}"
    if one.error is not None and one.tolerance is not None:
        norm = f" (norm {NORM_NAMES[one.norm]})" if one.norm not in (None, Norm.MAX) else ""
        found, due = f"Error of {one.name}{norm} {short(one.error)}", short(one.tolerance)
        if one.error <= one.tolerance or not one.tolerance:
            return f"{found}, tolerance {due}"
        return f"{found}, {ratio(one.error / one.tolerance)} times the tolerance {due}"
    if one.value is not None:
        return f"{one.name} = {short(one.value)}: {one.why}"
    return f"{one.name} is not finite"


def with_notes(quantities: Iterable[MeasuredQuantity]) -> list[str]:
    """Quantities beyond their bounds, and then the judge's notes on them, each once."""
    known = list(quantities)
    notes = dict.fromkeys(one.note for one in known if one.note)
    return [*map(excess, known), *notes]


def once(text: str, place: str, explained: dict[str, str]) -> str:
    """A text in which repeated long explanations are replaced by references.

    explained: explanation -> the place of its first occurrence; those of this text are added.
    """
    known = {
        part: explained.setdefault(part, place) for part in text.split("; ") if len(part) > LONG
    }
    parts = [
        part if known.get(part, place) == place else f"explained at {known[part]}"
        for part in text.split("; ")
    ]
    return "; ".join(dict.fromkeys(parts))


def reason(record: Record, came: Outcome) -> str:
    """The reason of a record's outcome; empty if the name of the outcome says enough."""
    if came is Outcome.NOT_CONSERVED:
        texts = [breach(found) for found in breaches(record.ledger)]
    else:
        ill = [one for one in record.quantities if one.verdict.value == came.value]
        texts = [] if came is Outcome.PASS else with_notes(ill)
    return "; ".join([record.reason, *texts] if record.reason else texts)


def setting(record: Record) -> str:
    """The setting of a record in words; empty if it has none."""
    knobs = (("dt", record.rung.dt, "s"), ("kn", record.rung.kn, "N/m"))
    return ", ".join(f"{name} = {value:.6g} {unit}" for name, value, unit in knobs if value)


def command(record: Record) -> str:
    """The command that reruns the job of a record."""
    words = ["vv", "run", f"{record.case}:{record.variant}", "--codes", record.label]
    at = rung(record)
    if at:
        words += ["--rung", at]
    words += [word for text in settings(record) for word in ("--set", text)]
    return shlex.join(words)
