"""Claims about the program inside YADE: failures that it sees, and the time that it states."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest

import adapters.yade
from adapters.yade import ADAPTER
from adapters.yade.inside import script
from adapters.yade.installed import PYTHON
from tests.support.adapters.live_asks import (
    FINE,
    FLOOR,
    SEEN,
    TRIALS,
    ball,
    error,
    flight,
    history,
    undamped,
)
from tests.support.installed import only_with
from vv.ask import Knobs, Status
from vv.scene import Contact, Scene

pytestmark = only_with(ADAPTER)


def test_yade_starts_without_a_prompt_and_hides_none(tmp_path: Path) -> None:
    """IPython, a third of the start, is not loaded with YADE, and can be had afterwards."""
    file = tmp_path / "in-yade.py"
    after = 'import IPython\nprint(bool(loaded), hasattr(IPython, "embed"))\n'
    file.write_text(f'{script()}\nloaded = "prompt_toolkit" in sys.modules\n{after}')
    env = {"VV_YADE": ADAPTER.found().path, "HOME": str(tmp_path)}
    command = [str(PYTHON), "-E", str(file)]
    told = subprocess.run(command, env=env, capture_output=True, text=True, check=True).stdout
    assert told.splitlines()[-1] == "False True"


def test_what_failed_is_no_result_and_the_next_ask_still_runs(tmp_path: Path) -> None:
    through = Scene((ball(0.05, [0, -100, 0]), FLOOR), Contact(10.0))
    asks = [history(flight(1e4), 1e-2, 50.0), history(through, 1e-3), history(flight(0.0), 1e-2)]
    blown, fallen, flying = ADAPTER.run(asks, "default", tmp_path, 0.0)
    assert (blown.status, fallen.status) == (Status.DIVERGED, Status.DIVERGED)
    assert "not finite" in blown.reason
    assert "went through a wall" in fallen.reason
    assert np.abs(flying.values[SEEN[0]] - undamped(flying.times)).max() < 1e-13  # exact here


def test_silent_failures_are_errors_and_a_death_costs_one_ask(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A driver made to lose contacts, to stand still and to die, each at a step of its own."""
    last = '    O.dt = ask["dt"]\n'
    sabotage = (
        "    if O.dt == 4e-3:\n        O.engines = [O.engines[0], O.engines[-1]]\n"
        "    if O.dt == 3e-3:\n        O.engines[-1].dead = True\n"
        "    if O.dt == 2e-3:\n        os._exit(7)\n"
    )
    text = script()
    assert text.count(last) == 1
    monkeypatch.setattr(adapters.yade, "script", lambda: text.replace(last, last + sabotage))
    kinds = (("T3", 4e-3), ("T1", 3e-3), ("T1", 1e-3), ("T1", 2e-3), ("T1", 5e-4))
    asks = [TRIALS[name].study.ask(Knobs(dt=dt)) for name, dt in kinds]
    blind, frozen, well, dead, alone = ADAPTER.run(asks, "default", tmp_path, 0.0)
    assert (blind.status, frozen.status, dead.status) == (Status.ERROR,) * 3
    assert "found 0 of 1 contacts" in blind.reason
    assert "nothing moved" in frozen.reason
    assert "exit code 7" in dead.reason
    assert error(well, "T1") < 1e-4
    assert error(alone, "T1") < 1e-4
    assert alone.cost.startup > 0  # a program of its own


TIMED = """
    O.timingEnabled = True
    build(ASK)
    cpu, wall = bare(ASK)
    print("timers", cpu, wall, 1e-9 * sum(engine.execTime for engine in O.engines))
"""


def test_the_solve_time_is_that_of_the_engines_by_yades_own_timers(tmp_path: Path) -> None:
    """Elapsed time of the engines, over elapsed time of the loop that is stated; the rest is
    YADE's own between engines. A shared core stretches both alike."""
    script = ADAPTER.native(TRIALS["T3"].study.ask(FINE), "default")
    assert script.endswith("    main()\n")
    file = tmp_path / "timed.py"
    file.write_text(script.removesuffix("    main()\n") + TIMED)
    done = subprocess.run(
        [PYTHON, str(file)], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    cpu, wall, engines = map(float, done.stdout.partition("timers")[2].split()[:3])
    assert 0.4 * wall < engines < wall
    assert 0.0 < cpu < 1.1 * wall
