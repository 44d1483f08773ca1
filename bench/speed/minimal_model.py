"""Measures how much the smallest model saves: T1 with one unknown, and with all terms."""

import time

import numpy as np

from bench.evidence import conclude
from cases.contact.single_contact import CASE
from tests.scenes.spheres.dem_contacts import forced
from vv.ask import Ask, Displacement, Knobs
from vv.engines import dem

MINIMUM = 3.0  # the least ratio of costs per step
AGREEMENT = 1e-13  # of max|y|


def nanoseconds_a_step(ask: Ask) -> float:
    """The wall nanoseconds per step, the minimum of many solves."""
    program = dem.prepare(ask, dem.CENTRED)
    program.warm()
    least = np.inf
    for _ in range(20):
        begun = time.perf_counter()
        program.solve()
        least = min(least, time.perf_counter() - begun)
    return float(least / ask.goal.steps(ask.knobs.dt or 1.0) * 1e9)


def main() -> None:
    """Measure and judge."""
    ask = CASE.declare("T1", CASE.defaults("T1")).study.ask(Knobs(dt=1e-5))
    least, full = (nanoseconds_a_step(question) for question in (ask, forced(ask)))
    one, all_ = (
        dem.solve_default(question).values[Displacement(1)][:, 1] for question in (ask, forced(ask))
    )
    apart = float(np.abs(one - all_).max() / np.abs(one).max())
    figures = {
        "one unknown [ns a step]": least,
        "every freedom and term [ns a step]": full,
        "ratio": full / least,
        "max difference over max|y|": apart,
    }
    bars = {
        f"at least {MINIMUM} times cheaper": full >= MINIMUM * least,
        f"the same to {AGREEMENT}": apart <= AGREEMENT,
    }
    conclude("minimal-model", figures, bars)


if __name__ == "__main__":
    main()
