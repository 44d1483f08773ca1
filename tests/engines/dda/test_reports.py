"""Claims about what a run of DDA reports beside its motion: worst steps, bounds, divergence."""

from __future__ import annotations

import dataclasses
import re
from typing import Any

import numpy as np
import pytest

from tests.scenes.blocks.dda_scenes import (
    DOWN,
    FLOOR,
    asked,
    box,
    general,
    moved,
    run,
    shaken,
    slope,
)
from vv.ask import Ask, Run
from vv.engines.dda import BORNE, DEFAULT, LAGGED, Formulation
from vv.engines.dda.general import rows
from vv.engines.dda.general.energy import KINETIC, NORMAL, SHEAR, STRAIN, TERMS
from vv.engines.dda.solve import HELD, prepare
from vv.engines.dda.stepping import generalised_alpha
from vv.engines.kernels.compiled import compiled
from vv.scene import Contact, Harmonic, Scene, Vector

WORST = re.compile(
    r"friction off by (.*) N, (.*) iterations, penetration (.*) m, (.*) N beyond mu N; "
    r"(.*) solutions, (.*) cuts, (.*) parts"
)


def thrice_shaken(duration: float) -> Ask:
    return asked(shaken((0.1, 0.1, 0.1), (2, 4, 1), 0.6), 1e-3, 1e9, duration)


def worst(done: Run) -> list[float]:
    """The numbers of the note on the worst step."""
    found = WORST.search(done.model.note if done.model else "")
    assert found is not None
    return [float(number) for number in found.groups()]


@pytest.mark.parametrize("way", [DEFAULT, LAGGED])
def test_both_routes_report_the_same_of_their_worst_step(way: Formulation) -> None:
    """Both are written for themselves; what friction that lags is off by is far from rounding."""
    ask = thrice_shaken(1.0)
    one, other = worst(run(ask, way)), worst(general(ask, way))
    peak = 1e5  # N
    assert one == pytest.approx(other, rel=1e-2, abs=1e-14 * peak)
    assert (one[0] > 100.0) == (way is LAGGED)


def test_solutions_count_whether_an_iteration_or_newton_s_method_takes_them() -> None:
    """Where a slide keeps its line both take as many."""
    early = dataclasses.replace(DEFAULT, iterations=1)
    one, other = (worst(general(thrice_shaken(0.1), way)) for way in (DEFAULT, early))
    assert one[1] == other[1] == 3
    assert one[4] == other[4] >= 200


@compiled
def has_diverged(ledger: Vector, most: float) -> bool:
    return rows.diverged(ledger, most)


@pytest.mark.parametrize("kind", [KINETIC, NORMAL, SHEAR, STRAIN])
@pytest.mark.parametrize(
    ("held", "over"), [(9.0, False), (10.0, False), (11.0, True), (np.inf, True), (np.nan, True)]
)
def test_a_run_diverges_by_any_energy_that_exceeds_what_was_put_in(
    kind: int, held: float, over: bool
) -> None:
    ledger = np.zeros(TERMS)
    ledger[kind] = held
    assert has_diverged(ledger, 10.0) is over


def test_a_divergence_is_told_by_its_step_its_time_and_its_energy() -> None:
    prepared = prepare(thrice_shaken(0.1), DEFAULT)
    goal, dt = prepared.ask.goal, prepared.ask.dt
    energy = np.zeros((5, 13))
    energy[3, HELD] = 4.0
    step = 3 * goal.stride(dt)
    held = energy[3, HELD].sum()
    why = prepared._why(energy, 3)
    assert why.startswith(f"by step {step}, t = {step / round(1 / dt):.6g} s: {held:g} J")
    energy[3, KINETIC] = np.nan
    assert prepared._why(energy, 3).endswith("the state is not finite")


def test_forces_that_are_in_the_momentum_alone_do_work_along_the_way_of_the_quickest_block() -> (
    None
):
    """3 N over 0.1 s at the speed at which all kinetic energy is in the block."""
    prepared = prepare(thrice_shaken(0.1), DEFAULT)
    report = np.zeros(9)
    report[7] = 3.0
    lightest = min(one.mass for one in prepared.ask.scene.blocks)
    speed = np.sqrt(2 * 8.0 / lightest)
    assert prepared._worked(report, 8.0) == pytest.approx(3.0 * 0.1 * speed)
    lagged = dataclasses.replace(prepared, formulation=LAGGED)
    assert lagged._worked(report, 8.0) == prepared._worked(report, 8.0)


def test_what_sticks_is_told_from_what_should_slip() -> None:
    """A block that friction holds on a slope takes hardly more than one solution a step."""
    done = run(asked(slope(20, 25), 1e-3, 1e8, 0.05), BORNE)
    *_, solutions, cuts, failed = worst(done)
    assert (cuts, failed) == (0.0, 0.0)
    assert 50 <= solutions < 2 * 50


def test_a_step_of_generalised_alpha_has_the_published_coefficients() -> None:
    """For a spectral radius of 0.8, by hand from Eqs. 17, 20 and 25."""
    found = generalised_alpha(0.8)
    assert (found.alpha_m, found.alpha_f) == pytest.approx((1 / 3, 4 / 9))
    assert (found.beta, found.gamma) == pytest.approx((25 / 81, 11 / 18))


@pytest.mark.parametrize("route", [run, general])
def test_a_block_that_sticks_is_carried_by_a_base_that_moves(route: Any) -> None:
    base = Harmonic(np.array([1e-3, 0.0, 0.0]), np.array([2.0, 0.0, 0.0]), np.zeros(3))
    rate = 2 * np.pi * 2.0 * 1e-3 * np.array([1.0, 0.0, 0.0])
    carried = dataclasses.replace(box((0.5, 0.5, 0.5), 2000.0), velocity=rate)
    scene = Scene(
        (dataclasses.replace(FLOOR, motion=base), carried), Contact(np.inf, mu=0.6), gravity=DOWN
    )
    done = route(asked(scene, 1e-3, 1e9, 0.5), DEFAULT)
    due = 1e-3 * np.sin(4 * np.pi * done.times)
    assert np.abs(moved(done)[:, 0] - due).max() <= 1e-2 * 1e-3
