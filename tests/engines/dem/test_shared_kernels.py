"""Claims about scenes that share a kernel, since they differ by cheap terms: answers agree."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from cases.blocks import incline
from cases.bonds import tetrahedral_unit, unlike_bonds
from cases.contact import bounce, single_contact
from cases.hard import galperin, resting, settling, shaken_corner, skid
from cases.impact import hertz_impact, kharaz, oblique_impact
from cases.stability import long_swing
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import dem
from vv.engines.dem.space.model import space
from vv.engines.dem.terms import near_contacts
from vv.engines.dem.terms.near_contacts import NearContacts
from vv.scene import Contact, Scene, Spheres, Wall

GROUPS = (
    ((bounce.CASE, "floor"), (bounce.CASE, "pair"), (bounce.CASE, "held"), (bounce.CASE, "again"),
     (resting.CASE, "still"), (resting.CASE, "held"), (kharaz.CASE, "linear")),
    ((hertz_impact.CASE, "glass"), (hertz_impact.CASE, "aluminium")),
    ((oblique_impact.CASE, "pair-alloy"), (kharaz.CASE, "hertz")),
    ((oblique_impact.CASE, "pair-alloy-linear"), (shaken_corner.CASE, "viscous")),
    ((single_contact.CASE, "T3-free"), (single_contact.CASE, "T4-free")),
    ((tetrahedral_unit.CASE, "gamma-0"), (unlike_bonds.CASE, "row")),
    ((tetrahedral_unit.CASE, "turning"), (unlike_bonds.CASE, "spinning")),
    ((single_contact.CASE, "T1"), (long_swing.CASE, "pressed")),
    ((single_contact.CASE, "T2"), (settling.CASE, "drop")),
    ((skid.CASE, "wall"), (incline.CASE, "gravity-10")),
)  # fmt: skip
UP = np.array([0.0, 0.0, 1.0])


def kernel_of(ask: Ask) -> Any:
    """The name of a kernel and the types of the arguments for which it is compiled."""
    program = dem.prepare(ask, dem.CENTRED)
    kernel: Any = program.system.kernel()
    return kernel.__name__, tuple(map(kernel.typeof_pyval, program.arguments))


def asked(case: Any, variant: str) -> Ask:
    study = case.declare(variant, case.defaults(variant)).study
    ask: Ask = study.ask(next(iter(study.rungs.values()))[0])
    return ask


@pytest.mark.parametrize("group", GROUPS, ids=lambda group: f"{group[0][0].name}:{group[0][1]}")
def test_scenes_of_a_kind_share_one_kernel(group: tuple[tuple[Any, str], ...]) -> None:
    assert len({kernel_of(asked(*one)) for one in group}) == 1


def test_what_steps_without_friction_and_rotation_is_no_dearer_for_those_with_them() -> None:
    smooth, rough = (asked(galperin.CASE, "31"), asked(kharaz.CASE, "linear"))
    assert kernel_of(smooth) != kernel_of(rough)


def test_spheres_that_bonds_hold_apart_ask_no_step_of_contacts() -> None:
    held, apart = (
        space(asked(case, variant).scene).state
        for case, variant in ((tetrahedral_unit.CASE, "turning"), (unlike_bonds.CASE, "spinning"))
    )
    squares = [
        near_contacts.highest_square(one.term(NearContacts), one.near, one.bodies)
        for one in (held, apart)
        if one.near is not None
    ]
    assert squares[0] == 0.0 < squares[1]


def viscous(mu: float, spins: bool) -> Ask:
    """Two spheres that collide obliquely on dashpots, with or without friction and rotation."""
    position = np.array([[0.0, 0.0, 0.0], [0.05, 0.0, 0.2]])
    free = np.ones((2, 3), bool)
    balls = Spheres(
        position, np.array([0.1, -1.0])[:, None] * UP, np.full(2, 0.1), np.ones(2), free
    )
    balls = dataclasses.replace(balls, free_spin=free & spins)
    contact = Contact(1e4, 1e4, mu, eta_n=5.0)
    return Ask(Scene((balls,), contact), History(0.05, 1e-4), (Displacement(1),), Knobs(1e-4))


def test_dashpots_ask_in_each_step_what_rubs_and_turns() -> None:
    asks = {(mu, spins): viscous(mu, spins) for mu in (0.0, 0.5) for spins in (False, True)}
    assert len({kernel_of(ask) for ask in asks.values()}) == 1
    ways = {key: dem.solve_default(ask).values[Displacement(1)] for key, ask in asks.items()}
    assert np.array_equal(ways[0.0, False], ways[0.0, True])
    for other in ((0.5, False), (0.5, True)):
        assert np.abs(ways[other] - ways[0.0, True]).max() > 1e-4
    assert np.abs(ways[0.5, False] - ways[0.5, True]).max() > 1e-4


def test_a_wall_far_away_changes_no_bit() -> None:
    ask = viscous(0.5, True)
    walled = Scene((Wall(-100.0 * UP, UP), *ask.scene.bodies), ask.scene.contact)
    far = dataclasses.replace(ask, scene=walled, observables=(Displacement(2),))
    assert kernel_of(far) == kernel_of(ask)
    alone, beside = dem.solve_default(ask), dem.solve_default(far)
    assert np.array_equal(alone.values[Displacement(1)], beside.values[Displacement(2)])
