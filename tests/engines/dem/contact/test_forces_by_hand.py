"""Claims about all forces of contacts in one step: balances, works and springs, by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.plain import plain
from vv.engines.dem.bonds import law
from vv.engines.dem.contact import pairs as of_pairs
from vv.engines.dem.contact import walls as of_walls
from vv.engines.dem.contact.hertz import Elastic
from vv.engines.dem.contact.linear import Linear
from vv.engines.dem.space.bodies import Motion
from vv.scene import Vector

DT, KN, KS, MU = 1e-3, 1e5, 4e4, 0.3
ROUGH, SMOOTH = Linear(KN, (KS, MU), None), Linear(KN, None, None)
ASKED_ROUGH, ASKED_SMOOTH = ROUGH._replace(at_run_time=0), Linear(KN, (0.0, 0.0), None, 0)
MASS = np.array([2.0, 0.7, 5.0])
PLACE = np.array([[0.0, 0.0, 0.0], [0.6, -0.3, 0.2], [0.1, 0.5, 0.4]])  # m
RADIUS = np.array([0.4, 0.35, 0.3])


def motion(turns: bool | None, walls: int = 0) -> Motion:
    """Three spheres at rest in u that move anyhow; turns: None if no spin is known."""
    random = np.random.default_rng(7)
    u = np.zeros((4 + walls, 3))
    v, before = random.normal(size=(2, 4 + walls, 3))
    v[3] = before[3] = 0.0
    spins = (None, None, None) if turns is None else (*random.normal(size=(2, 4, 3)),)
    if turns is None:
        return Motion(u, v, before, np.zeros((4, 3)), None, None, None)
    return Motion(u, v, before, np.zeros((4, 3)), spins[0], spins[1], np.zeros((4 * turns, 3)))


def touching() -> of_pairs.Pairs:
    """Three pairs, of which the first two touch and the last is open."""
    i, j = np.array([0, 0, 1]), np.array([1, 2, 2])
    offset, radii = PLACE[j] - PLACE[i], np.stack([RADIUS[i], RADIUS[j]], axis=1)
    gap = np.linalg.norm(offset, axis=1) - radii.sum(axis=1)
    return np.stack([i, j], axis=1), offset, gap, radii


@pytest.mark.parametrize(
    ("law", "turns"),
    [(SMOOTH, None), (ROUGH, None), (ROUGH, True), (ASKED_SMOOTH, True), (ASKED_ROUGH, True),
     (ASKED_ROUGH, False)],
)  # fmt: skip
def test_forces_of_pairs_are_opposite_and_turn_nothing_as_a_whole(
    law: Linear, turns: bool | None
) -> None:
    """Each acts on both spheres at one point, in the middle of their overlap."""
    told, pairs, shear = motion(turns), touching(), np.full((3, 3), 0.4)
    (rows, offset, gap, _), friction = pairs, law in (ROUGH, ASKED_ROUGH)
    found = plain(of_pairs.pair_forces)(told, MASS, DT, pairs, law, law.at_run_time, shear)
    n = offset / np.linalg.norm(offset, axis=1)[:, None]
    across = shear * (gap < 0.0)[:, None] if friction else np.zeros((3, 3))
    force = KN * np.maximum(-gap, 0.0)[:, None] * n + across
    push, moment = np.zeros((4, 3)), np.zeros((4, 3))
    for (i, j), one, normal, apart, drag in zip(rows, force, n, gap, across, strict=True):
        push[i] -= one
        push[j] += one
        moment[i] += (RADIUS[i] + apart / 2) * np.cross(normal, -drag)
        moment[j] += (RADIUS[j] + apart / 2) * np.cross(-normal, drag)
    assert told.push == pytest.approx(push)
    assert found[0] == pytest.approx(0.5 * KN * (gap[:2] ** 2).sum())
    assert found[1] == pytest.approx(0.5 / KS * (across**2).sum())
    if turns and friction:
        assert np.abs(moment).max() > 0.1
        assert told.turn == pytest.approx(moment)
    if friction:
        assert (np.abs((across * n).sum(axis=1)) < 1e-12).all()
        assert not shear[2].any()
    else:
        assert (shear == 0.4).all()


@pytest.mark.parametrize("friction", [None, (8e7, MU)])
def test_unlike_elastic_spheres_press_by_their_reduced_radius(friction: Any) -> None:
    """1/(1/r1 + 1/r2); friction is limited by what presses."""
    law, told, pairs = Elastic(1e8, friction, None, (0.0, 0.0)), motion(None), touching()
    told.v[:] = told.before[:] = 0.0
    told.v[0, 2] = 1e3
    shear = np.zeros((3, 3))
    held = plain(of_pairs.pair_forces)(told, MASS, DT, pairs, law, None, shear)[0]
    _, offset, gap, radii = pairs
    reduced = 1.0 / (1.0 / radii[:2, 0] + 1.0 / radii[:2, 1])
    push = 4.0 / 3.0 * 1e8 * np.sqrt(reduced * -gap[:2]) * -gap[:2]
    assert held == pytest.approx(0.4 * push @ -gap[:2])
    across = np.linalg.norm(shear[:2], axis=1)
    assert across == pytest.approx(MU * push if friction else [0.0, 0.0])
    n = offset[:2] / np.linalg.norm(offset[:2], axis=1)[:, None]
    assert told.push[1:3] == pytest.approx(push[:, None] * n + shear[:2])


WALL = np.array([[0.0, 0.6, 0.8], [0.0, 0.6, 0.8], [1.0, 0.0, 0.0]])
GAPS = np.array([-0.02, 0.01, -0.03])
SIZES = np.array([0.4, 0.35, 0.3])


@pytest.mark.parametrize("moves", [True, False])
@pytest.mark.parametrize(
    ("law", "turns"), [(SMOOTH, None), (ROUGH, True), (ASKED_SMOOTH, True), (ASKED_ROUGH, False)]
)
def test_walls_push_drag_turn_and_work(law: Linear, turns: bool | None, moves: bool) -> None:
    """Rows 4 and 5 are walls: the first has two spheres, of which one is off it."""
    told, shear = motion(turns, 2), np.full((3, 3), 0.4)
    walls: Any = np.arange(3), WALL, GAPS, SIZES
    told.u[0], told.u[4] = [0.1, -0.02, 0.01], [0.3, 0.04, -0.005]
    held = np.array([[30.0, 0.0, -20.0], [7.0, 8.0, 9.0], [-5.0, 10.0, 60.0]])
    moving = (np.array([4, 4, 5]), held.copy()) if moves else None
    found = plain(of_walls.wall_forces)(told, MASS, DT, walls, law, law.at_run_time, shear, moving)
    apart = told.u[:3] - (told.u[[4, 4, 5]] if moves else 0.0)
    overlap = -GAPS - (apart * WALL).sum(axis=1)
    assert (overlap > 0.0).tolist() == [True, moves, True]
    friction = law in (ROUGH, ASKED_ROUGH)
    across = shear if friction else np.zeros((3, 3))
    force = np.where(overlap > 0.0, KN * overlap, 0.0)[:, None] * WALL + across
    assert told.push[:3] == pytest.approx(force)
    assert not told.push[3].any()
    assert found[0] == pytest.approx(0.5 * KN * (np.maximum(overlap, 0.0) ** 2).sum())
    assert found[1] == pytest.approx(0.5 / KS * (across**2).sum())
    if friction and not moves:
        assert not shear[1].any()
    if turns and friction:
        arm = (SIZES - overlap / 2)[:, None]
        assert told.turn is not None
        assert told.turn[:3] == pytest.approx(arm * np.cross(-WALL, across))
    if moving is None:
        assert found[3] == 0.0
        return
    work = 0.5 * DT * ((held + force) * told.v[[4, 4, 5]]).sum()
    assert found[3] == pytest.approx(work)
    assert moving[1] == pytest.approx(force)


def slid(turns: bool, moves: bool) -> tuple[Any, Motion, Any]:
    told = motion(turns, 1)
    walls: Any = np.array([1]), WALL[:1], GAPS[:1], SIZES[:1]
    moving = (np.array([4]), np.zeros((1, 3))) if moves else None
    touch = plain(of_walls.wall_touch)(told, told.w, told.spun, turns, walls, moving, 0, 0.02, DT)
    return touch, told, told.v[4] if moves else np.zeros(3)


@pytest.mark.parametrize("moves", [True, False])
@pytest.mark.parametrize("turns", [True, False])
def test_a_sphere_slides_on_a_wall_by_its_velocity_and_its_spin(turns: bool, moves: bool) -> None:
    """The contact point is amid the overlap, amid the step; rates come from those of two steps."""
    touch, told, wall = slid(turns, moves)
    n, now = WALL[0], told.v[1] - wall
    earlier = told.before[1] - (told.before[4] if moves else 0.0)
    opened = DT * n @ now
    assert touch.opened == pytest.approx(opened)
    assert touch.rates == pytest.approx(
        (n @ now - 0.5 * n @ (now - earlier), n @ now + 0.5 * n @ (now - earlier))
    )
    assert touch.n == touch.n_before == touch.midway == tuple(n)
    w, spun = (s[1] if turns and s is not None else np.zeros(3) for s in (told.w, told.spun))
    arm = SIZES[0] - 0.5 * (0.02 + 0.5 * opened)
    assert touch.relative == pytest.approx(now - arm * np.cross(w, n))
    assert touch.changed == pytest.approx(now - earlier - arm * np.cross(w - spun, n))
    assert touch.twist == pytest.approx(0.5 * DT * w @ n)


def test_where_no_spin_is_known_nothing_twists() -> None:
    told, walls = motion(None), (np.array([1]), WALL[:1], GAPS[:1], SIZES[:1])
    touch = plain(of_walls.wall_touch)(told, None, None, False, walls, None, 0, 0.02, DT)
    assert touch.twist is None
    assert touch.relative == pytest.approx(told.v[1])


def friction_of(law: Linear, slide: Vector) -> tuple[Vector, Vector]:
    """The tangential force on a sphere that slides over a wall from rest, and the slide [m]."""
    told = motion(None)
    told.v[1] = told.before[1] = slide / DT
    walls: Any = np.array([1]), WALL[:1], GAPS[:1], SIZES[:1]
    shear = np.zeros((1, 3))
    plain(of_walls.wall_forces)(told, MASS, DT, walls, law, None, shear, None)
    return shear[0], slide


@pytest.mark.parametrize(("part", "slips"), [(0.999, False), (1.001, True)])
def test_a_slide_is_opposed_by_its_spring_up_to_the_limit_of_friction(
    part: float, slips: bool
) -> None:
    cap = MU * KN * 0.02
    along = np.array([0.8, 0.36, -0.27]) / np.linalg.norm([0.8, 0.36, -0.27])
    force, slide = friction_of(ROUGH, part * cap / KS * along)
    assert (np.linalg.norm(force) == pytest.approx(cap)) == slips
    due = cap * along if slips else KS * slide
    assert force == pytest.approx(-due)


@pytest.mark.parametrize("length", [0.9, 0.7])
def test_surfaces_of_bonded_spheres_move_by_centres_and_spins_and_turn_by_half_the_twist(
    length: float,
) -> None:
    """Of radii 0.5 and 0.3, which overlap or leave a gap that both share."""
    e, dt = np.array([0.6, 0.0, 0.8]), 0.01
    step, a, b = np.random.default_rng(5).normal(size=(3, 3))
    arms = np.array([0.5, 0.3]) + 0.5 * (length - 0.8)
    moved = step - dt * np.cross(arms[0] * a + arms[1] * b, e)
    turned = 0.5 * dt * (a + b) @ e
    given: Any = (tuple(step), tuple(length * e), dt, tuple(a), tuple(b), 0.5, 0.3)
    found, twist = plain(law.surface_motion)(*given)
    assert twist == pytest.approx(turned)
    assert found == pytest.approx(moved - 0.5 * turned * np.cross(e, moved))
