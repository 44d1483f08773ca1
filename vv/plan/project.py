"""Finds the project: where its cases and adapters lie, and how each is loaded by its name."""

from __future__ import annotations

import os
import tomllib
from dataclasses import dataclass
from pathlib import Path

from vv.case import Case
from vv.codes.adapter import Adapter
from vv.plan import content, imports
from vv.plan.content import ProjectError
from vv.plan.settings import name_hint

REQUIRED = ("adapters/__init__.py", "cases/__init__.py")


@dataclass(frozen=True)
class Project:
    """A folder of cases and adapters; bundled: it came with the installed package.

    Nothing is imported to list names. A name has `-` where its file has `_`.
    """

    root: Path
    bundled: bool = False

    def data(self) -> Path:
        """The folder of generated things: VV_DATA, or .vv, never inside an installed package."""
        if chosen := os.environ.get("VV_DATA"):
            return Path(chosen).resolve()
        return (Path.cwd() if self.bundled else self.root) / ".vv"

    def case_names(self) -> tuple[str, ...]:
        """The names of all cases, sorted."""
        return tuple(sorted(content.cases(self.root)))

    def adapter_names(self) -> tuple[str, ...]:
        """The names of all codes that have an adapter, sorted."""
        return tuple(sorted(content.adapters(self.root)))

    def family(self, case: str) -> str:
        """The subfolder of cases/ that a case lies in; a file beside them is its own family."""
        first = self.case_file(case).relative_to(self.root / "cases").parts[0]
        return content.name_of(Path(first))

    def case_file(self, name: str) -> Path:
        """The file of a case; raises ProjectError for an unknown name."""
        return _pick("case", name, content.cases(self.root))

    def adapter_files(self, name: str) -> tuple[Path, ...]:
        """The file of an adapter, or all files of its folder, decks and drivers included."""
        place = _pick("code", name, content.adapters(self.root))
        if place.is_file():
            return (place,)
        return tuple(
            p for p in sorted(place.rglob("*")) if p.is_file() and content.written(p, place)
        )

    def load_case(self, name: str) -> Case:
        """Import a case; raises ProjectError if its file fails or its CASE is not right."""
        file = self.case_file(name)
        case = imports.attribute(self.root, file, "CASE")
        if not isinstance(case, Case):
            raise ProjectError(
                f"{file}: CASE is a {type(case).__name__}; it must be a vv.case.Case"
            )
        _agree(file, "CASE", case.name, name)
        return case

    def load_adapter(self, name: str) -> Adapter:
        """Import an adapter; raises ProjectError if it fails or its ADAPTER is not right."""
        place = _pick("code", name, content.adapters(self.root))
        file = place if place.is_file() else place / "__init__.py"
        adapter: Adapter = imports.attribute(self.root, file, "ADAPTER")
        _agree(file, "ADAPTER", getattr(adapter, "name", None), name)
        return adapter

    def activate(self) -> None:
        """Make the content importable; raises ProjectError where a name of it is taken."""
        imports.activate(self.root)


def find(start: Path | None = None, chosen: str | Path | None = None) -> Project:
    """The project to work in.

    It is, in this order: `chosen`; what the environment's VV_PROJECT names; the nearest marked
    folder from `start` (the working directory) upwards; the content that came with this vv.
    A folder is marked by a file vv.toml or a table [tool.vv] in its pyproject.toml. Raises
    ProjectError if the folder so found has no packages cases and adapters.
    """
    named = chosen or os.environ.get("VV_PROJECT")
    if named:
        return _project(Path(named).expanduser().resolve())
    here = (start or Path.cwd()).resolve()
    for folder in (here, *here.parents):
        if _marked(folder):
            return _project(folder)
    return Project(imports.OWN, bundled=imports.OWN == imports.BUNDLE)


def _project(root: Path) -> Project:
    for name in REQUIRED:
        if not (root / name).is_file():
            raise ProjectError(f"{root} is no project: it has no {name}")
    return Project(root)


def _marked(folder: Path) -> bool:
    """Whether a folder says that it is a project; an unreadable file says so beside cases/."""
    settings = folder / "pyproject.toml"
    if (folder / "vv.toml").is_file():
        return True
    if not settings.is_file():
        return False
    try:
        return "vv" in tomllib.loads(settings.read_text(encoding="utf-8")).get("tool", {})
    except (OSError, ValueError) as error:
        if (folder / "cases").is_dir():
            raise ProjectError(f"{settings}: {error}") from error
        return False


def _pick(kind: str, name: str, known: dict[str, Path]) -> Path:
    if name not in known:
        raise ProjectError(f"no {kind} '{name}'{name_hint(name, known)}")
    return known[name]


def _agree(file: Path, attribute: str, given: object, name: str) -> None:
    if given != name:
        raise ProjectError(f"{file}: {attribute}.name = {given!r}; it must be {name!r}")
