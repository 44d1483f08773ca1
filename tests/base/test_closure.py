"""What a source imports is found without parsing it, and parsed wherever that could miss a name."""

from __future__ import annotations

import ast
from pathlib import Path

import numpy as np
import pytest

from tests import ROOT
from vv.base.closure import _names_in_tree, import_closure, imported_names, library_versions

FOLDERS = ("vv", "adapters", "cases", "reference_solutions", "reports", "bench", "tests")
SOURCES = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]


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


def test_libraries_are_those_that_sources_import_and_what_data_says_is_none(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text("import numpy\nimport nothing_of_that_name\nimport vv\n")
    (tmp_path / "b.txt").write_text("import scipy\n")
    found = library_versions([tmp_path / "a.py", tmp_path / "b.txt"])
    assert found["numpy"] == np.__version__
    assert not found.keys() & {"scipy", "nothing_of_that_name"}
