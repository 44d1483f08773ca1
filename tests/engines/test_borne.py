"""Claims about supports of shaken blocks: forces and impulses of locks, in rigid and in dda."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import DOWN, HELD, box
from vv.ask import Ask, History, Impulse, Knobs, Observable, Reaction, Run, Velocity
from vv.engines import dda, rigid
from vv.scene import Contact, Harmonic, Scene

DT, TIME = 1e-3, 0.1  # s
BED = box("bed", [0.0, 0.0, -0.5], [2.0, 0.5, 0.5], free=HELD, free_spin=HELD)
SHAKING = Harmonic(np.array([9.0, 0.0, 2.0]), np.array([2.0, 0.0, 3.0]), np.zeros(3))
SOLVERS: dict[str, Callable[[Ask], Run]] = {
    "rigid": rigid.solve,
    "dda": lambda ask: dda.solve(ask, dda.DEFAULT),
    "dda/lagged": lambda ask: dda.solve(ask, dda.LAGGED),
}


def pile(
    height: int, gap: float = 0.0, shaking: Harmonic | None = SHAKING, beside: float = 0.0
) -> Scene:
    """A pile of blocks on a fixed bed, shaken so that they slip.

    beside [m]: distance from the middle of the bed; beyond 2 m they tip over its edge, and faces
    turn.
    """
    middles = (0.5 + gap + np.arange(height)).tolist()
    blocks = (box(f"{z:g}", [beside + 0.1 * z, 0.0, z], [0.5] * 3) for z in middles)
    return Scene((BED, *blocks), Contact(np.inf, mu=0.3), gravity=DOWN, shaking=shaking)


def seen(code: str, scene: Scene, interval: float = DT) -> Run:
    """The results of a code for a scene: reaction and impulse of the bed, and all velocities."""
    moving: tuple[Observable, ...] = tuple(map(Velocity, range(1, len(scene.blocks))))
    watched = (Reaction(0), Impulse(0), *moving)
    return SOLVERS[code](Ask(scene, History(TIME, interval), watched, Knobs(DT, 1e9)))


def momentum(run: Run, scene: Scene) -> np.ndarray:
    """The momentum of all moving blocks (k, 3)."""
    moving = enumerate(scene.blocks[1:], 1)
    return np.asarray(sum(block.mass * run.values[Velocity(i)] for i, block in moving))


@pytest.mark.parametrize(("height", "beside"), [(1, 0.0), (10, 0.0), (1, 2.0)])
@pytest.mark.parametrize("code", SOLVERS)
def test_blocks_have_the_momentum_that_locks_and_loads_gave(
    code: str, height: int, beside: float
) -> None:
    scene = pile(height, beside=beside)
    run, mass = seen(code, scene), sum(block.mass for block in scene.blocks)
    t = run.times[:, None]
    w = 2 * np.pi * np.where(SHAKING.frequency > 0, SHAKING.frequency, 1.0)
    loads = mass * (DOWN * t + SHAKING.amplitude * (1 - np.cos(w * t)) / w)
    off = np.abs(run.values[Impulse(0)] + loads - momentum(run, scene)).max()
    late = 0.5 * DT * mass * np.abs(SHAKING.amplitude).max()  # dda takes shaking at ends of steps
    assert np.abs(momentum(run, scene)[-1, 0]) >= 10.0
    assert off <= 1e-10 * np.abs(loads).max() + (1.1 * late if code != "rigid" else 0.0)


@pytest.mark.parametrize("code", SOLVERS)
def test_the_force_of_locks_is_what_their_impulse_grows_by_in_a_step(code: str) -> None:
    run = seen(code, pile(10))
    grows = np.diff(run.values[Impulse(0)], axis=0) / DT
    uncut = np.median(np.abs(grows - run.values[Reaction(0)][1:]), axis=0)
    assert uncut.max() <= 1e-9 * np.abs(grows).max()
    assert np.abs(run.values[Reaction(0)][0] - grows[0]).max() <= 1e-9 * np.abs(grows).max()


@pytest.mark.parametrize("code", SOLVERS)
def test_a_blow_counts_among_the_impulses_of_locks(code: str) -> None:
    scene = pile(1, gap=1e-2, shaking=None)
    run, mass = seen(code, scene, interval=TIME), sum(block.mass for block in scene.blocks)
    given = run.values[Impulse(0)][-1] + mass * DOWN * TIME - momentum(run, scene)[-1]
    assert np.abs(given).max() <= 1e-10 * mass
