"""Who may import what: every folder's `__init__` says it, and data flows one way."""

import ast
import re
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

from tests import ROOT
from tests.support.sources import FOLDERS, OURS, TESTS, dotted, imported, tree

HEAVY = {"scipy", "numba", "pandas", "matplotlib", "jinja2", "junitparser", "rich", "pint"}
LOADED = {"engines": {"numba"}, "reports": HEAVY}  # what modules of a folder may load at once
MODULES = 15  # in a folder
GROWING = {"adapters", "cases", "reference_solutions"}  # by a file with each case or code


def own_rule(folder: Path) -> set[str] | None:
    """What a folder's `__init__` says it may import; None if it leaves that to the one above."""
    text = " ".join((ast.get_docstring(tree(folder / "__init__.py")) or "").split())
    _, says, named = text.partition("May import: ")
    names = set(named.rstrip(".").split(", ")) - {"nothing of ours"} if says else set()
    return {n if n.split(".")[0] in OURS else f"vv.{n}" for n in names} if says else None


def rule(folder: Path) -> set[str]:
    """What the modules of a folder may import; the folder itself always."""
    own = own_rule(folder)
    return rule(folder.parent) if own is None else own | {dotted(folder)}


@pytest.mark.parametrize("folder", FOLDERS, ids=dotted)
def test_a_folder_imports_only_what_it_says(folder: Path) -> None:
    allowed = {"vv.__version__", *rule(folder)}
    for path in folder.glob("*.py"):
        if path.name == "driver.py":
            continue  # runs inside YADE
        ours = {n for n in imported(path, [*ast.walk(tree(path))]) if n.split(".")[0] in OURS}
        wrong = {n for n in ours if not any(f"{n}.".startswith(f"{one}.") for one in allowed)}
        assert not wrong - {"vv"}, f"{path.relative_to(ROOT)} must not import {sorted(wrong)}"


@pytest.mark.parametrize("folder", [*FOLDERS, *TESTS], ids=dotted)
def test_a_folder_holds_few_modules(folder: Path) -> None:
    modules = [path for path in folder.glob("*.py") if path.name != "__init__.py"]
    assert len(modules) <= MODULES or dotted(folder) in GROWING


@pytest.mark.parametrize("folder", FOLDERS, ids=dotted)
def test_a_folder_loads_heavy_libraries_where_they_are_used(folder: Path) -> None:
    light = HEAVY - {h for name in LOADED if name in folder.parts for h in LOADED[name]}
    for path in folder.glob("*.py"):
        slow = {name.split(".")[0] for name in imported(path, [*tree(path).body])} & light
        assert not slow, f"{path.relative_to(ROOT)} must import {sorted(slow)} where it uses them"


def test_folders_import_each_other_one_way_only() -> None:
    said = {dotted(folder): own_rule(folder) for folder in FOLDERS}
    assert [*TopologicalSorter({name: rule or () for name, rule in said.items()}).static_order()]
    unruled = [name for name in said if re.fullmatch(r"vv\.\w+", name) and said[name] is None]
    assert not unruled, f"{unruled} do not say what they may import"
