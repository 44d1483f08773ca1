"""What a source imports is found without parsing it, and parsed wherever that could miss a name."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from tests import ROOT
from vv.base.closure import _names_in_tree, import_closure, imported_names

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
