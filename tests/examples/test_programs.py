"""Claims about the example programs in C, awk and Python: they answer, and are told their order."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from tests import ROOT
from tests.support.adapters.live_asks import TRIALS, error
from vv.ask import Knobs
from vv.base.metrics import observed_order
from vv.codes import program

EXAMPLES = ROOT / "examples"
STEPS = (4e-3, 1e-3, 2e-4)
TESTS = ("T1", "T2", "T3", "T4")
WITHOUT_FRICTION = TESTS[:2]


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the examples in which the C program is compiled, if there is a compiler."""
    folder = tmp_path_factory.mktemp("examples")
    shutil.copytree(EXAMPLES, folder, dirs_exist_ok=True)
    for ours in folder.rglob("first_dem"):
        ours.unlink()  # a build of the checkout's
    if compiler := shutil.which("cc"):
        words = [compiler, "-O2", "-Wall", "-Werror", "-o", "first_dem", "first_dem.c", "-lm"]
        subprocess.run(words, cwd=folder / "c", check=True)
    return folder


def orders(file: Path, variants: tuple[str, ...], folder: Path) -> list[float]:
    """The observed orders of a program on some of T1-T4."""
    code = program.load(file)
    if not code.found().installed:
        pytest.skip(code.found().how_to_install)
    folder.mkdir()
    asks = [TRIALS[name].study.ask(Knobs(dt=dt)) for name in variants for dt in STEPS]
    runs = list(code.run(asks, "default", folder, 0.0))
    assert [run.reason for run in runs] == [""] * len(asks)
    found = []
    for number, name in enumerate(variants):
        rungs = runs[number * len(STEPS) :][: len(STEPS)]
        fitted = observed_order(list(STEPS), [error(run, name) for run in rungs])
        assert fitted is not None
        found.append(fitted.order)
    return found


@pytest.mark.parametrize("file", ["c/first_dem.toml", "sh/awk_dem.toml"])
def test_sixty_lines_answer_t1_to_t4_to_first_order(built: Path, tmp_path: Path, file: str) -> None:
    found = orders(built / file, TESTS, tmp_path / "runs")
    assert found == pytest.approx([2.0, 1.0, 2.0, 1.0], abs=0.3)  # late drag alone is first order


def test_verlet_in_python_is_second_order_without_drag(built: Path, tmp_path: Path) -> None:
    found = orders(built / "python/verlet.toml", WITHOUT_FRICTION, tmp_path / "runs")
    assert found == pytest.approx([2.0, 1.0], abs=0.3)


def test_the_program_in_c_has_sixty_lines_and_its_declaration_twelve() -> None:
    assert len((EXAMPLES / "c" / "first_dem.c").read_text().splitlines()) <= 60
    for file in EXAMPLES.rglob("*.toml"):
        assert len(file.read_text().splitlines()) <= 12


def test_what_a_program_cannot_do_it_refuses_with_its_reason(built: Path, tmp_path: Path) -> None:
    code = program.load(built / "python" / "verlet.toml")
    (run,) = code.run([TRIALS["T3"].study.ask(Knobs(dt=1e-3))], "default", tmp_path, 0.0)
    assert (run.status.value, run.reason) == ("refused", "it has no friction")
