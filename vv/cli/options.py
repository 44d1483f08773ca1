"""Options that several commands share, and functions that interpret them."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vv.ask import Knobs
from vv.base.errors import UsageError
from vv.base.files import check_output
from vv.case import Level
from vv.plan.content import name_of
from vv.plan.project import Project

if TYPE_CHECKING:
    from vv.plan.plan import Options, Plan

EXECUTOR = re.compile(r"dask://[^/\s:]+:\d+")
PROGRAM = re.compile(r"(?P<file>.+\.toml)(?P<scheme>/[^/]+)?")
MOST = 200  # the most names, --set or --rung in one call
TIMEOUT = 300.0  # default limit for a job [s]; its kernels may have to be compiled


def completed_cases(incomplete: str) -> list[str]:
    """Completions of a selection: families and cases, after a colon the variants."""
    from vv.plan.project import find

    project = find()
    case, colon, _ = incomplete.partition(":")
    names = project.case_names()
    if colon and case in names:
        known = [f"{case}:{variant.name}" for variant in project.load_case(case).variants]
    else:
        known = sorted({*names, *project.families().values()})
    return [name for name in known if name.startswith(incomplete)]


def completed_codes(incomplete: str) -> list[str]:
    """Completions of the last code in a list with commas."""
    from vv.plan.project import find

    before, comma, last = incomplete.rpartition(",")
    names = find().adapter_names()
    return [f"{before}{comma}{name}" for name in names if name.startswith(last)]


Selection = Annotated[
    list[str] | None,
    typer.Argument(
        help="FAMILY, CASE or CASE:VARIANT; globs allowed.", autocompletion=completed_cases
    ),
]
Codes = Annotated[
    str,
    typer.Option(
        "--codes",
        "--code",
        metavar="CODES",
        help="Codes to run, CODE[/SCHEME] or a program's FILE.toml[/SCHEME],...; all if not given.",
        autocompletion=completed_codes,
    ),
]
Required = Annotated[
    str, typer.Option("--require", metavar="CODES", help="Codes whose absence is an error.")
]
Sets = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE[UNIT]", help="Change a parameter; repeatable."),
]
Keyword = Annotated[
    str,
    typer.Option(
        "-k",
        metavar="EXPR",
        help="Run only jobs whose names contain these words: 'T3 and not (rotated or yade)'.",
    ),
]
Rungs = Annotated[
    list[str] | None,
    typer.Option(
        "--rung",
        metavar="dt=..[,kn=..]",
        help="Run at this setting only, dt in s and kn in N/m; repeatable.",
    ),
]
Levels = Annotated[Level, typer.Option("--level", help="How much of each case to run.")]
Jobs = Annotated[
    int, typer.Option("--jobs", min=0, help="Number of processes; 0 means one per core.")
]
Fresh = Annotated[
    bool, typer.Option("--fresh", help="Run everything again and ignore stored results.")
]
Timeout = Annotated[float, typer.Option("--timeout", help="Seconds that one job may take.")]
Executor = Annotated[
    str,
    typer.Option(
        "--executor",
        metavar="local|dask://HOST:PORT",
        help="Where jobs run: in processes on this machine, or in the workers of a dask scheduler.",
    ),
]


def writable(path: Path | None) -> Path | None:
    """The path of an option for a file; raises OSError if it cannot be written."""
    if path is not None:
        check_output(path)
    return path


JsonFile = Annotated[
    Path | None,
    typer.Option(
        "--json",
        metavar="FILE",
        help="Write all records, histories included, as JSON.",
        callback=writable,
    ),
]


def plan_of(project: Project, selection: list[str], options: Options, keyword: str = "") -> Plan:
    """The plan of a selection; without a selection, every case.

    keyword: an expression that the names of jobs, FAMILY CASE:VARIANT CODE/SCHEME, must match.
    Raises UsageError if none matches, and for too many names or options.
    """
    from vv.plan.expression import matcher
    from vv.plan.plan import with_jobs_kept
    from vv.plan.planning import make_plan

    for what, words in (
        ("names", selection),
        ("--set", options.settings),
        ("--rung", options.rungs),
    ):
        if len(words) > MOST:
            raise UsageError(f"{len(words)} times {what}; at most {MOST} are accepted")
    if not keyword:
        return make_plan(project, selection or ["*"], options)
    fits = matcher(keyword)
    families = project.families()
    whole = make_plan(project, selection or ["*"], options)
    plan = with_jobs_kept(whole, lambda job: fits(f"{families[job.case]} {job.name}"))
    if not plan.jobs:
        raise UsageError(f"-k '{keyword}' matches none of {len(whole.jobs)} jobs")
    return plan


def split(text: str) -> tuple[str, ...]:
    """The parts of a text between commas."""
    return tuple(part.strip() for part in text.split(",") if part.strip())


def codes(text: str) -> tuple[str, ...]:
    """The patterns of --codes; raises UsageError for none."""
    named = split(text)
    if not named:
        raise UsageError(f"--codes '{text}' names no code; leave it out to ask all")
    return named


def with_programs(project: Project, text: str) -> tuple[Project, tuple[str, ...]]:
    """The project with the programs whose files --codes names, and the patterns of --codes.

    Raises UsageError if --codes is empty, and for a missing file.
    """
    files, patterns = [], []
    for part in codes(text):
        named = PROGRAM.fullmatch(part)
        if named is None:
            patterns.append(part)
            continue
        file = Path(named["file"])
        if not file.is_file():
            raise UsageError(f"there is no file {file}")
        files.append(file)
        patterns.append(f"{name_of(file)}{named['scheme'] or ''}")
    return project.with_programs(files), tuple(patterns)


def named_files(project: Project) -> Mapping[str, Path]:
    """The programs whose files --codes named, by the names of their codes."""
    return {name_of(file): file for file in project.programs}


def required(project: Project, text: str) -> tuple[str, ...]:
    """The codes of --require, and the programs whose files are named, which must run.

    Raises UsageError for a code that does not exist.
    """
    from vv.plan.selection import choose_schemes, named_adapters

    asked = (*split(text), *map(name_of, project.programs))
    if asked:
        choose_schemes(named_adapters(project, asked), asked)
    return asked


def knobs(texts: list[str] | None) -> tuple[Knobs, ...]:
    """The settings of --rung."""
    from vv.plan.settings import parse_knobs

    return tuple(parse_knobs(text) for text in texts or ())


def workers(jobs: int) -> int:
    """The number of processes of --jobs."""
    return jobs or len(os.sched_getaffinity(0))


def executor(text: str) -> str:
    """The executor of --executor; raises UsageError for an invalid one."""
    if text != "local" and not EXECUTOR.fullmatch(text):
        raise UsageError(f"--executor '{text}': it must be local or dask://HOST:PORT")
    return text


def positive(timeout: float) -> float:
    """The value of --timeout, which must be positive."""
    if not timeout > 0:
        raise UsageError(f"--timeout = {timeout!r} s; it must be positive")
    return timeout
