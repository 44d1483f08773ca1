"""Claims about docs/findings.md: a run or a test of the suite shows each figure and each sentence.

What shows words of the page has them beside it: a row of a table `FOUND` of this folder, which is
run, or the mark `shows` of a test anywhere. What sources say and definitions are in `said.py`.
"""

import ast
import importlib
import itertools
import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.core import TyperGroup
from typer.main import get_command

from tests import ROOT
from tests.findings.figures import PROJECT
from tests.findings.said import SAID
from tests.findings.table import Row, Table
from vv.case import Level
from vv.cli import app
from vv.plan.selection import choose_schemes, named_adapters, select

PAGE = (ROOT / "docs" / "findings.md").read_text()
BULLETS = [line[2:] for line in PAGE.splitlines() if line.startswith("- ")]
QUOTED = re.compile(r"`([^`]+)`")
FIGURE = re.compile(r"(?<![\w.^-])\d")
ENDS = re.compile(r"\.\)? (?=[A-Z`])")
MARK = "@pytest.mark.shows("
HERE = Path(__file__)
TABLES = sorted(path.stem for path in HERE.parent.glob("test_*.py") if path != HERE)
MODULES = [importlib.import_module(f"tests.findings.{name}") for name in TABLES]


def marked() -> Iterator[str]:
    """The words of the page that tests of the suite are marked to show."""
    for path in sorted((ROOT / "tests").rglob("test_*.py")):
        text = path.read_text()
        if path != HERE and MARK in text:
            for one in ast.walk(ast.parse(text)):
                if isinstance(one, ast.FunctionDef) and one.name.startswith("test_"):
                    yield from told_by(one)


def told_by(test: ast.FunctionDef) -> Iterator[str]:
    """The words in the marks of a test."""
    for mark in test.decorator_list:
        if isinstance(mark, ast.Call) and f"@{ast.unparse(mark.func)}(" == MARK:
            yield from map(ast.literal_eval, mark.args)


FOUND: list[Table] = [getattr(one, "FOUND", {}) for one in MODULES]
RUN = [(told, row) for table in FOUND for told, group in table.items() for row in group]
ROWS = [row for _, row in RUN]
TOLD = [*(told for told, _ in RUN), *marked(), *SAID]


def commands() -> list[str]:
    """The commands of the page that run cases."""
    return sorted({text for text in QUOTED.findall(PAGE) if text.startswith("vv run ")})


def parsed(command: str) -> dict[str, object]:
    """The arguments of a command as the command line reads them; it ends on what it does not."""
    group = get_command(app)
    assert isinstance(group, TyperGroup)
    return dict(group.commands["run"].make_context("run", shlex.split(command)[2:]).params)


@pytest.mark.parametrize("told", sorted(set(TOLD)))
def test_what_is_shown_is_on_the_page(told: str) -> None:
    assert PAGE.count(told) == 1


def unshown() -> Iterator[str]:
    """The places on the page with a figure that no table has; names and commands are no figures."""
    for bullet in BULLETS:
        shown = [(at, at + len(told)) for told in TOLD if (at := bullet.find(told)) >= 0]
        bare = QUOTED.sub(lambda found: "`" * len(found[0]), bullet)
        for found in FIGURE.finditer(bare):
            if not any(first <= found.start() < last for first, last in shown):
                yield bullet[max(0, found.start() - 50) : found.start() + 30]


def test_each_figure_is_shown_by_something() -> None:
    assert not list(unshown())


def unshown_sentences() -> Iterator[str]:
    """The sentences of which no table has a word; ends of sentences in names do not count."""
    for bullet in BULLETS:
        bare = QUOTED.sub(lambda found: "`" * len(found[0]), bullet)
        ends = [0, *(found.end() for found in ENDS.finditer(bare)), len(bullet)]
        shown = [(at, at + len(told)) for told in TOLD if (at := bullet.find(told)) >= 0]
        for start, end in itertools.pairwise(ends):
            if not any(first < end and start < last for first, last in shown):
                yield bullet[start:end]


def test_each_sentence_is_shown_by_something_or_said_to_be_no_finding() -> None:
    assert not list(unshown_sentences())


@pytest.mark.parametrize("bullet", BULLETS, ids=lambda text: " ".join(text.split()[:6]))
def test_each_finding_names_what_shows_it(bullet: str) -> None:
    paths = r"vv run .*|(tests|reference_solutions)/[\w/]*(\.py)?"
    assert any(re.fullmatch(paths, text) for text in QUOTED.findall(bullet))


@pytest.mark.parametrize("text", sorted(set(QUOTED.findall(PAGE))))
def test_files_that_are_named_are_there_and_no_bench_is(text: str) -> None:
    assert not text.startswith(("python ", "bench/"))
    if text.startswith(("tests/", "reference_solutions/", "cases/")):
        assert (ROOT / text).exists()


def test_figures_are_in_findings_alone() -> None:
    others = [line for line in PAGE.splitlines() if not line.startswith("- ")]
    assert not FIGURE.findall("\n".join(others))


@pytest.mark.parametrize("command", commands())
def test_the_command_line_takes_a_command_and_its_finding_is_run(command: str) -> None:
    """A row is of one of its variants, one of its schemes and its changes of parameters."""
    given = parsed(command)
    codes = tuple(str(given["codes"]).split(","))
    schemes = {
        f"{adapter.name}/{scheme.name}"
        for adapter, scheme in choose_schemes(named_adapters(PROJECT, codes), codes)
    }
    level = Level(given["level"])
    chosen = select(PROJECT, given["selection"])  # type: ignore[arg-type]
    variants = {f"{case.name}:{name}" for case, name in chosen if case.variant(name).runs_at(level)}
    sets = {one.replace(" ", "") for one in given["settings"] or ()}  # type: ignore[attr-defined]

    def shows(row: Row) -> bool:
        name, *changed = row.name.split()
        return name in variants and row.scheme in schemes and set(changed) >= sets

    assert any(shows(row) for row in ROWS)
