"""Whether each case sees a parameter that is 1 % off in a code: the in-house codes are asked.

`python -m bench.bounds.sensitivity [CASE ...]` gives every scheme the scenes of a variant with
one parameter 1 % off, at the settings of the quick level (`--level` names another), and judges them
by the answer at the default. It prints, for each class of method, the error over the tolerance of
the quantity that sees it best. The bar: each parameter that is neither inert nor said to be unseen
fails a tolerance of some class; and what fails none in a class is listed.
"""

from __future__ import annotations

import argparse
import dataclasses
import tempfile
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from bench.evidence import conclude
from vv.ask import Ask, Knobs, Method, Run, Status
from vv.case import Case, Level, Study, Trial
from vv.codes.adapter import Adapter, Scheme, known_beforehand
from vv.plan.planning import project_knobs
from vv.plan.project import Project, find
from vv.records.checking import checked
from vv.records.outcomes import Verdict
from vv.records.record import measured
from vv.run.search import answers

IN_HOUSE = ("exact", "rigid", "dem", "dda")
OFF = (1.01, 0.99)
JUDGED = (Verdict.PASS, Verdict.FAIL)


class Detected(NamedTuple):
    """One parameter off in one scheme: its worst error over the tolerance, and whose it is.

    excess: inf where the run or its measurement failed. right: the same with nothing off.
    """

    variant: str
    parameter: str
    method: Method
    scheme: str
    right: float
    excess: float
    quantity: str


def in_house(project: Project) -> tuple[Adapter, ...]:
    """The codes that are asked."""
    return tuple(project.load_adapter(name) for name in IN_HOUSE)


def off(case: Case, variant: str, name: str) -> list[Trial]:
    """The trials with a parameter 1 % more and 1 % less, but for those that the case refuses."""
    usual, found = case.defaults(variant), []
    for factor in OFF:
        try:
            found.append(case.declare(variant, {**usual, name: usual[name] * factor}))
        except ValueError:
            continue
    return found


def entering(case: Case, variant: str) -> list[str]:
    """The parameters that 1 % should show of: not inert, nor nil, unseen or a length of time."""
    own = case.variant(variant)
    left_out = {*own.inert, *own.unseen, "duration"}
    return [
        name for name, value in case.defaults(variant).items() if value and name not in left_out
    ]


def excess(trial: Trial, run: Run, method: Method, ask: Ask) -> tuple[float, str] | None:
    """The largest error over its tolerance, and whose it is; None where nothing is judged."""
    run = checked(run, ask)
    if run.status is not Status.RAN:
        return float("inf"), run.status.value
    found = []
    for quantity in trial.quantities:
        try:
            one, _ = measured(run, quantity, method, ask.knobs)
        except (ValueError, ArithmeticError):  # which a record of a run would state as its error
            return float("inf"), quantity.name
        if one.verdict in JUDGED:
            whole = float("inf") if one.verdict is Verdict.FAIL else 0.0
            part = one.error / one.tolerance if one.tolerance and one.error is not None else whole
            found.append((part, one.name))
    return max(found, default=None)


def asks(right: Study, wrong: Study, scheme: Scheme, level: Level) -> Iterator[Ask]:
    """The asks for the wrong scene, finest first, with steps, times and outputs of the right one.

    A stiffness that stands for rigid contact is that of the wrong one.
    """
    same = dataclasses.replace(right, scene=wrong.scene)
    rungs = [
        project_knobs(Knobs(one.dt, other.kn), scheme)
        for one, other in zip(right.rungs[level], wrong.rungs[level], strict=True)
    ]
    yield from map(same.ask, dict.fromkeys(rungs[::-1]))


def answer(adapter: Adapter, scheme: Scheme, ask: Ask) -> Run:
    """The run of an ask, or its refusal."""
    settled = known_beforehand(adapter, scheme, ask, adapter.found())
    if settled:
        return settled
    with tempfile.TemporaryDirectory() as scratch:
        return next(answers(adapter, [ask], scheme.name, Path(scratch), 0.0))


def shows(
    right: Trial, wrongs: Iterable[Trial], adapter: Adapter, scheme: Scheme, level: Level
) -> tuple[float, str] | None:
    """How far beyond its tolerance a scheme is where it is farthest; None if it is not judged.

    Given up are further settings once one is outside its tolerance.
    """
    method, best = scheme.method_for(right.study.scene.terms()), None
    for wrong in wrongs:
        for ask in asks(right.study, wrong.study, scheme, level):
            run = answer(adapter, scheme, ask)
            if run.status is Status.REFUSED:
                continue
            found = excess(right, run, method, ask)
            best = max(filter(None, (best, found)), default=None)
            if best and best[0] > 1:
                return best
    return best


def swept(
    case: Case, variant: str, adapters: Sequence[Adapter], level: Level
) -> Iterator[Detected]:
    """Each parameter of a variant off in each scheme that is judged."""
    right = case.declare(variant, case.defaults(variant))
    wrongs = {name: off(case, variant, name) for name in entering(case, variant)}
    for adapter in adapters:
        for scheme in adapter.schemes:
            usual = shows(right, [right], adapter, scheme, level)
            for name, trials in wrongs.items() if usual else ():
                method = scheme.method_for(right.study.scene.terms())
                found = shows(right, trials, adapter, scheme, level) or (0.0, "")
                label = f"{adapter.name}/{scheme.name}"
                yield Detected(variant, name, method, label, usual[0] if usual else 0.0, *found)


def unseen(case: Case, variant: str, adapters: Sequence[Adapter], level: Level) -> list[str]:
    """The parameters of a variant that no scheme is seen to have 1 % off."""
    right = case.declare(variant, case.defaults(variant))
    left = []
    for name in entering(case, variant):
        wrongs = off(case, variant, name)
        found = (
            shows(right, wrongs, adapter, scheme, level)
            for adapter in adapters
            for scheme in adapter.schemes
        )
        if wrongs and not any(one and one[0] > 1 for one in found):
            left.append(name)
    return left


def by_class(found: Iterable[Detected]) -> Mapping[tuple[str, str], Mapping[Method, Detected]]:
    """(variant, parameter) -> class of method -> the scheme that sees it best."""
    best: dict[tuple[str, str], dict[Method, Detected]] = defaultdict(dict)
    for one in found:
        row = best[one.variant, one.parameter]
        before = row.get(one.method)
        row[one.method] = one if before is None or one.excess > before.excess else before
    return best


def main() -> None:
    """Sweep the cases named, or all; print the table and judge."""
    parser = argparse.ArgumentParser()
    parser.add_argument("cases", nargs="*")
    parser.add_argument("--level", default="quick", choices=[level.value for level in Level])
    options = parser.parse_args()
    project, level = find(Path(__file__)), Level(options.level)
    adapters = in_house(project)
    rows, by_none, in_class = {}, [], []
    for name in options.cases or project.case_names():
        case = project.load_case(name)
        for variant in (one.name for one in case.variants if one.runs_at(level)):
            table = by_class(swept(case, variant, adapters, level))
            for (_, parameter), row in table.items():
                label = f"{name}:{variant} {parameter}"
                rows[label] = {
                    m.value: f"{one.excess:.3g} in {one.scheme} by {one.quantity}"
                    for m, one in row.items()
                }
                in_class += [f"{label}: {m.value}" for m, one in row.items() if one.excess <= 1]
                by_none += [label] if all(one.excess <= 1 for one in row.values()) else []
    figures = {
        "error over tolerance": rows,
        "not seen in a class": in_class,
        "parameters": len(rows),
    }
    conclude(
        "sensitivity", figures, {f"seen: {one}": False for one in by_none} or {"all seen": True}
    )


if __name__ == "__main__":
    main()
