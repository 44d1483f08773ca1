"""Claims about blocks that rotate freely in DDA, against Euler's equations of a rigid body."""

from __future__ import annotations

import functools

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from adapters.dda import ADAPTER
from cases.blocks.rocking import CASE as ROCKING
from tests.findings.figures import asked
from tests.scenes.blocks.block_scenes import box
from vv.ask import Ask, Displacement, History, Knobs
from vv.case import Series
from vv.codes import unsupported
from vv.engines.dda import DEFAULT, PUBLISHED, Formulation, prepare
from vv.engines.dda.general.bodies import Motion
from vv.gate.judgement import breaches
from vv.scene import Contact, Scene, Term, Vector

HALF = np.array([0.3, 0.2, 0.4])  # m: inertia is least about z, greatest about y
FLIP = np.array([5.0, 0.2, 0.0])  # 1/s: about the intermediate axis, and slightly oblique


@functools.cache
def euler(spin: tuple[float, ...], duration: float) -> Vector:
    """The rotation (3, 3) of a box with this initial spin: dL/dt = 0, L = R I R^T w."""
    inertia = box("free", np.zeros(3), HALF).inertia
    moment = inertia @ spin

    def rate(t: float, flat: Vector) -> Vector:
        r = flat.reshape(3, 3)
        w = r @ np.linalg.solve(inertia, r.T @ moment)
        return np.asarray(np.cross(w, r, axisb=0, axisc=0).ravel())

    end = solve_ivp(rate, (0.0, duration), np.eye(3).ravel(), "DOP853", rtol=1e-12, atol=1e-12)
    return np.asarray(end.y[:, -1].reshape(3, 3))


def spun(
    spin: Vector, duration: float, dt: float, way: Formulation = DEFAULT
) -> tuple[Vector, Vector, Vector]:
    """Rotation, angular momentum [kg m2/s] and kinetic energy [J] of the box in DDA at the end."""
    block = box("free", np.zeros(3), HALF, spin=spin)
    goal = History(duration, duration)
    scene = Scene((block,), Contact(np.inf))
    program = prepare(Ask(scene, goal, (Displacement(0),), Knobs(dt, 1e8)), way)
    program.solve()
    end = [part for part in program.arguments if isinstance(part, Motion)][-1]
    rotation = np.asarray(np.linalg.lstsq(block.vertices, end.vertex, rcond=None)[0].T)
    inertia = np.trace(end.second[0]) * np.eye(3) - end.second[0]
    ledger = program.run(2).ledger
    assert ledger is not None
    assert ledger.bound is not None
    assert ledger.unaccounted <= ledger.bound
    return rotation, inertia @ end.velocity[3:], np.array(ledger.terms["kinetic"])


@pytest.mark.parametrize("spin", [(1.0, 5.0, 2.0), (-3.0, 0.5, 4.0)])
def test_a_free_box_turns_as_eulers_equations_say_to_second_order(spin: tuple[float, ...]) -> None:
    block = box("free", np.zeros(3), HALF)
    moment, energy = block.inertia @ spin, 0.5 * np.dot(spin, block.inertia @ spin)
    off, lost = [], []
    for dt in (1e-2, 5e-3, 2.5e-3):
        rotation, kept, kinetic = spun(np.array(spin), 1.0, dt)
        assert np.abs(kept - moment).max() <= 1e-12 * np.linalg.norm(moment)
        off.append(np.abs(rotation - euler(spin, 1.0)).max())
        lost.append(abs(float(kinetic) - energy) / energy)
    assert off[-1] <= 1e-3
    for errors in (off, lost):
        assert np.log2(errors[0] / errors[-1]) / 2 == pytest.approx(2.0, abs=0.1)


def test_a_box_spun_about_its_middle_axis_turns_over() -> None:
    """That axis is reversed after 5 s, as Euler's equations say, and halfway at 2.6 s."""
    for time, points in ((2.6, 0.0), (5.0, -1.0)):
        rotation, _, _ = spun(FLIP, time, 2e-3)
        assert rotation[0, 0] == pytest.approx(points, abs=0.02)
        assert np.abs(rotation - euler(tuple(FLIP), time)).max() <= 5e-4


@pytest.mark.shows(
    "A box of 0.6 x 0.4 x 0.8 m thrown with the spin (1, 5, 2) 1/s keeps that spin, and its "
    "angular momentum is 14 % off after 1 s",
    "`dda/published` rotates free blocks in space without gyroscopic torque",
)
def test_the_published_step_has_no_gyroscopic_torque_and_says_so() -> None:
    """Its spin remains constant, while its angular momentum rotates with it."""
    spin = np.array([1.0, 5.0, 2.0])
    block = box("free", np.zeros(3), HALF, spin=spin)
    _, kept, _ = spun(spin, 1.0, 1e-4, PUBLISHED)
    moment = block.inertia @ spin
    assert kept == pytest.approx(Rotation.from_rotvec(spin).apply(moment), rel=5e-3)
    off = np.linalg.norm(kept - moment) / np.linalg.norm(moment)
    assert off == pytest.approx(0.14, abs=5e-3)
    ask = Ask(Scene((block,), Contact(np.inf)), History(1.0, 1.0), (), Knobs(1e-3, 1e8))
    words = "without gyroscopic torque"
    assert words in prepare(ask, PUBLISHED).model.note
    assert words not in prepare(ask, DEFAULT).model.note


@pytest.mark.parametrize("axis", range(3))
def test_a_spin_about_a_main_axis_turns_a_block_the_way_it_says(axis: int) -> None:
    spin = 3.0 * np.eye(3)[axis]
    rotation, _, _ = spun(spin, 1.0, 1e-2)
    assert np.abs(rotation - Rotation.from_rotvec(spin).as_matrix()).max() <= 1e-12


@pytest.mark.parametrize("velocity", [(0.0, 0.46875, 0.0), (0.0, 0.3, 0.1)])
def test_roundings_of_the_motion_of_what_nothing_acts_on_break_no_law(
    velocity: tuple[float, ...],
) -> None:
    thrown = box("thrown", np.zeros(3), HALF, velocity=velocity, free=np.array([0, 1, 1], bool))
    scene, goal = Scene((thrown,), Contact(np.inf)), History(0.2, 0.025)
    program = prepare(Ask(scene, goal, (Displacement(0),), Knobs(2.5e-3, 1e8)), DEFAULT)
    assert list(breaches(program.run(program.solve()).ledger)) == []


def leaned(dt: float, at_the_start: bool, steps: int) -> Vector:
    """The lean over alpha (steps + 1,) of the released block, in DDA's step on a rigid edge.

    theta'' = -p^2 sin(alpha - theta), with the lever arm of weight and reaction at the start of a
    step or at its end.
    """
    p = ROCKING.defaults("released")
    alpha, rate = np.arctan2(p["b"], p["h"]), 0.75 * p["g"] / np.hypot(p["b"], p["h"])
    lean, spin, seen = p["part"] * alpha, 0.0, [p["part"]]
    for _ in range(steps):
        turned = dt * spin
        for _ in range(1 if at_the_start else 30):
            arm = lean if at_the_start else lean + turned
            pull = -rate * np.sin(alpha - arm)
            turned = dt * spin + 0.5 * dt**2 * pull
        lean, spin = lean + turned, spin + dt * pull
        seen.append(lean / alpha)
    return np.array(seen)


@pytest.mark.shows("because the lever arms of weight and reaction are those at the start of a step")
def test_a_block_on_its_edge_is_late_because_lever_arms_are_of_the_start_of_a_step() -> None:
    """With the lever arm at the end of a step it would be as much too early."""
    dt, stride, rows = 1e-3, 30, 15
    found = asked("rocking:released", "dda/default", Knobs(dt, 1e11))
    lean = next(one for one in found.trial.quantities if one.name == "lean")
    assert isinstance(lean, Series)
    assert lean.reference is not None
    times = found.run.times[: rows + 1]
    assert times[1] == pytest.approx(stride * dt)
    exact = lean.reference(found.run.times)[: rows + 1]
    late = np.asarray(lean.observe(found.run))[: rows + 1] - exact
    before, after = (leaned(dt, way, stride * rows)[::stride] - exact for way in (True, False))
    assert late.max() == pytest.approx(before.max(), rel=0.05)
    assert -after.min() == pytest.approx(before.max(), rel=0.3)


@pytest.mark.shows("It refuses scenes where they do")
def test_the_second_order_step_refuses_blocks_that_rotate_and_says_why() -> None:
    scheme = next(one for one in ADAPTER.schemes if one.name == "generalised-alpha")
    assert unsupported(scheme, frozenset({Term.ROTATION, Term.GRAVITY})) == {Term.ROTATION}
    assert "those at the beginning of a step" in scheme.why_not[Term.ROTATION]
