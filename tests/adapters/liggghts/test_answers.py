"""Claims, without LIGGGHTS, that its rows and log become runs, or errors that say what is wrong."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from adapters.liggghts.answers import parse
from adapters.liggghts.costs import loops
from adapters.liggghts.setup import set_up
from tests.support.adapters.liggghts_asks import PLAIN, ball, ball_ask
from tests.support.adapters.small_asks import DT, case_ask
from vv.ask import Ask, Displacement, Model, Run, Status, Velocity
from vv.scene import Vector

MODEL = Model(3, frozenset())


def answer(folder: Path, ask: Ask, rows: Vector) -> Run:
    file = folder / "rows.txt"
    file.write_text("# title\n" + "\n".join(" ".join(map(str, row)) for row in rows))
    return parse(file, set_up(ask, PLAIN), MODEL)


def moved(ask: Ask) -> Vector:
    """Rows as a sphere that moves with 1 m/s along the second axis of its scene gives them."""
    times = ask.goal.times(ask.knobs.dt)[1:]
    steps = ask.goal.stride(DT) * np.arange(1, len(times) + 1)
    count = np.full(len(times), len(ask.scene.spheres))
    along = ask.scene.axes[1]
    parts = [
        np.outer(times if isinstance(seen, Displacement) else times**0, along)
        for seen, _ in set_up(ask, PLAIN).watched
    ]
    return np.column_stack([steps, count, *parts])


def test_rows_become_a_run_that_begins_at_the_start(tmp_path: Path) -> None:
    ask = ball_ask(ball(velocity=[[0, 1, 0]]))
    run = answer(tmp_path, ask, moved(ask))
    assert (run.status, run.steps, run.model) == (Status.RAN, 100, MODEL)
    assert run.values[Displacement(0)] == pytest.approx(np.outer(run.times, [0, 1, 0]))
    assert run.values[Velocity(0)] == pytest.approx(np.outer(run.times**0, [0, 1, 0]))


def test_lost_spheres_and_what_is_not_finite_are_divergence(tmp_path: Path) -> None:
    ask = ball_ask(ball())
    lost, broken = moved(ask), moved(ask)
    lost[4, 1], broken[6, 3] = 0, np.nan
    assert answer(tmp_path, ask, lost).status is Status.DIVERGED
    assert "0 of 1 spheres are left at t = 0.05 s" in answer(tmp_path, ask, lost).reason
    assert "not finite at t = 0.07 s" in answer(tmp_path, ask, broken).reason


def test_a_dead_load_that_does_not_hold_is_an_error(tmp_path: Path) -> None:
    ask = case_ask("T3-rotated")
    ask = dataclasses.replace(ask, observables=(Velocity(1),))
    assert set_up(ask, PLAIN).watched[1:] == ((Displacement(1), 0),)
    rows = moved(ask)
    held = answer(tmp_path, ask, rows)
    assert (held.status, list(held.values)) == (Status.RAN, [Velocity(1)])
    rows[-1, 5:8] += 1e-6 * ask.scene.axes[0]
    assert "along a locked direction" in answer(tmp_path, ask, rows).reason


def test_rows_that_are_missing_short_or_no_numbers_are_errors(tmp_path: Path) -> None:
    ask = ball_ask(ball())
    assert answer(tmp_path, ask, moved(ask)[:-1]).status is Status.ERROR
    assert answer(tmp_path, ask, moved(ask)[::-1]).status is Status.ERROR
    assert answer(tmp_path, ask, np.zeros((0, 8))).status is Status.ERROR
    (tmp_path / "cut.txt").write_text("10 1 0.1\n20 1")
    for name in ("cut.txt", "nowhere.txt"):
        assert "cannot be read" in parse(tmp_path / name, set_up(ask, PLAIN), MODEL).reason


LOG = """
charging shear springs
Loop time of 7e-06 on 1 procs for 1 steps with 1 atoms, finish time today
Outpt time (%) = 3e-06 (48.0)
shear springs are charged
Loop time of 0.005 on 1 procs for 400 steps with 1 atoms, finish time today
Outpt time (%) = 0.0004 (8.0)
Fix history print time (%) = 0.0026 (5.0)
Fix wall0 wall/gran time (%) = 0.001 (2.0)
Loop time of 0.00175 on 1 procs for 400 steps with 1 atoms, finish time today
Outpt time (%) = 2.5e-05 (8.0)
"""


def test_output_is_no_part_of_a_loop_s_time() -> None:
    assert loops(LOG).whole == pytest.approx([0.005, 0.00175])
    assert loops(LOG).solve == pytest.approx([0.002, 0.001725])
