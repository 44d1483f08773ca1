"""Claims about `vv docs`: a page for each case and code, or for those named alone."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any, NoReturn

import pytest

from tests.conftest import Tiny
from vv.base.errors import UsageError
from vv.case import Level
from vv.cli.docs_command import _pages_of_cases, case_pages
from vv.plan.plan import Options
from vv.plan.project import Project


def pages(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*.md")}


def test_all_pages_are_written_anew_or_those_named_beside_the_others(tiny: Tiny) -> None:
    out = tiny.root / "out"
    done = tiny.vv("docs", "--output", "out")
    assert done.returncode == 0, done.stderr
    whole = pages(out)
    assert whole >= {"cases/fall.md", "codes/fake.md", "codes/missing.md"}
    old = out / "cases" / "old.md"
    old.write_text((out / "cases" / "fall.md").read_text())  # of a case that is no more
    (out / "codes" / "fake.md").unlink()
    (out / "cases" / "fall.md").unlink()
    assert tiny.vv("docs", "fall", "--output", "out").returncode == 0
    assert pages(out) == whole - {"codes/fake.md"} | {"cases/old.md"}
    assert tiny.vv("docs", "--output", "out").returncode == 0
    assert pages(out) == whole


class AskedError(Exception):
    """The options that a plan was asked for with."""


@pytest.mark.parametrize(
    ("levels", "asked"),
    [
        ((Level.QUICK, Level.PAPER), Level.DEFAULT),
        ((Level.PAPER, Level.QUICK), Level.DEFAULT),
        ((Level.PAPER, Level.DEFAULT), Level.DEFAULT),
        ((Level.PAPER, Level.PAPER), Level.PAPER),
    ],
)
def test_a_page_is_of_the_default_level_or_of_the_first_that_its_case_has(
    levels: tuple[Level, ...], asked: Level, monkeypatch: pytest.MonkeyPatch
) -> None:
    def told(project: Project, selection: list[str], options: Options) -> NoReturn:
        raise AskedError(selection, options)

    monkeypatch.setattr("vv.plan.planning.make_plan", told)
    case = SimpleNamespace(variants=[SimpleNamespace(level=level) for level in levels])
    project: Any = SimpleNamespace(load_case=lambda name: case)
    with pytest.raises(AskedError) as found:
        case_pages(project, ["fall"])
    assert found.value.args == (["fall"], Options(asked))


def test_of_the_scenes_of_a_case_each_is_drawn_once_and_no_more_than_four(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scenes = [1, 1, 2, None, 3, 4, 5]
    trials = {("fall", f"v{i}"): _trial(one) for i, one in enumerate(scenes)}
    plan = SimpleNamespace(trials=trials)
    case = SimpleNamespace(name="fall", variants=[SimpleNamespace(name="v0", level=Level.QUICK)])
    project: Any = SimpleNamespace(load_case=lambda name: case, family=lambda name: "family")
    shown: dict[str, str] = {}

    def page(case: object, family: str, facts: object, drawn: dict[str, str], *_: object) -> Any:
        shown.update(drawn)
        return SimpleNamespace(text=lambda: "the page")

    monkeypatch.setattr("vv.plan.planning.make_plan", lambda *_: plan)
    monkeypatch.setattr("vv.run.case_facts.case_facts", lambda *_: None)
    monkeypatch.setattr("vv.output.gallery.case_page.CasePage", page)
    monkeypatch.setattr("vv.output.gallery.declared_numbers.numbers", lambda *_: {})
    monkeypatch.setattr("vv.output.gallery.numbers_page.numbers_page", lambda *_: "the numbers")
    monkeypatch.setattr("vv.cli.docs_command._drawing", lambda one: f"<svg {one}>" if one else "")
    monkeypatch.setattr("vv.cli.docs_command._answers", lambda *_: {})
    files = case_pages(project, ["fall"])
    drawn = {"v0": 1, "v2": 2, "v4": 3, "v5": 4}
    assert shown == {variant: f"fall-{variant}.svg" for variant in drawn}
    assert files == {
        Path("cases/fall.md"): "the page",
        Path("cases/fall-numbers.md"): "the numbers",
        **{Path(f"cases/fall-{variant}.svg"): f"<svg {one}>" for variant, one in drawn.items()},
    }


def _trial(scene: object) -> Any:
    return SimpleNamespace(study=SimpleNamespace(scene=scene))


@pytest.mark.parametrize(("name", "page"), [("a.md", True), ("a.svg", True), ("a.txt", False)])
def test_a_folder_in_which_anything_else_lies_is_no_gallery(
    name: str, page: bool, tmp_path: Path
) -> None:
    place = tmp_path / "cases" / name
    place.parent.mkdir()
    place.touch()
    if page:
        assert _pages_of_cases(tmp_path) == [place]
    else:
        with pytest.raises(UsageError, match="is not a gallery page"):
            _pages_of_cases(tmp_path)


def test_a_folder_named_like_a_page_is_no_page(tmp_path: Path) -> None:
    (tmp_path / "cases" / "a.md").mkdir(parents=True)
    with pytest.raises(UsageError, match="is not a gallery page"):
        _pages_of_cases(tmp_path)


def test_pages_of_some_codes_are_refused_and_a_picture_takes_one_variant(tiny: Tiny) -> None:
    done = tiny.vv("docs", "--codes", "fake", "--output", "out")
    assert done.returncode == 64
    assert "it applies to --picture only" in done.stderr
    many = tiny.vv("docs", "fall", "--picture", "a.svg")
    assert many.returncode == 64
    assert "takes one CASE:VARIANT, not 2" in many.stderr
