"""Claims about LIGGGHTS itself, where it is installed; VV_REQUIRE=liggghts makes absence red."""

from __future__ import annotations

import dataclasses
import functools
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from adapters.liggghts import ADAPTER
from adapters.liggghts.batch import MPI
from cases.contact.bounce import CASE as BOUNCE
from reference_solutions.contact import bouncing_pair
from tests.scenes.blocks.sliding_blocks import responding
from tests.support.adapters import live_asks as live
from tests.support.installed import only_with
from vv.ask import Ask, Displacement, History, Knobs, Status
from vv.scene import Contact, Harmonic, Scene, rotated, rotation_about_z

HERE = ADAPTER.found()
pytestmark = only_with(ADAPTER)
ran = functools.partial(live.ran, ADAPTER)
# max|e| / max|ref| at dt = 1e-3 s; drag half a step late costs T2 and T4 an order
PLAIN_ERROR = {"T1": 3e-5, "T2": 8e-3, "T3": 1e-4, "T4": 1.1e-2}


def test_a_required_liggghts_is_installed() -> None:
    assert HERE.installed, HERE.how_to_install
    assert HERE.version


def test_single_contacts_with_plain_masses(tmp_path: Path) -> None:
    asks = [live.TRIALS[name].study.ask(live.COARSE) for name in live.VARIANTS]
    for name, run in zip(live.VARIANTS, ran(asks, "default", tmp_path), strict=True):
        assert live.error(run, name) < PLAIN_ERROR[name[:2]], name


@pytest.fixture(scope="module")
def half_step(tmp_path_factory: pytest.TempPathFactory) -> live.Runs:
    """All variants at a coarse and a fine step, in one process."""
    keys = [(name, knobs) for name in live.VARIANTS for knobs in (live.COARSE, live.FINE)]
    asks = [live.TRIALS[name].study.ask(knobs) for name, knobs in keys]
    runs = ran(asks, "half-step-mass", tmp_path_factory.mktemp("half-step"))
    return dict(zip(keys, runs, strict=True))


def test_single_contacts_with_half_step_masses_are_second_order(half_step: live.Runs) -> None:
    for (name, knobs), run in half_step.items():
        assert live.error(run, name) < (1e-4 if knobs is live.COARSE else 1e-8), (name, knobs)


def test_a_mesh_and_a_dead_load_give_what_a_plane_and_a_lock_give(half_step: live.Runs) -> None:
    for name in ("T1", "T2", "T3", "T4"):
        axes = live.TRIALS[f"{name}-rotated"].study.scene.axes
        for knobs in (live.COARSE, live.FINE):
            seen = half_step[name, knobs].values[Displacement(1)]
            turned = half_step[f"{name}-rotated", knobs].values[Displacement(1)]
            assert np.abs(turned @ axes.T - seen).max() < 3e-11 * np.abs(seen).max(), name


def test_a_scene_may_be_turned_about_any_axis(tmp_path: Path, half_step: live.Runs) -> None:
    tilt = np.array([[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]])
    ask = live.TRIALS["T4"].study.ask(live.COARSE)
    turn = rotation_about_z(2.2) @ tilt @ rotation_about_z(-0.7)
    (run,) = ran(
        [dataclasses.replace(ask, scene=rotated(ask.scene, turn))], "half-step-mass", tmp_path
    )
    seen = half_step["T4", live.COARSE].values[Displacement(1)]
    assert np.abs(run.values[Displacement(1)] @ turn - seen).max() < 3e-11 * np.abs(seen).max()


def test_gravity_load_and_drag(tmp_path: Path) -> None:
    (flying,) = ran([live.history(live.flight(3.0), 1e-3)], "half-step-mass", tmp_path)
    place, speed = live.flown(flying.times, 1.5)
    assert np.abs(flying.values[live.SEEN[0]] - place).max() < 1e-6
    assert np.abs(flying.values[live.SEEN[1]] - speed).max() < 1e-5
    (folder := tmp_path / "falling").mkdir()
    (falling,) = ran([live.history(live.flight(0.0), 1e-2)], "default", folder)
    assert (
        np.abs(falling.values[live.SEEN[0]] - live.undamped(falling.times)).max() < 1e-14
    )  # exact here


def test_a_thrown_sphere_slides_and_then_rolls(tmp_path: Path) -> None:
    asks = [
        live.history(live.rolling(), 1e-4),
        live.history(rotated(live.rolling(), rotation_about_z(0.9)), 1e-4),
    ]
    for run in ran(asks, "default", tmp_path):
        speed = np.linalg.norm(run.values[live.SEEN[1]], axis=1)
        assert speed[5] == pytest.approx(1 - 0.3 * live.G * 0.05, rel=2e-3)
        assert speed[-1] == pytest.approx(5 / 7, rel=1e-3)  # rolls after 0.097 s
        assert run.model is not None
        assert run.model.unknowns == 6


def test_what_failed_is_no_result_and_the_next_ask_still_runs(tmp_path: Path) -> None:
    through = Scene((live.ball(0.05, [0, -100, 0]), live.FLOOR), Contact(10.0))
    slanted = np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]])
    held = live.ball(0.12, [0.6, -0.8, 0], free=np.array([[True, False, False]]))
    pushed = Scene((held, live.FLOOR), Contact(1e5), axes=slanted)
    asks = [
        live.history(scene, 1e-3) for scene in (live.flight(1e5), through, pushed, live.flight(0.0))
    ]
    blown, fallen, drifted, flying = ADAPTER.run(asks, "default", tmp_path, 0.0)
    assert (blown.status, fallen.status) == (Status.DIVERGED, Status.DIVERGED)
    assert "0 of 1 spheres" in blown.reason
    assert "through a wall" in fallen.reason
    assert (drifted.status, "constant load" in drifted.reason) == (Status.ERROR, True)
    assert flying.status is Status.RAN


def test_an_exported_deck_runs_alone_to_the_same_digits(
    tmp_path: Path, half_step: live.Runs
) -> None:
    (tmp_path / "deck.in").write_text(
        ADAPTER.native(live.TRIALS["T4-rotated"].study.ask(live.COARSE), "half-step-mass")
    )
    command = [HERE.path, "-in", "deck.in"]
    subprocess.run(command, cwd=tmp_path, env={**os.environ, **MPI}, check=True, stdout=-3)
    rows = np.loadtxt(tmp_path / "history.txt")
    run = half_step["T4-rotated", live.COARSE]
    assert (rows[:, 2:] == run.values[Displacement(1)][1:]).all()


@pytest.mark.parametrize("scheme", ["default", "clump"])
def test_an_exported_deck_slides_a_block_alone_to_the_same_digits(
    scheme: str, tmp_path: Path
) -> None:
    scene = responding(0.2, 2.0, 0.6)
    shaking = Harmonic(np.array([1.0, 0.0, 0.5]), np.full(3, 3.0))
    scene = dataclasses.replace(scene, shaking=shaking)
    ask = Ask(scene, History(0.2, 0.02), (Displacement(1),), Knobs(1e-4, 1e9))
    (run,) = ran([ask], scheme, tmp_path)
    (tmp_path / "deck.in").write_text(ADAPTER.native(ask, scheme))
    command = [HERE.path, "-in", "deck.in"]
    subprocess.run(command, cwd=tmp_path, env={**os.environ, **MPI}, check=True, stdout=-3)
    rows = np.loadtxt(tmp_path / "history.txt")
    assert (rows[:, 2:] == run.values[Displacement(1)][1:]).all()
    assert np.abs(rows[-1, 2:]).max() > 0.01


def test_the_next_contact_of_a_pair_starts_with_an_uncharged_shear_spring(tmp_path: Path) -> None:
    p = BOUNCE.defaults("again")
    trial = BOUNCE.declare("again", p)
    (run,) = ran([trial.study.ask(Knobs(dt=2e-5))], "default", tmp_path)
    law = {name: value for name, value in p.items() if name != "g"}
    across = bouncing_pair.pair(run.times, **law)[:, 3]
    found = run.values[Displacement(1)] @ trial.study.scene.axes[1]
    # 1.3e-4 is left of a whole step of charging; a spring that stays charged makes it 3.8e-4
    assert np.abs(found - across).max() < 2e-4 * np.abs(across).max()
