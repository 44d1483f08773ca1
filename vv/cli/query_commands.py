"""The commands that show cases and codes: list, codes, explain."""

from __future__ import annotations

import fnmatch
import re
from typing import TYPE_CHECKING, Annotated

import typer

from vv.base.errors import UsageError
from vv.case import Level
from vv.cli import options
from vv.output import terminal
from vv.plan.project import Project, find

if TYPE_CHECKING:
    from vv.case import Case

PAST = 20  # the most past runs in which a last result is searched


def list_cases(
    selection: options.Selection = None,
    family: Annotated[
        str, typer.Option("--family", metavar="FAMILY", help="Only this family; globs allowed.")
    ] = "*",
    code: Annotated[
        str, typer.Option("--code", metavar="CODES", help="Only what one of these codes runs.")
    ] = "",
    keyword: options.Keyword = "",
) -> None:
    """List families, cases and their variants."""
    from vv.output.listing import print_cases

    project = find()
    families = project.families()
    names = [name for name, own in families.items() if fnmatch.fnmatch(own, family)]
    if not names:
        from vv.base.hints import name_hint

        raise UsageError(f"no family '{family}'{name_hint(family, families.values())}")
    selected = _selected(project, selection or [])
    cases = project.load_cases([name for name in names if not selected or name in selected])
    shown = {case.name: selected.get(case.name) or _all_variants(case) for case in cases}
    if keyword:
        fitting = _fitting(families, cases, keyword)
        shown = {name: [v for v in own if v in fitting[name]] for name, own in shown.items()}
    if code:
        runs = _run_by(project, [name for name in names if shown[name]], code)
        shown = {name: [v for v in own if (name, v) in runs] for name, own in shown.items()}
    print_cases([case for case in cases if shown[case.name]], shown, families)


def _selected(project: Project, patterns: list[str]) -> dict[str, list[str]]:
    """Case -> its variants that patterns select; empty without patterns."""
    from vv.plan.selection import select

    found: dict[str, list[str]] = {}
    for case, variant in select(project, patterns) if patterns else ():
        found.setdefault(case.name, []).append(variant)
    return found


def _all_variants(case: Case) -> list[str]:
    return [variant.name for variant in case.variants]


LACKING = re.compile(r"\b(?:no|without) \w+")


def _fitting(families: dict[str, str], cases: list[Case], keyword: str) -> dict[str, list[str]]:
    """Case -> its variants whose names or descriptions match an expression.

    What a description says is lacking, such as `no drag`, is not matched.
    If no variant matches but the title of the case does, all its variants are selected. Raises
    UsageError if nothing matches.
    """
    from vv.plan.expression import matcher

    fits, fitting = matcher(keyword), {}
    for case in cases:
        family = families[case.name]
        own = [
            v.name
            for v in case.variants
            if fits(f"{family} {case.name}:{v.name} {LACKING.sub('', v.summary)}")
        ]
        by_title = fits(f"{family} {case.name} {LACKING.sub('', case.title)}")
        fitting[case.name] = own or (_all_variants(case) if by_title else [])
    if not any(fitting.values()):
        raise UsageError(f"-k '{keyword}' matches no variant; `vv list` shows all")
    return fitting


def _run_by(project: Project, names: list[str], code: str) -> set[tuple[str, str]]:
    """The (case, variant) that some scheme of the codes supports at some level."""
    from vv.ask import Status
    from vv.plan.plan import Options

    plan = options.plan_of(project, names, Options(Level.PAPER, options.codes(code)))
    return {
        (job.case, job.variant)
        for job in plan.jobs
        if job.settled is None or job.settled.status is not Status.REFUSED
    }


def list_codes(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="CODE", help="Only these codes; globs allowed.")
    ] = None,
) -> None:
    """List codes: whether each is installed, version, path, schemes, how to install it."""
    from vv.output.listing import print_codes
    from vv.plan.selection import choose_schemes, named_adapters

    patterns = names or ["*"]
    chosen = choose_schemes(named_adapters(find(), patterns), patterns)
    print_codes(list({adapter.name: adapter for adapter, _ in chosen}.values()))


def explain(
    selection: Annotated[
        list[str],
        typer.Argument(help="CASE or CASE:VARIANT.", autocompletion=options.completed_cases),
    ],
    codes: options.Codes = "*",
    settings: options.Sets = None,
    level: options.Levels = Level.DEFAULT,
    rungs: options.Rungs = None,
) -> None:
    """Explain a case: source, formula, parameters, tolerances, mapping into codes, results.

    The results are those with the same parameters. Whether and how a code runs the case is said
    for the settings of the level, or those of --rung.
    """
    from vv.output.explain import print_explanation
    from vv.plan.plan import Options
    from vv.plan.planning import make_plan
    from vv.store.store import Store

    project, named = options.with_programs(find(), codes)
    chosen = Options(level, named, tuple(settings or ()), options.knobs(rungs))
    plan = make_plan(project, selection, chosen)
    print_explanation(plan, Store(project.data()).manifests.newest(PAST, terminal.note))
