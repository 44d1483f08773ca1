"""Measures the cost of a step of one rigid block: as a point mass, in general, and rotating.

`python -m bench.speed.block_steps` solves Newmark's sine and the responding block in three
directions. The general model is that of many blocks; its cost must stay low for a single one.
"""

import dataclasses
import time

import numpy as np

from bench.evidence import conclude
from tests.scenes.blocks.block_scenes import FREE, HELD, incline, responding
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import rigid
from vv.engines.rigid import PreparedRigidBlocks
from vv.engines.rigid.general.model import Space
from vv.scene import Harmonic, Scene

GENERAL, POINT = 200.0, 5.0  # us a step at most
FLAT = np.array([0.5, 0.5, 0.1])  # m, half sides: a block that slides before it tips
SINE = Harmonic(np.array([5.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))
THREE = ([0.1, 0.1, 0.1], [2.0, 4.0, 1.0])  # m, Hz
SCENES = {
    "sine": (
        incline(20, 30, SINE, half=FLAT, free_spin=HELD),
        incline(20, 30, SINE, half=FLAT, free_spin=FREE),
    ),
    "three directions": (
        responding(*THREE, 0.6, free_spin=HELD),
        responding(*THREE, 0.6, free_spin=FREE),
    ),
}


def microseconds(program: PreparedRigidBlocks) -> float:
    """The CPU microseconds per step, the minimum of five solves."""
    program.warm()
    least = np.inf
    for _ in range(5):
        begun = time.process_time()
        program.solve()
        least = min(least, time.process_time() - begun)
    return float(least / program.ask.goal.steps(program.ask.dt) * 1e6)


def programs(held: Scene, free: Scene) -> dict[str, PreparedRigidBlocks]:
    """The programs for the three models of one block."""
    ask = Ask(held, History(5.0, 0.01), (Displacement(1),), Knobs(1e-3))
    turning = dataclasses.replace(ask, scene=free)
    return {
        "point": rigid.prepare(ask),
        "general": PreparedRigidBlocks(ask, Space(held)),
        "general, free to turn": rigid.prepare(turning),
    }


def main() -> None:
    """Measure and judge."""
    costs = {
        f"{name}, {way} [us a step]": microseconds(program)
        for name, scenes in SCENES.items()
        for way, program in programs(*scenes).items()
    }
    points = [cost for name, cost in costs.items() if ", point" in name]
    general = [cost for name, cost in costs.items() if ", general" in name]
    bars = {
        f"a point mass takes at most {POINT} us a step": max(points) <= POINT,
        f"the general model takes at most {GENERAL} us a step": max(general) <= GENERAL,
    }
    conclude("block-steps", costs, bars)


if __name__ == "__main__":
    main()
