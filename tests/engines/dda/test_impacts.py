"""Claims about impacts in dda: the rebound is that of its springs, by an independent route."""

from __future__ import annotations

import math

import numpy as np
import pytest

from cases.blocks.rocking import CASE as SHAKEN
from cases.blocks.rocking_restitution import CASE as ROCKING
from tests.scenes.blocks.dda_scenes import closes, run
from vv.ask import Knobs
from vv.case import Case
from vv.engines.dda import BORNE, DEFAULT, LAGGED, prepare, solve
from vv.engines.dda.formulation import Formulation
from vv.plan.project import find
from vv.scene import Vector
from vv.standins.stand_in import SHEAR

CASE = find().load_case("painleve")
P = CASE.defaults("mu-2")
KN = 1e8


def on_springs(duration: float, dt: float) -> Vector:
    """The displacement (x, z) [m] of the middle of Painleve's rod, with springs KN and SHEAR KN.

    A rod of mass m and length 2 l rotates about y through its middle, by Euler steps.
    """
    m, half, mu, g = P["m"], P["half"], P["mu"], P["g"]
    ks, inertia = SHEAR * KN, P["m"] * P["half"] ** 2 / 3
    turn, spin, shear = math.atan(P["slope"]), 0.0, 0.0
    x, z = half * math.cos(turn), half * math.sin(turn)
    start = x, z
    vx, vz = -P["V"], 0.0
    for _ in range(round(duration / dt)):
        c, s = math.cos(turn), math.sin(turn)
        push = max(0.0, -KN * (z - half * s))
        shear += dt * (vx + half * s * spin)  # the end is at the middle less half (c, s)
        if push == 0.0:
            shear = 0.0
        pull = max(-mu * push, min(mu * push, -ks * shear))
        shear = -pull / ks
        vx += dt * pull / m
        vz += dt * (push / m - g)
        spin += dt * (pull * half * s - push * half * c) / inertia
        x, z, turn = x + dt * vx, z + dt * vz, turn + dt * spin
    return np.array([x - start[0], z - start[1]])


@pytest.mark.shows(
    "`dda` rebounds from it, because springs return an impact",
    "Finer steps dissipate less of it, and converge to the motion on springs",
)
def test_the_rebound_of_a_rod_that_jams_is_that_of_its_springs_and_damped_by_the_step() -> None:
    """It does not vanish with the step: rigid contact with restitution zero is another law."""
    study = CASE.declare("mu-2", P).study
    duration = study.goal.duration
    due, ends = on_springs(duration, 1e-6), []
    for dt in (1e-4, 2e-5, 5e-6):
        ask = study.ask(Knobs(dt, KN))
        program = prepare(ask, DEFAULT)
        done = program.run(program.solve())
        ends.append(done.values[ask.observables[0]][-1, [0, 2]])
    off = np.linalg.norm(np.array(ends) - due, axis=1) / np.linalg.norm(due)
    assert off[2] < off[1] < off[0]
    assert off[2] < 2e-3


def test_passes_of_multipliers_end_with_the_solution_of_equations_and_not_beside_it() -> None:
    """Springs may carry nothing for unknowns that Newton's iteration has not found yet."""
    closes(run(CASE.declare("mu-2", P).study.ask(Knobs(2.5e-4, KN)), BORNE))


@pytest.mark.parametrize(
    ("case", "variant", "given", "way", "most"),
    [
        (ROCKING, "aspect-3", {"b": 0.13, "h": 0.41}, DEFAULT, 1e-9),
        (SHAKEN, "threshold", {"b": 0.006}, LAGGED, 1e-8),
    ],
)
def test_forces_that_stiff_springs_make_of_rounding_are_in_the_bound_of_the_energy(
    case: Case, variant: str, given: dict[str, float], way: Formulation, most: float
) -> None:
    p = {**case.defaults(variant), **given}
    ask = case.declare(variant, p).study.ask(Knobs(1e-3, 1e10))
    done = solve(ask, way)
    assert done.ledger is not None
    assert done.ledger.bound is not None
    assert done.ledger.unaccounted <= done.ledger.bound <= most * done.ledger.peak
