"""What happens to the energy of a block of 2166 elements that is pulled in two (Liu et al. 2017).

`python -m bench.lattice_failure` carries the platens apart at Eq. 28's viscosity and the paper's
step, 1e-8 s, but at some 20 times its rate of loading, 1.7e-10 m in 100 steps. It prints what the
paper's Fig. 6b and text report beside what is found, and keeps the curves in
.vv/bench-lattice-failure.csv.
"""

import sys
from pathlib import Path

import numpy as np

from bench.evidence import conclude
from cases.close_packed_strength import CASE, specimen
from reference_solutions.close_packed_lattice import SIZES, lattice
from vv import dem
from vv.ask import Ask, History, Knobs, Reaction
from vv.dem.rows import Index
from vv.scene import Scene, Vector

SIZE, DT, EVERY = 2166, 1e-8, 1e-7
BALANCE = 1e-4  # of the work, that may be unaccounted for
NAMES = ("kinetic", "normal", "shear", "friction", "viscous", "gravity", "loads", "shaking",
         "walls", "work", "broken normal", "broken shear")  # fmt: skip
"""Columns of the ledger over time [J]; work with its sign turned."""


def solved(scene: Scene, top: Index, area: float, end: float) -> tuple[Vector, Vector, Vector]:
    """Times (k,) [s], stress (k,) [Pa] on the platen, and the ledger (k, 12) [J]."""
    ask = Ask(scene, History(end, EVERY), tuple(Reaction(int(i)) for i in top), Knobs(DT))
    program = dem.prepare(ask, dem.CENTRED)
    run = program.run(program.solve())
    path, energy = program.arguments[:2]
    force = np.sum([run.values[what][:, 2] for what in ask.observables], axis=0)
    return run.times, force / area, program.system.held(path, energy)


def main(size: int = SIZE) -> None:
    """Measure and judge."""
    p = CASE.defaults("pulled-82")
    block = lattice(*SIZES[size], p["d"])
    scene = specimen(p, block, (1.0,))
    end = 3.0e-4 / p["rate"]
    times, stress, held = solved(scene, np.flatnonzero(block.at(2, 1)), block.area, end)
    held[:, 9] *= -1.0
    kinetic, work, broken = held[:, 0], held[:, 9], held[:, 10:].sum(axis=1)
    gap = np.abs(np.delete(held, 9, axis=1).sum(axis=1) - work - kinetic[0])
    parting = np.flatnonzero((broken > 0.01 * broken[-1]) & (broken < 0.99 * broken[-1]))
    last = int(stress.argmax())
    elastic = held[last, 1:3].sum()
    table = np.column_stack([times, stress, held])
    Path(".vv").mkdir(exist_ok=True)
    head = ",".join(("time", "stress", *NAMES))
    np.savetxt(".vv/bench-lattice-failure.csv", table, delimiter=",", header=head, comments="")
    figures = {
        "elements": size,
        "T_u over Eq. 7, less 1 (paper: -0.0889 on average)": stress[last] / 25e6 - 1,
        "largest kinetic energy over work (paper: 0.162)": kinetic.max() / work[kinetic.argmax()],
        "largest kinetic energy over elastic energy at failure": kinetic.max() / elastic,
        "bonds part for [s] (paper: the crack crosses in 2.83e-6)": float(np.ptp(times[parting])),
        "elastic energy at failure that bonds take as they part": broken[-1] / elastic,
        "of it, in normal springs": held[-1, 10] / broken[-1],
        "energy unaccounted for over work": float(gap.max() / work.max()),
    }
    closed = figures["energy unaccounted for over work"] <= BALANCE
    conclude("lattice-failure", figures, {f"energy closes to {BALANCE:g} of the work": closed})


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
