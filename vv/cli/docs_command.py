"""The command that writes the gallery: `vv docs`, a page for each case and each code."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vv.base.errors import UsageError
from vv.base.files import write_whole
from vv.case import Level
from vv.cli import options
from vv.output.terminal import say
from vv.plan.project import Project, find

if TYPE_CHECKING:
    from vv.case import Case
    from vv.output.gallery.case_page import Answers

DRAWN = 4  # the most scenes of a case
Files = dict[Path, str]  # place in the gallery -> text


def docs(
    selection: options.Selection = None,
    output: Annotated[
        Path, typer.Option("--output", metavar="DIR", help="The folder to write.")
    ] = Path("docs/gallery"),
    picture: Annotated[
        Path | None,
        typer.Option(
            "--picture",
            metavar="FILE",
            help="Write error against cost of CASE:VARIANT, as last timed, and no page.",
        ),
    ] = None,
    codes: options.Codes = "*",
) -> None:
    """Write the gallery: a page for each case and code, generated from its declaration."""
    project = find()
    if picture is not None:
        _picture(project, selection or [], options.codes(codes), picture)
        return
    if codes != "*":
        raise UsageError(f"--codes {codes}: it applies to --picture only; pages describe all codes")
    old = _pages_of_cases(output)
    names = _cases(project, selection or ["*"])
    files = {**case_pages(project, names), **({} if selection else code_pages(project))}
    for page in () if selection else old:  # some belong to cases that no longer exist
        page.unlink()
    for place, text in files.items():
        path = output / place
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, text.encode())
    say(f"{len(files)} files in {output}")


def _pages_of_cases(gallery: Path) -> list[Path]:
    """The pages and drawings in a gallery; raises UsageError for any other file."""
    found = sorted((gallery / "cases").glob("*"))
    for one in found:
        if one.suffix not in (".md", ".svg") or not one.is_file():
            rule = "is not a gallery page; name another folder, as `vv docs` rewrites it"
            raise UsageError(f"--output {gallery}: {one} {rule}")
    return found


def _cases(project: Project, selection: Sequence[str]) -> list[str]:
    from vv.plan.selection import select

    return list(dict.fromkeys(case.name for case, _ in select(project, selection)))


def case_pages(project: Project, names: Sequence[str]) -> Files:
    """The pages and drawings of cases."""
    return dict(file for name in names for file in _of_case(project, name))


def _of_case(project: Project, name: str) -> Iterator[tuple[Path, str]]:
    from vv.output.gallery.case_page import CasePage
    from vv.output.gallery.declared_numbers import numbers
    from vv.output.gallery.numbers_page import numbers_page
    from vv.plan.plan import Options
    from vv.plan.planning import make_plan
    from vv.run.case_facts import case_facts

    case = project.load_case(name)
    first = min((variant.level for variant in case.variants), key=lambda level: level.rank)
    level = max(first, Level.DEFAULT, key=lambda level: level.rank)
    plan = make_plan(project, [name], Options(level))
    drawn: dict[str, str] = {}
    scenes: dict[str, str] = {}
    for (_, variant), trial in plan.trials.items():
        if len(scenes) < DRAWN and (text := _drawing(trial.study.scene)) and text not in scenes:
            scenes[text] = f"{name}-{variant}.svg"
            drawn[variant] = scenes[text]
    page = CasePage(
        case,
        project.family(name),
        case_facts(case, plan),
        drawn,
        _answers(project, case),
        f"{name}-numbers.md",
    )
    yield Path("cases", f"{name}.md"), page.text()
    declared = {variant.name: numbers(case, variant) for variant in case.variants}
    yield Path("cases", f"{name}-numbers.md"), numbers_page(case, declared)
    for text, file in scenes.items():
        yield Path("cases", file), text


def _drawing(scene: object) -> str:
    from vv.output.gallery.scene_drawing import drawing
    from vv.scene import Scene

    return drawing(scene) if isinstance(scene, Scene) else ""


def _answers(project: Project, case: Case) -> Answers:
    from vv.gate.answers import accepted

    return accepted(project, case.name) or {}


def code_pages(project: Project) -> Files:
    """The pages of codes, and the page that lists cases and codes."""
    from vv.gate.ledger_file import read_disagreements
    from vv.output.gallery.code_page import CodePage
    from vv.output.gallery.index_page import index

    cases = [project.load_case(name) for name in project.case_names()]
    answers = {case.name: _answers(project, case) for case in cases}
    adapters = [project.load_adapter(name) for name in project.adapter_names()]
    known = [
        entry
        for root in project.roots
        for entry in read_disagreements(root / "cases" / "disagreements.toml")
    ]
    files: Files = {Path("README.md"): index(cases, project.families(), adapters)}
    for adapter in adapters:
        own = [
            (one.case, ", ".join(one.variants), one.reason)
            for one in known
            if one.code == adapter.name
        ]
        files[Path("codes", f"{adapter.name}.md")] = CodePage(adapter, answers, own).text()
    return files


def _picture(
    project: Project, selection: Sequence[str], codes: tuple[str, ...], file: Path
) -> None:
    """Draw error against cost of one variant, as it was last timed."""
    from vv.insight.effort import efforts
    from vv.output.gallery.error_cost import picture
    from vv.plan.selection import choose_schemes, named_adapters, select
    from vv.store.store import Store

    chosen = select(project, selection)
    if len(chosen) != 1:
        raise UsageError(f"--picture takes one CASE:VARIANT, not {len(chosen)}")
    (case, variant), labels = (
        (chosen[0][0].name, chosen[0][1]),
        [
            f"{adapter.name}/{scheme.name}"
            for adapter, scheme in choose_schemes(named_adapters(project, codes), codes)
        ],
    )
    store = Store(project.data())
    for name in reversed(store.manifests.names()):
        every = efforts(store.manifests.read(name))
        own = [e for e in every if (e.case, e.variant) == (case, variant) and e.label in labels]
        if own:
            picture(own, f"{case}:{variant}", file)
            say(f"{file}, of run {name}")
            return
    raise UsageError(f"{case}:{variant} was never timed; `vv speed {case}:{variant}` times it")
