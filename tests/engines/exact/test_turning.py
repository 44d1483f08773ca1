"""Claims about the exact motion of a block whose slip changes direction on a rigid wall."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from reference_solutions.blocks import turning_slip
from tests.scenes.blocks.exact_slides import BOX, DOWN, LEVEL, apart, ran, turned
from tests.scenes.blocks.sliding_blocks import FREE, Frame, G, block, wall
from vv.ask import Ask, History, Knobs, Status
from vv.engines.exact import duration, prepare, ready, solve
from vv.engines.exact.turn.flow import TurningFlow
from vv.plan.project import find
from vv.scene import Contact, Harmonic, Scene, Vector

ROUNDING = 1e-13  # of the greatest slip: some 500 pieces, each a few roundings off
DURATION = 4.0


def shaken_slope(
    seed: int, mu: float = 0.45, frame: Frame | None = None, start: tuple[float, float] = (0, 0)
) -> Scene:
    """A block on a slope, shaken along its dip, strike and normal at three frequencies."""
    r, frame = np.random.default_rng(seed), frame or Frame(15.0)
    amplitude, frequency = r.uniform((2, 2, 0.5), (5, 5, 1.5)), r.uniform(0.6, 3.0, 3)
    drive = Harmonic(amplitude, frequency, r.uniform(0, 6.3, 3), frame.axes)
    velocity = start[0] * frame.axes[0] + start[1] * frame.axes[1]
    bodies = (wall(frame), block(frame, velocity))
    return Scene(bodies, Contact(np.inf, mu=mu), gravity=DOWN, shaking=drive)


def by_collocation(
    frame: Frame, mu: float, times: Vector, frequency: Vector, phase: Vector, amplitude: Vector
) -> Vector:
    """The slip (t, 3) under weight and k sines, amplitude (k, 3) [m/s2] along the frame's axes, by
    the reference's collocation, which starts from rest."""
    size = amplitude.T * np.array([[1.0], [1.0], [-mu]])
    weight = np.array([1.0, 1.0, -mu]) * (frame.axes @ DOWN)
    omega = 2 * np.pi * frequency
    given = turning_slip.Drive(omega, weight, size * np.cos(phase), size * np.sin(phase))
    steps = turning_slip.history(given, float(times[-1]))
    return np.asarray(turning_slip.displacement(times, steps) @ frame.axes[:2])


@pytest.mark.parametrize("seed", range(6))
def test_a_slip_that_turns_agrees_with_collocation(seed: int) -> None:
    frame, scene = Frame(15.0), shaken_slope(seed)
    run, drive = ran(scene, DURATION), scene.shaking
    assert run.times is not None
    assert isinstance(drive, Harmonic)
    sines = drive.frequency, drive.phase, np.diag(drive.amplitude)
    found = by_collocation(frame, scene.contact.mu, run.times, *sines)
    assert apart(run.values[BOX], found) < ROUNDING


def test_six_sines_of_shaking_and_of_the_wall_agree_with_collocation() -> None:
    """The wall starts from rest, and is felt as a shaking with its opposite acceleration."""
    frame, scene, size = Frame(15.0), shaken_slope(1), np.array([0.03, 0.02, 0.005])
    frequency, phase = np.array([1.9, 2.3, 1.1]), np.full(3, -np.pi / 2)
    motion, drive = Harmonic(size, frequency, phase, frame.axes), scene.shaking
    bodies = (wall(frame, motion), scene.blocks[0])
    run = ran(dataclasses.replace(scene, bodies=bodies), DURATION)
    assert run.times is not None
    assert isinstance(drive, Harmonic)
    found = by_collocation(
        frame,
        scene.contact.mu,
        run.times,
        np.append(drive.frequency, frequency),
        np.append(drive.phase, phase),
        np.vstack((np.diag(drive.amplitude), np.diag((2 * np.pi * frequency) ** 2 * size))),
    )
    moved = (np.sin(2 * np.pi * np.outer(run.times, frequency) + phase) + 1) * size @ frame.axes
    assert apart(run.values[BOX], moved + found) < ROUNDING


def pieces(name: str) -> int:
    """How many pieces the motion of a case's variant takes."""
    case, _, variant = name.partition(":")
    made = find().load_case(case)
    ask = made.declare(variant, made.defaults(variant)).study.ask(Knobs())
    flow = ready(prepare(ask), duration(ask))
    assert isinstance(flow, TurningFlow)
    return flow.follow()


def test_a_slip_that_nearly_stops_takes_long_pieces() -> None:
    """A series in time reaches no farther than a complex time at which the slip would stop: with
    such series there were 709 pieces."""
    assert pieces("responding-block:2d") < 460


def test_a_drive_that_friction_nearly_balances_takes_long_pieces() -> None:
    """A slip that starts slowly on a slope: pieces are limited by the convergence of their series.

    They are not limited by the time to rest without a driving force.
    """
    assert pieces("incline:two-directions") < 250


def test_a_slip_under_constant_forces_ends_when_the_closed_form_says() -> None:
    """F |w| + T.w decreases at the rate F^2 - |T|^2, whatever the path of the slip."""
    frame, start = Frame(15.0), np.array([-0.7, 1.3])
    law = Contact(np.inf, mu=0.45)
    bodies = (wall(frame), block(frame, start @ frame.axes[:2]))
    path = turned(Scene(bodies, law, gravity=DOWN), 3.0)
    pull, hold = G * np.sin(np.radians(15)), 0.45 * G * np.cos(np.radians(15))
    end = (hold * np.linalg.norm(start) + pull * start[0]) / (hold**2 - pull**2)
    assert path.changes == pytest.approx([end], rel=ROUNDING)


def test_sines_in_step_along_two_axes_slip_as_one_along_their_diagonal() -> None:
    box, law = block(LEVEL, 0 * DOWN), Contact(np.inf, mu=0.2)
    turn = np.array([[np.cos(0.6), np.sin(0.6), 0], [-np.sin(0.6), np.cos(0.6), 0], [0, 0, 1]])
    both = Harmonic((4 * np.cos(0.6), 4 * np.sin(0.6), 0), (1.5, 1.5, 1))  # type: ignore[arg-type]
    one = Harmonic((4, 0, 0), (1.5, 1, 1), axes=turn)  # type: ignore[arg-type]
    plane, line = (
        ran(Scene((wall(LEVEL), box), law, gravity=DOWN, shaking=drive), DURATION)
        for drive in (both, one)
    )
    assert [run.model and run.model.unknowns for run in (plane, line)] == [2, 1]
    assert apart(plane.values[BOX], line.values[BOX]) < ROUNDING


def test_a_slip_without_friction_is_the_sum_of_its_sines() -> None:
    scene = shaken_slope(0, mu=0.0, start=(0.3, -0.2))
    run, frame = ran(scene, DURATION), Frame(15.0)
    drive, t = scene.shaking, run.times
    assert isinstance(drive, Harmonic)
    assert t is not None
    omega = 2 * np.pi * drive.frequency
    sines = (np.sin(drive.phase) - np.sin(np.outer(t, omega) + drive.phase)) / omega**2
    sines += np.outer(t, np.cos(drive.phase) / omega)
    along = drive.amplitude * sines + np.outer(t, [0.3, -0.2, 0])
    along[:, 0] += G * np.sin(np.radians(15)) * t**2 / 2
    assert apart(run.values[BOX], along[:, :2] @ frame.axes[:2]) < ROUNDING


def test_the_frame_of_a_slope_changes_nothing() -> None:
    here, there = Frame(15.0), Frame(15.0, 1.1)
    runs = [ran(shaken_slope(3, frame=frame), DURATION) for frame in (here, there)]
    seen = [run.values[BOX] @ frame.axes.T for run, frame in zip(runs, (here, there), strict=True)]
    assert apart(*seen) < ROUNDING


def test_a_wall_that_moves_in_two_directions_carries_the_block_as_shaking_would() -> None:
    """In the frame of the wall, its motion is a shaking with the opposite acceleration."""
    frequency, size = np.array([1.3, 0.9, 1.0]), np.array([0.06, 0.1, 0.0])
    motion = Harmonic(size, frequency)
    bodies = (wall(LEVEL, motion), block(LEVEL, 2 * np.pi * frequency * size))
    law = Contact(np.inf, mu=0.2)
    carried = ran(Scene(bodies, law, gravity=DOWN), DURATION)
    still = Harmonic((2 * np.pi * frequency) ** 2 * size, frequency)
    shaken = ran(
        Scene((wall(LEVEL), block(LEVEL, 0 * DOWN)), law, gravity=DOWN, shaking=still), DURATION
    )
    assert carried.times is not None
    ground = size * np.sin(2 * np.pi * np.outer(carried.times, frequency))
    assert apart(carried.values[BOX] - ground, shaken.values[BOX]) < ROUNDING


@pytest.mark.parametrize("seed", range(4))
def test_energy_is_conserved_while_the_wall_moves_too(seed: int) -> None:
    scene = shaken_slope(seed, start=(0.4, 0.9))
    motion = Harmonic((0.02, 0.03, 0.0), (1.1, 2.3, 1.0), axes=Frame(15.0).axes)  # type: ignore[arg-type]
    ledger = ran(
        dataclasses.replace(scene, bodies=(wall(Frame(15.0), motion), scene.blocks[0])), DURATION
    ).ledger
    assert ledger is not None
    assert ledger.terms["friction dissipation"] > 0
    assert ledger.bound is not None
    assert ledger.unaccounted < ledger.bound < 1e-9 * ledger.terms["friction dissipation"]


def test_a_block_locked_across_the_dip_slips_along_a_line() -> None:
    free = FREE.copy()
    free[1] = False
    bodies = (wall(LEVEL), block(LEVEL, 0 * DOWN, free))
    drive = Harmonic((3, 3, 0), (1.0, 2.0, 1.0))  # type: ignore[arg-type]
    run = ran(Scene(bodies, Contact(np.inf, mu=0.1), gravity=DOWN, shaking=drive), 1.0)
    assert run.model is not None
    assert run.model.unknowns == 1


def test_too_many_pieces_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vv.engines.exact.turn.flow.FEW", 10)
    monkeypatch.setattr("vv.engines.exact.turn.flow.MOST", 40)
    run = solve(Ask(shaken_slope(0), History(DURATION, 0.1), (BOX,)))
    assert run.status is Status.REFUSED
    assert "more than 40 steps" in run.reason


def test_a_long_quick_slip_is_the_same_with_its_axes_turned() -> None:
    """Phases that lose digits, or gaps between pieces, would cause a difference of 1e-11."""
    frequency, size = np.array([20.0, 15.0, 1.0]), np.array([0.3, 0.2, 0.0])
    ways = []
    for angle in (0.0, 0.6):
        c, s = np.cos(angle), np.sin(angle)
        axes = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        motion = Harmonic(size, frequency, np.full(3, -np.pi / 2), axes)
        bodies = (wall(LEVEL, motion), block(LEVEL, 0 * DOWN))
        run = ran(Scene(bodies, Contact(np.inf, mu=0.6), gravity=DOWN), 5.0)
        ways.append(run.values[BOX] @ axes.T)
    assert apart(ways[1], ways[0]) < 5e-12


@pytest.mark.parametrize("quicker", [1e-5, 1e5])
def test_a_slip_that_is_quicker_at_every_time_is_as_much_smaller(quicker: float) -> None:
    """With the same accelerations; when rest ends is found among microseconds as among days."""
    slow = shaken_slope(3)
    drive = slow.shaking
    assert isinstance(drive, Harmonic)
    fast = dataclasses.replace(
        slow, shaking=dataclasses.replace(drive, frequency=quicker * drive.frequency)
    )
    paths = turned(slow, DURATION), turned(fast, DURATION / quicker)
    assert quicker * paths[1].changes == pytest.approx(paths[0].changes, rel=ROUNDING)
