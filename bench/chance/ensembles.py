"""Compares mean properties of packs of spheres between codes, over many random starts.

`python -m bench.chance.ensembles [SEEDS]` lets frictionless spheres of the case packing settle from
that many random starts in dem, LIGGGHTS and YADE. The mean of each quantity is printed with its
confidence interval of 95 %. Two codes must not differ by more than the sum of their intervals, and
the laws of equilibrium must hold.
"""

from __future__ import annotations

import math
import sys
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from adapters import dem, liggghts, yade
from bench.evidence import conclude
from cases.bulk import packing
from reference_solutions.bulk.packing import CONTACTS, weight
from vv.ask import Ask, Run, Status
from vv.case import Level
from vv.codes import Adapter
from vv.scene import Scene, Vector

CODES: tuple[Adapter, ...] = (dem.ADAPTER, liggghts.ADAPTER, yade.ADAPTER)
SEEDS, EARLY = 12, 3  # starts; the output at 0.45 s, when spheres still fall and bounce
P = packing.CASE.defaults("seed-1")
QUANTITIES: Mapping[str, Callable[[Scene, Run], float]] = {
    "contacts for each sphere": packing.contacts,
    "push of the floor over the weight": lambda scene, run: (
        P["kn"] * float(packing.pressed(scene, run)[:, 2].sum())
        / weight(scene.spheres.mass, P["g"])
    ),
    "push of opposite sides that does not cancel over the weight": lambda scene, run: (
        packing.sideways(P["kn"], scene, run) / weight(scene.spheres.mass, P["g"])
    ),
    "log10 of the energy of motion at 0.45 s over that at the start": lambda scene, run: (
        math.log10(packing.moving(scene, run)[EARLY] / packing.moving(scene, run)[0])
    ),
    "sum of momenta at the end over those at the start": packing.momentum,
}  # fmt: skip
LAWS = {
    "contacts for each sphere": (CONTACTS, 0.05),
    "push of the floor over the weight": (1.0, 1e-4),
}


def asked(seed: int) -> Ask:
    """The ask of one start."""
    trial = packing.CASE.declare(f"seed-{seed}", P)
    return trial.study.ask(trial.study.rungs[Level.DEFAULT][0])


def drawn(code: Adapter, asks: list[Ask]) -> dict[str, Vector]:
    """The quantities of all starts (n,), by name."""
    with tempfile.TemporaryDirectory() as folder:
        runs = list(code.run(asks, "default", Path(folder), 0.0))
    assert all(run.status is Status.RAN for run in runs), [run.reason for run in runs]
    return {
        name: np.array([one(ask.scene, run) for ask, run in zip(asks, runs, strict=True)])
        for name, one in QUANTITIES.items()
    }


def interval(draws: Vector) -> tuple[float, float]:
    """The mean, and half of its confidence interval of 95 %, by Student's t."""
    from scipy.stats import t

    n = len(draws)
    return float(draws.mean()), float(t.ppf(0.975, n - 1) * draws.std(ddof=1) / math.sqrt(n))


def main(seeds: str = str(SEEDS)) -> None:
    """Measure, print the figures and judge them."""
    asks = [asked(seed) for seed in range(1, int(seeds) + 1)]
    found = {code.name: drawn(code, asks) for code in CODES if code.found().installed}
    told = {
        name: {code: interval(draws[name]) for code, draws in found.items()} for name in QUANTITIES
    }
    bars: dict[str, bool] = {}
    for name, means in told.items():
        for code, (mean, doubt) in means.items():
            other, more = means["dem"]
            rounding = 1e-12 * abs(mean)
            bars[f"{name}: {code} as dem"] = abs(mean - other) <= doubt + more + rounding
            if name in LAWS:
                right, slack = LAWS[name]
                bars[f"{name}: {code} by the law"] = abs(mean - right) <= doubt + slack
    conclude("ensembles", {"starts": len(asks), **told}, bars)


if __name__ == "__main__":
    main(*sys.argv[1:])
