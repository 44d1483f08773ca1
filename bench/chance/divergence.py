"""Finds the step from which trajectories of spheres differ between codes and prove nothing.

`python -m bench.chance.divergence [SEED]` lets the spheres of the case packing fall in dem,
LIGGGHTS and YADE, all with schemes of second order. For each pair of codes it prints the first step
at which the positions of a sphere differ by more than a fraction of its radius, from rounding to
the whole radius. Quantities of such scenes must be compared before that step, or be laws or means
over many starts.
"""

from __future__ import annotations

import sys
import tempfile
from itertools import combinations
from pathlib import Path

import numpy as np

from bench.chance.ensembles import CODES, asked
from bench.evidence import conclude
from cases.bulk.packing import SEEN
from vv.ask import Ask, History, Status
from vv.codes import Adapter
from vv.scene import Vector

STEPS, EVERY = 12000, 20  # number of steps, and the interval between outputs
SECOND_ORDER = "half-step-mass"  # the scheme of codes that have it
PARTS = (1e-9, 1e-6, 1e-3, 1.0)  # fractions of the largest radius


def places(code: Adapter, ask: Ask) -> Vector:
    """The displacements of the spheres at each output (k, n, 3) [m]."""
    known = [scheme.name for scheme in code.schemes]
    scheme = SECOND_ORDER if SECOND_ORDER in known else known[0]
    with tempfile.TemporaryDirectory() as folder:
        (run,) = code.run([ask], scheme, Path(folder), 0.0)
    assert run.status is Status.RAN, run.reason
    return np.stack([run.values[what] for what in SEEN], axis=1)


def parted(one: Vector, other: Vector, far: float) -> int | None:
    """The first output at which two runs (k, n, 3) differ by more than `far` [m]; None if none.

    Values that are not finite count as different.
    """
    apart = ~(np.linalg.norm(one - other, axis=2).max(axis=1) <= far)
    return int(apart.argmax()) if apart.any() else None


def main(seed: str = "1") -> None:
    """Run the codes, compare each pair, and print the steps."""
    whole = asked(int(seed))
    goal = History(STEPS * whole.dt, EVERY * whole.dt)
    ask = Ask(whole.scene, goal, SEEN, whole.knobs)
    found = {code.name: places(code, ask) for code in CODES if code.found().installed}
    radius = float(whole.scene.spheres.radius.max())
    figures: dict[str, object] = {"steps": STEPS, "looked at every": EVERY}
    for a, b in combinations(found, 2):
        first = {
            f"{part:g} of a radius": parted(found[a], found[b], part * radius) for part in PARTS
        }
        figures[f"{a} and {b}: step from which they are apart by"] = {
            part: None if output is None else output * EVERY for part, output in first.items()
        }
    conclude("divergence", figures, {"codes were compared": len(found) > 1})


if __name__ == "__main__":
    main(*sys.argv[1:])
