"""Measures the cost of a step of a bonded lattice in dem and in YADE, in the same run.

`python -m bench.speed.bonded_lattice` steps blocks of quartzite with bonds that never break,
without contacts, and with bonds that may break and then have friction. YADE has no model of the
first kind: at each step it checks whether bonds break and searches for contacts, so that it is
comparable with the second.
"""

import json
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

from adapters.yade.installed import PYTHON, find
from bench.evidence import conclude
from reference_solutions.bonds.close_packed_lattice import SIZES, Lattice, lattice
from vv.engines.dem.space.model import space
from vv.scene import Bonds, Contact, Scene, Spheres

KN, KS, M, D, SPEED, DT = 46793831.1079, 8067901.91516, 1.87383297e-6, 1e-3, 1e-2, 1e-8
MU, KINDS = 0.396446609, {"lasting": np.inf, "breakable": 1e3}  # strengths [N] of bonds
TIMES = {
    2166: 12.0,
    10985: 12.0,
    37681: 20.0,
}  # the least speed-up over YADE
WORK, YADES_WORK = 6e6, 1e6  # particle-steps in a run
LOSS = 1e-9  # relative change of the energy in a run


def scene(block: Lattice, strength: float) -> Scene:
    """Free elements at random velocities; bonds of a tensile and shear strength [N]."""
    n = len(block.position)
    velocity = np.random.default_rng(1).normal(size=(n, 3)) * SPEED
    free = np.ones((n, 3), bool)
    spheres = Spheres(block.position, velocity, np.full(n, D / 2), np.full(n, M), free)
    values = (D, KN, KS, strength, strength)
    bonds = Bonds(block.bonds, *(np.full(len(block.bonds), value) for value in values))
    return Scene((spheres,), Contact(KN, KS, MU), bonds=bonds)


def ours(block: Lattice, strength: float) -> tuple[float, float]:
    """The CPU seconds of a step, minimum of three runs, and the relative change of the energy."""
    system = space(scene(block, strength))
    steps = int(WORK / len(block.position))
    path, energy, watched = system.outputs(2, (0,))
    given = (watched, steps, DT, *system.state, 0.5, 0.5)
    move = system.kernel()
    move(path[:1], energy[:1], *given)
    seconds = []
    for _ in range(3):
        begun = time.process_time()
        move(path, energy, *given)
        seconds.append(time.process_time() - begun)
    held = energy[:, :3].sum(axis=1)
    return min(seconds) / steps, float(abs(held[1] / held[0] - 1))


def yades(block: Lattice) -> float:
    """The CPU seconds of a step of YADE, which must have found the same bonds."""
    script, steps = (
        Path(__file__).with_name("yade_lattice.py"),
        int(YADES_WORK / len(block.position)),
    )
    with tempfile.TemporaryDirectory() as folder:
        centres, out = Path(folder) / "centres.npy", Path(folder) / "out.json"
        np.save(centres, block.position)
        command = [str(word) for word in (PYTHON, script, centres, steps, out)]
        subprocess.run(
            command, check=True, capture_output=True, timeout=300,
            env={"HOME": folder, "TMPDIR": folder, "VV_YADE": find().path},
        )  # fmt: skip
        answer = json.loads(out.read_text())
    assert answer["bonds"] == len(block.bonds)
    return float(answer["seconds"]) / steps


def main() -> None:
    """Measure and judge."""
    figures, bars = {}, {}
    for n, least in TIMES.items():
        block = lattice(*SIZES[n], D)
        theirs = yades(block) if find().installed else None
        if theirs is not None:
            figures[f"{n}: YADE, million particle-steps a second"] = n / theirs / 1e6
        for kind, strength in KINDS.items():
            seconds, lost = ours(block, strength)
            figures[f"{n}, {kind}: million particle-steps a second"] = n / seconds / 1e6
            figures[f"{n}, {kind}: million bonds a second"] = len(block.bonds) / seconds / 1e6
            bars[f"{n}, {kind}: energy is kept to {LOSS:g}"] = lost <= LOSS
            if theirs is not None:
                figures[f"{n}, {kind}: times YADE"] = theirs / seconds
                bars[f"{n}, {kind}: at least {least:g} times YADE"] = theirs / seconds >= least
    conclude("bonded-lattice", figures, bars)


if __name__ == "__main__":
    main()
