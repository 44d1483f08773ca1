"""The commands that write working templates: `vv new`, `vv init`."""

from __future__ import annotations

import enum
from pathlib import Path
from typing import Annotated

import typer

from vv.base.errors import UsageError
from vv.output.terminal import say
from vv.plan.project import find
from vv.plan.templates import Language


class Kind(enum.Enum):
    """The kinds of templates."""

    CODE = "code"
    CASE = "case"


NAMES = {Kind.CODE: "mydem", Kind.CASE: "mycase"}


def new(
    kind: Annotated[Kind, typer.Argument(help="What to start.", show_choices=True)],
    name: Annotated[
        str, typer.Argument(metavar="[NAME]", help="Its name: small letters, digits, - and _.")
    ] = "",
    language: Annotated[
        Language, typer.Option("--language", help="The language of a program.")
    ] = Language.C,
) -> None:
    """Write a working template of a code or a case.

    A code is written where you are, a case into your project.
    """
    from vv.plan import imports, templates

    name = templates.file_name(name or NAMES[kind])
    if kind is Kind.CODE:
        for path in templates.program(Path.cwd(), name, language):
            say(f"written: {path.name}")
        if language is Language.C:
            say(f"to build it: cc -O2 -o {name} {name}.c -lm")
        say(f"then: vv check {name}.toml", f"      vv run single-contact --code ./{name}.toml")
        return
    project = find()
    if project.root == imports.OWN:
        raise UsageError(f"{project.root} is not a project of your own; `vv init` makes one")
    for path in templates.case(project.root, name):
        say(f"written: {path.relative_to(project.root)}")
    say(f"then: vv gate {name.replace('_', '-')}")


def init(
    folder: Annotated[Path, typer.Argument(help="The folder of the project.")] = Path("."),
) -> None:
    """Make a folder a project: its cases and codes are added to those of vv."""
    from vv.plan import templates

    for path in templates.project(folder):
        say(f"written: {path}")
    say("then: vv new case, or a TOML file of a program in adapters/; `vv list` shows all cases")
