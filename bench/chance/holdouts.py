"""Runs cases at random parameters in every code: some are right, some refuse, some are red.

`python -m bench.chance.holdouts [NUMBER] [SEED] [SELECTION] [CODES]` draws NUMBER variants, with
every case equally often, gives their parameters random values and runs them at level quick.
Parameters that a case refuses are reported and drawn again, at most TRIES times. A draw is red if
any of its results would turn the gate red; the command that reruns it is printed with it.

In half of the draws all parameters are multiplied by 0.6 to 1.4, in the other half one to three
parameters by 1/3 to 3. If all parameters varied that much, nearly all scenes would be useless or
refused.
"""

from __future__ import annotations

import itertools
import shlex
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from bench.evidence import conclude
from vv.ask import Status
from vv.base.errors import UsageError
from vv.case import Case, Level
from vv.gate.judgement import judgement
from vv.plan.plan import Options
from vv.plan.planning import make_plan
from vv.plan.project import Project, find
from vv.plan.selection import select
from vv.records.job_record import Record
from vv.run.limits import Limits
from vv.run.session import carry_out

CODES = "exact,dem,dda,rigid,yade,liggghts"
NEAR, FAR = 0.4, 3.0  # parameters are multiplied by 1 -+ NEAR, or by 1/FAR to FAR
TRIES = 8
WORKERS, TIMEOUT = 2, 300.0  # processes, and the time limit of a job [s]
NOT_TRIED = (Status.REFUSED, Status.NOT_INSTALLED, Status.TOO_LONG)


@dataclass(frozen=True)
class Draw:
    """A variant with values for parameters, as texts NAME=VALUE."""

    case: str
    variant: str
    settings: tuple[str, ...]

    def command(self, codes: str) -> str:
        """The command that reruns the draw."""
        sets = " ".join(f"--set {shlex.quote(one)}" for one in self.settings)
        return f"vv run {self.case}:{self.variant} {sets} --level quick --codes {codes}"


def draw(case: Case, variant: str, chance: np.random.Generator) -> Draw:
    """Random values for a variant, to three digits; zeros stay zero, and counts are whole."""
    usual = {name: value for name, value in case.defaults(variant).items() if value}
    names = list(usual)
    if chance.random() < 0.5:
        factors = {name: chance.uniform(1 - NEAR, 1 + NEAR) for name in names}
    else:
        few = chance.choice(len(names), min(len(names), int(chance.integers(1, 4))), replace=False)
        factors = {names[i]: FAR ** chance.uniform(-1, 1) for i in sorted(few)}
    counts = {parameter.name for parameter in case.parameters if parameter.whole}
    given = tuple(
        f"{name}={usual[name] * factor:{'.0f' if name in counts else '.3g'}}"
        for name, factor in factors.items()
    )
    return Draw(case.name, variant, given)


def variants(
    project: Project, selection: str, chance: np.random.Generator
) -> Iterator[tuple[Case, str]]:
    """An endless sequence of variants: all cases in random order, each with a random variant."""
    names: dict[str, list[str]] = {}
    for case, name in select(project, [selection]):
        if case.parameters and case.variant(name).runs_at(Level.QUICK):
            names.setdefault(case.name, []).append(name)
    while names:
        for case_name in chance.permutation(sorted(names)):
            yield project.load_case(case_name), str(chance.choice(names[case_name]))


class Silent:
    """Shows no progress."""

    def begin(self, jobs: int) -> None:
        """Jobs begin."""

    def done(self, record: Record) -> None:
        """A record is finished."""

    def timing(self, settings: int) -> None:
        """Nothing is timed."""


def judged(project: Project, one: Draw, codes: str) -> tuple[str, list[str]]:
    """The result of a draw, green, red or refused, and its details in words."""
    options = Options(Level.QUICK, tuple(codes.split(",")), one.settings)
    try:
        plan = make_plan(project, [f"{one.case}:{one.variant}"], options)
    except UsageError as error:
        return "refused", [str(error)]
    except Exception as error:  # a crash of a case is a failure, and the other draws go on
        return "red", [f"the case ends with {error!r}"]
    manifest = carry_out(project, plan, Limits(WORKERS, TIMEOUT), Silent(), ["holdouts"])
    if all(record.status in NOT_TRIED for record in manifest.records):
        reasons = Counter(record.reason for record in manifest.records)
        return "refused", [reason for reason, _ in reasons.most_common(2)]
    wrong = [found for found in judgement(manifest) if found.bit]
    told = [f"{one.label} {one.rung} {one.quantity}: {one.text}" for one in wrong]
    return ("red" if wrong else "green"), told


def main(number: str = "40", seed: str = "1", selection: str = "*", codes: str = CODES) -> None:
    """Draw, run, print each draw, and count the results."""
    project, chance = find(), np.random.default_rng(int(seed))
    count, reds = Counter[str](), []
    for case, variant in itertools.islice(variants(project, selection, chance), int(number)):
        for _ in range(TRIES):
            one = draw(case, variant, chance)
            ended, told = judged(project, one, codes)
            count[ended] += 1
            print(f"{ended}: {one.command(codes)}", *told, sep="\n    ", flush=True)
            if ended != "refused":
                break
        reds += [one.command(codes)] if ended == "red" else []
    figures = {"number": int(number), "seed": int(seed), **count, "red draws": reds}
    conclude("holdouts", figures, {"none is red": not reds})


if __name__ == "__main__":
    main(*sys.argv[1:])
