"""Measures how much the reduced solver of DDA saves for one block that cannot rotate."""

import time
from collections.abc import Mapping

import numpy as np

from bench.evidence import conclude
from tests.scenes.blocks.dda_scenes import asked, shaken, slope
from vv.ask import Ask
from vv.engines.dda import DEFAULT, PUBLISHED, Formulation, PreparedBlocks, prepare
from vv.engines.dda.general.model import General
from vv.scene import Scene, Vector

DT, KN, DURATION = 1e-3, 1e9, 5.0
CHEAP = 5.0  # the most microseconds per step of the reduced solver
MINIMUM = 20.0  # the least ratio of costs per step
AGREEMENT = 1e-10  # relative to the largest displacement
SCENES: Mapping[str, Scene] = {
    "responding block in space": shaken((0.1, 0.1, 0.1), (2, 4, 1), 0.6),
    "sine on a slope": slope(20, 30, A=5.0),
    "gravity on a slope": slope(28, 20),
}


def solved(program: PreparedBlocks) -> tuple[float, Vector]:
    """The microseconds per step, minimum of several solves, and the path."""
    program.warm()
    spent = []
    for _ in range(7):
        begun = time.perf_counter()
        rows = program.solve()
        spent.append(time.perf_counter() - begun)
    done = program.run(rows)
    return 1e6 * min(spent) / done.steps, next(iter(done.values.values()))


def routes(ask: Ask, way: Formulation) -> tuple[float, float, float]:
    """The microseconds per step of both solvers, and the difference of their paths."""
    few, short = solved(prepare(ask, way))
    listed = np.arange(len(ask.scene.blocks))
    many, long = solved(PreparedBlocks(ask, way, General(ask.scene, way), listed))
    return few, many, float(np.abs(short - long).max() / np.abs(short).max())


def main() -> None:
    """Measure and judge."""
    figures = {}
    for name, scene in SCENES.items():
        for label, way in (("default", DEFAULT), ("published", PUBLISHED)):
            figures[f"{name}, {label}"] = dict(
                zip(
                    ("reduced [us/step]", "general [us/step]", "apart"),
                    routes(asked(scene, DT, KN, DURATION), way),
                    strict=True,
                )
            )
    measured = [tuple(figure.values()) for figure in figures.values()]
    conclude(
        "dda-routes",
        figures,
        {
            f"reduced takes at most {CHEAP:g} us a step": all(m[0] <= CHEAP for m in measured),
            f"it is {MINIMUM:g} times cheaper": all(m[1] >= MINIMUM * m[0] for m in measured),
            f"routes agree to {AGREEMENT:g}": all(m[2] <= AGREEMENT for m in measured),
        },
    )


if __name__ == "__main__":
    main()
