"""The step from which the ways of spheres differ between codes, so that they are no evidence.

`python -m bench.chance.divergence [SEED]` lets the spheres of the case packing fall in dem,
LIGGGHTS and YADE, all as second order, looks at each of the first steps, and tells for each pair of
codes the first at which a sphere is further apart than a part of its radius: rounding first, then
all of it. What is compared of such scenes must be read before that, or be a law or a mean over many
starts.
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

STEPS, EVERY = 12000, 20  # looked at, and how often
SECOND_ORDER = "half-step-mass"  # of those that have it
PARTS = (1e-9, 1e-6, 1e-3, 1.0)  # of the largest radius


def places(code: Adapter, ask: Ask) -> Vector:
    """Where spheres are at each output (k, n, 3) [m]."""
    known = [scheme.name for scheme in code.schemes]
    scheme = SECOND_ORDER if SECOND_ORDER in known else known[0]
    with tempfile.TemporaryDirectory() as folder:
        (run,) = code.run([ask], scheme, Path(folder), 0.0)
    assert run.status is Status.RAN, run.reason
    return np.stack([run.values[what] for what in SEEN], axis=1)


def parted(one: Vector, other: Vector, far: float) -> int | None:
    """The first output (k,) at which a sphere of two runs (k, n, 3) is further apart; None: never.

    What is no number is apart.
    """
    apart = ~(np.linalg.norm(one - other, axis=2).max(axis=1) <= far)
    return int(apart.argmax()) if apart.any() else None


def main(seed: str = "1") -> None:
    """Find and tell."""
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
