"""Claims of README, tutorials and gallery: their commands run, and they show what comes of it."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from tests import ROOT
from tests.conftest import Tiny
from tests.support.installed import require
from vv.cli.docs_command import case_pages, code_pages
from vv.plan.project import Project

PAGES = ("choose-a-code.md", "test-my-code.md", "in-ci.md", "compare-runs.md")
GALLERY = ROOT / "docs" / "gallery"
LINK = re.compile(r"\]\((?!https?:)([^)#]+)\)")


def written(page: Path, kind: str) -> list[str]:
    """The blocks of a kind in a page."""
    return re.findall(rf"^```{kind}\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", PAGES)
def test_the_commands_of_a_tutorial_run_in_a_project_of_one_s_own(
    page: str, tmp_path: Path
) -> None:
    (tmp_path / "vv.toml").touch()
    (tmp_path / "cases").mkdir()
    mine = Tiny(tmp_path)
    commands = [line for b in written(ROOT / "docs" / page, "console") for line in b.splitlines()]
    assert len(commands) > 4
    for command in commands:
        program, *words = shlex.split(command)
        done = mine.vv(*words)
        assert (program, done.returncode) == ("vv", 0), f"{command}\n{done.stdout}{done.stderr}"


def test_the_readme_shows_what_its_first_command_prints(tmp_path: Path) -> None:
    for name in ("yade", "liggghts"):
        require(Project(ROOT).load_adapter(name))
    blocks = written(ROOT / "README.md", "")
    (command,) = [line for line in blocks[0].splitlines() if " run " in line]
    (tmp_path / "vv.toml").touch()
    (tmp_path / "cases").mkdir()
    done = Tiny(tmp_path).vv(*shlex.split(command)[1:])
    assert done.returncode == 0
    assert bare(blocks[1]) == bare(done.stdout)[: len(bare(blocks[1]))]


def bare(text: str) -> list[list[str]]:
    """The words of each line but what depends on the machine: costs, and last digits of errors."""
    rows = [re.sub(r"~\S+ [mu]?s", "", line).split() for line in text.strip().splitlines()]
    return [[re.sub(r"^(\d)\.\de", r"\1e", word) for word in row] for row in rows]


def test_the_gallery_is_what_cases_and_codes_declare() -> None:
    project = Project(ROOT)
    files = {**case_pages(project, project.case_names()), **code_pages(project)}
    kept = {path.relative_to(GALLERY) for path in GALLERY.rglob("*") if path.is_file()}
    assert kept == files.keys(), "run `vv docs`"
    stale = [str(place) for place, text in files.items() if (GALLERY / place).read_text() != text]
    assert not stale, "run `vv docs`"


@pytest.mark.parametrize("page", ["README.md", *(f"docs/{p}" for p in (*PAGES, "python.md"))])
def test_links_within_the_project_lead_somewhere(page: str) -> None:
    place = ROOT / page
    links = LINK.findall(place.read_text())
    assert links
    assert not [link for link in links if not (place.parent / link).exists()]


def test_the_glossary_has_every_word_that_the_architecture_page_introduces() -> None:
    glossary = (ROOT / "docs" / "glossary.md").read_text()
    entries = [word.lower() for word in re.findall(r"^\*\*([\w -]+)", glossary, re.MULTILINE)]
    assert entries == sorted(entries)
    page = (ROOT / "docs" / "architecture.md").read_text()
    words = set(re.findall(r"\*(\w+)\*", page.partition("## The words")[2].partition("##")[0]))
    plurals = {re.sub("y$", "ie", word) + "s" for word in entries}
    assert words
    assert not words - {*entries, *plurals}


def test_links_within_the_gallery_lead_somewhere() -> None:
    lost = [
        f"{page.relative_to(GALLERY)}: {link}"
        for page in GALLERY.rglob("*.md")
        for link in LINK.findall(page.read_text())
        if not (page.parent / link).exists()
    ]
    assert not lost


def test_every_column_of_the_table_of_results_is_explained() -> None:
    from vv.output.table import table

    page = (ROOT / "docs" / "python.md").read_text()
    assert not [name for name in table([]).columns if f"`{name}`" not in page]


def test_the_examples_of_the_python_interface_run(tmp_path: Path) -> None:
    (tmp_path / "vv.toml").touch()
    (tmp_path / "cases").mkdir()
    read, make = written(ROOT / "docs" / "python.md", "python")
    done = subprocess.run(
        [sys.executable, "-c", f"{make}\n{read}\nassert len(finest) and softer.modified.all()"],
        cwd=tmp_path,
        env={name: value for name, value in os.environ.items() if not name.startswith("VV_")},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    assert "tolerance" in done.stdout
