"""All numbers that a variant declares, as text: parameters, settings, exact answers, scene."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from vv.ask import Knobs
from vv.case import (
    Case,
    Level,
    Parameters,
    Quantity,
    Series,
    Study,
    Trial,
    Variant,
    evaluated,
)
from vv.codes.program.question import data
from vv.output.gallery.number_text import LISTED, fields, gathered, listed

MANY = 300  # bodies, above which numbers that are costly to compute are left out
DIGITS = 4  # of exact answers, some of which are integrated numerically
SCALES = ("scale", "still")
Lines = dict[str, str]  # what it is -> its numbers


def numbers(case: Case, variant: Variant, other: Parameters | None = None) -> Lines:
    """The numbers of a variant at its default parameters, or at others."""
    values = other or case.defaults(variant.name)
    trial = case.declare(variant.name, values)
    return {
        **{f"parameter {name}": f"{value:g}" for name, value in values.items()},
        **dict(_of_study(trial.study)),
        **dict(fields(trial.unexplained, "unexplained energy")),
        **dict(fields(trial.regions, "map")),
        **dict(line for one in trial.quantities for line in _of_quantity(one, trial)),
        **dict(_of_scene(trial.study)),
    }


def differing(lines: Lines, first: Lines) -> Lines:
    """The lines that another variant does not have; 'none' for what only that one has."""
    own = {name: text for name, text in lines.items() if first.get(name) != text}
    return own | dict.fromkeys((name for name in first if name not in lines), "none")


def _of_study(study: Study) -> Iterator[tuple[str, str]]:
    """Duration, outputs, settings at each level, and limits."""
    goal = study.goal
    yield "duration", f"{goal.duration:g} s, output every {goal.interval:g} s"
    for level in Level:
        yield f"settings, {level.value}", _settings(study.rungs[level])
    if study.timed:
        yield "settings, timed", _settings(study.timed)
    limit = getattr(study, "cpu_limit", math.inf)
    if math.isfinite(limit):
        yield "limit of CPU time", f"{limit:g} s"
    yield from fields(getattr(study, "search", None), "search")
    yield from fields(getattr(study, "bracket", None), "search")


def _settings(knobs: Iterable[Knobs]) -> str:
    return "; ".join(text for one in knobs for _, text in fields(one))


def _of_quantity(quantity: Quantity, trial: Trial) -> Iterator[tuple[str, str]]:
    """The bounds of a quantity's judge, what its errors are relative to, and its exact answer."""
    name = quantity.name
    yield from fields(quantity.judge, f"{name}, judge")
    bodies = sum(map(len, trial.study.scene.bodies))
    given = {part: getattr(quantity, part, None) for part in SCALES}
    known = {part: one for part, one in given.items() if one and _is_cheap(one, bodies)}
    sizes = {part: abs(evaluated(one)) for part, one in known.items()}
    for part, size in sizes.items():
        yield f"{name}, {part}", listed(np.array([size]), DIGITS)
    if isinstance(quantity, Series):
        times = trial.study.goal.duration * np.array([0.0, 0.5, 1.0])
        answer = None if quantity.reference is None else quantity.reference(times)
    else:
        own = quantity.reference
        answer = None if own is None or not _is_cheap(own, bodies) else np.array([evaluated(own)])
    if answer is not None:
        yield f"{name}, exact", listed(answer, DIGITS, max(sizes.values(), default=0.0))


def _is_cheap(number: object, bodies: int) -> bool:
    """Whether a number is worked out for a page; a function is costly in a large scene."""
    return not callable(number) or bodies <= MANY


def _of_scene(study: Study) -> Iterator[tuple[str, str]]:
    """The observables, and the scene as a program reads it."""
    whole = data(study.ask(study.rungs[Level.QUICK][0]), "", ())
    seen = [f"{one['kind']} of {one['body']}" for one in whole["observables"]]
    more = f" and {len(seen) - LISTED} more" if len(seen) > LISTED else ""
    yield "observed", ", ".join(seen[:LISTED]) + more
    yield from gathered(whole["scene"], "scene,")
