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
from tests import ROOT
from tests.support.adapters.small_asks import case_ask as asked
from vv.ask import Displacement, Knobs, Status
from vv.base import closure
from vv.engines import dem
from vv.engines.kernels.compiled import cache_folder, kernel_sources

KERNEL = ROOT / "vv/engines/dem/line/kernel.py"


def test_what_cannot_be_run_honestly_is_refused_with_a_reason() -> None:
    ask = asked("T1", 1e-3)
    spheres = ask.scene.spheres
    turning = dataclasses.replace(spheres, spin=np.full((2, 3), 0.1))
    doubled = dataclasses.replace(spheres, position=np.zeros((2, 3)))
    scenes = {"locked axis": turning, "same centre": doubled}
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
        "import sys; from adapters.dem import ADAPTER;"
        "from cases.contact.single_contact import CASE;"
        "from vv.ask import Knobs;"
        "ask = CASE.declare('T1', CASE.defaults('T1')).study.ask(Knobs(dt=1e-3));"
        "ADAPTER.found(), ADAPTER.describe(ask, 'default'), ADAPTER.native(ask, 'default');"
        "assert ADAPTER.refuses(ask, 'default') is None; sys.exit('numba' in sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, timeout=60)


def test_an_edited_part_gives_a_kernel_a_cache_of_its_own(tmp_path: Path) -> None:
    copy = tmp_path / "vv"
    shutil.copytree(ROOT / "vv", copy, ignore=shutil.ignore_patterns("__pycache__"))
    kernels = [copy / "engines" / name for name in ("dem/space/kernel.py", "dda/general/kernel.py")]

    def digests() -> list[str]:
        closure._DIGESTS.clear()
        return [closure.source_digest(kernel_sources(kernel, tmp_path)) for kernel in kernels]

    assert cache_folder(ROOT / "vv/engines/dem/space/kernel.py").name == digests()[0][:16]
    for edited, stale in (("dem/contact/friction.py", 0), ("blocks/clip.py", 1)):
        before = digests()
        path = copy / "engines" / edited
        path.write_text(path.read_text() + "\n")
        after = digests()
        assert after[stale] != before[stale]
        assert after[1 - stale] == before[1 - stale]


def test_the_cache_goes_where_it_is_told_and_else_where_it_can(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VV_CACHE", str(tmp_path / "chosen"))
    assert cache_folder(KERNEL).is_relative_to(tmp_path / "chosen" / "numba")
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("VV_CACHE", str(tmp_path / "file" / "under"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "user"))
    assert cache_folder(KERNEL).is_relative_to(tmp_path / "user" / "vv" / "numba")
