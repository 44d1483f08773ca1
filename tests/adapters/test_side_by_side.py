"""Claims about several blocks on one wall, which in YADE and LIGGGHTS are a body each."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import adapters.liggghts
import adapters.yade
from cases.blocks.failure_modes import CASE as CHART
from cases.blocks.rocking import CASE as ROCKING
from tests.scenes.blocks.block_scenes import FREE, HELD, box, incline
from tests.support.installed import require
from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.case import Ladder, Quantity
from vv.codes import Adapter
from vv.scene import Block, Scene, polyhedron_inertia

CODES: dict[str, Adapter] = {"yade": adapters.yade.ADAPTER, "liggghts": adapters.liggghts.ADAPTER}
ALPHA, PHI, G = 30.0, 20.0, 9.81
STARTS, PULLS = (0.0, 0.4, 0.1), (0.0, 20.0, -600.0)  # m/s and N down the slope
SIDES = ((0.5, 0.5, 0.5), (0.3, 0.2, 0.1), (0.8, 0.4, 0.3))


def sliding() -> Scene:
    """Three blocks side by side on one slope, each with its size, mass, start and load."""
    slope = incline(ALPHA, PHI, free_spin=HELD)
    down, along, up = slope.axes
    blocks = []
    for n, (half, v0, pull) in enumerate(zip(SIDES, STARTS, PULLS, strict=True)):
        centre, moves = half[2] * up + 3.0 * n * along, {"velocity": v0 * down, "load": pull * down}
        blocks.append(box(str(n), centre, half, slope.axes, free_spin=HELD, **moves))
    return dataclasses.replace(slope, bodies=(*slope.walls, *blocks))


def ran(code: str, ask: Ask, scheme: str, scratch: Path) -> Run:
    require(CODES[code])
    assert CODES[code].refuses(ask, scheme) is None
    (run,) = CODES[code].run([ask], scheme, scratch, 0.0)
    assert run.status is Status.RAN, run.reason
    return run


@pytest.mark.parametrize("scheme", ["default", "clump"])
@pytest.mark.parametrize("code", CODES)
def test_each_block_slides_by_its_own_start_and_load(
    code: str, scheme: str, tmp_path: Path
) -> None:
    scene, seen = sliding(), tuple(Displacement(1 + n) for n in range(len(SIDES)))
    run = ran(code, Ask(scene, History(0.5, 0.05), seen, Knobs(1e-5, 1e9)), scheme, tmp_path)
    slope = np.radians(ALPHA)
    for n, block in enumerate(scene.blocks):
        rubs = np.tan(np.radians(PHI)) * np.cos(slope)
        pull = G * (np.sin(slope) - rubs) + PULLS[n] / block.mass
        due = STARTS[n] * run.times + 0.5 * pull * run.times**2
        moved = run.values[seen[n]] @ scene.axes.T
        assert moved[:, 0] == pytest.approx(due, abs=1e-9)
        assert np.abs(moved[:, 1:]).max() < 1e-9


def charted(variant: str) -> tuple[Ask, dict[str, Quantity]]:
    """The chart at a step that explicit codes bear."""
    trial = CHART.declare(variant, CHART.defaults(variant))
    assert isinstance(trial.study, Ladder)
    ask = trial.study.ask(Knobs(trial.study.goal.duration / 400, 1e10))
    return ask, {quantity.name: quantity for quantity in trial.quantities}


@pytest.mark.parametrize("variant", ["2d-60", "3d-20", "gravity-32"])
@pytest.mark.parametrize("code", CODES)
def test_the_chart_of_first_motions_is_right_at_every_point(
    code: str, variant: str, tmp_path: Path
) -> None:
    ask, quantities = charted(variant)
    run = ran(code, ask, "clump", tmp_path)
    assert quantities["agree"].observe(run) == len(ask.scene.blocks)
    assert quantities["worst"].observe(run) < 1e-3


@pytest.mark.parametrize("variant", ["3d-6", "3d-20"])  # in the first no block is to tip
@pytest.mark.parametrize("code", CODES)
def test_a_step_that_throws_one_of_many_blocks_about_is_refused(code: str, variant: str) -> None:
    ask, _ = charted(variant)
    long = dataclasses.replace(ask, knobs=Knobs(5e-4, 1e10))
    assert "the springs of its corners are stable up to" in (
        CODES[code].refuses(long, "clump") or ""
    )


@pytest.mark.parametrize("code", CODES)
def test_blocks_on_unlike_numbers_of_corners_are_refused(code: str) -> None:
    scene = sliding()
    ask = Ask(scene, History(0.5, 0.05), (Displacement(1),), Knobs(1e-5, 1e9))
    down, along, up = scene.axes
    flat = np.array([[0, 0], [1, 0], [0, 1]]) @ np.array([down, along]) + 12.0 * along
    vertices = np.concatenate([flat, flat + up])
    faces = ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))
    mass, inertia = polyhedron_inertia(vertices, faces, 1000.0)
    prism = Block("prism", vertices, faces, mass, inertia, np.zeros(3), FREE, HELD)
    mixed = dataclasses.replace(
        ask, scene=dataclasses.replace(scene, bodies=(*scene.bodies, prism))
    )
    assert "stand on 4 and 3 corners" in (CODES[code].refuses(mixed, "clump") or "")


@pytest.mark.parametrize("code", CODES)
def test_a_wide_block_turns_by_its_own_moment_of_inertia(code: str, tmp_path: Path) -> None:
    """About the axis it is free in, whichever of its three moments that is."""
    trial = ROCKING.declare("released", {**ROCKING.defaults("released"), "b": 0.5, "mu": 1.2})
    assert isinstance(trial.study, Ladder)
    run = ran(code, trial.study.ask(Knobs(2.5e-5, 1e10)), "clump", tmp_path)
    swing = next(one for one in trial.quantities if one.name == "first swing")
    assert swing.observe(run) < 1e-3


def test_yade_refuses_a_block_that_turns_about_two_axes() -> None:
    scene = incline(0.0, 30.0, free_spin=np.array([True, True, False]))
    ask = Ask(scene, History(0.5, 0.05), (Displacement(1),), Knobs(1e-5, 1e9))
    assert "can rotate about two axes" in (CODES["yade"].refuses(ask, "clump") or "")
    assert CODES["liggghts"].refuses(ask, "clump") is None
