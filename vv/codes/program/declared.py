"""Reads the TOML file that declares a program: its command, its version, its files, its schemes."""

from __future__ import annotations

import dataclasses
import enum
import functools
import shlex
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn, TypeVar, get_args

from vv.ask import Displacement, Knobs, Method, Observable
from vv.base.errors import UsageError
from vv.base.hints import name_hint
from vv.codes.adapter import Scheme
from vv.scene import Form, Term

Member = TypeVar("Member", bound=enum.Enum)
KINDS = {kind.__name__.lower(): kind for kind in get_args(Observable)}
KNOBS = tuple(field.name for field in dataclasses.fields(Knobs))
USUAL = frozenset({Displacement})  # what a program reports unless it says otherwise


@dataclass(frozen=True)
class Declared:
    """What a TOML file says of a program.

    command: the words that start it, paths of files beside the TOML made absolute. version: the
    words that print its version, or none. files: what its results depend on besides its command,
    the TOML included. install: what builds it, shown where it is missing.
    """

    file: Path
    name: str
    command: tuple[str, ...]
    version: tuple[str, ...]
    files: tuple[Path, ...]
    install: str
    schemes: tuple[Scheme, ...]


@dataclass(frozen=True)
class Entry:
    """A value of a TOML file and the name by which messages call it."""

    file: Path
    name: str
    value: Any

    def refuse(self, rule: str) -> NoReturn:
        """Raise UsageError that names the file, the entry, its value and the rule."""
        raise UsageError(f"{self.file}: {self.name} = {self.value!r:.80}; {rule}")

    def text(self) -> str:
        """A text."""
        return self.value if isinstance(self.value, str) else self.refuse("it must be a text")

    def texts(self) -> tuple[str, ...]:
        """A list of texts."""
        if not isinstance(self.value, list) or not all(isinstance(v, str) for v in self.value):
            self.refuse("it must be a list of texts")
        return tuple(self.value)

    def words(self) -> tuple[str, ...]:
        """A command: a list of texts, or a text as one types it in a shell."""
        try:
            words = tuple(shlex.split(self.value)) if isinstance(self.value, str) else self.texts()
        except ValueError as error:
            self.refuse(f"not a valid shell command: {error}")
        if any("\0" in word for word in words):
            self.refuse("it must hold no zero byte")
        return words or self.refuse("it must name a program")

    def table(self) -> Mapping[str, Entry]:
        """The entries of a table, each with its full name."""
        if not isinstance(self.value, dict):
            self.refuse("it must be a table")
        above = f"{self.name}." if self.name else ""
        return {key: Entry(self.file, f"{above}{key}", one) for key, one in self.value.items()}

    def one_of(self, known: Mapping[str, Member]) -> Member:
        """A text that stands for something known."""
        word = self.text()
        return known[word] if word in known else self.refuse(f"unknown{name_hint(word, known)}")

    def each_of(self, known: Mapping[str, Any]) -> tuple[Any, ...]:
        """A list of texts that stand for something known."""
        for number, word in enumerate(self.texts()):
            if word not in known:
                entry = Entry(self.file, f"{self.name}[{number}]", word)
                entry.refuse(f"unknown{name_hint(word, known)}")
        return tuple(known[word] for word in self.value)


def read(file: Path) -> Declared:
    """The program that a TOML file declares; raises UsageError naming the entry and the rule."""
    try:
        top = Entry(file, "", tomllib.loads(file.read_text(encoding="utf-8")))
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise UsageError(f"{file}: {reason}") from error
    given = _known(top, TOP, ("command", "scheme"))
    schemes = given["scheme"].table()
    if not schemes:
        given["scheme"].refuse("there must be a scheme, such as [scheme.default]")
    return Declared(
        file=file,
        name=file.stem.replace("_", "-"),
        command=_found_beside(file, given["command"].words()),
        version=_found_beside(file, given["version"].words()) if "version" in given else (),
        files=(file, *_files(given.get("files"))),
        install=given["install"].text() if "install" in given else "",
        schemes=tuple(_scheme(name, entry) for name, entry in schemes.items()),
    )


def words_of(kind: type[Member]) -> Mapping[str, Member]:
    """The members of an enum by the words that stand for them in files, such as wall-contact."""
    return {member.name.lower().replace("_", "-"): member for member in kind}


def _known(
    entry: Entry, allowed: Mapping[str, object], needed: tuple[str, ...]
) -> Mapping[str, Entry]:
    """The entries of a table; raises UsageError for one that there is not, or that is missing."""
    found = entry.table()
    for name, one in found.items():
        if name not in allowed:
            one.refuse(f"there is no such entry{name_hint(name, allowed)}")
    for name in needed:
        if name not in found:
            place = f"{entry.name}.{name}".lstrip(".")
            raise UsageError(f"{entry.file}: {place} is missing; {allowed[name]}")
    return found


def _found_beside(file: Path, words: tuple[str, ...]) -> tuple[str, ...]:
    """The words of a command; those that name a file beside the TOML, or a path, made absolute."""
    folder = file.resolve().parent
    first = str(folder / words[0]) if "/" in words[0] else words[0]
    return tuple(
        str(folder / word) if (folder / word).is_file() else word for word in (first, *words[1:])
    )


def _files(entry: Entry | None) -> tuple[Path, ...]:
    if entry is None:
        return ()
    found = tuple(entry.file.resolve().parent / name for name in entry.texts())
    for path in found:
        if not path.is_file():
            entry.refuse(f"there is no file {path}")
    return found


def _scheme(name: str, entry: Entry) -> Scheme:
    given = _known(entry, SCHEME, ("method", "terms"))
    read_as = {field: READERS[field](one) for field, one in given.items()}
    fields = {NAMES.get(field, field): value for field, value in read_as.items()}
    observables = fields.pop("observables", USUAL)
    summary = fields.pop("summary", f"the program {entry.file.name}")
    try:
        return Scheme(name=name, summary=summary, observables=observables, **fields)
    except ValueError as error:
        raise UsageError(f"{entry.file}: {entry.name}: {error}") from error


def _lowered(entry: Entry) -> dict[Term, Method]:
    methods = words_of(Method)
    return {_term(one): one.one_of(methods) for one in entry.table().values()}


def _why_not(entry: Entry) -> dict[Term, str]:
    return {_term(one): one.text() for one in entry.table().values()}


def _term(entry: Entry) -> Term:
    """The term that the key of an entry names."""
    word = entry.name.rpartition(".")[2]
    return Entry(entry.file, f"a key of {entry.name.rpartition('.')[0]}", word).one_of(
        words_of(Term)
    )


def _pace(entry: Entry) -> tuple[float, float]:
    pair = entry.value
    if not (isinstance(pair, list) and len(pair) == 2 and all(_is_time(one) for one in pair)):
        entry.refuse("it must be [CPU seconds of a step, and besides for each body]")
    return float(pair[0]), float(pair[1])


def _is_time(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and 0 <= value < 1e9


def _each(known: Callable[[], Mapping[str, Any]]) -> Callable[[Entry], frozenset[Any]]:
    return lambda entry: frozenset(entry.each_of(known()))


TOP = {
    "command": "the words that start the program",
    "version": "the words that print its version",
    "files": "the files that its results depend on",
    "install": "how to build or install it",
    "scheme": "what it can do: a table such as [scheme.default]",
}
SCHEME = {
    "summary": "what it does, in words",
    "method": "its class of method, such as second-order",
    "terms": "the physical effects that it has, such as sphere and wall-contact",
    "knobs": "its numerical parameters: dt, kn or both",
    "observables": "what it reports of a body, such as displacement",
    "energies": "the forms of energy that it can report over time",
    "lowered": "terms in whose presence it is of another class of method",
    "why-not": "why it lacks a term",
    "pace": "CPU seconds of a step, and besides for each body",
}
READERS: Mapping[str, Callable[[Entry], Any]] = {
    "summary": Entry.text,
    "method": lambda entry: entry.one_of(words_of(Method)),
    "terms": _each(functools.partial(words_of, Term)),
    "knobs": lambda entry: entry.each_of({knob: knob for knob in KNOBS}),
    "observables": _each(lambda: KINDS),
    "energies": _each(functools.partial(words_of, Form)),
    "lowered": _lowered,
    "why-not": _why_not,
    "pace": _pace,
}
NAMES = {"why-not": "why_not"}
