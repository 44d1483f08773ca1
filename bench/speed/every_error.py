"""Measures whether `exact` costs less than every stepping code at every error up to 0.3.

`python -m bench.speed.every_error [SCENE ...]` runs each scheme of the in-house codes on each
scene, from steps so coarse that the error exceeds 0.3 to those that cost more than the answer of
`exact/default`, which is exact to rounding: finer steps cost more still. Where contact is rigid,
springs of five stiffnesses are tried. `exact` takes part with all of its schemes, and of its runs
that err no more than a run of another code, the cheapest counts. `VV_PROGRAMS=yade,liggghts` adds
codes that run as programs, of which each run takes a second.
"""

import os
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bench.evidence import conclude
from vv.ask import Ask, Knobs, Run, Status
from vv.case import Ladder, Scalar, Series, Trial
from vv.codes import Adapter, Scheme, known_beforehand
from vv.plan.project import find
from vv.run.search import answers

PROJECT = find(Path(__file__))
SCENES = (
    *(f"single-contact:T{test}" for test in (1, 2, 3, 4)),
    *(f"incline:{name}" for name in ("newmark-22", "newmark-30", "newmark-35", "newmark-3d")),
    "incline:two-directions",
    *(f"responding-block:{name}" for name in ("1d", "2d", "3d")),
)
CODES = ("dem", "dda", "rigid", *filter(None, os.environ.get("VV_PROGRAMS", "").split(",")))
LARGEST = 0.3  # relative error; a larger one is no answer
DENSITY = 20  # numbers of steps in each decade
FEWEST, MOST = (4, 25), 40_000  # steps of an elastic contact, of a block on rigid contact; of any
STIFFNESSES = (1e5, 1e6, 1e7, 1e8, 1e9)  # N/m
ENOUGH = 4.0
VISITS, REPEAT = 2, 0.01  # timings, of which the least counts, of so many CPU seconds


@dataclass(frozen=True)
class Point:
    """The cost [s] and the relative error of a run, and what ran."""

    cost: float
    error: float
    label: str


def error(trial: Trial, run: Run) -> float:
    """The error of the last quantity over its scale: of the whole motion, where it has parts."""
    quantity = trial.quantities[-1]
    value = quantity.observe(run)
    if isinstance(quantity, Series):
        assert quantity.reference is not None
        due = quantity.reference(run.times)
        return float(np.abs(value - due).max() / np.abs(due).max())
    assert isinstance(quantity, Scalar)
    assert callable(quantity.scale)
    return float(value) / float(quantity.scale())


def timed(trial: Trial, adapter: Adapter, scheme: Scheme, ask: Ask) -> Point | None:
    """The point of an ask, or None if it is refused or diverges."""
    with tempfile.TemporaryDirectory() as scratch:
        visits = [ask] * VISITS
        runs = list(answers(adapter, visits, scheme.name, Path(scratch), REPEAT))
        whole = next(iter(answers(adapter, [ask], scheme.name, Path(scratch), 0.0)))
    if whole.status is not Status.RAN:
        return None
    label = f"{adapter.name}/{scheme.name} dt={ask.knobs.dt:g}"
    label += f",kn={ask.knobs.kn:g}" if ask.knobs.kn and "kn" in scheme.knobs else ""
    return Point(min(run.cost.solve_cpu for run in runs), error(trial, whole), label)


def numbers(fewest: int) -> Iterator[int]:
    """Numbers of steps from `fewest` to MOST, of which each decade has DENSITY."""
    found = sorted({round(10 ** (i / DENSITY)) for i in range(5 * DENSITY)})
    yield from (number for number in found if fewest <= number <= MOST)


def points(trial: Trial, code: str, most: float) -> Iterator[Point]:
    """The points of a code, for each scheme to the first good one that costs more than `most` [s].

    Where none is good, they end at ENOUGH times that.
    """
    adapter, study = PROJECT.load_adapter(code), trial.study
    assert isinstance(study, Ladder)
    found, rigid = adapter.found(), study.scene.contact.rigid
    for scheme in adapter.schemes if found.installed else ():
        springs = STIFFNESSES if rigid and "kn" in scheme.knobs else (None,)
        for kn in springs if "dt" in scheme.knobs else ():
            for steps in numbers(FEWEST[rigid]):
                ask = study.ask(Knobs(study.goal.duration / steps, kn))
                refused = known_beforehand(adapter, scheme, ask, found) is not None
                point = None if refused else timed(trial, adapter, scheme, ask)
                if point is not None:
                    yield point
                    good = point.error <= LARGEST
                    if point.cost > (most if good else ENOUGH * most):
                        break


def margin(name: str) -> dict[str, float | int | str]:
    """How much more the nearest run of a stepping code costs than `exact` with its error."""
    case, _, variant = name.partition(":")
    found = PROJECT.load_case(case)
    trial = found.declare(variant, found.defaults(variant))
    study = trial.study
    assert isinstance(study, Ladder)
    adapter = PROJECT.load_adapter("exact")
    ask = study.ask(Knobs(dt=study.goal.interval))
    default = timed(trial, adapter, adapter.schemes[0], ask)
    assert default is not None
    own = [default, *points(trial, "exact", default.cost)]
    others = [
        point
        for code in CODES
        for point in points(trial, code, default.cost)
        if point.error <= LARGEST
    ]
    if not others:
        return {"runs": 0, "exact [us]": 1e6 * default.cost}

    def rival(point: Point) -> Point:
        return min((one for one in own if one.error <= point.error), key=lambda one: one.cost)

    nearest = min(others, key=lambda point: point.cost / rival(point).cost)
    return {
        "exact/default [us]": 1e6 * default.cost,
        "runs compared": len(others),
        "least ratio of costs": nearest.cost / rival(nearest).cost,
        "of": f"{nearest.label}: {1e6 * nearest.cost:.3g} us, error {nearest.error:.2g}",
        "against": f"{rival(nearest).label}: {1e6 * rival(nearest).cost:.3g} us",
    }


def main() -> None:
    """Measure the scenes that are named, or all of them, and judge."""
    figures = {name: margin(name) for name in sys.argv[1:] or SCENES}
    bars = {
        f"{name}: exact costs less at every error": float(found.get("least ratio of costs", 0.0))
        > 1
        for name, found in figures.items()
    }
    conclude("every-error", figures, bars)


if __name__ == "__main__":
    main()
