"""Claims about a gas of spheres: means over seeds agree with theory, errors are detected."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable

import numpy as np
import pytest

from cases.bulk import homogeneous_cooling as gas
from reference_solutions.bulk import cooling
from vv.ask import Run, Status
from vv.case import Level, Scalar
from vv.engines import dem
from vv.scene import Contact

SEEDS = range(1, 13)
STUDENT = 3.11  # Student's t of 99 % for twelve draws
LEFT_OUT = 0.03  # neglected by theory: 1 - e^2 times the share of the walls, 0.19 x 0.18


@functools.cache
def seen(variant: str, damping: float = 1.0) -> dict[str, float]:
    """The ratio of each unrounded quantity of a variant to its reference."""
    p = gas.CASE.defaults(f"{variant.partition('-')[0]}-1")
    trial = gas.CASE.declare(variant, p)
    ask = trial.study.ask(trial.study.rungs[Level.DEFAULT][0])
    scene = ask.scene
    law = Contact(scene.contact.kn, eta_n=damping * scene.contact.eta_n)
    run = dem.solve_default(dataclasses.replace(ask, scene=dataclasses.replace(scene, contact=law)))
    assert run.status is Status.RAN, run.reason
    observed: dict[str, Callable[[Run], float]] = {
        "cooling rate": functools.partial(gas.cooling_rate, scene),
        "contacts": functools.partial(gas.contacts, scene),
        "flatness": gas.flatness,
        "energy": functools.partial(gas.energy, p, scene),
    }
    return {
        one.name: over(one, observed[one.name], run)
        for one in trial.quantities
        if isinstance(one, Scalar)
    }


def over(scalar: Scalar, observe: Callable[[Run], float], run: Run) -> float:
    assert isinstance(scalar.reference, float)
    return float(observe(run)) / scalar.reference


@pytest.mark.parametrize(
    ("kind", "name", "left_out"),
    [("viscous", "cooling rate", LEFT_OUT), ("elastic", "contacts", 0.0),
     ("elastic", "flatness", 0.0), ("elastic", "energy", 1e-3)],
)  # fmt: skip
def test_the_mean_over_seeds_is_what_theory_says(kind: str, name: str, left_out: float) -> None:
    draws = np.array([seen(f"{kind}-{seed}")[name] for seed in SEEDS])
    doubt = STUDENT * draws.std(ddof=1) / np.sqrt(len(draws))
    assert doubt < 0.05
    assert abs(draws.mean() - 1) < left_out + doubt


def test_a_dashpot_a_fifth_too_weak_is_seen_in_each_seed() -> None:
    for seed in (1, 2, 3):
        assert seen(f"viscous-{seed}", 0.8)["cooling rate"] < 1 - 0.5 * gas.RATE


def test_what_is_chance_does_not_move_what_is_told() -> None:
    assert gas.to_nearest(1.04 * 7, 0.1, 7.0) == gas.to_nearest(0.96 * 7, 0.1, 7.0) == 7.0
    assert gas.to_nearest(1.06 * 7, 0.1, 7.0) == pytest.approx(1.1 * 7)


def test_spheres_that_only_fly_on_would_stay_at_one_speed() -> None:
    """At a single speed the flatness is 1, far outside the tolerance about the correct value."""
    p = gas.CASE.defaults("elastic-1")
    speeds = (gas.scene_of(1, p).spheres.velocity ** 2).sum(axis=1)
    assert speeds.max() == pytest.approx(speeds.min())
    assert cooling.flatness(gas.COUNT) * (1 - 0.5 * gas.SPREAD) > 1.5


def test_contacts_hold_half_as_much_as_their_temperature_of_all_that_the_gas_has() -> None:
    """The mean energy is T/2 in the spring of a contact and 3 T/2 in the motion of a sphere."""
    p = gas.CASE.defaults("elastic-1")
    (met, *_) = gas.CASE.declare("elastic-1", p).quantities
    assert isinstance(met, Scalar)
    assert isinstance(met.reference, float)
    whole = 1.5 * gas.COUNT * p["m"] * p["v"] ** 2
    temperature = whole / (1.5 * gas.COUNT + 0.5 * met.reference)
    found = cooling.gas(
        gas.COUNT, side=gas.SIDE, d=2 * gas.RADIUS, m=p["m"], kn=p["kn"], temperature=temperature
    )
    due = cooling.touching(found, m=p["m"], kn=p["kn"])
    assert met.reference == pytest.approx(due, rel=1e-4)  # its own search is accurate to 1e-5


@pytest.mark.parametrize("variant", ["viscous-1", "elastic-1"])
def test_a_gas_in_other_units_of_time_and_mass_is_the_same_gas(variant: str) -> None:
    """A unit of time is halved, then one of mass divided by three."""
    p = gas.CASE.defaults(variant)
    first = gas.CASE.declare(variant, p)
    powers = {"cooling rate": (1, 0), "contacts": (0, 0), "flatness": (0, 0), "energy": (2, 1)}
    for faster, heavier in ((2.0, 1.0), (1.0, 3.0)):
        law = {"v": faster * p["v"], "m": heavier * p["m"], "kn": faster**2 * heavier * p["kn"]}
        other = gas.CASE.declare(variant, {**p, **law})
        assert other.study.goal.duration == pytest.approx(first.study.goal.duration / faster)
        assert other.study.goal.interval == pytest.approx(first.study.goal.interval / faster)
        for one, same in zip(other.quantities, first.quantities, strict=True):
            assert isinstance(one, Scalar)
            assert isinstance(same, Scalar)
            of_time, of_mass = powers[one.name]
            assert isinstance(same.reference, float)
            assert one.reference == pytest.approx(
                faster**of_time * heavier**of_mass * same.reference, rel=1e-9
            )
