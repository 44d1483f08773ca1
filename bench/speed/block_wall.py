"""Solves a dry wall of 205 blocks in `rigid`: at rest, shaken without and with sliding.

Running bond, ten courses of 20 blocks or of 19 and two halves, on a base that moves along the wall
as D (1 - cos 2 pi f t), no damping, dt = 1e-3 s. At 0.36 g the wall holds; at 0.72 g it slides and
its courses separate, and steps must converge there too.
"""

import time

import numpy as np

from bench.evidence import conclude
from tests.scenes.blocks.block_scenes import G, running_bond
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import rigid
from vv.engines.rigid import PreparedRigidBlocks

COLUMNS, COURSES = 20, 10
FREQUENCY = 3.0  # Hz
CREEPS = 5e-6  # m/s: a residual above which friction creeps
PARTS = {"at rest": (0.0, 1.0), "shaken": (0.01, 1.0), "sliding": (0.02, 0.3)}  # D [m], time [s]


def figures(program: PreparedRigidBlocks, seconds: float) -> dict[str, float]:
    """The figures of a solve."""
    energies, report = program.energies, program.report[1:]
    put_in = max(float(np.abs(np.diff(energies[:, 3])).sum()), float(np.ptp(energies[:, 0])))
    weight = sum(block.mass for block in program.ask.scene.blocks) * G
    return {
        "CPU [ms a step]": seconds / len(report) * 1e3,
        "sweeps a step, mean": float(report[:, 1].mean()),
        "residual, largest [m/s]": float(report[:, 0].max()),
        f"steps whose residual is above {CREEPS} m/s": int((report[:, 0] > CREEPS).sum()),
        "penetration, largest [m]": float(report[:, 2].max()),
        "energy unaccounted, of the work put in": float(np.abs(energies.sum(axis=1)).max())
        / put_in,
        "base reaction at the end, of the weight, less 1": float(
            program.reactions[-1, 0, 2] / weight - 1
        ),
    }


def solved(amplitude: float, duration: float, frequency: float = FREQUENCY) -> dict[str, float]:
    """Solve the wall, with an output at every step."""
    scene = running_bond(COLUMNS, COURSES, amplitude, frequency)
    ask = Ask(scene, History(duration, 1e-3), (Displacement(1),), Knobs(1e-3))
    program = rigid.prepare(ask)
    program.warm()
    begun = time.process_time()
    program.solve()
    return figures(program, time.process_time() - begun)


def main() -> None:
    """Measure and judge."""
    parts = {name: solved(*part) for name, part in PARTS.items()}
    bars = {
        "residual at most 5e-6 m/s at every step": max(
            part["residual, largest [m/s]"] for part in parts.values()
        ) <= CREEPS,
        "at most 25 ms a step on one core": max(
            part["CPU [ms a step]"] for part in parts.values()
        ) <= 25,
        "penetration under 1 mm": max(
            part["penetration, largest [m]"] for part in parts.values()
        ) < 1e-3,
        "energy closed to 1e-3 of the work put in": max(
            part["energy unaccounted, of the work put in"] for part in parts.values()
        ) <= 1e-3,
        "base reaction at rest is the weight to 1e-8": abs(
            parts["at rest"]["base reaction at the end, of the weight, less 1"]
        ) <= 1e-8,
    }  # fmt: skip
    conclude("block-wall", parts, bars)


if __name__ == "__main__":
    main()
