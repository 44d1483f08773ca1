"""Claims about the adapter of the DEM engine: refusals, clocks, scripts, and compiled kernels."""

from __future__ import annotations

import dataclasses
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from adapters.dem import ADAPTER
from tests.adapter_asks import case_ask as asked
from vv import dem
from vv.ask import Displacement, Knobs, Status
from vv.compiled import cache_folder

ROOT = Path(__file__).parents[1]
HERE = ROOT / "vv" / "dem"


def test_what_cannot_be_run_honestly_is_refused_with_a_reason() -> None:
    ask = asked("T1", 1e-3)
    spheres = ask.scene.spheres
    turning = dataclasses.replace(spheres, spin=np.full((2, 3), 0.1))
    doubled = dataclasses.replace(spheres, position=np.zeros((2, 3)))
    scenes = {"locked axis": turning, "one centre": doubled}
    for words, bodies in scenes.items():
        scene = dataclasses.replace(ask.scene, bodies=(bodies,))
        run = dem.solve_default(dataclasses.replace(ask, scene=scene))
        assert (run.status, words in run.reason) == (Status.REFUSED, True)
    for words, knobs in {"needs a step": Knobs(), "no step": Knobs(dt=0.5)}.items():
        reason = ADAPTER.refuses(dataclasses.replace(ask, knobs=knobs), "default")
        assert reason is not None
        assert words in reason


def test_the_adapter_answers_in_order_and_clocks_the_steps_alone(tmp_path: Path) -> None:
    asks = [asked("T2", dt) for dt in (1e-3, 1e-4)]
    runs = list(ADAPTER.run(asks, "default", tmp_path, 0.01))
    assert [run.steps for run in runs] == [400, 4000]
    for ask, run in zip(asks, runs, strict=True):
        assert run.status is Status.RAN
        assert run.cost.repeats > 5
        assert 0 < run.cost.solve_cpu < 1e-3
        assert run.model == ADAPTER.describe(ask, "default")


def test_the_native_script_runs_alone(tmp_path: Path) -> None:
    ask = asked("T3-rotated", 1e-3)
    script = tmp_path / "script.py"
    script.write_text(ADAPTER.native(ask, "published"))
    done = subprocess.run(
        [sys.executable, str(script)],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    table = np.loadtxt(done.stdout.splitlines(), skiprows=1)
    run = dem.solve_published(ask)
    assert np.array_equal(table[:, 0], run.times)
    assert np.array_equal(table[:, 1:], run.values[Displacement(1)])


def test_describing_and_refusing_need_no_numba() -> None:
    code = (
        "import sys; from adapters.dem import ADAPTER; from cases.single_contact import CASE;"
        "from vv.ask import Knobs;"
        "ask = CASE.declare('T1', CASE.defaults('T1')).study.ask(Knobs(dt=1e-3));"
        "ADAPTER.found(), ADAPTER.describe(ask, 'default'), ADAPTER.native(ask, 'default');"
        "assert ADAPTER.refuses(ask, 'default') is None; sys.exit('numba' in sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, timeout=60)


def test_an_edited_kernel_gets_a_cache_of_its_own(tmp_path: Path) -> None:
    copy = tmp_path / "dem"
    shutil.copytree(HERE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    before = cache_folder(copy)
    assert before == cache_folder(HERE)
    law = copy / "friction.py"
    law.write_text(law.read_text() + "\n")
    assert cache_folder(copy) != before


def test_the_cache_goes_where_it_is_told_and_else_where_it_can(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VV_CACHE", str(tmp_path / "chosen"))
    assert cache_folder(HERE).is_relative_to(tmp_path / "chosen" / "numba")
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("VV_CACHE", str(tmp_path / "file" / "under"))
    assert not cache_folder(HERE).is_relative_to(tmp_path)
