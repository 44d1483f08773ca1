"""Lists the bounds that are more than a hundred times the errors of accepted results.

`python -m bench.bounds.loose_bounds [CASE ...]` compares `cases/baselines` with the declarations,
and runs nothing. For each quantity of a variant in each scheme it takes the setting of level
default at which the bound is closest to the error. The bar: bounds of more than FAR times the error
say why, as `slack` of their `Tolerance`.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bench.evidence import conclude
from vv.case import (
    Case,
    Exact,
    Level,
    Tolerance,
    Trial,
    judge_for_method,
    knobs_in_scene,
)
from vv.codes.adapter import Adapter, Scheme
from vv.gate.baseline import read
from vv.plan.planning import project_knobs
from vv.plan.project import Project, find
from vv.records.accepted import Baseline
from vv.records.reading import in_words

FAR = 100.0  # times the error
EPS = float(np.finfo(float).eps)
ROUNDING = 1e-11  # of 40 000 steps, eps each, as many as a run of these cases has: such bounds pass


@dataclass(frozen=True)
class Bound:
    """The bound of a quantity in a scheme, at the setting at which it is closest to the error."""

    name: str
    setting: str
    bound: float
    error: float
    tolerance: Tolerance

    @property
    def times(self) -> float:
        """The bound over the error; an error of less than an eps counts as one."""
        return self.bound / max(self.error, EPS)

    @property
    def loose(self) -> bool:
        """Whether it is more than FAR times the error, and more than rounding."""
        return self.bound > ROUNDING and self.times > FAR

    def __str__(self) -> str:
        text = f"{self.bound:.2g} allowed, error {self.error:.2g}"
        return f"{text} at {self.setting}" if self.setting else text


def bounds(case: Case, accepted: Baseline, adapters: Iterable[Adapter]) -> Iterator[Bound]:
    """The bounds of all quantities of a case that are compared with a reference."""
    schemes = [(one.name, scheme) for one in adapters for scheme in one.schemes]
    for variant in case.variants:
        if variant.runs_at(Level.DEFAULT):
            trial = case.declare(variant.name, case.defaults(variant.name))
            for code, scheme in schemes:
                label = f"{variant.name} {code}/{scheme.name}"
                for name, found in _in_scheme(trial, scheme, accepted, label).items():
                    closest = min(found, key=lambda one: one[1] / max(one[2], EPS))
                    yield Bound(f"{case.name}:{label} {name}", *closest)


Row = tuple[str, float, float, Tolerance]  # setting, bound, error and tolerance


def _in_scheme(
    trial: Trial, scheme: Scheme, accepted: Baseline, label: str
) -> Mapping[str, Sequence[Row]]:
    """Quantity -> a row for each setting of level default whose result was accepted."""
    method, found = scheme.method_for(trial.study.scene.terms()), defaultdict[str, list[Row]](list)
    for knobs in trial.study.rungs[Level.DEFAULT]:
        given = project_knobs(knobs, scheme, knobs_in_scene(trial.study))
        setting = in_words(given)
        result = accepted.results.get(f"{label} {setting}".rstrip())
        for quantity in trial.quantities:
            judge = judge_for_method(quantity.judge, method)
            one = result.quantities.get(quantity.name) if result else None
            if isinstance(judge, Exact) and one and one.error is not None:
                allowed = judge.tolerance(method)
                found[quantity.name].append((setting, allowed.at(given), one.error, allowed))
    return found


def of_case(project: Project, name: str) -> list[Bound]:
    """The bounds of a case; none if no results of it were accepted."""
    accepted = read(project.root / "cases" / "baselines", name)
    adapters = [project.load_adapter(code) for code in project.adapter_names()]
    return list(bounds(project.load_case(name), accepted, adapters)) if accepted else []


def main(*names: str) -> None:
    """List the loose bounds of the cases named, or of all."""
    project = find(Path(__file__))
    every = [one for name in names or project.case_names() for one in of_case(project, name)]
    loose = {one.name: one for one in every if one.loose}
    figures = {
        "bounds": len(every),
        "loose with a reason": {
            n: f"{b}: {b.tolerance.slack}" for n, b in loose.items() if b.tolerance.slack
        },
        "loose without": {n: str(b) for n, b in loose.items() if not b.tolerance.slack},
    }
    conclude("loose_bounds", figures, {"each says why": not figures["loose without"]})


if __name__ == "__main__":
    main(*sys.argv[1:])
