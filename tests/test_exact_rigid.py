"""Claims about the exact engine on rigid contact: closed forms, a second route, refusals."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from adapters.exact import ADAPTER
from reference_solutions import incline as slopes
from reference_solutions import responding_block
from tests.sliding_blocks import (
    FREE,
    Frame,
    G,
    block,
    by_scipy,
    incline,
    random_scene,
    responding,
    wall,
)
from vv.ask import Ask, Displacement, History, Run, Status, Velocity
from vv.exact import Slide, assemble_slider, follow_slider, solve
from vv.exact.clock import Clock
from vv.exact.modes import State
from vv.scene import Contact, Harmonic, Mask, Scene, Spheres, Vector, Wall
from vv.transform import rotated

BOX = Displacement(1)
EXACT = 1e-12
DOWN = np.array([0.0, 0.0, -G])
LEVEL = Frame(0.0)


def ran(scene: Scene, duration: float, interval: float | None = None) -> Run:
    run = solve(Ask(scene, History(duration, interval or duration / 500), (BOX, Velocity(1))))
    assert run.status is Status.RAN, run.reason
    return run


def slid(scene: Scene, duration: float) -> Slide:
    return follow_slider(assemble_slider(scene), duration)


def apart(found: Vector, expected: Vector) -> float:
    return float(np.abs(found - expected).max() / np.abs(expected).max())


SLOPES = [(28.0, phi) for phi in (5.0, 10.0, 15.0, 20.0, 25.0)]
SLOPES += [(45.0, phi) for phi in (10.0, 20.0, 30.0)]


@pytest.mark.parametrize(("alpha", "phi"), SLOPES)
def test_sliding_under_gravity_is_exact(alpha: float, phi: float) -> None:
    frame = Frame(alpha)
    run = ran(incline(frame, phi), 1.0)
    expected = slopes.gravity(run.times, alpha=alpha, phi=phi, g=G, v0=0.0)
    assert apart(run.values[BOX], expected[:, None] * frame.dip) < EXACT


@pytest.mark.parametrize("v0", [0.01, 0.1, 1.0, -1.0])
@pytest.mark.parametrize(("alpha", "phi"), [(45.0, 20.0), (20.0, 30.0), (20.0, 20.0)])
def test_a_start_at_a_speed_is_exact_also_where_it_ends_at_rest(
    alpha: float, phi: float, v0: float
) -> None:
    frame = Frame(alpha)
    run = ran(incline(frame, phi, v0=v0), 1.0)
    expected = slopes.gravity(run.times, alpha=alpha, phi=phi, g=G, v0=v0)
    assert apart(run.values[BOX] @ frame.dip, expected) < EXACT


SHAKEN = [
    (20.0, 22.0, 5.0, 1.0),
    (20.0, 30.0, 5.0, 1.0),
    (20.0, 35.0, 5.0, 1.0),
    (20.0, 22.0, 20.0, 10.0),
    (20.0, 30.0, 20.0, 10.0),
    (20.0, 20.0, 5.0, 10.0),
    (45.0, 45.0, 2.0, 10.0),
    (45.0, 50.0, 2.0, 10.0),
]


@pytest.mark.parametrize(("alpha", "phi", "A", "duration"), SHAKEN)
def test_newmark_sliding_is_exact(alpha: float, phi: float, A: float, duration: float) -> None:
    frame = Frame(alpha)
    run = ran(incline(frame, phi, A), duration)
    expected = slopes.newmark(run.times, alpha=alpha, phi=phi, A=A, f=1.0, g=G, v0=0.0)
    assert apart(run.values[BOX] @ frame.dip, expected) < EXACT


@pytest.mark.parametrize(
    ("phi", "d"), [(22.0, 0.7080274127), (30.0, 0.3270772510), (35.0, 0.1688662375)]
)
def test_newmark_sliding_ends_where_it_was_found_before(phi: float, d: float) -> None:
    frame = Frame(20.0)
    assert ran(incline(frame, phi, 5.0), 1.0).values[BOX][-1] @ frame.dip == pytest.approx(
        d, abs=5.1e-11
    )


RESPONDING = [
    (0.2, 2.0, 0.6, 0.4371496536),
    (0.2, 3.0, 0.6, 0.4790353311),
    (0.2, 5.0, 0.6, 0.4671690830),
    (0.3, 1.0, 0.6, 0.2205859410),
    (0.5, 1.0, 0.6, 0.8813472810),
    (1.0, 1.0, 0.6, 2.1827977173),
    (0.5, 1.0, 0.1, 0.7724770347),
    (0.5, 1.0, 1.0, 0.3676432349),
]


@pytest.mark.parametrize(("D", "f", "mu", "d"), RESPONDING)
def test_the_responding_block_is_exact(D: float, f: float, mu: float, d: float) -> None:
    run = ran(responding(D, f, mu), 5.0)
    moved = run.values[BOX][:, 0]
    assert apart(moved, responding_block.one_direction(run.times, D=D, f=f, mu=mu, g=G)) < EXACT
    assert moved[-1] == pytest.approx(d, abs=5.1e-11)


def quick(times: Vector, D: float, f: float, mu: float) -> Vector:
    """d2 [m] of a block that always slips, in extended precision: parabolas between reversals."""
    wide = np.longdouble
    turn = 8 * np.arctan(wide(1)) * wide(f)
    t, d, v, a, found = wide(0), wide(0), wide(0), wide(mu) * wide(G), []
    for reversal in range(1, int(2 * f * times[-1]) + 2):
        end = wide(reversal) / (2 * wide(f))
        for _ in range(8):
            excess = v + a * (end - t) - D * turn * np.sin(turn * end)
            end -= excess / (a - D * turn**2 * np.cos(turn * end))
        s = times[(t <= times) & (times <= end)].astype(wide) - t
        found.append(d + v * s + a * s * s / 2)
        d, v, t = d + (end - t) * (v + a * (end - t) / 2), v + a * (end - t), end
        a = -a
    return np.concatenate(found).astype(float)


@pytest.mark.skipif(bool(np.finfo(np.longdouble).eps > 1e-18), reason="no extended precision here")
@pytest.mark.parametrize("f", [5.0, 20.0, 100.0])
def test_a_quick_base_costs_no_digits(f: float) -> None:
    """Seen 8e-15 at 100 Hz: the speed of the block is carried, not its small difference."""
    run = ran(responding(0.2, f, 0.6), 5.0, 5.0 / 997)
    assert apart(run.values[BOX][:, 0], quick(run.times, 0.2, f, 0.6)) < 1e-13


@pytest.mark.parametrize("seed", range(10))
def test_walls_and_shaking_of_many_periods_agree_with_scipy(seed: int) -> None:
    """The normal force varies by a third; seen 5e-14 at most."""
    scene, frame = random_scene(seed)
    run = ran(scene, 3.0, 0.1)
    assert apart(run.values[BOX], by_scipy(scene, frame, run.times)) < 1e-11


def test_the_random_scenes_stick_and_slip_both_ways() -> None:
    seen = {(e.before, e.after) for s in range(10) for e in slid(random_scene(s)[0], 3.0).events}
    stuck, there, back = State.STUCK, State.SLIP_FORWARD, State.SLIP_BACKWARD
    assert {(there, stuck), (stuck, there), (back, stuck), (stuck, back), (there, back)} <= seen


@pytest.mark.parametrize("frame", [Frame(20, 0.7), Frame(20, 0, True), Frame(20, 4.0, True)])
def test_a_slope_slides_alike_wherever_it_faces(frame: Frame) -> None:
    plain = ran(incline(Frame(20), 22.0, 20.0), 3.0).values[BOX] @ Frame(20).dip
    moved = ran(incline(frame, 22.0, 20.0), 3.0).values[BOX]
    assert apart(moved, plain[:, None] * frame.dip) < 1e-13


def test_scenes_turned_in_space_move_alike() -> None:
    for seed in range(6):
        scene, rotation = random_scene(seed)[0], _turned(seed)
        plain, other = (ran(s, 2.0).values[BOX] for s in (scene, rotated(scene, rotation)))
        assert apart(other @ rotation, plain) < 1e-12, f"seed {seed}"


def _turned(seed: int) -> Vector:
    matrix = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return np.asarray(matrix * np.sign(np.linalg.det(matrix)))


def test_a_sphere_that_cannot_turn_moves_as_a_block_does() -> None:
    scene = incline(Frame(20), 22.0, 5.0)
    ball = Spheres(
        position=Frame(20).normal[None],
        velocity=np.zeros((1, 3)),
        radius=np.ones(1),
        mass=np.array([7.0]),
        free=np.ones((1, 3), bool),
    )
    other = dataclasses.replace(scene, bodies=(scene.walls[0], ball))
    assert apart(ran(other, 3.0).values[BOX], ran(scene, 3.0).values[BOX]) < 1e-14


def test_shaking_is_a_wall_that_moves_seen_from_the_wall() -> None:
    D, f = 0.3, 1.0
    moving = ran(responding(D, f, 0.6), 5.0)
    still = responding(D, f, 0.6)
    felt = Harmonic((D * (2 * np.pi * f) ** 2, 0, 0), (f, f, f), (-np.pi / 2,) * 3)  # type: ignore[arg-type]
    shaken = dataclasses.replace(still, bodies=(wall(LEVEL), still.blocks[0]), shaking=felt)
    base = D * (1 - np.cos(2 * np.pi * f * moving.times))
    slip = moving.values[BOX][:, 0] - base
    assert apart(ran(shaken, 5.0).values[BOX][:, 0], slip) < 1e-13


def test_a_block_without_friction_follows_its_shaking_and_the_normal_of_its_wall_alone() -> None:
    wave = Harmonic((3.0, 0, 0), (2.0,) * 3)  # type: ignore[arg-type]
    lift = Harmonic((0.1, 0, 0.01), (1.0,) * 3, (np.pi / 2,) * 3)  # type: ignore[arg-type]
    bodies = (wall(LEVEL, lift), block(LEVEL, np.array([0.5, 0.0, 0.0])))
    run = ran(Scene(bodies, Contact(np.inf), gravity=DOWN, shaking=wave), 2.0)
    t, w = run.times, 4 * np.pi
    x = 0.5 * t + 3.0 * (t / w - np.sin(w * t) / w**2)
    z = 0.01 * (np.cos(2 * np.pi * t) - 1)
    assert apart(run.values[BOX], np.stack([x, 0 * t, z], axis=1)) < 1e-14


def test_a_block_slips_on_through_the_touch_of_zero_once_a_period() -> None:
    """phi = alpha: the speed (A/(w cos alpha))(1 - cos wt) is zero at whole periods."""
    for scene in (incline(Frame(20), 20.0, 5.0), incline(Frame(45), 45.0, 2.0)):
        path = slid(scene, 10.0)
        assert [e.after for e in path.events if e.time > 1e-9] == []


def test_a_block_that_touches_its_slip_limit_stays() -> None:
    """The drive reaches mu g, exactly or but for rounding, and turns."""
    for A in np.nextafter(0.5 * G, [0.0, np.inf]):
        scene = responding(1.0, 1.0, 0.5)
        shaking = Harmonic((A, 0, 0), (1.0,) * 3)  # type: ignore[arg-type]
        resting = dataclasses.replace(scene, bodies=(wall(LEVEL), scene.blocks[0]), shaking=shaking)
        assert slid(resting, 5.0).events == ()


def test_the_energy_is_accounted_for_to_rounding_and_within_its_bound() -> None:
    scenes = [random_scene(seed)[0] for seed in range(10)]
    scenes += [incline(Frame(20), 22.0, 20.0), responding(0.2, 20.0, 0.6)]
    share: dict[str, float] = {}
    for number, scene in enumerate(scenes):
        ledger = ran(scene, 3.0).ledger
        assert ledger is not None
        assert ledger.bound is not None
        size = sum(map(abs, ledger.terms.values()))
        assert ledger.unaccounted <= ledger.bound <= 1e-11 * max(size, ledger.peak), number
        for name, term in ledger.terms.items():
            share[name] = max(share.get(name, 0.0), abs(term) / size)
    assert min(share.values()) > 0.05, share  # no term is always small


def test_a_base_pays_for_friction_and_speed() -> None:
    run = ran(responding(0.5, 1.0, 0.1), 5.0)
    ledger = run.ledger
    assert ledger is not None
    mass = responding(0.5, 1.0, 0.1).blocks[0].mass
    assert ledger.terms["kinetic"] == pytest.approx(mass * run.values[Velocity(1)][-1, 0] ** 2 / 2)
    paid = -ledger.terms["work left to the wall"]
    spent = ledger.terms["kinetic"] + ledger.terms["friction dissipation"]
    assert paid == pytest.approx(spent, rel=1e-13)
    assert spent > 0


def test_the_velocity_is_that_of_the_base_while_the_block_sticks() -> None:
    run = ran(responding(0.05, 0.5, 0.6), 4.0)
    w = np.pi
    assert apart(run.values[Velocity(1)][:, 0], 0.05 * w * np.sin(w * run.times)) < 1e-13
    assert slid(responding(0.05, 0.5, 0.6), 4.0).events == ()


def test_phases_are_as_sharp_after_a_million_periods_as_at_first() -> None:
    clock = Clock.of(np.array([2.0, 0.375]), np.array([0.3, 1.1]), 1e9)
    assert (clock.waves((8 * 10**9 * 16, 0.25)) == clock.waves((0, 0.25))).all()
    assert clock.waves_at(np.array([16e6]))[0] == pytest.approx(clock.waves((0, 0.0)), abs=1e-15)


def test_a_long_history_repeats_itself() -> None:
    d = ran(incline(Frame(20), 22.0, 5.0), 400.0, 100.0).values[BOX] @ Frame(20).dip
    gains = np.diff(d)
    assert np.abs(gains - 100 * 0.7080274126836).max() < 1e-12 * d[-1]


def test_the_model_has_one_unknown() -> None:
    scene = responding(0.2, 2.0, 0.6)
    run = ran(scene, 5.0)
    assert run.model is not None
    assert (run.model.unknowns, run.model.terms) == (1, scene.terms())
    assert "out of 3 freedoms; 1 rigid contact with constant normal; 1 sine" in run.model.note
    assert slid(scene, 5.0).series.ndim == 2


@pytest.mark.parametrize("scene", [incline(Frame(20), 22.0, 5.0), responding(0.2, 2.0, 0.6)])
def test_a_solve_takes_some_milliseconds(scene: Scene, tmp_path: Path) -> None:
    (run,) = ADAPTER.run([Ask(scene, History(5.0, 0.01), (BOX,))], "default", tmp_path, 0.05)
    assert 0 < run.cost.solve_cpu < 25e-3
    assert run.cost.setup < 25e-3


def shaken(along: Vector, scene: Scene, amplitude: float = 1.0) -> Scene:
    axes = np.array([along, np.roll(along, 1), np.roll(along, 2)])
    return dataclasses.replace(
        scene,
        shaking=Harmonic((amplitude, 0, 0), (1.0,) * 3, axes=axes),  # type: ignore[arg-type]
    )


def on_floor(free: Mask = FREE, motion: Harmonic | None = None, **changed: object) -> Scene:
    box = block(LEVEL, np.array([1.0, 0.0, 0.0]) * free, free, **changed)
    return Scene((wall(LEVEL, motion), box), Contact(np.inf, mu=0.5), gravity=DOWN)


X, Y, Z = np.eye(3)
SIDE = Harmonic((0.1, 0, 0), (1.0,) * 3, (np.pi / 2,) * 3)  # type: ignore[arg-type]
LIFT = Harmonic((0, 0, 0.1), (1.0,) * 3)  # type: ignore[arg-type]
BOXED = dataclasses.replace(incline(LEVEL, 20.0), bodies=(wall(LEVEL), block(LEVEL, X), *(
    Wall(np.array([9.0, 0, 0]), -X),)))  # fmt: skip
REFUSED = {
    "the slip between bodies 0 and 1 can turn": shaken(Y, on_floor()),
    "the slip between bodies 0 and 1 has two directions": dataclasses.replace(
        shaken(Y, on_floor()), contact=Contact(np.inf)
    ),
    "nothing in the scene moves": incline(LEVEL, 20.0),
    "free rotation is not modelled": on_floor(free_spin=FREE),
    "block 'box' spins and may not; a sphere in its place would not spin": on_floor(spin=X),
    "block 'box' stands between 2 walls; a sphere has one": BOXED,
    "bodies 0 and 1 leave each other at 0.5 m/s at t = 0": dataclasses.replace(
        on_floor(), bodies=(wall(LEVEL), block(LEVEL, X + 0.5 * Z))
    ),
    "bodies 0 and 1 meet at 0.628319 m/s at t = 0": on_floor(motion=LIFT),
    "bodies 0 and 1 are 0.1 m apart at t = 0; they must touch": dataclasses.replace(
        on_floor(), bodies=(Wall(-0.1 * Z, Z), block(LEVEL, X))
    ),
    "body 1 is not pressed on body 0 at t = 0": dataclasses.replace(
        on_floor(), gravity=np.zeros(3)
    ),
    "body 1 is locked normal to body 0; how hard they press is not determined": on_floor(X > 0),
    "body 1 is locked along the slip of body 0; how hard they rub is not determined": on_floor(
        Z > 0, SIDE
    ),
    "viscous drag -eta v is not modelled on rigid contact": dataclasses.replace(
        on_floor(), eta=1.0
    ),
    "convex blocks is not modelled on springs": dataclasses.replace(
        on_floor(), contact=Contact(1e6, 1e6, 0.5)
    ),
}


@pytest.mark.parametrize("reason", REFUSED)
def test_scenes_outside_the_class_are_refused_with_the_reason(reason: str, tmp_path: Path) -> None:
    ask = Ask(REFUSED[reason], History(1.0, 0.1), (BOX,))
    assert ADAPTER.refuses(ask, "default") == reason
    (run,) = ADAPTER.run([ask], "default", tmp_path, 0.0)
    assert (run.status, run.reason) == (Status.REFUSED, reason)


def test_a_block_that_would_fly_is_refused_unless_the_run_ends_before() -> None:
    """It lifts off as A sin 2 pi t = g; a normal force that only touches zero keeps it down."""
    scene = shaken(Z, on_floor(), 2 * G)
    late, early = (Ask(scene, History(end, 0.01), (BOX,)) for end in (0.1, 0.08))
    reason = "body 1 lifts off body 0 at t = 0.0833333 s; flight is not followed"
    assert ADAPTER.refuses(late, "default") == reason
    assert ADAPTER.refuses(early, "default") is None
    touching = Ask(shaken(Z, on_floor(), G), History(3.0, 0.01), (BOX,))
    assert ADAPTER.refuses(touching, "default") is None


def test_events_that_accumulate_are_an_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vv.exact.slide.CHATTER", 0)
    run = solve(Ask(incline(Frame(20), 22.0, 5.0), History(1.0, 0.1), (BOX,)))
    assert run.status is Status.DIVERGED
    assert "events accumulate" in run.reason
    assert run.model is not None


def test_too_many_steps_are_an_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vv.exact.slide.STEPS", 10)
    run = solve(Ask(responding(0.2, 2.0, 0.6), History(5.0, 0.1), (BOX,)))
    assert run.status is Status.DIVERGED
    assert "more than 10 steps" in run.reason
