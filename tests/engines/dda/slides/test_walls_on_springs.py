"""Claims about a high wall that slides on springs, which no rigid wall follows.

All joints of such a wall are at Coulomb's limit, and friction makes springs without damping
vibrate: normal forces change, and courses creep on one another. A separate explicit integration of
the same springs shows it, so that it is no error of the steps of `dda`, which damp it if long.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from cases.blocks.masonry import BED, CASE
from reference_solutions.blocks import responding_block
from tests.support.plain import plain
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import dda
from vv.engines.dda.general import bodies as kernels
from vv.engines.dda.general import contact
from vv.engines.dda.springs import springs
from vv.scene import Vector

KN, MU, DURATION = 1e9, 0.167, 0.04  # N/m, -, s
SHARE = 0.25  # of the largest stable step, 2/w of the stiffest mode
P = {**CASE.defaults("slides"), "courses": 12.0, "mu": MU, "duration": DURATION}


def prepared(dt: float) -> dda.PreparedBlocks:
    """The wall, prepared for steps dt [s]."""
    scene = CASE.declare("slides", P).study.ask(Knobs(dt, KN)).scene
    seen = tuple(Displacement(body) for body in range(len(scene.bodies)) if body != BED)
    return dda.prepare(Ask(scene, History(DURATION, DURATION), seen, Knobs(dt, KN)), dda.DEFAULT)


def in_dda(dt: float) -> Vector:
    """The displacement along the base of each block at the end [m]."""
    program = prepared(dt)
    run = program.run(program.solve())
    return np.array([run.values[what][-1, 0] for what in program.ask.observables])


def start() -> tuple[Any, Any, Vector, float]:
    """The unknowns, contact points, masses (q, q) and shear stiffness [N/m] at the start."""
    program = prepared(1e-3)
    model: Any = program.system
    law = springs(model.scene, KN, dda.DEFAULT)
    initial, setting = model.pressed(law), model.setting(1.0, law)
    bodies, walls = setting.bodies, np.zeros((len(model.scene.walls), 3))
    none = plain(contact.contact_arrays)(0)
    touch = plain(contact.find_contacts)(none, setting, initial, walls)
    plain(contact.close_initial)(touch, initial.strain, setting.law)
    q = len(initial.velocity)
    rows, mass = np.zeros((q, 12)), np.zeros((q, q))
    plain(kernels.fill_masses)(rows, bodies, initial)
    for one, end in zip(bodies.start, bodies.start[1:], strict=False):
        mass[one:end, one:end] = rows[one:end, : end - one]
    return bodies, touch, mass, law.ks or 0.0


def on_springs() -> Vector:
    """As `in_dda`, by explicit steps of the springs without damping, with geometry of the start."""
    bodies, touch, mass, ks = start()
    along = np.stack([touch.normal[:, 2], 0 * touch.gap, -touch.normal[:, 0]], axis=1)
    opens, slips = np.zeros((2, len(touch.key), len(mass)))
    for k, count in enumerate(touch.columns):
        np.add.at(opens[k], touch.column[k, :count], touch.field[k, :count] @ touch.normal[k])
        np.add.at(slips[k], touch.column[k, :count], touch.field[k, :count] @ along[k])
    owner = np.repeat(np.arange(len(bodies.mass)), np.diff(bodies.start))
    heavy = bodies.mass[owner, None] * bodies.line
    stiffness = KN * opens.T @ opens + ks * slips.T @ slips
    fastest = math.sqrt(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real.max())
    steps = math.ceil(DURATION * fastest / (2 * SHARE))
    dt, w, inverse = DURATION / steps, 2 * math.pi * P["f"], np.linalg.inv(mass)
    moved, speed, spring = np.zeros(len(mass)), np.zeros(len(mass)), (touch.spring * along).sum(1)
    slid = slips @ moved
    for step in range(steps):
        push = KN * np.maximum(0.0, -touch.gap - opens @ moved)
        slid, before = slips @ moved, slid
        spring = np.clip(spring + slid - before, -MU * push / ks, MU * push / ks)
        shaken = P["D"] * w**2 * math.cos(w * step * dt)
        force = push @ opens - ks * spring @ slips - heavy @ [shaken, 0.0, P["g"]]
        speed += dt * (inverse @ force)
        moved += dt * speed
    return np.asarray([bodies.line[owner == i, 0] @ moved[owner == i] for i in np.unique(owner)])


@pytest.mark.shows(
    "friction makes springs without damping vibrate",
    "This is the motion of the springs and no error of the step",
)
def test_fine_steps_converge_to_the_motion_on_springs_and_not_to_a_rigid_wall() -> None:
    right, t = on_springs(), np.array([0.0, DURATION])
    rigid = responding_block.one_direction(t, D=P["D"], f=P["f"], mu=MU, g=P["g"])
    rigid -= responding_block.base(t, D=P["D"], f=P["f"])
    creeps = np.abs(right - rigid[-1]).max()
    off = [np.abs(in_dda(dt) - right).max() / creeps for dt in (5e-4, 1e-4, 2e-5)]
    assert 5e-4 < creeps < 7e-4
    assert off[0] > 2 * off[1] > 3 * off[2]
    assert off[2] < 0.1
