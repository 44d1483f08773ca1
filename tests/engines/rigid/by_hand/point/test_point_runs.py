"""Claims about whole runs of a point mass: where it goes, what it spends, how steps are divided."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import HELD, box, slope
from vv.engines.rigid.limits import FINEST, TOUCHING
from vv.engines.rigid.point.kernel import move_point
from vv.engines.rigid.point.model import point
from vv.engines.rigid.scales import scales
from vv.scene import Contact, Harmonic, Scene, Wall

pytestmark = pytest.mark.usefixtures("in_python")
G, MU, DT = 9.81, 0.4, 0.01
AXES, PLANE = slope(20.0)
ALONG, ON = G * np.sin(np.radians(20.0)), G * np.cos(np.radians(20.0))  # m/s2
KINETIC, RUBBED, HIT, BASE, SHAKEN, GRAVITY, LOAD, SHOVED = range(8)
SIGNS = np.array([1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0, 1.0])


class Moved:
    """A block of 24 kg that cannot turn on a slope of 20 degrees, and the rows of its run.

    v, load: along dip, strike and normal, as are its rows; load per mass [m/s2].
    """

    def __init__(
        self, steps: int, gap: float = 0.0, v: Any = (0.0, 0.0, 0.0), load: Any = (0, 0, 0),
        motion: Any = None, shaking: Any = None, mu: float = MU, dt: float = DT, stride: int = 1,
    ) -> None:  # fmt: skip
        block = box(
            "b", (0.15 + gap) * AXES[2], [0.1, 0.2, 0.15], AXES, free_spin=HELD,
            velocity=np.array(v) @ AXES, load=24.0 * np.array(load, float) @ AXES,
        )  # fmt: skip
        made = Scene(
            (Wall(PLANE.point, PLANE.normal, motion), block), Contact(np.inf, mu=mu),
            gravity=np.array([0.0, 0.0, -G]), axes=AXES, shaking=shaking,
        )  # fmt: skip
        system = point(made)
        assert system is not None
        path, self.energy, report, reaction = system.outputs(steps // stride + 1, (0,))
        start, ground = system.arguments(dt)
        self.rows = move_point(path, self.energy, report, reaction, stride, dt, start, ground)
        self.x, self.v = path[:, :3] @ AXES.T, path[:, 3:] @ AXES.T
        self.force, self.deep, self.cuts = reaction[:, 0] @ AXES.T, report[:, 2], report[:, 3]
        self.t = dt * stride * np.arange(self.rows)
        balance = self.energy @ SIGNS
        assert balance == pytest.approx(np.full(self.rows, balance[0]), abs=1e-12)


def sines(along: Any, hertz: float, phase: float = 0.0) -> Harmonic:
    """Sines along dip, strike and normal."""
    return Harmonic(np.array(along, float), np.full(3, hertz), np.full(3, phase), AXES)


def test_a_mass_that_falls_without_friction_loses_what_it_had_along_the_normal() -> None:
    """A load pulls it up by 1 m/s2 and along the strike by 2; the wall is hit at 0.0183 s."""
    run = Moved(6, gap=0.02, v=(0.5, 0.2, -1.0), load=(0.0, 2.0, 1.0), mu=0.0)
    falls = ON - 1.0
    hit = (np.sqrt(1.0 + 2.0 * falls * 0.02) - 1.0) / falls
    flies = np.minimum(run.t, hit)
    x, y = 0.5 * run.t + 0.5 * ALONG * run.t**2, 0.2 * run.t + run.t**2
    z = -flies - 0.5 * falls * flies**2
    assert run.x == pytest.approx(np.transpose([x, y, z]), abs=1e-12)
    up = np.where(run.t < hit, -1.0 - falls * run.t, 0.0)
    assert run.v == pytest.approx(np.transpose([0.5 + ALONG * run.t, 0.2 + 2 * run.t, up]))
    assert run.energy[:, HIT] == pytest.approx(0.5 * (1.0 + falls * hit) ** 2 * (run.t > hit))
    assert run.energy[:, GRAVITY] == pytest.approx(ALONG * x - ON * z)
    assert run.energy[:, LOAD] == pytest.approx(2.0 * y + z, abs=1e-12)
    assert run.cuts.tolist() == [0, 0, 1, 0, 0, 0, 0]
    assert run.force[3:] == pytest.approx(np.tile([0.0, 0.0, falls], (4, 1)))
    assert not run.energy[:, [RUBBED, BASE, SHAKEN]].any()
    assert np.abs(run.energy[:, SHOVED]).max() <= 1e-15


def test_a_mass_that_is_just_above_its_plane_comes_down_to_it_before_it_lands() -> None:
    """It lands at 5e-6 of the first step; the plane does not hold it where it began."""
    run = Moved(2, gap=5e-8, v=(0.0, 0.0, -1.0))
    assert run.x[1:, 2] == pytest.approx([-5e-8, -5e-8], abs=1e-15)


@pytest.mark.parametrize("stride", [1, 4])
def test_a_mass_slides_down_until_it_stops_and_stays(stride: int) -> None:
    """At 0.3 m/s it stops within a step, which is divided there; a load adds to its weight."""
    run = Moved(32, v=(0.3, 0.0, 0.0), load=(0.0, 0.0, -2.0), stride=stride)
    press = ON + 2.0
    slows = MU * press - ALONG
    stops = 0.3 / slows
    t = np.minimum(run.t, stops)
    x = 0.3 * t - 0.5 * slows * t**2
    assert 0.1 < stops < 0.3
    assert run.x == pytest.approx(np.transpose([x, 0 * t, 0 * t]), abs=1e-9)
    assert run.v[:, 0] == pytest.approx(np.maximum(0.3 - slows * run.t, 0.0), abs=1e-9)
    assert run.energy[:, RUBBED] == pytest.approx(MU * press * x, abs=1e-9)
    assert run.energy[:, GRAVITY] == pytest.approx(ALONG * x, abs=1e-9)
    assert run.cuts.sum() == 1.0
    assert run.cuts[int(np.ceil(stops / DT / stride))] == 1.0
    assert run.force[-1] == pytest.approx([-ALONG, 0.0, press])
    assert run.force[1] == pytest.approx([-MU * press, 0.0, press])
    assert np.abs(run.energy[:, [HIT, LOAD, BASE]]).max() <= 1e-15


@pytest.mark.parametrize(("up", "off"), [(0.0, 1e-9), (0.002, 1e-4)])
def test_a_mass_that_sticks_goes_with_its_plane_which_works_for_it(up: float, off: float) -> None:
    """Displacements are by the trapezoidal rule: off by dt^2/12 times the change of velocity."""
    size = np.array([0.01, 0.004, up])
    run = Moved(20, v=4 * np.pi * np.cos(0.3) * size, motion=sines(size, 2.0, 0.3), mu=3.0)
    way = np.outer(np.sin(4 * np.pi * run.t + 0.3) - np.sin(0.3), size)
    rate = np.outer(4 * np.pi * np.cos(4 * np.pi * run.t + 0.3), size)
    assert run.v[1:] == pytest.approx(rate[1:], abs=off)
    assert run.x == pytest.approx(way, abs=3e-5)
    gained = run.energy[:, KINETIC] - run.energy[0, KINETIC] - run.energy[:, GRAVITY]
    assert run.energy[:, BASE] == pytest.approx(gained, abs=3e-5)
    assert run.energy[-1, BASE] < -5e-4


def test_shaking_moves_a_mass_in_flight_and_works_for_it() -> None:
    """The velocity is that of its integral; displacements are by the trapezoidal rule."""
    run = Moved(10, gap=9.0, shaking=sines([3.0, -2.0, 1.0], 5.0, 0.4))
    speed = (np.cos(0.4) - np.cos(10 * np.pi * run.t + 0.4)) / (10 * np.pi)
    v = np.outer(speed, [3.0, -2.0, 1.0]) + np.outer(run.t, [ALONG, 0.0, -ON])
    assert run.v == pytest.approx(v, abs=1e-12)
    x = np.vstack([np.zeros(3), np.cumsum(0.5 * DT * (v[1:] + v[:-1]), axis=0)])
    assert run.x == pytest.approx(x, abs=1e-12)
    push = np.diff(speed)[:, None] * [3.0, -2.0, 1.0]
    assert run.energy[1:, SHAKEN] == pytest.approx(
        np.cumsum((push * np.diff(x, axis=0)).sum(1) / DT)
    )


@pytest.mark.parametrize("base", [True, False])
def test_a_mass_begins_to_slip_when_its_plane_accelerates_too_much(base: bool) -> None:
    """Within 1/64 of a step, so that its path is that of steps twenty times finer."""
    given: dict[str, Any] = {"motion": sines([0.03, 0.02, 0.0], 3.0), "mu": 0.6}
    if not base:
        given = {"shaking": sines([12.0, 7.0, 2.0], 3.0, 0.2), "mu": 0.6}
    coarse = Moved(30, **given)
    fine = Moved(600, dt=DT / 20, stride=20, **given)
    far = np.abs(fine.x).max()
    assert np.abs(coarse.x - fine.x).max() <= 0.01 * far
    assert np.abs(coarse.v - fine.v).max() <= 0.02 * np.abs(fine.v).max()
    assert coarse.cuts.sum() >= 2.0
    assert coarse.energy[-1, RUBBED] == pytest.approx(fine.energy[-1, RUBBED], rel=0.02)


def test_a_plane_that_falls_faster_than_a_mass_leaves_it_and_meets_it_again() -> None:
    given: dict[str, Any] = {"motion": sines([0.0, 0.0, 0.02], 4.0, np.pi / 2), "mu": 0.2}
    coarse, fine = Moved(30, **given), Moved(600, dt=DT / 20, stride=20, **given)
    apart = coarse.x[:, 2] - 0.02 * (np.cos(8 * np.pi * coarse.t) - 1.0)
    assert apart.max() > 1e-3
    assert apart.min() >= -1e-12
    assert np.abs(coarse.x - fine.x).max() <= 0.02 * np.abs(fine.x).max()
    assert coarse.energy[-1, HIT] == pytest.approx(fine.energy[-1, HIT], rel=0.1)


def test_a_point_has_the_forces_per_mass_the_gap_and_the_scales_of_its_scene() -> None:
    """A gap within rounding of the block's size is none."""
    shaken, rate = sines([3.0, -2.0, 1.0], 5.0, 0.4), np.array([0.3, 0.2, 0.0])
    for gap, due in ((0.02, 0.02), (0.5 * TOUCHING * 0.4, 0.0)):
        block = box(
            "b", (0.15 + gap) * AXES[2], [0.1, 0.2, 0.15], AXES, free_spin=HELD,
            velocity=rate @ AXES, load=24.0 * np.array([1.0, 2.0, 3.0]) @ AXES,
        )  # fmt: skip
        gravity = np.array([0.0, 0.0, -G])
        made = Scene((Wall(PLANE.point, PLANE.normal), block), Contact(np.inf, mu=MU),
                     gravity=gravity, axes=AXES, shaking=shaken)  # fmt: skip
        system, known = point(made), scales(made)
        assert system is not None
        start, ground = system.arguments(DT)
        assert start == pytest.approx(rate @ AXES)
        assert ground.gravity == pytest.approx(gravity)
        assert ground.load == pytest.approx(np.array([1.0, 2.0, 3.0]) @ AXES)
        assert ground.gap == pytest.approx(due, abs=1e-15)
        assert (ground.mu, ground.pull, ground.braking) == (MU, known.pull, known.braking)
        assert ground.quick == known.quick
        assert ground.fine == pytest.approx(FINEST * (known.given + known.pull * DT), abs=0.0)
        per_mass = np.arange(1.0, 17.0).reshape(2, 8)
        joules = block.mass * np.array([[1, 2, 3, 4, 5, 13, 8, 0], [9, 10, 11, 12, 13, 29, 16, 0]])
        assert system.joules(per_mass) == pytest.approx(joules)
        assert system.newtons(per_mass) == pytest.approx(block.mass * per_mass)
