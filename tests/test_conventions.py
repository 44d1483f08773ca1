"""What holds of every adapter, case and file, whatever it does."""

import ast
import re

from tests import ROOT
from tests.support.sources import FOLDERS, OURS, dotted, imported, tree


def test_an_adapter_drives_one_engine_at_most() -> None:
    for path in ROOT.glob("adapters/**/*.py"):
        found = {n for n in imported(path, [*ast.walk(tree(path))]) if "vv.engines." in n}
        assert len({name.split(".")[2] for name in found}) <= 1, f"{path} imports {sorted(found)}"


def test_cases_never_name_a_code() -> None:
    """A label such as CODE/SCHEME, or the name of a program; DEM and DDA are also methods."""
    places = [p for p in (ROOT / "adapters").iterdir() if p.stem[0] not in "_."]
    codes, programs = {p.stem for p in places}, {p.stem for p in places if p.is_dir()}
    for path in ROOT.glob("cases/**/*.py"):
        text = path.read_text().lower()
        named = set(re.findall(r"([a-z]+)/[a-z]", text)) & codes
        named |= set(re.findall(r"[a-z]+", text)) & programs
        assert not named, f"{path.name} names {sorted(named)}"


def test_every_folder_of_the_tool_is_named_on_the_architecture_page() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text()
    named = [f.relative_to(ROOT).as_posix() for f in FOLDERS if dotted(f).startswith("vv.")]
    assert not [name for name in named if f"`{name}/`" not in page]


def test_every_file_starts_with_one_sentence_on_its_job() -> None:
    for top in (*OURS, "tests", "bench"):
        for path in (ROOT / top).rglob("*.py"):
            assert ast.get_docstring(tree(path)), f"{path.relative_to(ROOT)} has no docstring"
