"""Fills the templates of pages; text is escaped, and unknown names are errors."""

from __future__ import annotations

import csv
import functools
import io
import json
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup, escape

from reports import library, text
from reports.book import Book
from reports.formula import typeset
from reports.looks import defined, glyph, palette
from reports.norms import NORM_NAMES
from reports.outcomes import WORST_FIRST, ShownOutcome
from reports.pages import code as codes_page
from reports.pages.case import case
from reports.pages.findings import findings, refused
from reports.pages.front import front
from reports.pages.measured import measured, together
from reports.pages.overview import overview
from reports.pages.papers import papers
from reports.pages.steadiness import sections
from reports.pages.troubles import troubles
from reports.settings_table import setting_rows
from reports.variant.inputs import heads
from reports.variant.ranking import ranks
from vv.base.private_folder import cache_root
from vv.output import table
from vv.output.wording import in_words
from vv.records.finding import Change, worst_first
from vv.records.outcomes import Outcome
from vv.records.reading import tried

HERE = Path(__file__).parent
LOOKS = "<!-- looks -->"  # in a template: the place of the definitions of marks
COLUMNS = (  # columns of the table of a case; `vv report --csv` writes more
    "variant", "code", "scheme", "dt", "kn", "reason", "steps", "timed", "solve_cpu",
    "quantity", "unit", "value", "reference", "error", "norm", "tolerance", "verdict", "note",
)  # fmt: skip
DIGITS = {  # all other numbers have seven digits
    "dt": ".6g", "kn": ".6g", "solve_cpu": ".3g", "error": ".4g", "tolerance": ".4g",
}  # fmt: skip
FILTERS = (
    text.sci,
    text.brief,
    text.short,
    text.ratio,
    text.seconds,
    text.slug,
    text.known_columns,
    text.with_unit,
    text.alike,
    text.sort_key,
    text.within,
    text.unbroken,
    in_words,
    typeset,
)


@functools.cache
def _templates() -> jinja2.Environment:
    """Compiled templates lie where kernels do: in a store, bytecode of others would be run."""
    environment = jinja2.Environment(
        bytecode_cache=_compiled(),
        loader=jinja2.FileSystemLoader(HERE / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {name.__name__: name for name in FILTERS}
    environment.globals |= {
        "glyph": glyph,
        "tag": tag,
        "setting_rows": setting_rows,
        "norms": {name: norm.value for norm, name in NORM_NAMES.items()},
        "legend": WORST_FIRST[::-1],
    }
    return environment


def _compiled() -> jinja2.BytecodeCache | None:
    """The private folder of compiled templates; None without one."""
    try:
        return jinja2.FileSystemBytecodeCache(str(cache_root("templates")))
    except OSError:
        return None


def _page(template: str, book: Book, **parts: Any) -> str:
    text = _templates().get_template(template).render(book=book, **parts)
    return text.replace(LOOKS, defined(text, book.marks.values()), 1)


def front_page(book: Book) -> str:
    """index.html"""
    return _page("front.html.j2", book, front=front(book))


def case_page(book: Book, name: str) -> str:
    """case-NAME.html"""
    return _page("case.html.j2", book, case=case(book, name))


def code_page(book: Book, name: str) -> str:
    """code-NAME.html"""
    return _page("code.html.j2", book, code=_code(book, name), overview=_of_codes(book)[0])


def attention_page(book: Book) -> str:
    """attention.html: failures, known failures, changes, refusals; stability; glossary."""
    return _page("attention.html.j2", book, **_attention(book))


def papers_page(book: Book) -> str:
    """papers.html: the published statements and their assessments."""
    return _page("papers.html.j2", book, papers=papers(book))


def measured_page(book: Book) -> str:
    """measured.html: computed values compared with measured ones."""
    return _page("measured.html.j2", book, measured=measured(book), together=together(book))


def whole_page(book: Book) -> str:
    """All pages of a selection as one."""
    return _page(
        "whole.html.j2",
        book,
        front=front(book),
        cases=[case(book, name) for name in book.manifest.cases],
        codes=[_code(book, name) for name in codes(book)],
        overview=_of_codes(book)[0],
        papers=papers(book),
        measured=measured(book),
        together=together(book),
        style=Markup(style()),
        script=Markup(script()),
        library=Markup(library.script()),
        **_attention(book),
    )


def style() -> str:
    """report.css"""
    return palette() + library.style() + _asset("report.css")


def script() -> str:
    """report.js"""
    return _asset("report.js") + (_asset("zoom.js") if library.script() else "")


def _asset(name: str) -> str:
    return (HERE / "assets" / name).read_text(encoding="utf-8")


def inputs_script(book: Book) -> str:
    """inputs.js: the common beginnings of the inputs of codes, loaded when one is copied."""
    return f"globalThis.vvInputs = {json.dumps(heads(book), sort_keys=True)};\n"


def _attention(book: Book) -> dict[str, Any]:
    moved = [f for f in worst_first(book.manifest.findings) if f.compares]
    without = [f for f in moved if f.kind == Change.NEW.value and not f.red]
    return {
        "troubles": troubles(book),
        "trouble": findings(book, ("bad", "odd")),
        "known": findings(book, ("known",)),
        "idle": findings(book, ("idle",), {Outcome.REFUSED}),
        "refused": refused(book),
        "without": list(dict.fromkeys(f.case for f in without)),
        "unheld": len(without),
        "moved": [f for f in moved if f.kind != Change.NEW.value or f.red],
        "stability": sections(book),
    }


def codes(book: Book) -> list[str]:
    """The codes that have a page."""
    return list(dict.fromkeys(mark.code for mark in book.marks.values()))


def _code(book: Book, name: str) -> codes_page.Code:
    return codes_page.code(book, name, *_of_codes(book))


@functools.lru_cache(maxsize=1)
def _of_codes(book: Book) -> tuple[Any, Any]:
    """The data that all pages of codes share."""
    return overview(book), ranks(book)


def case_csv(book: Book, name: str) -> str:
    """case-NAME.csv: a row for each quantity of each record that a code supports."""
    own = filter(tried, book.of_case[name])
    target = io.StringIO()
    writer = csv.writer(target, lineterminator="\n")
    writer.writerow(COLUMNS)
    for record in own:
        timed = "yes" if record.cost.timed else ""
        for row in table.rows(record):
            row["timed"] = timed
            row["verdict"] = row["verdict"] or row["status"]
            writer.writerow([_brief(column, row[column]) for column in COLUMNS])
    return target.getvalue()


def _brief(column: str, value: Any) -> Any:
    """A number to its meaningful digits; other values unchanged."""
    return f"{value:{DIGITS.get(column, '.7g')}}" if isinstance(value, float) else value


@functools.cache
def tag(outcome: ShownOutcome, count: int | None = None, quiet: bool = False) -> Markup:
    """An outcome as symbol and word, with the number of its records.

    quiet: it does not turn the gate red.
    """
    many = "" if count is None else f" {escape(count)}"
    look = "known" if quiet and outcome.troubling else outcome.look
    only = ", reported only" if quiet and outcome.troubling else ""
    return Markup(
        f'<span class="tag {escape(look)}">{escape(outcome.symbol)} {escape(outcome.word)}'
        f"{many}{only}</span>"
    )
