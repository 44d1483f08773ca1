"""Prints lists of cases, of codes, and of the jobs that a plan would run."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from vv.output.terminal import say
from vv.output.wording import in_words
from vv.records.outcomes import Outcome

if TYPE_CHECKING:
    from vv.case import Case
    from vv.codes.adapter import Adapter, Scheme
    from vv.plan.plan import Plan


def print_jobs(plan: Plan, stored: Container[int]) -> None:
    """The jobs that would run, a line for each scheme and variant; stored: jobs with results."""
    from vv.output.results_table import by_outcome

    waiting: dict[tuple[str, str], list[str]] = {}
    outcomes: dict[str, Outcome] = {}
    for number, job in enumerate(plan.jobs):
        if job.settled:
            outcomes.setdefault(f"{job.code}/{job.scheme}", Outcome(job.settled.status.value))
        else:
            mark = "  (stored)" if number in stored else ""
            setting = job.label.removeprefix(job.name).strip()
            waiting.setdefault((job.name, mark), []).append(setting)
    for (name, mark), settings in waiting.items():
        say(f"{name}  {' '.join(settings)}".rstrip() + mark)
    took = {name.split()[1] for name, _ in waiting}
    if rest := {name: fate for name, fate in outcomes.items() if name not in took}:
        say(by_outcome(rest))
    kept = sum(len(own) for (_, mark), own in waiting.items() if mark)
    run = sum(map(len, waiting.values())) - kept
    none = Counter(Outcome(job.settled.status.value) for job in plan.jobs if job.settled)
    others = "".join(f", {number} {in_words(fate)}" for fate, number in none.items())
    say(f"{len(plan.jobs)} jobs, {run} would run, {kept} are stored{others}")


def print_cases(
    cases: Sequence[Case], shown: Mapping[str, Sequence[str]], families: Mapping[str, str]
) -> None:
    """Cases by family, with the variants that are to be shown: case -> names."""
    groups: dict[str, list[Case]] = {}
    for case in cases:
        groups.setdefault(families[case.name], []).append(case)
    for number, (family, own) in enumerate(groups.items()):
        if [case.name for case in own] != [
            family
        ]:  # a case outside any family is a family of its own
            say(*([""] if number else []), f"family {family}")
        for case in own:
            say(f"{case.name}  {case.title} [{case.source.doi or case.source.citation}]")
            variants = [v for v in case.variants if v.name in shown[case.name]]
            width = max((len(variant.name) for variant in variants), default=0)
            for variant in variants:
                say(f"  {case.name}:{variant.name:<{width}}  {variant.summary}")


def print_codes(adapters: Sequence[Adapter]) -> None:
    """Print codes with version, place and schemes, and how to install missing ones."""
    for adapter in adapters:
        found = adapter.found()
        state = f"{found.version}  {found.path}" if found.installed else "not installed"
        say(f"{adapter.name}  {state}".rstrip())
        if not found.installed:
            say(f"  to install: {found.how_to_install}")
        for scheme in adapter.schemes:
            knobs = ", ".join(scheme.knobs) or "none"
            how = f"[{'; '.join(_methods(scheme))}; knobs: {knobs}]"
            say(f"  {adapter.name}/{scheme.name}: {scheme.summary} {how}")


def _methods(scheme: Scheme) -> Iterator[str]:
    """The classes of method of a scheme, with the terms for which it has another class."""
    yield scheme.method.value
    for method in dict.fromkeys(scheme.lowered.values()):
        terms = [term.value for term, other in scheme.lowered.items() if other is method]
        few = " or ".join((", ".join(terms[:-1]), terms[-1])) if terms[1:] else terms[0]
        yield f"{method.value} in scenes with {few}"
