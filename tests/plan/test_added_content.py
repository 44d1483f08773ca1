"""Claims about a project of one's own: it adds to what came with vv, and hides nothing of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests import ROOT
from tests.plan.test_project import ADAPTER, CASE, apart, write
from vv.gate.all_checks import baseline_of
from vv.plan import keys
from vv.plan.content import ProjectError
from vv.plan.project import Project, find

__all__ = ["apart"]  # the fixture applies here too


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """A case and a code of one's own, without any __init__.py."""
    files = {"cases/free_fall.py": CASE.format("free-fall"), "adapters/mine.py": ADAPTER}
    files["adapters/mine.py"] = ADAPTER.format("mine")
    return write(tmp_path / "own", {"vv.toml": "", **files})


def test_own_cases_and_codes_stand_beside_those_that_came_with_vv(root: Path) -> None:
    project = find(root)
    assert {"free-fall", "single-contact", "settling"} <= set(project.case_names())
    assert {"mine", "exact", "dem", "yade"} <= set(project.adapter_names())
    assert project.family("free-fall") == "free-fall"
    assert project.family("settling") == "hard"


def test_all_of_them_are_loaded_by_name_with_the_helpers_they_import(root: Path) -> None:
    project = find(root)
    assert project.load_case("single-contact").name == "single-contact"
    assert project.load_case("free-fall").name == "free-fall"
    assert project.load_case("settling").name == "settling"
    assert project.load_adapter("mine").name == "mine"
    assert project.load_adapter("yade").name == "yade"


def test_an_init_of_one_s_own_is_allowed_and_hides_nothing(root: Path) -> None:
    inits = ("cases", "adapters", "reference_solutions", "reference_solutions/checks", "cases/hard")
    write(root, {f"{folder}/__init__.py": "" for folder in inits})
    write(root, {"cases/hard/zeno.py": f"import cases.hard.settling\n{CASE.format('zeno')}"})
    route = "from reference_solutions.checks.contact import skid\n"
    write(root, {"reference_solutions/checks/zeno.py": route})
    write(root, {"cases/fall.py": f"import reference_solutions.checks.zeno\n{CASE}"})
    project = find(root)
    assert project.load_case("zeno").name == "zeno"
    with pytest.raises(ProjectError, match=r"CASE\.name = '\{\}'; it must be 'fall'"):
        project.load_case("fall")
    assert project.load_case("settling").name == "settling"


def test_a_project_that_stands_alone_has_only_its_own(root: Path) -> None:
    write(root, {"vv.toml": "alone = true"})
    write(root, {"cases/__init__.py": "", "adapters/__init__.py": ""})
    assert find(root).case_names() == ("free-fall",)
    with pytest.raises(ProjectError, match="no case 'single-contact'"):
        find(root).load_case("single-contact")


@pytest.mark.parametrize("file", ["cases/settling.py", "cases/mine/settling.py"])
def test_a_case_s_name_that_both_have_names_both_files(root: Path, file: str) -> None:
    write(root, {file: CASE.format("settling")})
    with pytest.raises(ProjectError, match="must be unique") as caught:
        find(root).case_names()
    assert str(root / file) in str(caught.value)
    assert str(ROOT / "cases/hard/settling.py") in str(caught.value)


def test_a_code_s_name_that_both_have_names_both_files(root: Path) -> None:
    write(root, {"adapters/yade.py": ADAPTER.format("yade")})
    with pytest.raises(ProjectError, match="must be unique") as caught:
        find(root).adapter_names()
    assert str(root / "adapters/yade.py") in str(caught.value)
    assert str(ROOT / "adapters/yade") in str(caught.value)


@pytest.mark.parametrize(
    "file",
    [
        "cases/_papers.py",
        "reference_solutions/contact/skid.py",
        "reference_solutions/checks/contact/skid.py",
    ],
)
def test_a_helper_or_a_reference_that_would_hide_one_of_vv_s_names_both(
    root: Path, file: str
) -> None:
    write(root, {file: ""})
    with pytest.raises(ProjectError, match="must be unique") as caught:
        find(root).load_case("free-fall")
    assert str(root / file) in str(caught.value)
    assert str(ROOT / file) in str(caught.value)


def test_a_case_that_came_with_vv_keeps_its_key_and_its_baseline(root: Path) -> None:
    """So what was stored of it elsewhere would answer here, and it is judged the same."""
    own, ours = find(root), Project(ROOT)
    here, there = (
        keys.case_digest(project.case_file("settling"), keys.roots(project))
        for project in (own, ours)
    )
    assert here == there
    assert baseline_of(own, "settling") == baseline_of(ours, "settling") is not None


def test_a_project_that_vv_itself_lies_in_is_told_apart_by_the_inner_folder(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As with a .venv in the project."""
    inner = write(root / ".venv", {f"{name}/__init__.py": "" for name in ("cases", "adapters")})
    write(inner, {"cases/hard/zeno.py": CASE.format("zeno")})
    monkeypatch.setattr("vv.plan.imports.OWN", inner)
    assert find(root).case_names() == ("free-fall", "zeno")
    assert find(root).family("zeno") == "hard"
    assert find(root).load_case("zeno").name == "zeno"
