"""Runs and paths of the exact engine on a block that rigid contact keeps on a wall."""

from __future__ import annotations

import numpy as np

from tests.scenes.blocks.sliding_blocks import Frame, G
from vv.ask import Ask, Displacement, History, Run, Status, Velocity
from vv.engines.exact import (
    Slide,
    Slider,
    Turn,
    TurningSlider,
    assemble_slider,
    move,
    solve,
)
from vv.scene import Scene, Vector

BOX = Displacement(1)
EXACT = 1e-12
DOWN = np.array([0.0, 0.0, -G])
LEVEL = Frame(0.0)


def ran(scene: Scene, duration: float, interval: float | None = None) -> Run:
    run = solve(Ask(scene, History(duration, interval or duration / 500), (BOX, Velocity(1))))
    assert run.status is Status.RAN, run.reason
    return run


def slid(scene: Scene, duration: float) -> Slide:
    slider = assemble_slider(scene)
    assert isinstance(slider, Slider)
    slide = move(slider, duration)
    assert isinstance(slide, Slide)
    return slide


def turned(scene: Scene, duration: float) -> Turn:
    slider = assemble_slider(scene)
    assert isinstance(slider, TurningSlider)
    turn = move(slider, duration)
    assert isinstance(turn, Turn)
    return turn


def apart(found: Vector, expected: Vector) -> float:
    return float(np.abs(found - expected).max() / np.abs(expected).max())
