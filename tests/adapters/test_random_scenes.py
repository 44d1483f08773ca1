"""Claims that hold in any valid scene: no code of ours fails in it, and all agree on it.

Hypothesis draws the scenes, and makes those small in which a claim does not hold.
"""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, given, settings

import adapters.dda
import adapters.dem
import adapters.exact
import adapters.rigid
from tests.scenes.other_worlds import rescaled
from tests.scenes.random_scenes import (
    any_blocks,
    any_spheres,
    in_a_row,
    mirrored,
    moving,
    slopes,
    thrown,
)
from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.codes import Adapter, known_beforehand
from vv.gate.judgement import breaches
from vv.records.checking import checked
from vv.scene import Block, Scene, Spheres, Vector, rotated, with_bodies_reversed

OURS: tuple[Adapter, ...] = (
    adapters.dem.ADAPTER, adapters.exact.ADAPTER, adapters.rigid.ADAPTER, adapters.dda.ADAPTER
)  # fmt: skip
FEW = settings(max_examples=6, derandomize=True,
               suppress_health_check=list(HealthCheck))  # fmt: skip
MANY = settings(FEW, max_examples=60)
ENDS = {Status.RAN, Status.REFUSED, Status.DIVERGED}
TURN = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
ROUNDED = 1e-7  # of the way: rounding, and what a few blows make of it


def asked(scene: Scene, duration: float, dt: float | None, kn: float | None = None) -> Ask:
    kind = Block if scene.blocks else Spheres
    seen = tuple(map(Displacement, scene.body_numbers(kind)))
    return Ask(scene, History(duration, duration / 8), seen, Knobs(dt, kn))


def answer(adapter: Adapter, ask: Ask, scheme: str = "default") -> Run:
    """What a scheme says of an ask, as the framework takes it."""
    one = next(s for s in adapter.schemes if s.name == scheme)
    knobs = {name: getattr(ask.knobs, name) for name in one.knobs}
    mine = dataclasses.replace(ask, knobs=Knobs(**knobs))
    known = known_beforehand(adapter, one, mine, adapter.found())
    if known is not None:
        return known
    (run,) = adapter.run([mine], scheme, Path(), 0.0)
    return checked(run, mine)


def way(run: Run) -> Vector:
    """The displacements (k, b, 3) of a run that kept to the laws that it promises."""
    assert run.status is Status.RAN, run.reason
    assert list(breaches(run.ledger)) == []
    return np.stack(list(run.values.values()), axis=1)


def apart(one: Vector, other: Vector) -> float:
    return float(np.abs(one - other).max() / np.abs(one).max())


@given(any_spheres())
@MANY
def test_a_scheme_that_does_not_refuse_a_scene_models_all_of_it(scene: Scene) -> None:
    for adapter in OURS:
        for scheme in adapter.schemes:
            dt = 1e-5 if "dt" in scheme.knobs else None
            ask = asked(scene, 1e-3, dt, 1e8 if "kn" in scheme.knobs else None)
            if known_beforehand(adapter, scheme, ask, adapter.found()) is None:
                left_out = scene.terms() - adapter.describe(ask, scheme.name).terms
                assert not left_out, f"{adapter.name}/{scheme.name}"


@given(any_blocks())
@FEW
def test_blocks_end_well_wherever_they_are_taken_and_keep_to_the_laws(scene: Scene) -> None:
    for adapter in (adapters.rigid.ADAPTER, adapters.dda.ADAPTER):
        run = answer(adapter, asked(scene, 0.2, 2.5e-3, 1e8))
        assert run.status in ENDS, run.reason
        assert list(breaches(run.ledger)) == [], adapter.name


@given(thrown())
@FEW
def test_spheres_do_not_care_how_the_world_is_turned_mirrored_numbered_or_measured(
    scene: Scene,
) -> None:
    dem, dt, duration = adapters.dem.ADAPTER, 2e-4, 0.1
    plain = way(answer(dem, asked(scene, duration, dt)))
    assert np.abs(plain).max() > 0.05
    turned = way(answer(dem, asked(rotated(scene, TURN), duration, dt))) @ TURN
    flipped = way(answer(dem, asked(mirrored(scene), duration, dt))) * [1.0, -1.0, 1.0]
    backward = way(answer(dem, asked(with_bodies_reversed(scene), duration, dt)))[:, ::-1]
    measured = way(answer(dem, asked(rescaled(scene, 1e3, 1e-2, 10.0), 1e-2 * duration, 1e-2 * dt)))
    for other in (turned, flipped, backward, measured / 1e3):
        assert apart(plain, other) <= ROUNDED


@given(thrown())
@FEW
def test_two_spheres_collide_alike_in_a_frame_that_moves(scene: Scene) -> None:
    dem, dt, duration, by = adapters.dem.ADAPTER, 2.5e-4, 0.05, np.array([0.3, -2.0, 1.0])
    alone = moving(scene, np.zeros(3))
    one = answer(dem, asked(alone, duration, dt))
    other = way(answer(dem, asked(moving(alone, by), duration, dt)))
    assert apart(way(one), other - np.multiply.outer(one.times, by)[:, None]) <= ROUNDED


@given(in_a_row())
@FEW
def test_the_leapfrog_comes_to_the_exact_answer(scene: Scene) -> None:
    # not by its order: a blow begins within a step
    exact = way(answer(adapters.exact.ADAPTER, asked(scene, 0.2, None)))
    for dt, within in ((1e-3, 0.05), (1e-4, 0.005)):
        assert apart(exact, way(answer(adapters.dem.ADAPTER, asked(scene, 0.2, dt)))) <= within


@given(slopes())
@FEW
def test_a_block_slides_alike_in_all_codes_that_have_blocks(scene: Scene) -> None:
    exact = way(answer(adapters.exact.ADAPTER, asked(scene, 0.4, None)))
    slid = np.linalg.norm(np.diff(exact, axis=0), axis=-1).sum()  # up and down: each turn costs
    scale = max(float(slid), 0.02)  # m: a block that sticks at once goes nowhere
    for adapter, within in ((adapters.rigid.ADAPTER, 1e-4), (adapters.dda.ADAPTER, 2e-2),
                            (adapters.dem.ADAPTER, 5e-2)):  # fmt: skip
        run = answer(adapter, asked(scene, 0.4, 1e-3, 1e8))
        assert run.status in ENDS, run.reason
        if run.status is Status.RAN:
            assert np.abs(way(run) - exact).max() <= within * scale, adapter.name
