"""Writes the report of an invocation as a folder of pages that needs no other files."""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import itertools
import json
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from reports.beside import NOTHING, Beside
from reports.book import Book
from vv.base import closure
from vv.base.files import read_whole, write_output, write_whole
from vv.base.parallel import parallel_map
from vv.base.printable import printable
from vv.insight import history as histories
from vv.insight.history import Point
from vv.output.terminal import note
from vv.records import codec
from vv.records.manifest import Manifest
from vv.store.store import Store

HERE = Path(__file__).parent
TOOL = Path(closure.__file__).parents[2]  # the folder of the modules that a report depends on
FRONT = "index.html"
PAPERS = "papers.html"
INPUTS = "inputs.js"
ZOOM = "uplot.js"
MEASURED = "measured.html"
OWN = re.compile(r"[\w-]+\.(html|csv|css|js)")  # the names of files of a report
STAMPS = "stamps.json"  # name of a file -> digests of its inputs and of the file
Stamps = Mapping[str, list[str]]


@dataclass(frozen=True)
class File:
    """A file of the report. made_from: digest of all that it shows; write: creates its content."""

    name: str
    made_from: str
    write: Callable[[], str]


def build(manifest: Manifest, store: Store, folder: Path, beside: Beside = NOTHING) -> Path:
    """Write the report of a manifest (with its `name`) into a folder; returns its front page.

    Reads the manifest, and the series of its records through the store. A page that was made from
    the same results by the same sources, and was not changed since, is kept.
    """
    book = _book(manifest, store, beside)
    folder.mkdir(parents=True, exist_ok=True)
    before = _stamps(folder)
    *files, front = _files(book, store.manifests.digests_of(manifest.name))
    named = itertools.groupby(files, key=lambda file: Path(file.name).stem)
    piles = [list(pile) for _, pile in named]  # per case, as its page and its table share series
    write = functools.partial(_written, folder, before)
    done = [*parallel_map(write, piles, len(os.sched_getaffinity(0))), write([front])]
    now = {name: kept for stamps in done for name, kept in stamps.items()}
    for name in before.keys() - now.keys():
        (folder / Path(name).name).unlink(missing_ok=True)
    if now != before:
        write_whole(folder / STAMPS, json.dumps(now, indent=0).encode())
    return folder / FRONT


def _written(folder: Path, before: Stamps, files: Sequence[File]) -> dict[str, list[str]]:
    """Write the files whose inputs have changed; returns the stamps of all of them."""
    now = {}
    for file in files:
        path, kept = folder / file.name, before.get(file.name)
        if kept is None or kept != [file.made_from, _digest_of(path)]:
            content = printable(file.write()).encode()
            write_whole(path, content)
            kept = [file.made_from, hashlib.sha256(content).hexdigest()]
        now[file.name] = kept
    return now


def build_single(
    manifest: Manifest,
    store: Store,
    cases: Sequence[str],
    output: Path,
    beside: Beside = NOTHING,
) -> Path:
    """Write the report of some cases of a manifest as one file; returns its path."""
    from reports.environment import whole_page

    kept = {name: facts for name, facts in manifest.cases.items() if name in cases}
    part = dataclasses.replace(
        manifest,
        cases=kept,
        records=tuple(r for r in manifest.records if r.case in kept),
        findings=tuple(f for f in manifest.findings if f.case in kept),
        recorded=tuple(r for r in manifest.recorded if r.case in kept),
    )
    book = dataclasses.replace(_book(part, store, beside), whole=True)
    write_output(output, printable(whole_page(book)).encode())
    return output


def _book(manifest: Manifest, store: Store, beside: Beside) -> Book:
    past = histories.histories(store, manifest.cases, {manifest.name: manifest}, note)
    return Book(manifest, store.series_of(manifest.records), past, beside=beside)


def _files(book: Book, known: Mapping[str, str]) -> Iterator[File]:
    """All files of a report; the front page is last, so that all its links work once it exists.

    known: case -> digest of its records, for records in the store.
    """
    from reports import environment as env
    from reports import library
    from reports.variant.inputs import heads

    looks = _digest((library.script(), library.style()))
    yield File("report.css", looks, env.style)
    yield File("report.js", looks, env.script)
    if library.script():
        yield File(ZOOM, looks, library.script)
    yield File(INPUTS, _digest(heads(book)), functools.partial(env.inputs_script, book))
    of_cases = {case: _of_case(book, case, known.get(case)) for case in book.manifest.cases}
    for case, made_from in of_cases.items():
        name = book.page_of(case)
        yield File(name, made_from, functools.partial(env.case_page, book, case))
        yield File(
            f"{name.removesuffix('html')}csv",
            made_from,
            functools.partial(env.case_csv, book, case),
        )
    all_of_it = _of_all(book, [*of_cases.values()])
    for code in env.codes(book):
        yield File(book.page_of_code(code), all_of_it, functools.partial(env.code_page, book, code))
    if book.beside.papers:
        yield File(PAPERS, _of_papers(book), functools.partial(env.papers_page, book))
    if book.has_measurements:
        yield File(MEASURED, all_of_it, functools.partial(env.measured_page, book))
    yield File("attention.html", all_of_it, functools.partial(env.attention_page, book))
    yield File(FRONT, all_of_it, functools.partial(env.front_page, book))


def _of_case(book: Book, case: str, records: str | None) -> str:
    """The digest of all data that the page of a case shows; records: of its records, if known."""
    from reports.variant.inputs import heads

    whole = book.manifest
    past = [_without_time(point) for point in book.past.get(case, ())]
    parts = (
        whole.cases[case],
        records or book.of_case[case],
        [f for f in whole.findings if f.case == case],
        whole.baselines.get(case),
        [r for r in whole.recorded if r.case == case],
        past,
        sorted(whole.external()),
        bool(book.beside.papers),
        heads(book),
    )
    return _digest(parts)


def _of_all(book: Book, of_cases: Sequence[str]) -> str:
    """The digest of all data that other pages show, except the time and name of the invocation.

    Invocations with the same results have the same report.
    """
    circumstances = dataclasses.replace(book.manifest.provenance, utc="")
    return _digest((circumstances, of_cases, book.manifest.findings, bool(book.beside.papers)))


def _of_papers(book: Book) -> str:
    """The digest of all data that the page of the papers shows."""
    parts = [(p.name, p.citation, p.doi, rows) for p, rows in book.beside.papers]
    return _digest((parts, [*book.marks], book.places))


def _without_time(point: Point) -> tuple[object, ...]:
    return point.name, point.closeness, point.cost, point.outcomes


def _digest(parts: object) -> str:
    text = codec.render(parts, sort_keys=True)
    return hashlib.sha256(f"{sources()}{text}".encode()).hexdigest()


def _stamps(folder: Path) -> Stamps:
    """The stamps of the files of a report; empty if they cannot be read."""
    try:
        found = codec.parse(read_whole(folder / STAMPS).decode())
    except (OSError, ValueError):
        return {}
    return {n: kept for n, kept in found.items() if OWN.fullmatch(n)} if type(found) is dict else {}


def _digest_of(path: Path) -> str:
    try:
        return hashlib.sha256(read_whole(path)).hexdigest()
    except OSError:
        return ""


@functools.cache
def sources() -> str:
    """The digest of the sources of reports."""
    own = [p for p in HERE.rglob("*") if p.suffix in (".py", ".j2", ".css", ".js")]
    return closure.source_digest(closure.import_closure(own, (HERE.parent, TOOL)))
