"""Runs findings of docs/findings.md that take minutes: blocks of bonds, silos, masonry.

`python -m bench.findings [WORDS]` runs those whose key has these words, prints each figure beside
its band, and ends with 1 if one is outside. Keys are words of the page, which a test asserts;
quicker findings are run by tests/findings. All of them take about 400 CPU seconds.
"""

import sys

from bench.evidence import conclude
from tests.findings.figures import Answer, passes, value
from tests.findings.grains import clear, outflow
from tests.findings.table import Row, Table
from vv.ask import Knobs
from vv.case import Level

DEM, PAPER, COARSE = "dem/default", Level.PAPER, Knobs(8e-8)


def cpu_of_a_step(answer: Answer) -> float:
    """CPU time of a step [s]."""
    return answer.run.cost.solve_cpu / answer.run.steps


SLOW: Table = {
    "and 9.7 % below at 37 681": [
        Row("close-packed-strength:pulled-37681", DEM, COARSE, value("T_u over Eq. 7"),
            -0.0975, -0.0965),
        Row("close-packed-strength:pulled-37681", DEM, COARSE, "T_u", 0.0, 1.2e-3),
    ],
    "Compressed blocks of 82, 580 and 2166 elements are within 9e-4 of it": [
        Row("close-packed-strength:pressed-2166", DEM, COARSE, "C_u", 0.0, 9e-4),
    ],
    "and 3e-6 when they are pressed until they slide": [
        Row("close-packed-energy:pressed-2166", DEM, PAPER, value("balance"), 2.5e-6, 3.5e-6),
    ],
    "to 3 % with holes of 5.1 and 6.7 grains in `dem`": [
        Row("hopper:wide-1", DEM, None, outflow(), -0.03, 0.03),
    ],
    "With its clear width alone they would be 20 and 9 % too fast": [
        Row("hopper:wide-1", DEM, None, outflow(clear), 0.085, 0.095),
    ],
    "and to 5 % in YADE and LIGGGHTS": [
        Row(f"hopper:{one}-1", f"{code}/default", None, outflow(), -0.05, 0.05)
        for one in ("narrow", "wide")
        for code in ("yade", "liggghts")
    ],
    "every start is within it in `dem` and YADE": [
        Row(f"column-collapse:seed-{seed}", "yade/default", None, passes("run-out"), 1, 1)
        for seed in (1, 2, 3)
    ],
    "216 blocks that are shaken apart at 0.51 g take 27 ms of CPU a step of 5e-4 s in `dda`, and "
    "88 ms a step of 1e-3 s": [
        Row("masonry:shaken-200", "dda/default", Knobs(5e-4, 1e9), cpu_of_a_step, 0.015, 0.045),
        Row("masonry:shaken-200", "dda/default", Knobs(1e-3, 1e9), cpu_of_a_step, 0.05, 0.15),
    ],
}  # fmt: skip


def main(words: str = "") -> None:
    """Run, print and judge."""
    figures, bars = {}, {}
    for told, group in SLOW.items():
        for row in group if words in told else ():
            name = f"{told}: {row.name} {row.scheme}"
            figures[name] = f"{row.found():.4g} in [{row.low:.4g}, {row.high:.4g}]"
            bars[name] = row.holds()
            print(name, figures[name], flush=True)
    conclude("findings", figures, bars)


if __name__ == "__main__":
    main(*sys.argv[1:])
