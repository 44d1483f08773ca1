"""Solves the facade of 216 blocks of the case `masonry` in `rigid`: at rest and shaken.

The residual and the cost of every step are evaluated, and the steps are counted in which sweeps
stall, so that Newton steps are tried. At 0.51 g, the value of the case, and at 0.72 g stones
separate and wedge.
"""

import time

import numpy as np

from bench.evidence import conclude
from cases.blocks.masonry import BED, CASE
from vv.ask import Ask, History, Knobs, Reaction
from vv.engines import rigid
from vv.engines.rigid.limits import STUCK

DT = 1e-3  # s
CREEPS = 5e-6  # m/s: a residual above which friction creeps
PARTS = {
    "at rest": ("rest-200", {}),
    "sliding": ("slides-200", {}),
    "shaken at 0.51 g": ("shaken-200", {}),
    "shaken at 0.72 g": ("shaken-200", {"D": 0.02}),
}


def solved(variant: str, changed: dict[str, float]) -> dict[str, float]:
    """The figures of a variant with changed parameters, with an output at every step."""
    p = {**CASE.defaults(variant), **changed}
    scene = CASE.declare(variant, p).study.ask(Knobs(DT)).scene
    program = rigid.prepare(Ask(scene, History(p["duration"], DT), (Reaction(BED),), Knobs(DT)))
    program.warm()
    begun = time.process_time()
    program.solve()
    spent = time.process_time() - begun
    energies, report = program.energies, program.report[1:]
    put_in = max(float(np.abs(np.diff(energies[:, 3])).sum()), float(np.ptp(energies[:, 0])))
    return {
        "CPU [ms a step]": spent / len(report) * 1e3,
        "sweeps a step, mean": float(report[:, 1].mean()),
        "sweeps a step, most": float(report[:, 1].max()),
        "steps in which sweeps stall, of 100": float((report[:, 1] >= STUCK).mean()) * 100,
        "residual, largest [m/s]": float(report[:, 0].max()),
        f"steps above {CREEPS} m/s": int((report[:, 0] > CREEPS).sum()),
        "penetration, largest [m]": float(report[:, 2].max()),
        "energy unaccounted, of the work put in": float(np.abs(energies.sum(axis=1)).max())
        / max(put_in, 1e-300),
    }


def main() -> None:
    """Measure and judge; the load of the bedstone at rest is judged by the case."""
    parts = {name: solved(*part) for name, part in PARTS.items()}
    moving = {name: part for name, part in parts.items() if name != "at rest"}

    def most(name: str) -> float:
        return max(part[name] for part in parts.values())

    bars = {
        "residual at most 5e-6 m/s at every step": most("residual, largest [m/s]") <= CREEPS,
        "at most 25 ms a step on one core": most("CPU [ms a step]") <= 25,
        "penetration under 1 mm": most("penetration, largest [m]") < 1e-3,
        "energy closed to 1e-9 of the work put in": max(
            part["energy unaccounted, of the work put in"] for part in moving.values()
        ) <= 1e-9,
    }  # fmt: skip
    conclude("masonry", parts, bars)


if __name__ == "__main__":
    main()
