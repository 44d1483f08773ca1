"""Runs cases from Python, for notebooks and scripts: what `vv run` does, with a table as answer.

It is not in `vv/__init__.py`, which every module imports, since results would then depend on the
command line.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from vv.ask import Knobs
from vv.base import closure
from vv.base.closure import OUR_PACKAGES
from vv.base.errors import UsageError
from vv.case import Level
from vv.cli import invocation, options
from vv.output.table import table
from vv.plan.project import find
from vv.plan.settings import parse_knobs
from vv.records.reading import to_the_last_digit

if TYPE_CHECKING:
    import pandas as pd

    from vv.plan.plan import Options

Rung = str | float | Knobs | Mapping[str, float]


def verify(
    *selection: str,
    codes: str = "*",
    level: str = "default",
    settings: str | Iterable[str] | Mapping[str, float | str] = (),
    rungs: Rung | Iterable[Rung] = (),
) -> pd.DataFrame:
    """Run cases in codes as `vv run` does, and return the results as `vv.results` does.

    selection: FAMILY, CASE or CASE:VARIANT, with globs. codes: CODE[/SCHEME],... level: quick,
    default or paper. settings: texts NAME=VALUE[UNIT], or a mapping from names to values. rungs:
    texts dt=..[,kn=..], mappings, steps dt [s], or Knobs. Stored results are not computed again;
    no report is written. Raises UsageError for what does not exist or cannot be read, and where a
    file that this process has loaded was edited since.
    """
    from vv.plan.plan import Options
    from vv.run.limits import Limits

    _require_unchanged()
    project, named = options.with_programs(find(), codes)
    chosen = Options(_level(level), named, _settings(settings), _rungs(rungs))
    limits = Limits(options.workers(0), options.TIMEOUT)
    try:
        plan = options.plan_of(project, list(selection), chosen)
        command = _command(selection, codes, chosen)
        made = invocation.carry_out_with_progress(project, plan, limits, command=command)
        return table(made.records)
    finally:
        _note_loaded()


def _command(selection: Sequence[str], codes: str, chosen: Options) -> list[str]:
    """The command that runs the same, by which `vv runs` and reports name the run."""
    words = ["vv", "run", *(selection or ("--all",))]
    words += ["--codes", codes, "--level", chosen.level.value]
    words += [word for text in chosen.settings for word in ("--set", text)]
    return words + [word for knobs in chosen.rungs for word in ("--rung", to_the_last_digit(knobs))]


def _level(name: str) -> Level:
    known = [level.value for level in Level]
    if name not in known:
        raise UsageError(f"level = {name!r}; it must be one of {', '.join(known)}")
    return Level(name)


def _settings(given: str | Iterable[str] | Mapping[str, float | str]) -> tuple[str, ...]:
    """The texts NAME=VALUE[UNIT] of changed parameters; raises UsageError for other things."""
    if isinstance(given, str):
        return (given,)
    if isinstance(given, Mapping):
        return tuple(f"{name}={value}" for name, value in given.items())
    texts = tuple(given) if isinstance(given, Iterable) else (given,)
    if not all(isinstance(text, str) for text in texts):
        raise UsageError(
            f"settings = {given!r}; expected texts NAME=VALUE[UNIT], or a mapping NAME: VALUE"
        )
    return texts


def _rungs(given: object) -> tuple[Knobs, ...]:
    if isinstance(given, Iterable) and not isinstance(given, (str, Mapping)):
        return tuple(map(_rung, given))
    return (_rung(given),)


def _rung(given: object) -> Knobs:
    """A setting in one of the forms of Rung; raises UsageError for other things."""
    if isinstance(given, Knobs):
        return given
    if isinstance(given, Mapping):
        return parse_knobs(",".join(f"{name}={value}" for name, value in given.items()))
    if isinstance(given, (str, float, int)):
        return parse_knobs(given if isinstance(given, str) else f"dt={given}")
    raise UsageError(f"rung = {given!r}; expected dt=..[,kn=..], a mapping, a step in s, or Knobs")


def _require_unchanged() -> None:
    """Raise UsageError for edited files: Python would go on with what it loaded before."""
    if changed := closure.changed_files():
        names = ", ".join(map(str, changed))
        raise UsageError(f"files have changed since they were loaded: restart Python ({names})")


def _note_loaded() -> None:
    """Take the digests of the modules loaded so far, also of those that a failed plan loaded."""
    ours = [m for name, m in [*sys.modules.items()] if name.partition(".")[0] in OUR_PACKAGES]
    files = [Path(module.__file__).resolve() for module in ours if module.__file__]
    closure.source_digest([file for file in files if file.is_file()])
