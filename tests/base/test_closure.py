"""What a source imports is found without parsing it, and parsed wherever that could miss a name."""

from __future__ import annotations

import ast
from pathlib import Path

import numpy as np
import pytest

from tests import ROOT
from vv.base.closure import (
    _names_in_tree,
    changed_files,
    import_closure,
    imported_names,
    library_versions,
    source_digest,
)

FOLDERS = ("vv", "adapters", "cases", "reference_solutions", "reports", "bench", "tests")
SOURCES = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]


@pytest.fixture(autouse=True)
def _no_digests_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """What this process knows of files is that of all its tests: these edit theirs."""
    monkeypatch.setattr("vv.base.closure._DIGESTS", {})


def test_nothing_that_parsing_finds_is_missed_in_any_of_our_sources() -> None:
    for path in SOURCES:
        text = path.read_text()
        assert set(_names_in_tree(ast.parse(text))) <= set(imported_names(text)), path


@pytest.mark.parametrize(
    "text",
    [
        "import vv.a, vv.b as b",
        "from vv import a, b  # both",
        "from vv import (\n    a,\n    b,\n)",
        "from vv import (\n    a,  # the first)\n    b,\n)",
        "from vv import a, \\\n    b",
        "import vv.a; import vv.b",
        "x = 1; import vv.a, vv.b",
        "if True: import vv.a, vv.b",
        "def f():\n    import vv.a\n    from vv import b",
        "try:\n\timport vv.a, vv.b\nexcept ImportError: pass",
        "import vv.a  # import\nif True: import vv.b",
        "from vv import(a, b)",
        "import\\\n vv.a, vv.b",
        "import vv . a, vv. b",
        '"""\nimport this\n"""; import vv.a, vv.b',
        "from vv import \N{FULLWIDTH LATIN SMALL LETTER A}, b",  # the same name, by PEP 3131
    ],
)
def test_a_name_is_found_however_it_is_imported(text: str) -> None:
    assert {"vv.a", "vv.b"} <= set(imported_names(text))


def test_a_closure_follows_an_import_inside_a_function(tmp_path: Path) -> None:
    for name, text in {"__init__": "", "a": "def f():\n    from cases import b", "b": ""}.items():
        (tmp_path / "cases").mkdir(exist_ok=True)
        (tmp_path / "cases" / f"{name}.py").write_text(text)
    found = import_closure([tmp_path / "cases" / "a.py"], [tmp_path])
    assert {path.name for path in found} == {"__init__.py", "a.py", "b.py"}


def test_vv_is_the_one_that_runs_and_no_folder_of_that_name_in_a_project(tmp_path: Path) -> None:
    for root in ("project", "tool"):
        (tmp_path / root / "vv").mkdir(parents=True)
        (tmp_path / root / "vv" / "__init__.py").touch()
    (tmp_path / "project" / "a.py").write_text("import vv\n")
    found = import_closure(
        [tmp_path / "project" / "a.py"], [tmp_path / "project", tmp_path / "tool"]
    )
    assert tmp_path / "tool" / "vv" / "__init__.py" in found
    assert tmp_path / "project" / "vv" / "__init__.py" not in found


def test_a_package_brings_the_data_in_its_folder_but_no_source_that_nothing_imports(
    tmp_path: Path,
) -> None:
    (tmp_path / "cases").mkdir()
    for name in ("__init__.py", "a.py", "alone.py", "alone.pyc", "table.csv"):
        (tmp_path / "cases" / name).touch()
    (tmp_path / "mine.py").write_text("from cases import a\n")
    found = import_closure([tmp_path / "mine.py"], [tmp_path])
    assert {path.name for path in found} == {"mine.py", "__init__.py", "a.py", "table.csv"}


@pytest.mark.parametrize("package", ["adapters", "cases", "reference_solutions", "reports"])
def test_a_module_brings_the_init_of_every_package_around_it(tmp_path: Path, package: str) -> None:
    """Importing a module executes them all, so that each may change what it gives."""
    inner = tmp_path / package / "inner"
    inner.mkdir(parents=True)
    for file in (inner.parent / "__init__.py", inner / "__init__.py", inner / "a.py"):
        file.touch()
    (tmp_path / "mine.py").write_text(f"import {package}.inner.a\n")
    found = import_closure([tmp_path / "mine.py"], [tmp_path])
    here = [path.relative_to(tmp_path).as_posix() for path in found]
    assert here == sorted(
        [f"{package}/__init__.py", f"{package}/inner/__init__.py", f"{package}/inner/a.py",
         "mine.py"]
    )  # fmt: skip


def test_a_module_in_two_roots_is_that_of_the_first(tmp_path: Path) -> None:
    for root in ("mine", "came-with-it"):
        (tmp_path / root / "cases").mkdir(parents=True)
        (tmp_path / root / "cases" / "a.py").touch()
    (tmp_path / "b.py").write_text("import cases.a\n")
    found = import_closure([tmp_path / "b.py"], [tmp_path / "mine", tmp_path / "came-with-it"])
    assert tmp_path / "mine" / "cases" / "a.py" in found
    assert tmp_path / "came-with-it" / "cases" / "a.py" not in found


def test_a_digest_depends_on_names_and_contents_but_not_on_folders(tmp_path: Path) -> None:
    """Of two clones, folders that are sorted otherwise included."""

    def made(folders: tuple[str, str], names: tuple[str, str], texts: tuple[str, str]) -> str:
        root = tmp_path / "-".join((*folders, *names, *texts))
        paths = [root / f / n for f, n in zip(folders, names, strict=True)]
        for path, text in zip(paths, texts, strict=True):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return source_digest(paths)

    known = made(("x", "y"), ("a", "b"), ("1", "2"))
    assert made(("y", "x"), ("a", "b"), ("1", "2")) == known
    assert made(("x", "y"), ("a", "c"), ("1", "2")) != known
    assert made(("x", "y"), ("a", "b"), ("1", "3")) != known


def test_a_file_that_was_removed_since_its_digest_was_taken_has_changed(tmp_path: Path) -> None:
    kept, edited, removed = files = [tmp_path / name for name in ("kept", "edited", "removed")]
    for path in files:
        path.write_text("before")
    source_digest(files)
    edited.write_text("after")
    removed.unlink()
    assert {kept, edited, removed} & {*changed_files()} == {edited, removed}


def test_libraries_are_those_that_sources_import_and_what_data_says_is_none(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text("import numpy\nimport nothing_of_that_name\nimport vv\n")
    (tmp_path / "b.txt").write_text("import scipy\n")
    found = library_versions([tmp_path / "a.py", tmp_path / "b.txt"])
    assert found["numpy"] == np.__version__
    assert not found.keys() & {"scipy", "nothing_of_that_name"}
