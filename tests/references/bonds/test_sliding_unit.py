"""Claims about units whose contacts end: the rates of separation, and the energy that remains."""

from math import atan2, cos, hypot, sin

import numpy as np
import pytest

from cases.bonds.tetrahedral_strength import CASE
from reference_solutions.bonds import lattice_material, sliding_unit, tetrahedral_unit
from reference_solutions.bonds.lattice_material import QUARTZITE, Element
from reference_solutions.bonds.tetrahedral_unit import A0
from reference_solutions.checks.bonds import sliding_unit as by_work
from vv.ask import Ask, Knobs, Method
from vv.engines import dem

D, M = 1e-3, 1.87383297e-6
QUARTZ = lattice_material.element(QUARTZITE, D)
OTHER = Element(QUARTZ.kn, 6.4e6, 2.2e-7, 23.0, 0.3)


def contact(element: Element) -> tuple[float, float]:
    """Length [m] and angle [rad] of an inclined contact at the onset of sliding."""
    state = tetrahedral_unit.sliding_failure(element, D)
    r, z = D * sin(A0) * (1.0 + state.lateral), D * cos(A0) * (1.0 + state.strain)
    return hypot(r, z), atan2(r, z)


@pytest.mark.parametrize("element", [QUARTZ, OTHER])
@pytest.mark.parametrize("eta", [0.0, 2.0, 6.0])
@pytest.mark.parametrize("rate", [-7.5, -15.0])
def test_contacts_part_at_the_rates_of_virtual_work(
    element: Element, eta: float, rate: float
) -> None:
    """To the error of a step of the second route; viscosity reduces the rates."""
    found = sliding_unit.separation_rates(element, D, m=M, eta=eta, rate=rate)
    known = by_work.separation_rates(
        kn=element.kn, mu_p=element.mu_p, d=D, m=M, eta=eta, begin=contact(element),
        fall=abs(rate) * D * cos(A0), longest=2e-5,
    )  # fmt: skip
    assert known is not None
    assert found == pytest.approx(known, rel=0.03)


def test_contacts_that_viscosity_holds_do_not_end() -> None:
    assert sliding_unit.separation_rates(QUARTZ, D, m=M, eta=30.0, rate=-7.5) == (0.0, 0.0)


@pytest.mark.parametrize("dt", [4e-8, 2e-8, 1e-8])
def test_the_energy_that_parting_leaves_is_that_of_its_contacts(dt: float) -> None:
    """Also with bonds other than those of quartzite, which separate five times as fast."""
    given = {"ks": OTHER.ks, "xb": OTHER.xb, "fs0": OTHER.fs0, "mu_p": OTHER.mu_p}
    trial = CASE.declare("pressed", {**CASE.defaults("pressed"), **given})
    (balance,) = (q for q in trial.quantities if q.name == "balance")
    knobs = Knobs(dt=dt)
    run = dem.solve_default(
        Ask(trial.study.scene, trial.study.goal, trial.study.observables, knobs)
    )
    assert run.ledger is not None
    within = balance.judge.tolerances[Method.SECOND_ORDER].at(knobs)  # type: ignore[union-attr]
    assert run.ledger.unaccounted / run.ledger.peak < within < 5e-5 * (dt / 4e-8) ** 2


def test_a_step_is_the_series_of_a_linear_motion_up_to_the_fourth_power() -> None:
    """r'' = 2 z - 3 r and z' = -0.7; on linear equations Runge-Kutta's steps are this series."""
    h, start = 0.3, np.array([1.1, 0.4, -0.6, 1.0])
    by = h * np.array([[0, 1, 0, 0], [-3, 0, 2, 0], [0, 0, 0, -0.7], [0, 0, 0, 0]])
    series, term = start.copy(), start
    for k in range(1, 5):
        term = by @ term / k
        series += term
    r, v, z, _ = map(float, start)
    made = sliding_unit._stepped(lambda r, v, z: 2.0 * z - 3.0 * r, r, v, z, 0.7, h)
    assert made == pytest.approx(tuple(series[:3]), rel=1e-14)
