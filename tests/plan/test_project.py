"""Claims about projects: where one is found, what it holds, how its content is loaded."""

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests import ROOT
from vv.base.closure import CONTENT_PACKAGES, import_closure
from vv.plan import imports
from vv.plan.content import ProjectError
from vv.plan.keys import roots
from vv.plan.project import Project, find

CASE = """
from vv.case import Case, Source
CASE = Case("{}", "", Source("", ""), parameters=(), variants=(), declare=lambda v, p: None)
"""
ADAPTER = """
class Code:
    name = "{}"
ADAPTER = Code()
"""


@pytest.fixture(autouse=True)
def apart(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let a test import another project's content; afterwards all is as it was."""
    monkeypatch.delenv("VV_PROJECT", raising=False)
    monkeypatch.setattr(sys, "path", sys.path[:])
    kept = {name: module for name, module in sys.modules.items() if is_content(name)}
    forget_content()
    yield
    forget_content()
    sys.modules.update(kept)


def is_content(module: str) -> bool:
    return module.partition(".")[0] in CONTENT_PACKAGES


def forget_content() -> None:
    for name in [name for name in sys.modules if is_content(name)]:
        del sys.modules[name]


def write(root: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return root


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """A project alone, with a case, a family of one, and two codes; a helper is neither."""
    return write(
        tmp_path / "project",
        {
            "vv.toml": "alone = true",
            "cases/__init__.py": "",
            "cases/_helper.py": "",
            "cases/free_fall.py": CASE.format("free-fall"),
            "cases/hard_ones/zeno.py": CASE.format("zeno"),
            "cases/baselines/exact.json": "{}",
            "adapters/__init__.py": "",
            "adapters/_helper.py": "",
            "adapters/one_file.py": ADAPTER.format("one-file"),
            "adapters/folder/__init__.py": ADAPTER.format("folder"),
            "adapters/folder/deck.txt": "",
            "adapters/folder/__pycache__/x.pyc": "",
        },
    )


def test_a_project_is_found_from_any_folder_below_it(root: Path) -> None:
    assert find(root / "cases" / "hard_ones") == Project(root)


def test_a_project_is_marked_by_vv_toml_or_by_a_table_in_pyproject(root: Path) -> None:
    (root / "vv.toml").rename(root / "pyproject.toml")
    assert find(root) == Project(imports.SOURCES)
    (root / "pyproject.toml").write_text("[tool.vv]\n")
    assert find(root) == Project(root)


def test_this_checkout_is_a_project() -> None:
    assert find(ROOT / "tests") == Project(ROOT)


def test_a_nearer_project_wins(root: Path) -> None:
    inner = write(root / "inner", {"vv.toml": "", "cases/free_fall.py": ""})
    assert find(inner) == Project(inner)


def test_the_environment_overrides_the_place_and_a_choice_overrides_both(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VV_PROJECT", str(root))
    assert find(ROOT) == Project(root)
    assert find(ROOT, chosen=ROOT) == Project(ROOT)


def test_what_is_no_project_is_refused_by_name(root: Path) -> None:
    with pytest.raises(ProjectError, match="cases is not a project: it has neither cases/ nor"):
        find(chosen=root / "cases")


def test_a_marked_folder_without_cases_is_not_passed_over(tmp_path: Path) -> None:
    write(tmp_path, {"vv.toml": "", "readme": ""})
    with pytest.raises(ProjectError, match="neither cases/ nor adapters/"):
        find(tmp_path)


def test_a_project_that_stands_alone_needs_both_packages(root: Path) -> None:
    (root / "cases/__init__.py").unlink()
    with pytest.raises(ProjectError, match=r"no cases/__init__\.py"):
        find(root)


@pytest.mark.parametrize("text", ["alone = 1", "lone = true"])
def test_a_setting_that_there_is_not_is_refused_by_name(root: Path, text: str) -> None:
    write(root, {"vv.toml": text})
    with pytest.raises(
        ProjectError, match=r"vv\.toml: a?lone = .*; the only setting is alone, true or"
    ):
        find(root)


def test_a_broken_pyproject_matters_only_beside_cases(root: Path) -> None:
    (root / "pyproject.toml").write_text("[tool")
    assert find(root) == Project(root)
    (root / "vv.toml").unlink()
    with pytest.raises(ProjectError, match=r"pyproject\.toml: "):
        find(root)
    write(root.parent, {"pyproject.toml": "[tool"})
    (root / "pyproject.toml").unlink()
    assert find(root) == Project(imports.SOURCES)


def test_generated_things_go_to_the_project_but_never_into_an_installed_one(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert Project(root).data() == root / ".vv"
    assert Project(root, bundled=True).data() == tmp_path / ".vv"


def test_names_and_families_come_from_the_files(root: Path) -> None:
    project = Project(root)
    assert project.case_names() == ("free-fall", "zeno")
    assert [project.family(name) for name in project.case_names()] == ["free-fall", "hard-ones"]
    assert project.adapter_names() == ("folder", "one-file")
    assert project.case_file("zeno") == root / "cases/hard_ones/zeno.py"


def test_listing_imports_nothing(root: Path) -> None:
    write(root, {"cases/bad.py": "1/0", "adapters/bad.py": "1/0"})
    assert "bad" in Project(root).case_names()
    assert "bad" in Project(root).adapter_names()


def test_an_adapter_s_files_are_what_was_written(root: Path) -> None:
    files = Project(root).adapter_files("folder")
    assert files == (root / "adapters/folder/__init__.py", root / "adapters/folder/deck.txt")
    assert Project(root).adapter_files("one-file") == (root / "adapters/one_file.py",)


@pytest.mark.parametrize(
    ("file", "rule"),
    [
        ("cases/zeno.py", "a case's name must be unique"),
        ("cases/hard_ones.py", "a family must not have the name of a case"),
        ("cases/my-case.py", "a name must be lower-case letters"),
    ],
)
def test_ambiguous_and_unusable_case_names_are_errors(root: Path, file: str, rule: str) -> None:
    write(root, {file: ""})
    with pytest.raises(ProjectError, match=rule):
        Project(root).case_names()


def test_cases_and_adapters_are_loaded_by_name(root: Path) -> None:
    project = Project(root)
    assert project.load_case("free-fall").name == "free-fall"
    assert project.load_case("zeno").name == "zeno"
    assert project.load_adapter("one-file").name == "one-file"
    assert project.load_adapter("folder").name == "folder"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "free_fall.py has no CASE; it must end in CASE = ..."),
        ("CASE = 1", "free_fall.py: CASE is of type int; it must be a vv.case.Case"),
        (CASE.format("free_fall"), "CASE.name = 'free_fall'; it must be 'free-fall'"),
        ("x = 1\nimport nowhere", "free_fall.py:2: ModuleNotFoundError: No module named 'nowhere'"),
        ("x = 1\nx = = 2", "free_fall.py:2: SyntaxError: invalid syntax"),
        ("raise ValueError('r = -1\\nno')", "free_fall.py:1: ValueError: r = -1 no"),
    ],
)
def test_a_case_that_is_not_right_gives_one_line_that_names_its_file(
    root: Path, text: str, message: str
) -> None:
    write(root, {"cases/free_fall.py": text})
    with pytest.raises(ProjectError) as caught:
        Project(root).load_case("free-fall")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_adapter_that_is_not_right_is_named(root: Path) -> None:
    write(root, {"adapters/one_file.py": "", "adapters/folder/__init__.py": ADAPTER.format("x")})
    with pytest.raises(ProjectError, match=r"one_file\.py has no ADAPTER"):
        Project(root).load_adapter("one-file")
    with pytest.raises(ProjectError, match=r"ADAPTER\.name = 'x'; it must be 'folder'"):
        Project(root).load_adapter("folder")


def test_an_unknown_name_brings_the_near_ones(root: Path) -> None:
    with pytest.raises(ProjectError, match="no case 'free-fal'; did you mean free-fall"):
        Project(root).load_case("free-fal")
    with pytest.raises(ProjectError, match="no code 'foldre'; did you mean folder"):
        Project(root).adapter_files("foldre")


def test_one_entry_makes_all_content_importable_and_what_lacks_comes_from_our_own(
    root: Path,
) -> None:
    Project(root).load_case("zeno")
    Project(root).load_adapter("folder")
    assert sys.path.count(str(root)) == 1
    assert sys.path[:2] == [str(root), str(imports.OWN)]
    assert importlib.import_module("reports").__file__ == str(imports.OWN / "reports/__init__.py")


def test_packages_taken_from_elsewhere_are_not_mistaken_for_the_project_s(
    root: Path, tmp_path: Path
) -> None:
    other = write(tmp_path / "other", {"cases/__init__.py": "", "cases/free_fall.py": "CASE = 1"})
    sys.path.insert(0, str(other))
    __import__("cases.free_fall")
    with pytest.raises(ProjectError, match=f"in this process 'cases' is {other / 'cases'}"):
        Project(root).load_case("free-fall")


def test_the_content_of_a_checkout_is_used_though_another_vv_runs(root: Path) -> None:
    write(root, {"vv/__init__.py": "raise ImportError('not the vv that runs')"})
    assert Project(root).load_case("zeno").name == "zeno"


@pytest.mark.parametrize("code", Project(ROOT).adapter_names())
def test_no_solver_is_asked_anew_where_only_what_is_told_of_it_changes(code: str) -> None:
    project = Project(ROOT)
    read = import_closure(project.adapter_files(code), roots(project))
    layers = {
        path.relative_to(ROOT / "vv").parts[0] for path in read if ROOT / "vv" in path.parents
    }
    assert not layers & {"store", "records", "gate", "run", "insight", "output", "cli"}
