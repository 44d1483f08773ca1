"""Claims about boxes that fall on each other at random: every step of dda/default ends."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.scenes.blocks.dda_scenes import DOWN, FLOOR, box
from vv.ask import Ask, Displacement, History, Knobs, Status
from vv.engines.dda import DEFAULT, Formulation, prepare
from vv.engines.dda.general.energy import FAILED
from vv.scene import Block, Contact, Scene

PLANE, TURNING = np.array([True, False, True]), np.array([False, True, False])


def thrown(seed: int, count: int) -> tuple[Block, ...]:
    """A number of boxes above one another, none in contact with another, thrown and spinning."""
    chance, blocks, top = np.random.default_rng(seed), [], 0.0
    for _ in range(count):
        half = chance.uniform(0.1, 0.5, 3)
        top += float(np.linalg.norm(half))
        c, s = math.cos(turn := chance.uniform(0, 6.28)), math.sin(turn)
        blocks.append(
            box(
                (half[0], half[1], half[2]),
                chance.choice([500.0, 2500.0, 20000.0]),
                np.array([chance.uniform(-0.3, 0.3), 0.0, 1.1 * top]),
                np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
                PLANE,
                TURNING,
                np.array([chance.normal(), 0.0, chance.normal() - 2.0]),
                np.array([0.0, 2.0 * chance.normal(), 0.0]),
            )
        )
        top += float(np.linalg.norm(half))
    return tuple(blocks)


def unended(scene: Scene, dt: float, kn: float, way: Formulation) -> float:
    """The number of parts of steps accepted although contacts still changed; audits are checked."""
    program = prepare(Ask(scene, History(0.8, 0.02), (Displacement(1),), Knobs(dt, kn)), way)
    done = program.run(program.solve())
    assert done.status is Status.RAN, done.reason
    assert done.ledger is not None
    assert done.ledger.bound is not None
    assert done.ledger.unaccounted <= done.ledger.bound
    for law in ("Coulomb: friction beyond mu N [N]", "error of the momentum balance [N]"):
        seen, allowed = done.ledger.audits.get(law, (0.0, 0.0))
        assert seen <= allowed, law
    return float(program.arguments[2][-1, FAILED])


@settings(max_examples=15, suppress_health_check=[HealthCheck.too_slow])
@given(st.integers(0, 10**6), st.integers(2, 4), st.sampled_from([0.1, 0.4, 1.5]))
def test_no_step_ends_with_contacts_that_still_change(seed: int, count: int, mu: float) -> None:
    scene = Scene((FLOOR, *thrown(seed, count)), Contact(math.inf, mu=mu), gravity=DOWN)
    assert unended(scene, 1e-3, 1e7, DEFAULT) == 0


def test_newtons_iteration_is_what_ends_them() -> None:
    scene = Scene((FLOOR, *thrown(7, 4)), Contact(math.inf, mu=1.5), gravity=DOWN)
    without = dataclasses.replace(DEFAULT, newton=0, iterations=3)
    assert unended(scene, 1e-3, 1e7, without) > 0 == unended(scene, 1e-3, 1e7, DEFAULT)


def test_blocks_that_rest_on_nothing_stay_where_they_are_as_others_are_pressed() -> None:
    """Steps almost without inertia threw them through each other, which ended in an error."""
    for seed in (0, 5, 6, 7, 10, 13):
        blocks = thrown(seed, 3)
        scene = Scene((FLOOR, *blocks), Contact(math.inf, mu=0.4), gravity=DOWN)
        ask = Ask(scene, History(1e-3, 1e-3), (Displacement(1),), Knobs(1e-3, 1e7))
        assert prepare(ask, DEFAULT).solve() == 2
