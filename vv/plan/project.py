"""Finds the project: where its cases and adapters lie, and how each is loaded by its name."""

from __future__ import annotations

import functools
import os
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import vv
from vv.base.hints import name_hint
from vv.case import Case
from vv.codes.adapter import Adapter
from vv.plan import content, imports
from vv.plan.content import ProjectError

PROGRAMS = Path(vv.__file__).parent / "codes" / "program" / "__init__.py"  # what runs programs
REQUIRED = ("adapters/__init__.py", "cases/__init__.py")


@dataclass(frozen=True)
class Project:
    """A folder of cases and adapters; bundled: it came with the installed package.

    What came with vv is added to it, unless its settings say that it stands alone. Nothing is
    imported to list names. A name has `-` where its file has `_`. programs: TOML files elsewhere
    that declare further codes.
    """

    root: Path
    bundled: bool = False
    programs: tuple[Path, ...] = ()

    @functools.cached_property
    def roots(self) -> tuple[Path, ...]:
        """The folders of its content: its own, and that which came with this vv if it is added."""
        alone = self.root == imports.OWN or (content.settings(self.root) or {}).get("alone")
        return (self.root,) if alone else (self.root, imports.OWN)

    def data(self) -> Path:
        """The folder of results and reports: VV_DATA, or .vv; never inside an installed package."""
        if chosen := os.environ.get("VV_DATA"):
            return Path(chosen).resolve()
        return (Path.cwd() if self.bundled else self.root) / ".vv"

    def case_names(self) -> tuple[str, ...]:
        """The names of all cases, sorted."""
        return tuple(sorted(content.cases(self.roots)))

    def adapter_names(self) -> tuple[str, ...]:
        """The names of all codes that have an adapter, sorted."""
        return tuple(sorted(self._codes()))

    def family(self, case: str) -> str:
        """The subfolder of cases/ that a case lies in; a file beside them is its own family."""
        return self._family(self.case_file(case))

    def families(self) -> dict[str, str]:
        """The family of every case, by the cases' names, sorted."""
        found = content.cases(self.roots)
        return {name: self._family(found[name]) for name in sorted(found)}

    def _family(self, file: Path) -> str:
        within = content.home(file, (root / "cases" for root in self.roots))
        return content.name_of(Path(file.relative_to(within).parts[0]))

    def case_files(self) -> dict[str, Path]:
        """The file of every case by its name; the folders are searched once for all."""
        return content.cases(self.roots)

    def case_file(self, name: str) -> Path:
        """The file of a case; raises ProjectError for an unknown name."""
        return _pick("case", name, content.cases(self.roots))

    def with_programs(self, files: Iterable[Path]) -> Project:
        """The same project with codes that TOML files elsewhere declare."""
        added = (*self.programs, *(file.resolve() for file in files))
        return replace(self, programs=tuple(dict.fromkeys(added)))

    def adapter_files(self, name: str) -> tuple[Path, ...]:
        """The file of an adapter, or all files of its folder, decks and drivers included."""
        place = _pick("code", name, self._codes())
        if place.suffix == content.PROGRAM:
            return (place, PROGRAMS)
        if place.is_file():
            return (place,)
        return tuple(
            p for p in sorted(place.rglob("*")) if p.is_file() and content.written(p, place)
        )

    def load_case(self, name: str) -> Case:
        """Import a case; raises ProjectError if its file fails or its CASE is not right."""
        (case,) = self.load_cases([name])
        return case

    def load_cases(self, names: Iterable[str]) -> list[Case]:
        """As `load_case`, several at once: the folders are searched once for all."""
        known = content.cases(self.roots)
        return [self._load(_pick("case", name, known), name) for name in names]

    def _load(self, file: Path, name: str) -> Case:
        case = imports.attribute(self.roots, file, "CASE")
        if not isinstance(case, Case):
            raise ProjectError(
                f"{file}: CASE is of type {type(case).__name__}; it must be a vv.case.Case"
            )
        _agree(file, "CASE", case.name, name)
        return case

    def load_adapter(self, name: str) -> Adapter:
        """Import an adapter; raises ProjectError if it fails or its ADAPTER is not right."""
        place = _pick("code", name, self._codes())
        if place.suffix == content.PROGRAM:
            return load_program(place)
        file = place if place.is_file() else place / "__init__.py"
        adapter: Adapter = imports.attribute(self.roots, file, "ADAPTER")
        _agree(file, "ADAPTER", getattr(adapter, "name", None), name)
        return adapter

    def _codes(self) -> dict[str, Path]:
        return content.adapters(self.roots, self.programs)

    def activate(self) -> None:
        """Make the content importable; raises ProjectError where a name of it is taken."""
        imports.activate(self.roots)


def load_program(file: Path) -> Adapter:
    """The code that a TOML file declares; raises UsageError naming the entry and the rule."""
    from vv.codes import program

    return program.load(file)


def find(start: Path | None = None, chosen: str | Path | None = None) -> Project:
    """The project to work in.

    It is, in this order: `chosen`; what the environment's VV_PROJECT names; the nearest marked
    folder from `start` (the working directory) upwards; the content that came with this vv.
    A folder is marked by a file vv.toml or a table [tool.vv] in its pyproject.toml. Raises
    ProjectError if the folder so found has neither cases nor adapters, or stands alone and lacks
    the package of either.
    """
    named = chosen or os.environ.get("VV_PROJECT")
    if named:
        return _project(Path(named).expanduser().resolve())
    here = (start or Path.cwd()).resolve()
    for folder in (here, *here.parents):
        if content.settings(folder) is not None:
            return _project(folder)
    return Project(imports.OWN, bundled=imports.OWN == imports.BUNDLE)


def _project(root: Path) -> Project:
    project = Project(root)
    if project.roots == (root,):
        lacking = [name for name in REQUIRED if not (root / name).is_file()]
        if lacking:
            raise ProjectError(f"{root} is not a project: it has no {lacking[0]}")
    elif not any((root / Path(name).parent).is_dir() for name in REQUIRED):
        raise ProjectError(
            f"{root} is not a project: it has neither cases/ nor adapters/; make one of them"
        )
    return project


def _pick(kind: str, name: str, known: dict[str, Path]) -> Path:
    if name not in known:
        raise ProjectError(f"no {kind} '{name}'{name_hint(name, known)}")
    return known[name]


def _agree(file: Path, attribute: str, given: object, name: str) -> None:
    if given != name:
        raise ProjectError(f"{file}: {attribute}.name = {given!r}; it must be {name!r}")
