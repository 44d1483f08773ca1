"""Claims about docs/extending.md: its files work as they stand, and nothing else need be edited."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests import ROOT
from tests.conftest import Tiny
from tests.support.written_pages import shown, write
from vv.ask import NO_STIFFNESS, Ask, History, Knobs
from vv.plan.project import find

PAGE = shown("extending.md")
CASE = ("cases/rebound.py", "reference_solutions/rebound.py")
CODE = "adapters/verlet.py"
TERM = "vv/engines/dem/terms/stiffening.py"
SECOND = ("reference_solutions/checks/rebound.py", "tests/references/test_rebound.py")
CODES = "exact,dem/default,rigid,verlet"
WRONG_ANSWER = (CASE[1], "-v / w", "v / w")
WRONG_CODE = (CODE, "push * wall.normal", "-push * wall.normal")
COPIED = ("adapters", "cases", "reference_solutions", "reports", "tests", "vv", "pyproject.toml")
SEEN = "every_file or rebound or verlet or single-contact or rule or small or one_way"


@pytest.fixture
def own(tmp_path: Path) -> Tiny:
    """A project of one's own with the case and the code of the page."""
    write(tmp_path, {"vv.toml": "", **{name: PAGE[name] for name in (*CASE, CODE)}})
    return Tiny(tmp_path)


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Tiny:
    """A copy of this project in which all files of the page were written, and none was edited."""
    root = tmp_path_factory.mktemp("copy")
    for name in COPIED:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, root / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(ROOT / name, root)
    write(root, PAGE)
    return Tiny(root)


def outcomes(project: Tiny, *words: str) -> dict[str, list[str]]:
    """Scheme -> what its runs came to: verdicts, or why it refuses."""
    project.vv("run", *words, "--json", "out.json")
    records: list[dict[str, Any]] = json.loads((project.root / "out.json").read_text())["records"]
    found: dict[str, list[str]] = {}
    for record in records:
        verdicts = [entry["verdict"] for entry in record["quantities"]]
        said = verdicts or [record["status"], record["reason"]]
        found.setdefault(f"{record['code']}/{record['scheme']}", []).extend(said)
    return found


def pytest_in(project: Tiny, *words: str) -> subprocess.CompletedProcess[str]:
    """The tests of a copy, run there."""
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *words],
        cwd=project.root,
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )


def test_a_case_is_one_file_beside_its_answer_and_a_code_is_one_file() -> None:
    assert set(PAGE) == {*CASE, *SECOND, CODE, TERM}


def test_the_block_of_the_page_is_taken_by_codes_of_blocks_springs_and_spheres() -> None:
    page = (ROOT / "docs" / "extending.md").read_text(encoding="utf-8")
    section = page.partition("### Blocks and rigid contact")[2]
    said: dict[str, Any] = {}
    exec(section.partition("```python\n")[2].partition("```")[0], said)
    project = find()

    def refusal(code: str, knobs: Knobs) -> str | None:
        ask = Ask(said["scene"], History(0.1, 0.01), (said["BLOCK"],), knobs)
        return project.load_adapter(code).refuses(ask, "default")

    codes = ("exact", "rigid", "dda", "dem")
    assert [refusal(code, said["RUNGS"][0]) for code in codes] == [None] * 4
    assert [refusal(code, Knobs(dt=1e-4)) for code in codes] == [None] * 2 + [NO_STIFFNESS] * 2


def test_the_case_is_judged_where_it_runs_and_refused_elsewhere_for_what_is_lacking(
    own: Tiny,
) -> None:
    found = outcomes(own, "rebound", "--codes", CODES)
    assert {name for name, said in found.items() if set(said) == {"pass"}} == {
        "dem/default",
        "exact/default",
        "verlet/default",
    }
    refused = {name: said[:2] for name, said in found.items() if "pass" not in said}
    elastic = "Contact.kn = 10000.0 N/m; steps are for rigid contact"
    assert refused.pop("exact/second-order") == ["refused", elastic]
    assert refused == {
        name: ["refused", f"{name} does not support: {lacking}"]
        for name, lacking in {
            "exact/linearised": "contact with a plane wall",
            "rigid/default": "spheres",
        }.items()
    }


def test_the_new_code_is_asked_the_cases_that_came_with_vv_and_explains_what_it_lacks(
    own: Tiny,
) -> None:
    (said,) = outcomes(own, "skid", "--codes", "verlet").values()
    assert said[:2] == [
        "refused",
        "verlet/default does not support: motion locked along directions oblique to the frame, "
        "shear spring capped by Coulomb friction",
    ]
    told = own.vv("explain", "rebound").stdout
    assert "z = -(v/w) sin wt" in told
    assert "verlet/default: position and velocity of the sphere" in told
    assert "velocity Verlet" in own.vv("codes").stdout


def test_the_gate_is_green_as_the_page_stands(own: Tiny) -> None:
    done = own.vv("gate", "rebound", "--codes", CODES)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("wrong", [WRONG_ANSWER, WRONG_CODE], ids=["answer", "code"])
def test_a_wrong_sign_turns_the_gate_red(own: Tiny, wrong: tuple[str, str, str]) -> None:
    own.edit(*wrong)
    done = own.vv("gate", "rebound", "--codes", CODES)
    assert done.returncode == 1, done.stderr
    named = "verlet/default dt=" in done.stdout, "dem/default dt=" in done.stdout
    assert named == (True, wrong is WRONG_ANSWER)


def test_in_the_project_itself_no_table_elsewhere_wants_an_edit(copy: Tiny) -> None:
    files = ("test_completeness.py", "test_architecture.py", "references/test_rebound.py")
    done = pytest_in(copy, *(f"tests/{file}" for file in files), "-k", SEEN)
    assert done.returncode == 0, done.stdout


def test_what_the_author_accepts_is_guarded_from_then_on(copy: Tiny) -> None:
    before = {path: path.read_bytes() for path in (copy.root / "cases").rglob("*.json")}
    done = copy.vv("accept", "rebound", "--reason", "two routes agree")
    assert done.returncode == 0, done.stderr
    after = {path: path.read_bytes() for path in (copy.root / "cases").rglob("*.json")}
    new = [path.relative_to(copy.root / "cases").as_posix() for path in after.keys() - before]
    assert sorted(new) == ["answers/rebound.json", "baselines/rebound.json"]
    assert {path: after[path] for path in before} == before
    words = ("gate", "rebound", "--codes", CODES, "--against", "cases/baselines")
    assert copy.vv(*words).returncode == 0
    copy.edit(CODE, "Term.SPHERE, ", "")
    try:
        done, seen = copy.vv(*words), pytest_in(copy, "tests/test_completeness.py", "-k", "rebound")
    finally:
        copy.edit(CODE, "frozenset({", "frozenset({Term.SPHERE, ")
    assert done.returncode == 1
    assert "has a baseline, but now: refused" in done.stdout
    assert "test_what_runs_and_what_is_refused_is_as_it_was_accepted[rebound]" in seen.stdout


def test_the_second_route_catches_a_wrong_sign_in_the_answer(copy: Tiny) -> None:
    file, right, wrong = WRONG_ANSWER
    copy.edit(file, right, wrong)
    try:
        assert pytest_in(copy, SECOND[1]).returncode == 1
    finally:
        copy.edit(file, wrong, right)
