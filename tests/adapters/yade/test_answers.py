"""Claims, without YADE, that its answers become runs, or errors that say what is wrong."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from adapters.yade.answers import parse
from adapters.yade.setup import set_up
from tests.support.adapters.small_asks import ball, ball_ask, case_ask
from tests.support.adapters.yade_asks import PLAIN, plan_of
from vv.ask import Displacement, Model, Status, Velocity

FACTS = {
    "status": "ran", "reason": "", "steps": 100, "unknowns": 3, "ready": 12.5, "setup": 0.1,
    "solve_cpu": 0.2, "solve_wall": 0.3, "output": 0.4, "repeats": 5, "spread": 0.6,
}  # fmt: skip
MODEL = Model(0, frozenset(), "as described")


def answered(folder: Path, values: Any, **changes: Any) -> Path:
    path = folder / "ask-0.json"
    np.save(f"{path}.npy", values)
    Path(f"{path}.answer").write_text(json.dumps({**FACTS, **changes}))
    return path


def test_an_answer_becomes_a_run(tmp_path: Path) -> None:
    ask = ball_ask(ball())
    values = np.arange(33.0).reshape(1, 11, 3)
    run = parse(answered(tmp_path, values), set_up(ask, PLAIN), MODEL, started=11.0)
    assert run is not None
    assert run.status is Status.RAN
    assert (run.values[Displacement(0)] == values[0]).all()
    assert run.times == pytest.approx(0.01 * np.arange(11))
    assert (run.cost.startup, run.cost.solve_cpu, run.cost.repeats) == (1.5, 0.2, 5)
    assert run.model == Model(3, frozenset(), "as described")


def test_an_answer_in_another_frame_is_told_in_the_scene_s(tmp_path: Path) -> None:
    rows = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    setup = dataclasses.replace(set_up(ball_ask(ball()), PLAIN), frame=rows)
    values = np.zeros((1, 11, 3))
    values[0, :, 2] = np.arange(11.0)  # along the third axis of YADE's frame
    run = parse(answered(tmp_path, values), setup, MODEL, started=11.0)
    assert run is not None
    assert run.values[Displacement(0)][-1] == pytest.approx(10.0 * rows[2])


def test_only_the_first_answer_of_a_program_carries_its_start(tmp_path: Path) -> None:
    path = answered(tmp_path, np.zeros((1, 11, 3)), ready=0.0)
    run = parse(path, set_up(ball_ask(ball()), PLAIN), MODEL, started=11.0)
    assert run is not None
    assert run.cost.startup == 0.0


def test_a_quantity_missing_from_an_answer_is_an_error(tmp_path: Path) -> None:
    ask = dataclasses.replace(ball_ask(ball()), observables=(Displacement(0), Velocity(0)))
    run = parse(answered(tmp_path, np.zeros((1, 11, 3))), set_up(ask, PLAIN), MODEL, started=0.0)
    assert run is not None
    assert run.status is Status.ERROR
    assert "(2, 11, 3) was asked for" in run.reason


def test_a_sphere_that_drifts_where_it_was_locked_is_an_error(tmp_path: Path) -> None:
    ask = case_ask("T3-rotated", dt=0.1)
    along, across = ask.scene.axes[1], ask.scene.axes[0]
    moved = np.array([[0.0, 0.0, 0.0], 0.1 * along, 0.2 * along, 0.3 * along, 0.4 * along])
    kept = parse(
        answered(tmp_path, moved[None] + 1e-13 * across), set_up(ask, PLAIN), MODEL, started=0.0
    )
    lost = parse(
        answered(tmp_path, moved[None] + 1e-9 * across), set_up(ask, PLAIN), MODEL, started=0.0
    )
    assert kept is not None
    assert lost is not None
    assert kept.status is Status.RAN
    assert (lost.status, "constant load replaces the lock" in lost.reason) == (Status.ERROR, True)


def test_a_sphere_under_a_dead_load_is_watched_though_nobody_asked() -> None:
    ask = dataclasses.replace(case_ask("T3-rotated"), observables=(Velocity(1),))
    assert plan_of(ask, PLAIN)["observe"] == [["velocity", 1], ["displacement", 1]]
    assert plan_of(case_ask("T3"), PLAIN)["observe"] == [["displacement", 1]]


def test_a_failure_keeps_its_status_and_reason(tmp_path: Path) -> None:
    path = answered(tmp_path, np.zeros(0), status="diverged", reason="not finite at t = 1 s")
    run = parse(path, set_up(ball_ask(ball()), PLAIN), MODEL, started=0.0)
    assert run is not None
    assert (run.status, run.reason) == (Status.DIVERGED, "not finite at t = 1 s")


def test_values_without_their_facts_are_no_answer_yet(tmp_path: Path) -> None:
    path = answered(tmp_path, np.zeros((1, 11, 3)))
    Path(f"{path}.answer").unlink()
    assert parse(path, set_up(ball_ask(ball()), PLAIN), MODEL, started=0.0) is None
