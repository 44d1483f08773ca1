"""Claims about codes whose bodies are all polyhedra: what they refuse and what they answer."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import adapters.lmgc90
import adapters.pybullet
from cases.blocks.incline import CASE as INCLINE
from cases.blocks.laden_block import CASE as LADEN
from cases.blocks.rocking import CASE as ROCKING
from cases.hard.knife_edge import CASE as KNIFE_EDGE
from cases.hard.painleve import CASE as PAINLEVE
from cases.hard.spin_stopped import CASE as SPIN_STOPPED
from cases.hard.standing import CASE as STANDING
from tests.support.installed import require
from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.case import Case, Ladder, Series
from vv.codes import Adapter
from vv.scene import Block, Contact, Harmonic, Pulse, Wall

CODES: dict[str, Adapter] = {
    "lmgc90": adapters.lmgc90.ADAPTER,
    "pybullet": adapters.pybullet.ADAPTER,
}
STEP = Knobs(1e-3)


def asked(case: Case, variant: str, **parameters: float) -> tuple[Ask, Series]:
    """An ask at 1e-3 s, and its first quantity."""
    trial = case.declare(variant, {**case.defaults(variant), **parameters})
    assert isinstance(trial.study, Ladder)
    quantity = trial.quantities[0]
    assert isinstance(quantity, Series)
    return trial.study.ask(STEP), quantity


def answered(code: str, asks: list[Ask], scratch: Path) -> list[Run]:
    require(CODES[code])
    runs = list(CODES[code].run(asks, "default", scratch, 0.0))
    assert [run.status for run in runs] == [Status.RAN] * len(asks), runs
    return runs


def off(run: Run, quantity: Series) -> float:
    assert quantity.reference is not None
    exact = quantity.reference(run.times)
    return float(np.abs(quantity.observe(run) - exact).max() / np.abs(exact).max())


def test_lmgc90_refuses_what_does_not_meet_face_to_face_and_says_so() -> None:
    adapter = CODES["lmgc90"]
    reasons = {
        "knife-edge": adapter.refuses(asked(KNIFE_EDGE, "topples")[0], "default"),
        "painleve": adapter.refuses(asked(PAINLEVE, "mu-0.8")[0], "default"),
        "spin-stopped": adapter.refuses(asked(SPIN_STOPPED, "crossed")[0], "default"),
    }
    assert "do not meet face to face" in str(reasons["knife-edge"])
    assert "inertia which is not that of its volume" in str(reasons["painleve"])
    assert "spins at the start" in str(reasons["spin-stopped"])


def test_lmgc90_takes_blocks_of_one_density_only() -> None:
    trial = STANDING.declare("stack-10", STANDING.defaults("stack-10"))
    assert isinstance(trial.study, Ladder)
    ask = trial.study.ask(STEP)
    assert CODES["lmgc90"].refuses(ask, "default") is None
    *others, last = ask.scene.bodies
    assert isinstance(last, Block)
    heavy = dataclasses.replace(last, mass=2 * last.mass, inertia=2 * last.inertia)
    scene = dataclasses.replace(ask.scene, bodies=(*others, heavy))
    reason = CODES["lmgc90"].refuses(dataclasses.replace(ask, scene=scene), "default")
    assert reason == "block '10' has another density than the first; LMGC90 takes a single one"


def test_pybullet_locks_rotation_about_axes_of_inertia_only() -> None:
    reason = CODES["pybullet"].refuses(asked(KNIFE_EDGE, "topples")[0], "default")
    assert reason == "block 'upper' is locked about an axis that is no principal axis of inertia"


def test_pybullet_has_one_frame_for_all_walls_and_tells_nothing_of_them() -> None:
    ask, _ = asked(LADEN, "level")
    refuses = CODES["pybullet"].refuses
    (wall,) = ask.scene.walls
    assert wall.motion is not None
    assert refuses(ask, "default") is None
    still = dataclasses.replace(wall, point=wall.point - 99 * wall.normal, motion=None)
    both = dataclasses.replace(ask.scene, bodies=(*ask.scene.bodies, still))
    reason = refuses(dataclasses.replace(ask, scene=both), "default")
    assert reason == (
        "a wall moves and another does not; all must move alike, as the frame of the blocks"
    )
    number = ask.scene.body_numbers(Wall)[0]
    seen = dataclasses.replace(ask, observables=(Displacement(number),))
    assert refuses(seen, "default") == (
        f"body {number} is a wall, for which PyBullet reports nothing"
    )
    blocks = [one for one in ask.scene.bodies if one is not wall]
    pair = dataclasses.replace(ask.scene, bodies=(*blocks, still, still))
    first, second = pair.body_numbers(Wall)
    told = dataclasses.replace(
        ask, scene=pair, observables=tuple(map(Displacement, (second, first)))
    )
    assert refuses(told, "default") == f"body {first} is a wall, for which PyBullet reports nothing"


@pytest.mark.parametrize("code", CODES)
def test_contacts_with_a_stiffness_of_their_own_are_refused(code: str) -> None:
    ask, _ = asked(INCLINE, "gravity-10")
    springs = dataclasses.replace(ask.scene, contact=Contact(1e8, 1e8, 0.5))
    reason = CODES[code].refuses(dataclasses.replace(ask, scene=springs), "default")
    assert reason == "its contacts have no stiffness, but those of the scene do"


@pytest.mark.parametrize("code", CODES)
def test_the_exported_script_holds_the_ask_and_compiles(code: str) -> None:
    ask, _ = asked(INCLINE, "newmark-30")
    script = CODES[code].native(ask, "default")
    names: dict[str, object] = {}
    start = script.index("ASK: dict[str, Any] | None = {")
    exec("from typing import Any\n" + script[start : script.index("Plan = dict")], names)
    plan = names["ASK"]
    assert isinstance(plan, dict)
    assert (plan["dt"], plan["steps"]) == (1e-3, ask.goal.steps(1e-3))
    assert len(plan["blocks"]) == 1
    assert "from vv" not in script
    compile(script, code, "exec")


@pytest.mark.parametrize("code", CODES)
def test_a_block_slides_from_rest_or_thrown_without_error(code: str, tmp_path: Path) -> None:
    """Gravity alone is integrated exactly."""
    asks, quantities = zip(
        *(asked(INCLINE, name) for name in ("gravity-20", "launch-1")), strict=True
    )
    for run, quantity in zip(answered(code, list(asks), tmp_path), quantities, strict=True):
        assert off(run, quantity) < 1e-12


@pytest.mark.parametrize("code", CODES)
def test_velocities_and_a_base_that_moves_with_the_block(code: str, tmp_path: Path) -> None:
    """All drives at once: a shaken slope that moves, a load and a block that is thrown."""
    ask, slip = asked(LADEN, "level")
    trial = LADEN.declare("level", LADEN.defaults("level"))
    speed = next(one for one in trial.quantities if one.name == "slipping")
    assert isinstance(speed, Series)
    (run,) = answered(code, [ask], tmp_path)
    assert off(run, slip) < 1e-5
    assert off(run, speed) < 1e-5
    assert run.cost.solve_cpu > 0


def test_lmgc90_gives_up_a_block_that_turns_and_slips_far(tmp_path: Path) -> None:
    adapter = CODES["lmgc90"]
    require(adapter)
    ask, _ = asked(INCLINE, "two-directions-turning")
    (run,) = adapter.run([ask], "default", tmp_path, 0.0)
    assert run.status is Status.REFUSED
    assert "moved by more than a quarter of its size" in run.reason


@pytest.mark.parametrize("code", CODES)
def test_half_a_sine_rocks_a_block_almost_over(code: str, tmp_path: Path) -> None:
    ask, way = asked(ROCKING, "stands")
    (run,) = answered(code, [ask], tmp_path)
    assert off(run, way) < 1e-3


@pytest.mark.parametrize("code", CODES)
def test_shaking_that_ends_at_its_peak_ends_there_whatever_the_step(
    code: str, tmp_path: Path
) -> None:
    ask, _ = asked(ROCKING, "stands")
    w, end = 2 * np.pi * 1.0, 0.25
    pulse = Pulse(Harmonic(2.0 * np.eye(3)[0], np.eye(3)[0]), end)
    scene = dataclasses.replace(ask.scene, contact=Contact(np.inf), shaking=pulse)
    slides = Ask(scene, History(0.5, 0.05), (Displacement(1),), STEP)
    (run,) = answered(code, [slides], tmp_path)
    t = np.minimum(run.times, end)
    exact = 2.0 / w * (t - np.sin(w * t) / w + np.maximum(run.times - end, 0.0))
    assert np.abs(run.values[Displacement(1)][:, 0] - exact).max() < 1e-5 * exact[-1]
