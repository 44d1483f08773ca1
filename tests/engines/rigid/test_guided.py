"""Claims about blocks in `rigid` that walls or locks guide while shaking acts across their path."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from cases.blocks.shaken_wedge import CASE
from cases.hard.wedge import WEDGE
from reference_solutions.checks.hard import shaken_wedge as stepped
from reference_solutions.hard import shaken_wedge
from tests.scenes.blocks.block_scenes import HELD, incline
from vv.ask import Ask, Displacement, History, Knobs, Status
from vv.engines import rigid
from vv.engines.rigid import PreparedRigidBlocks
from vv.engines.rigid.general.model import Space
from vv.scene import Block, Harmonic, Scene, Vector

HARDLY = {"dip": 33.2, "phi": 20.0, "xi": 1.18, "A": 1.92}  # friction almost holds the wedge


def way(dt: float, changes: dict[str, float]) -> tuple[Vector, Vector, dict[str, Any]]:
    """Times and displacement along the groove of a wedge shaken horizontally, and its exact law."""
    p = {**CASE.defaults("level"), **changes}
    scene = CASE.declare("level", p).study.scene
    run = rigid.solve(Ask(scene, History(3.0, 0.01), (WEDGE,), Knobs(dt)))
    assert run.status is Status.RAN, run.reason
    law = {name: p[name] for name in ("dip", "xi", "A", "f", "g")}
    return run.times, run.values[WEDGE] @ scene.axes[0], law | {"mu": scene.contact.mu}


@pytest.mark.parametrize("changes", [{}, HARDLY, {"dip": 40.0, "xi": 1.0, "A": 6.0}])
def test_a_sine_across_a_groove_does_not_turn_the_slip_along_it(changes: dict[str, float]) -> None:
    errors = []
    for dt in (1e-3, 5e-4, 2.5e-4):
        times, s, law = way(dt, changes)
        exact = shaken_wedge.level(times, **law)
        errors.append(np.abs(s - exact).max() / np.abs(exact).max())
    assert errors[0] <= 1e-5
    assert np.log2(errors[0] / errors[-1]) / 2 >= 1.8


def test_a_second_route_says_the_same_of_a_wedge_that_friction_all_but_holds() -> None:
    times, s, law = way(2.5e-4, HARDLY)
    other = stepped.slid(times[-1], level=True, steps=100_000, **law)
    assert other == pytest.approx(s[-1], rel=1e-7)


def locked(across: float) -> Scene:
    """A cube on a slope that is shaken along the dip, and across it, where the cube is locked."""
    amplitude, frequency = np.array([2.0, across, 0.0]), np.array([1.0, 2.0, 0.0])
    scene = incline(45, 50, Harmonic(amplitude, frequency), free_spin=HELD)
    bodies = tuple(
        dataclasses.replace(body, free=np.array([True, False, True]))
        if isinstance(body, Block)
        else body
        for body in scene.bodies
    )
    return dataclasses.replace(scene, bodies=bodies)


@pytest.mark.parametrize("small", [True, False])
def test_what_shakes_a_block_where_it_is_locked_moves_nothing(small: bool) -> None:
    paths = []
    for across in (0.0, 1.0):
        ask = Ask(locked(across), History(2.0, 0.01), (Displacement(1),), Knobs(1e-3))
        program = rigid.prepare(ask) if small else PreparedRigidBlocks(ask, Space(ask.scene))
        paths.append(program.run(program.solve()).values[Displacement(1)])
    assert np.abs(paths[1] - paths[0]).max() <= 1e-12 * np.abs(paths[0]).max()
