"""Claims about the exact engine: closed forms, a second route, conservation and symmetry."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from cases.contact.single_contact import CASE
from tests.scenes.blocks.exact_slides import apart
from tests.scenes.event_located import event_located
from tests.scenes.other_worlds import rescaled
from tests.scenes.small_scenes import ALONG, DOWN, FLOOR, KINDS, UP, ball, crowded, small_scene
from vv.ask import Ask, Displacement, History, Run, Status, Velocity
from vv.engines.exact import Path as Motion
from vv.engines.exact import assemble, follow, solve
from vv.engines.exact.modes import State
from vv.scene import Contact, Scene, Spheres, Vector, Wall, rotated

VARIANTS = [variant.name for variant in CASE.variants]
PLAIN = ["T1", "T2", "T3", "T4"]
SCENES = range(200)
SOME = SCENES[::5]  # all kinds are among them
DURATION = 0.2  # s; some four events each


def asked(variant: str, duration: float = 0.4) -> Ask:
    study = CASE.declare(variant, CASE.defaults(variant)).study
    return Ask(study.scene, History(duration, 1e-3), study.observables)


def observed(scene: Scene, duration: float, interval: float) -> Run:
    """The run of a scene with the displacements of all its spheres."""
    numbers: list[int] = []
    first = 0
    for group in scene.bodies:
        numbers.extend(range(first, first + len(group)) if isinstance(group, Spheres) else ())
        first += len(group)
    seen = tuple(Displacement(number) for number in numbers)
    run = solve(Ask(scene, History(duration, interval), seen))
    assert run.status is Status.RAN, run.reason
    return run


def displacements(run: Run) -> Vector:
    """The displacements (times, spheres, 3) [m]."""
    return np.stack(list(run.values.values()), axis=1)


def turned(seed: int) -> Vector:
    """A random rotation of space."""
    matrix = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return np.asarray(matrix * np.sign(np.linalg.det(matrix)))


def motion(scene: Scene, duration: float) -> Motion:
    return follow(assemble(scene), duration)


@pytest.mark.parametrize("variant", VARIANTS)
def test_closed_forms_are_met_to_rounding(variant: str) -> None:
    quantity = CASE.declare(variant, CASE.defaults(variant)).quantities[0]
    run = solve(asked(variant))
    assert run.status is Status.RAN, run.reason
    found = np.asarray(quantity.observe(run))
    assert apart(found, quantity.reference(run.times)) < 1e-13  # type: ignore[operator,misc,call-arg,arg-type]


@pytest.mark.parametrize("test", PLAIN)
def test_coordinates_that_dwarf_the_motion_cost_no_accuracy(test: str) -> None:
    """Spheres of 50 m in a randomly rotated frame: a gap of zero remains zero.

    The overlap of T3 and T4, 0.2 m between coordinates of 50 m, is rounded by the rotation itself
    to 7e-14 of it: hence twice the usual bound.
    """
    quantity = CASE.declare(test, CASE.defaults(test)).quantities[0]
    ask = asked(test)
    for seed in range(20):
        rotation = turned(seed)
        run = solve(dataclasses.replace(ask, scene=rotated(ask.scene, rotation)))
        y = run.values[Displacement(1)] @ rotation[:, 1]
        expected = quantity.reference(run.times)  # type: ignore[operator,misc,call-arg]
        assert apart(y, np.asarray(expected)) < 2e-13, f"seed {seed}"


@pytest.mark.parametrize("variant", VARIANTS)
def test_a_single_contact_has_one_unknown_and_no_arrays_it_does_not_need(variant: str) -> None:
    """It has two if the contact can move along its normal: T3 and T4 under a load, not a lock."""
    ask = asked(variant)
    run, system = solve(ask), assemble(ask.scene)
    path = follow(system, 0.4)
    unknowns = 2 if variant in ("T3-free", "T4-free") else 1
    springs = int(variant[:2] in ("T3", "T4"))
    assert run.model is not None
    assert run.model.unknowns == path.series.shape[2] == unknowns
    assert run.model.terms == ask.scene.terms()
    assert system.rows.shape == (1 + springs, unknowns)
    assert path.lengths.shape == (len(path.start), 1 + springs)


@pytest.mark.parametrize("kind", range(len(KINDS)))
def test_random_scenes_agree_with_scipy_from_event_to_event(kind: int) -> None:
    """The engine solves the scene in a randomly rotated frame. Differences are 3e-12 at most."""
    for seed in SCENES[kind :: len(KINDS)]:
        scene, rotation = small_scene(seed), turned(seed)
        run = observed(rotated(scene, rotation), DURATION, DURATION / 4)
        quickest = np.sqrt(scene.spheres.mass.min() / (6 * scene.contact.kn))
        expected = event_located(scene, run.times, 2 * quickest)
        found = displacements(run) @ rotation
        assert apart(found[..., :2], expected) < 1e-10, f"seed {seed}"
        assert np.abs(found[..., 2]).max() < 1e-13 * np.abs(expected).max(), f"seed {seed}"


def test_the_random_scenes_open_close_stick_and_slip() -> None:
    seen = {
        (event.before, event.after)
        for seed in SOME
        for event in motion(small_scene(seed), DURATION).events
    }
    slips = {State.SLIP_FORWARD, State.SLIP_BACKWARD}
    assert {(State.OPEN, State.STUCK), (State.STUCK, State.OPEN)} < seen
    assert {(State.OPEN, slip) for slip in slips} < seen  # slips from the first touch
    assert {(State.STUCK, slip) for slip in slips} < seen
    assert {(slip, State.STUCK) for slip in slips} < seen
    assert {(slip, State.OPEN) for slip in slips} < seen
    assert {(State.STUCK, State.PARTED), (State.PARTED, State.OPEN)} < seen


@pytest.mark.parametrize("units", [(2.0**-30, 1.0, 1.0), (2.0**20, 2.0**-10, 2.0**15)])
def test_events_know_no_unit(units: tuple[float, float, float]) -> None:
    """Units that are powers of two change no rounding, and a margin in m, s or kg would."""
    for seed in SOME:
        scene, time = small_scene(seed), units[1]
        path = motion(scene, DURATION)
        other = motion(rescaled(scene, *units), time * DURATION)
        assert [event.after for event in other.events] == [event.after for event in path.events]
        assert [e.time for e in other.events] == [time * e.time for e in path.events], (
            f"seed {seed}"
        )


def test_a_contact_that_parted_pushes_again_before_it_was_open() -> None:
    """A ball leaves its wall too fast for the dashpot, and a load drives it back."""
    up = np.array([0.0, 1.0, 0.0])
    thrown = ball(0.99 * up, 0.5 * up, load=-100.0 * up[None], free=np.array([[0, 1, 0]]))
    scene = Scene((Wall(np.zeros(3), up), thrown), Contact(1e3, eta_n=40.0))
    path = motion(scene, 0.1)
    assert path.states[0] == (State.PARTED,)
    assert [event.after for event in path.events] == [State.STUCK]
    run = observed(scene, 0.1, 0.02)
    expected = event_located(scene, run.times, 1e-3)
    assert apart(displacements(run)[..., :2], expected) < 1e-11


def test_a_scene_turned_in_space_moves_alike() -> None:
    for seed in SOME:
        scene, rotation = small_scene(seed), turned(seed)
        plain, other = (observed(s, DURATION, 0.01) for s in (scene, rotated(scene, rotation)))
        assert apart(displacements(other) @ rotation, displacements(plain)) < 1e-13, f"seed {seed}"


def test_a_scene_mirrored_in_a_point_moves_exactly_oppositely() -> None:
    for seed in SOME:
        scene = small_scene(seed)
        found = displacements(observed(_inverted(scene), DURATION, 0.01))
        assert (found == -displacements(observed(scene, DURATION, 0.01))).all(), f"seed {seed}"


@pytest.mark.parametrize("test", ["T3", "T4"])
def test_a_throw_the_other_way_is_the_exact_negative(test: str) -> None:
    there, back = (displacements(solve(asked(v))) for v in (test, f"{test}-mirrored"))
    assert (there == -back).all()


def _inverted(scene: Scene) -> Scene:
    """The scene with all vectors reversed, except for its axes."""
    bodies = []
    for group in scene.bodies:
        wall = isinstance(group, Wall)
        names = ("point", "normal") if wall else ("position", "velocity", "load")
        bodies.append(dataclasses.replace(group, **{n: -getattr(group, n) for n in names}))
    return dataclasses.replace(scene, bodies=tuple(bodies), gravity=-scene.gravity)


def test_an_elastic_motion_runs_backwards() -> None:
    for seed in range(0, 100, len(KINDS)):  # chains, with gravity and loads or without
        scene = dataclasses.replace(small_scene(seed), eta=0.0)
        moved = displacements(observed(scene, DURATION, DURATION))[-1]
        back = displacements(observed(_returning(scene, moved), DURATION, DURATION))[-1]
        assert np.abs(back + moved).max() < 1e-12 * np.abs(moved).max() + 1e-15, f"seed {seed}"


def _returning(scene: Scene, moved: Vector) -> Scene:
    """The scene in its state at the end of a run, with all velocities reversed."""
    path = motion(scene, DURATION)
    _, v = path.at(np.array([DURATION]))
    spheres, velocity = scene.spheres, np.zeros_like(scene.spheres.velocity)
    np.add.at(velocity, path.system.owner, -v[0][:, None] * path.system.direction)
    state = dataclasses.replace(spheres, position=spheres.position + moved, velocity=velocity)
    return dataclasses.replace(scene, bodies=(*scene.walls, state))


def test_energy_is_accounted_for_to_rounding_and_within_its_bound() -> None:
    peaks: dict[str, float] = {}
    for seed in SOME:
        ledger = observed(small_scene(seed), DURATION, DURATION).ledger
        assert ledger is not None
        assert ledger.bound is not None
        size = sum(map(abs, ledger.terms.values()))
        assert ledger.unaccounted <= ledger.bound <= 1e-11 * max(size, ledger.peak), f"seed {seed}"
        for name, term in ledger.terms.items():
            peaks[name] = max(peaks.get(name, 0.0), abs(term) / size)
    assert min(peaks.values()) > 0.05, peaks  # no term is always small


def test_overlaps_far_below_the_displacements_keep_the_energy() -> None:
    """A ball of 1 kg falls 0.5 m again and again on a plane that is compressed by 3e-11 m."""
    falling = ball(np.array([0.0, 0.0, 1.5]), np.zeros(3))
    scene = Scene((FLOOR, falling), Contact(1e22), gravity=DOWN)
    path = motion(scene, 5.0)
    assert len(path.events) == 16
    ledger = observed(scene, 5.0, 1.0).ledger
    assert ledger is not None
    assert ledger.bound is not None
    assert ledger.unaccounted <= ledger.bound < 1e-12


def test_the_energies_of_t3_are_those_of_the_closed_form() -> None:
    """m v_b^2/2 = ks y1^2/2 + mu Fn b: half of the oscillation remains at the end, about b."""
    p, run = CASE.defaults("T3"), solve(asked("T3", 20.0))
    scene = asked("T3").scene
    dx = -float(scene.walls[0].normal @ (0 - scene.walls[0].point)) + p["r"]
    y1 = p["mu"] * p["kn"] * dx / p["ks"]
    assert run.ledger is not None
    thrown = scene.spheres.mass[0] * p["v_b"] ** 2 / 2
    lost = run.ledger.terms["friction dissipation"]
    assert lost == pytest.approx(thrown - p["ks"] * y1**2 / 2, rel=1e-12)
    left = run.ledger.terms["kinetic"] + run.ledger.terms["shear elastic"]
    assert left == pytest.approx(p["ks"] * y1**2 / 2, rel=1e-12)


def test_t3_grazes_the_slip_limit_for_twenty_seconds_and_slips_once() -> None:
    events = motion(asked("T3").scene, 20.0).events
    assert [event.after for event in events] == [State.SLIP_FORWARD, State.STUCK]
    assert [event.time for event in events] == pytest.approx([0.0225389403, 0.1896128782])


@pytest.mark.parametrize(("ratio", "collisions"), [(1e2, 31), (1e4, 314)])
def test_a_ball_between_a_wall_and_a_heavy_one_counts_the_digits_of_pi(
    ratio: float, collisions: int
) -> None:
    path = motion(crowded(ratio), 3.0)
    opened = [event for event in path.events if event.after is State.OPEN]
    assert len(opened) == collisions


def test_the_velocity_is_that_of_the_closed_form() -> None:
    ask = asked("T1", 0.1)
    run = solve(dataclasses.replace(ask, observables=(Velocity(1),)))
    p = CASE.defaults("T1")
    k = np.sqrt(p["kn"] / ask.scene.spheres.mass[1])
    assert apart(run.values[Velocity(1)][:, 1], p["v_a"] * np.cos(k * run.times)) < 1e-14


def test_a_load_that_bears_the_weight_but_for_rounding_moves_nothing() -> None:
    """A ball that floats over a floor has one unknown, along its velocity."""
    weight = 2.0 * -DOWN
    bearing = np.nextafter(weight, 0.0)
    floats = ball(2.0 * UP, ALONG, mass=np.array([2.0]), load=bearing[None])
    scene = Scene((Wall(np.zeros(3), UP), floats), Contact(1e3), gravity=DOWN)
    assert 0.0 < np.abs(weight - bearing).max() < 1e-14
    assert len(assemble(scene).mass) == 1


def test_bodies_that_cannot_meet_are_no_reason_to_refuse() -> None:
    """Balls fall side by side: their normal would turn if they could touch."""
    falling = tuple(ball(np.array([x, 0.0, 1.5]), np.zeros(3)) for x in (0.0, 2.0, 4.5))
    scene = Scene((FLOOR, *falling), Contact(1e3, 1e3, 0.5), gravity=DOWN)
    run = observed(scene, 1.0, 0.1)
    assert run.model is not None
    assert run.model.unknowns == 3
    first = displacements(run)[:, :1]
    assert np.abs(displacements(run) - first).max() < 1e-14
    assert "without effect here: contact between spheres, shear spring" in run.model.note
