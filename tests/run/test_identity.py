"""What an invocation's results depend on: each thing that changes makes another invocation."""

from __future__ import annotations

import dataclasses
import datetime
import os
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from vv.codes import Found
from vv.run import reuse

TODAY = datetime.date(2025, 1, 31)
ASKED = ("fall:up", "quick")


class World:
    """A project with one code, whose version, files, machine and day are given."""

    def __init__(self, root: Path, patched: pytest.MonkeyPatch) -> None:
        self.program = root / "program"
        self.program.write_text("x")
        self.found = Found(True, "1.0", str(self.program), files=(self.program,))
        self.today, self.asked = TODAY, ASKED
        self.against: Path | None = root / "accepted"
        self.against.mkdir()
        (self.against / "fall.json").write_text("{}")
        self.patched = patched
        self.project: Any = SimpleNamespace(
            root=root,
            adapter_names=lambda: ["mine"],
            load_adapter=lambda name: SimpleNamespace(name=name, found=lambda: self.found),
        )
        patched.setattr(reuse, "machine", lambda: "this one")
        patched.setattr(reuse, "_sources", lambda project: {})  # a second; others test it

    def identity(self) -> str:
        return reuse.identity(self.project, self.asked, self.today, self.against)


@pytest.fixture
def world(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> World:
    monkeypatch.chdir(tmp_path)
    return World(tmp_path, monkeypatch)


def test_the_same_again_is_the_same(world: World) -> None:
    assert world.identity() == world.identity()


@pytest.mark.parametrize(
    "name",
    ["PATH", "PYTHONPATH", "VV_DATA", "LD_LIBRARY_PATH", "NUMBA_OPT", "OMP_NUM_THREADS",
     "MKL_NUM_THREADS", "OPENBLAS_CORETYPE"],
)  # fmt: skip
def test_a_variable_that_affects_results_is_part_of_it(world: World, name: str) -> None:
    before = world.identity()
    world.patched.setenv(name, os.environ.get(name, "") + "1")
    assert world.identity() != before


def test_a_variable_that_does_not_is_not(world: World) -> None:
    before = world.identity()
    world.patched.setenv("TERM", "dumb")
    assert world.identity() == before


def test_version_and_presence_of_a_code_and_the_state_of_its_files_are_part_of_it(
    world: World,
) -> None:
    seen = {world.identity()}
    world.found = dataclasses.replace(world.found, version="1.1")
    seen.add(world.identity())
    world.found = dataclasses.replace(world.found, installed=False)
    seen.add(world.identity())
    world.program.write_text("longer")
    seen.add(world.identity())
    state = world.program.stat()
    os.utime(world.program, ns=(state.st_atime_ns, state.st_mtime_ns + 10**9))  # of one size
    seen.add(world.identity())
    world.program.unlink()
    seen.add(world.identity())
    assert len(seen) == 6


def test_machine_day_folder_selection_and_baselines_are_part_of_it(
    world: World, tmp_path: Path
) -> None:
    seen = {world.identity()}
    world.patched.setattr(reuse, "machine", lambda: "another")
    seen.add(world.identity())
    world.today += datetime.timedelta(days=1)
    seen.add(world.identity())
    world.asked = ("fall:up", "default")
    seen.add(world.identity())
    assert world.against is not None
    (world.against / "fall.json").write_text("[]")
    seen.add(world.identity())
    world.against = None
    seen.add(world.identity())
    (tmp_path / "elsewhere").mkdir()
    world.patched.chdir(tmp_path / "elsewhere")
    seen.add(world.identity())
    assert len(seen) == 7


@pytest.mark.parametrize("folder", ["own", "shipped"])
def test_sources_of_a_project_and_those_that_came_with_vv_are_part_of_it(
    world: World, tmp_path: Path, folder: str
) -> None:
    world.patched.undo()
    world.patched.setattr("vv.plan.imports.OWN", tmp_path / "shipped")
    world.project.root = tmp_path / "own"
    for each in ("own", "shipped"):
        (tmp_path / each / "cases").mkdir(parents=True)
        (tmp_path / each / "cases" / "fall.py").write_text("x = 1\n")
    before = world.identity()
    (tmp_path / folder / "cases" / "fall.py").write_text("x = 2\n")
    assert world.identity() != before


@pytest.mark.parametrize("other", ["Python", "packages", "environment"])
def test_the_python_that_runs_it_is_part_of_it(world: World, other: str) -> None:
    before = world.identity()
    reuse._libraries.cache_clear()
    if other == "Python":
        world.patched.setattr("platform.python_version", lambda: "9.9")
    elif other == "packages":
        world.patched.setattr("importlib.metadata.distributions", lambda: iter(()))
    else:
        world.patched.setattr("sys.prefix", "/elsewhere")
    try:
        assert world.identity() != before
    finally:
        reuse._libraries.cache_clear()
