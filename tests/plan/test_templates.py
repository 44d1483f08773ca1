"""Claims about working starts: they are the examples by another name, and hide nothing."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests import ROOT
from vv.base.errors import UsageError
from vv.codes import program
from vv.plan import imports, templates
from vv.plan.project import find
from vv.plan.templates import Language


@pytest.mark.parametrize("language", Language)
def test_a_program_starts_as_the_example_by_another_name(
    tmp_path: Path, language: Language
) -> None:
    source, declaration = sorted(templates.program(tmp_path, "my_dem", language))
    example = templates.PROGRAMS[language]
    assert (source.stem, declaration.name) == ("my_dem", "my_dem.toml")
    assert example not in source.read_text() + declaration.read_text()
    code = program.load(declaration)
    assert code.name == "my-dem"
    assert any("my_dem" in word for word in code.declared.command)


def test_a_case_starts_as_the_one_that_the_page_shows(tmp_path: Path) -> None:
    page = (ROOT / "docs" / "extending.md").read_text()
    shown = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    for part in ("cases", "reference_solutions"):
        assert (templates.EXAMPLES / "case" / part / "rebound.py").read_text() in shown
    templates.project(tmp_path)
    templates.case(tmp_path, "my_case")
    case = (tmp_path / "cases" / "my_case.py").read_text()
    assert "from reference_solutions import my_case" in case
    assert 'name="my-case"' in case
    assert 'title="My case"' in case


def test_a_new_project_adds_to_what_came_with_vv(tmp_path: Path) -> None:
    templates.project(tmp_path)
    project = find(tmp_path)
    assert project.roots == (tmp_path, imports.OWN)
    assert "single-contact" in project.case_names()
    assert "dem" in project.adapter_names()


def test_nothing_is_written_over_and_nothing_by_halves(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text("mine")
    with pytest.raises(UsageError, match=r"mine\.toml already exists"):
        templates.program(tmp_path, "mine", Language.C)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.toml"]
    with pytest.raises(UsageError, match="a name must be lower-case letters"):
        templates.program(tmp_path, "My-DEM", Language.SH)
    (tmp_path / ".gitignore").write_text("build\n")
    templates.project(tmp_path)
    assert (tmp_path / ".gitignore").read_text() == "build\n"
    with pytest.raises(UsageError, match=r"vv\.toml already exists"):
        templates.project(tmp_path)
