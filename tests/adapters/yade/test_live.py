"""Claims about YADE itself, run where it is installed; VV_REQUIRE=yade makes its absence red."""

from __future__ import annotations

import dataclasses
import functools
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from adapters.yade import ADAPTER
from adapters.yade.installed import PYTHON
from cases.hard.dashpot import CASE as DASHPOT
from reference_solutions.contact import dashpot
from tests.scenes.blocks.sliding_blocks import responding
from tests.support.adapters import live_asks as live
from tests.support.installed import only_with
from vv.ask import Ask, Displacement, History, Knobs
from vv.case import Scalar
from vv.scene import Contact, Scene, rotated, rotation_about_z, with_bodies_reversed

HERE = ADAPTER.found()
pytestmark = only_with(ADAPTER)
ran = functools.partial(live.ran, ADAPTER)
# max|e| / max|ref| at dt = 1e-3 s; drag half a step late costs T2 and T4 an order
PLAIN_ERROR = {"T1": 1e-4, "T2": 8e-3, "T3": 1e-4, "T4": 1.2e-2}


def test_a_required_yade_is_installed() -> None:
    assert HERE.installed, HERE.how_to_install
    assert HERE.version


def test_single_contacts_with_plain_masses(tmp_path: Path) -> None:
    asks = [live.TRIALS[name].study.ask(live.COARSE) for name in live.VARIANTS]
    for name, run in zip(live.VARIANTS, ran(asks, "default", tmp_path), strict=True):
        assert live.error(run, name) < PLAIN_ERROR[name[:2]], name


@pytest.fixture(scope="module")
def half_step(tmp_path_factory: pytest.TempPathFactory) -> live.Runs:
    """All variants at a coarse step, plain and rotated ones at a fine step too; one process."""
    keys = [(name, live.COARSE) for name in live.VARIANTS]
    keys += [(name, live.FINE) for name in live.VARIANTS if "-" not in name or "rotated" in name]
    asks = [live.TRIALS[name].study.ask(knobs) for name, knobs in keys]
    runs = ran(asks, "half-step-mass", tmp_path_factory.mktemp("half-step"))
    return dict(zip(keys, runs, strict=True))


def test_single_contacts_with_half_step_masses_are_second_order(half_step: live.Runs) -> None:
    for (name, knobs), run in half_step.items():
        assert live.error(run, name) < (1e-4 if knobs is live.COARSE else 1e-8), (name, knobs)


def test_the_model_built_is_the_model_described(half_step: live.Runs) -> None:
    for (name, knobs), run in half_step.items():
        assert run.model == ADAPTER.describe(live.TRIALS[name].study.ask(knobs), "half-step-mass")


def test_a_dead_load_holds_a_body_where_a_lock_would(half_step: live.Runs) -> None:
    for name, knobs in (("T3-rotated", live.COARSE), ("T4-rotated", live.FINE)):
        moved = half_step[name, knobs].values[Displacement(1)]
        normal = live.TRIALS[name].study.scene.walls[0].normal
        assert np.abs(moved @ normal).max() < 1e-12 * np.abs(moved).max()


def test_a_rotated_scene_gives_what_the_straight_one_gives(half_step: live.Runs) -> None:
    for name, body in (("T1", 1), ("T2", 1), ("T3", 1), ("T4", 1)):
        straight, turned = half_step[name, live.FINE], half_step[f"{name}-rotated", live.FINE]
        axes = live.TRIALS[f"{name}-rotated"].study.scene.axes
        seen = straight.values[Displacement(body)]
        difference = turned.values[Displacement(body)] @ axes.T - seen
        assert np.abs(difference).max() < 1e-11 * np.abs(seen).max()


def test_gravity_load_drag_and_rotation(tmp_path: Path) -> None:
    turned = rotated(live.rolling(), rotation_about_z(0.9))
    asks = [
        live.history(live.flight(3.0), 1e-3),
        live.history(live.rolling(), 1e-4),
        live.history(turned, 1e-4),
    ]
    flying, straight, oblique = ran(asks, "half-step-mass", tmp_path, repeat=1e-2)
    place, speed = live.flown(flying.times, 1.5)
    assert np.abs(flying.values[live.SEEN[0]] - place).max() < 1e-6
    assert np.abs(flying.values[live.SEEN[1]] - speed).max() < 1e-6
    for run in (straight, oblique):
        speed = np.linalg.norm(run.values[live.SEEN[1]], axis=1)
        assert speed[-1] == pytest.approx(5 / 7, rel=1e-3)  # rolls after 0.097 s; springs ring on
        assert speed[5] == pytest.approx(1 - 0.3 * live.G * 0.05, rel=2e-3)
    assert straight.cost.repeats >= 3
    assert min(straight.cost.setup, straight.cost.solve_cpu, straight.cost.output) > 0
    assert (straight.cost.startup, straight.model and straight.model.unknowns) == (0.0, 6)


def test_friction_between_spheres_is_a_plain_spring(tmp_path: Path) -> None:
    """A sphere pressed deep into a fixed one swings across it, whichever comes first.

    The normal force, which turns with the sphere, weakens the spring: ks - kn dx/L for a
    distance L of the centres.
    """
    kn, ks, dx, v0 = 1e4, 1e7, 0.04, 1e-3
    base, swinging = live.ball(0.0, [0, 0, 0]), live.ball(0.2 - dx, [v0, 0, 0])
    pair = Scene(
        (
            dataclasses.replace(base, free=np.zeros((1, 3), bool)),
            dataclasses.replace(swinging, free=np.array([[True, False, False]])),
        ),
        Contact(kn, ks, 1.0),
    )
    goal = History(0.01, 1e-4)
    ask = Ask(pair, goal, (Displacement(1),), Knobs(dt=1e-6))
    swapped_ask = dataclasses.replace(
        ask, scene=with_bodies_reversed(pair), observables=(Displacement(0),)
    )
    runs = ran([ask, swapped_ask], "default", tmp_path)
    k = np.sqrt((ks - kn * dx / (0.2 - dx)) / 2.0)
    for run, seen in zip(runs, (Displacement(1), Displacement(0)), strict=True):
        exact = v0 / k * np.sin(k * run.times)
        assert np.abs(run.values[seen][:, 0] - exact).max() < 1e-5 * v0 / k  # leapfrog: 5e-6


def test_an_exported_script_runs_alone_to_the_same_bits(
    tmp_path: Path, half_step: live.Runs
) -> None:
    ask = live.TRIALS["T4-rotated"].study.ask(live.COARSE)
    script = tmp_path / "script.py"
    left = "\nprint('folder left:', os.path.exists(os.path.dirname(O.tmpFilename())))\n"
    script.write_text(ADAPTER.native(ask, "half-step-mass") + left)
    home = {**os.environ, "HOME": str(tmp_path), "TMPDIR": str(tmp_path)}
    command = [str(PYTHON), "-E", str(script)]
    output = subprocess.run(command, env=home, capture_output=True, text=True, check=True).stdout
    printed = np.array([line.split() for line in output.splitlines() if line[:1].isdigit()], float)
    run = half_step["T4-rotated", live.COARSE]
    assert "folder left: False" in output
    assert (printed[:, 0] == run.times).all()
    assert (printed[:, 1:] == run.values[Displacement(1)]).all()


@pytest.mark.parametrize("scheme", ["default", "clump", "polyhedra"])
def test_an_exported_script_slides_a_block_alone_to_the_same_bits(
    scheme: str, tmp_path: Path
) -> None:
    ask = Ask(responding(0.2, 2.0, 0.6), History(0.2, 0.02), (Displacement(1),), Knobs(2e-4, 1e9))
    (run,) = ran([ask], scheme, tmp_path)
    script = tmp_path / "script.py"
    script.write_text(ADAPTER.native(ask, scheme))
    home = {**os.environ, "HOME": str(tmp_path), "TMPDIR": str(tmp_path)}
    command = [str(PYTHON), "-E", str(script)]
    output = subprocess.run(command, env=home, capture_output=True, text=True, check=True).stdout
    printed = np.array([line.split() for line in output.splitlines() if line[:1].isdigit()], float)
    assert (printed[:, 1:] == run.values[Displacement(1)]).all()  # its frame is that of the scene
    assert np.abs(printed[-1, 1:]).max() > 0.01


@pytest.mark.parametrize("variant", ["z-0.1", "z-0.6", "pair-0.6"])
def test_a_dashpot_that_acts_from_the_start_returns_what_half_a_step_of_lag_leaves(
    variant: str, tmp_path: Path
) -> None:
    p = DASHPOT.defaults(variant)
    trial = DASHPOT.declare(variant, p)
    (run,) = ran([trial.study.ask(Knobs(dt=2e-5))], "default", tmp_path)
    (back,) = (q for q in trial.quantities if isinstance(q, Scalar) and q.name == "restitution")
    lag = np.pi / 2 * p["z"] ** 2 * 0.02
    assert abs(back.observe(run) / dashpot.restitution(p["z"]) - 1) < lag
