"""What people see on the terminal: progress, tables, counts and explanations."""

from __future__ import annotations

import contextlib
import math
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from vv.adapter import Adapter
from vv.ask import Run, Status
from vv.case import Case, Exact, Quantity
from vv.gate import Bit, outcome
from vv.plan import Job, Plan

WORDS = {"xfail": "known disagreement", "xpass": "unexpected pass", "no-reference": "shown only"}
PLURAL = {"known disagreement": "known disagreements", "unexpected pass": "unexpected passes"}
ORDER = ("pass", "fail", "xpass", "xfail", "no-reference")
EVERY = 2.0  # s between two plain progress lines


def say(text: str) -> None:
    """Print a line."""
    print(text, flush=True)


def complain(text: str) -> int:
    """Print an error line and return the exit status of a usage error."""
    print(f"vv: {text}", file=sys.stderr)
    return int(Bit.USAGE)


@contextlib.contextmanager
def progress(total: int) -> Iterator[Callable[[Job, Run], None]]:
    """A function to call with each finished job: a bar on a terminal, plain lines elsewhere."""
    with _bar() if sys.stderr.isatty() else _lines() as shown:
        yield shown


@contextlib.contextmanager
def _bar() -> Iterator[Callable[[Job, Run], None]]:
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
    counts: Counter[str] = Counter()
    with Progress(*columns, auto_refresh=False, transient=True) as bars:
        task = bars.add_task("running")

        def shown(job: Job, run: Run) -> None:
            counts[run.status.value] += 1
            bars.update(task, description=f"{_counted(counts)}  {job.label}", refresh=True)

        yield shown


@contextlib.contextmanager
def _lines() -> Iterator[Callable[[Job, Run], None]]:
    counts: Counter[str] = Counter()
    last = time.monotonic()

    def shown(job: Job, run: Run) -> None:
        nonlocal last
        counts[run.status.value] += 1
        if run.status is not Status.RAN:
            print(f"{job.label}: {run.status.value}: {run.reason}", file=sys.stderr)
        if time.monotonic() - last > EVERY:
            last = time.monotonic()
            print(f"{_counted(counts)} so far", file=sys.stderr, flush=True)

    yield shown


def _counted(counts: Mapping[str, int]) -> str:
    return ", ".join(f"{n} {word}" for word, n in counts.items())


def print_counts(records: Iterable[Mapping[str, Any]], report: Path) -> None:
    """The last line of a run: outcomes counted, where the report is, where to read why."""
    counts = Counter(outcome(record) for record in records)
    ranked = sorted(counts, key=lambda word: (ORDER.index(word) if word in ORDER else 9, word))
    named = []
    for word in ranked:
        text = WORDS.get(word, word)
        named.append(f"{counts[word]} {PLURAL.get(text, text) if counts[word] > 1 else text}")
    say(f"{', '.join(named)}; report: {report}; why: vv explain CASE")


def print_jobs(plan: Plan) -> None:
    """Each job in a line, with why it would not run."""
    for job in plan.jobs:
        fate = f"  ({job.settled.status.value}: {job.settled.reason})" if job.settled else ""
        say(f"{job.label}{fate}")
    say(f"{len(plan.jobs)} jobs, {sum(job.settled is None for job in plan.jobs)} would run")


def print_cases(cases: Sequence[Case]) -> None:
    """Cases with their variants."""
    for case in cases:
        say(f"{case.name}  {case.title} [{case.source.doi}]")
        for variant in case.variants:
            say(f"  {case.name}:{variant.name:<14}{variant.summary}")


def print_codes(adapters: Sequence[Adapter]) -> None:
    """Codes with version, place, schemes, and how to install those that are missing."""
    for adapter in adapters:
        found = adapter.found()
        state = f"{found.version}  {found.path}" if found.installed else "not installed"
        say(f"{adapter.name}  {state}")
        if not found.installed:
            say(f"  to install: {found.how_to_install}")
        for scheme in adapter.schemes:
            knobs = ", ".join(scheme.knobs) or "none"
            how = f"[{scheme.method.value}; knobs: {knobs}]"
            say(f"  {adapter.name}/{scheme.name}: {scheme.summary} {how}")


def explain(plan: Plan, manifests: Iterable[Mapping[str, Any]]) -> None:
    """All there is to know of the planned variants, and their last results."""
    results = _last_results(manifests)
    for name, case in plan.cases.items():
        say(f"{case.title}\n  source: {case.source.citation}, doi:{case.source.doi}")
        say(f"  note: {case.source.note}")
        for source, text in case.published.items():
            say(f"  published, {source}: {text}")
        for variant in case.variants:
            if (name, variant.name) in plan.trials:
                _explain_variant(plan, case, variant.name, results)


def _explain_variant(
    plan: Plan, case: Case, name: str, results: Mapping[tuple[str, ...], str]
) -> None:
    variant, trial = case.variant(name), plan.trials[case.name, name]
    scene, values = trial.study.scene, case.defaults(name)
    say(f"\n{case.name}:{name}: {variant.summary}\n  formula: {variant.formula}")
    for p in case.parameters:
        inert = "  (inert)" if p.name in variant.inert else ""
        say(f"  {p.name} = {values[p.name]:g} {p.unit}  {p.meaning}{inert}")
    terms = ", ".join(sorted(term.value for term in scene.terms()))
    say(f"  terms: {terms}\n  unknowns: {scene.unknowns()}")
    for quantity in trial.quantities:
        _explain_quantity(quantity)
    last = {
        (job.code, job.scheme): job
        for job in plan.jobs
        if (job.case, job.variant) == (case.name, name)
    }
    for (code, scheme), job in last.items():
        how = (
            job.settled.reason
            if job.settled
            else plan.adapters[code].describe(job.ask, scheme).note
        )
        say(f"  {code}/{scheme}: {how}")
        say(f"    last result: {results.get((case.name, name, code, scheme), 'none yet')}")


def _explain_quantity(quantity: Quantity) -> None:
    judge = quantity.judge
    say(f"  quantity {quantity.name} [{getattr(quantity, 'unit', '')}]: {quantity.meaning}")
    if not isinstance(judge, Exact):
        say(f"    {type(judge).__name__.lower()}: {judge.reason}")
        return
    say(f"    norm: {judge.norm.value}")
    for method, tolerance in judge.tolerances.items():
        step = f" at dt = {tolerance.dt:g} s, as dt^{tolerance.order}" if tolerance.dt else ""
        say(f"    {method.value}: {tolerance.value:g}{step}: {tolerance.reason}")


def _last_results(manifests: Iterable[Mapping[str, Any]]) -> dict[tuple[str, ...], str]:
    """The newest result of each (case, variant, code, scheme): its finest rung in words."""
    found: dict[tuple[str, ...], str] = {}
    for manifest in manifests:
        newest: dict[tuple[str, ...], str] = {}
        for record in manifest["records"]:
            key = tuple(record[part] for part in ("case", "variant", "code", "scheme"))
            errors = "; ".join(_entry_in_words(entry) for entry in record["quantities"])
            dt = f" at dt = {record['rung']['dt']:g} s" if record["rung"]["dt"] else ""
            changed = ", modified parameters" if record["modified"] else ""
            said = f"{outcome(record)}{dt}{changed}: {errors or record['reason']}"
            newest[key] = f"{said} ({manifest['provenance']['utc']})"
        found = {**newest, **found}
    return found


def _entry_in_words(entry: Mapping[str, Any]) -> str:
    error, bound = entry["errors"].get(entry["norm"] or "max"), entry["tolerance"]
    if bound is None:
        said = f"{entry['name']}: {entry['value']}, {entry['why']}"
    else:
        said = f"{entry['name']}: error {math.nan if error is None else error:.3g} of {bound:.3g}"
    return f"{said}, {entry['note']}" if entry["note"] else said
