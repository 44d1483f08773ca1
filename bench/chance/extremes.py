"""Changes one parameter at a time of every variant, far from its usual value, in every code.

`python -m bench.chance.extremes [SELECTION] [FACTORS] [CODES] [PART]` multiplies each parameter
of each variant by each factor (0.1,8 if none is given), all others unchanged, and runs it at level
quick. Whole numbers are rounded; what a case refuses is counted and not tried again. PART, K/N,
runs every Nth of them from the Kth on, so that a long sweep can be shared or sampled.

Random draws (`bench.chance.holdouts`) change several parameters by less. A bound that omits a
parameter is off by the most where that one alone is far from its usual value.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator

from bench.chance.holdouts import CODES, Draw, judged
from bench.evidence import conclude
from vv.case import Case, Level
from vv.plan.project import Project, find
from vv.plan.selection import select


def changed(case: Case, variant: str, factors: list[float]) -> Iterator[Draw]:
    """Each parameter of a variant times each factor; those that are zero or stay as they are not.

    Values have eight digits, so that a parameter of which others depend keeps its ratio to them.
    """
    whole = {parameter.name for parameter in case.parameters if parameter.whole}
    for name, usual in case.defaults(variant).items():
        for factor in factors:
            value = round(usual * factor) if name in whole else usual * factor
            if value != usual:
                yield Draw(case.name, variant, (f"{name}={value:.8g}",))


def everything(project: Project, selection: str, factors: list[float]) -> Iterator[Draw]:
    """The changes of all variants that run at level quick."""
    for case, name in select(project, [selection]):
        if case.parameters and case.variant(name).runs_at(Level.QUICK):
            yield from changed(case, name, factors)


def main(
    selection: str = "*", factors: str = "0.1,8", codes: str = CODES, part: str = "1/1"
) -> None:
    """Run all changes, print each red one with its details, and count the results."""
    project, numbers = find(), [float(one) for one in factors.split(",")]
    first, step = (int(one) for one in part.split("/"))
    count, reds = Counter[str](), []
    for one in list(everything(project, selection, numbers))[first - 1 :: step]:
        ended, told = judged(project, one, codes)
        count[ended] += 1
        if ended == "red":
            reds.append(one.command(codes))
            print(one.command(codes), *told, sep="\n    ", flush=True)
    figures = {"selection": selection, "factors": numbers, "part": part, **count, "red": reds}
    conclude("extremes", figures, {"none is red": not reds})


if __name__ == "__main__":
    main(*sys.argv[1:])
