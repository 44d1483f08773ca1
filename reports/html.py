"""Writes the report of an invocation: one HTML file that needs nothing but itself."""

from __future__ import annotations

import dataclasses
import functools
import hashlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from reports.charts import Chart
from reports.gallery import Draw
from reports.maps import HeatMap
from reports.views import Page
from vv.base import closure
from vv.base.files import write_output
from vv.base.printable import printable
from vv.insight import history as histories
from vv.insight.history import Point
from vv.output.terminal import note
from vv.records import codec
from vv.records.manifest import Manifest
from vv.store.store import Store

HERE = Path(__file__).parent
TOOL = Path(closure.__file__).parents[2]  # below which the modules that a report leans on lie
HEAD = 4096  # characters within which a report names the digest of its inputs


def build(manifest: Manifest, store: Store, output: Path) -> Path:
    """Write the report of a manifest (with its `name`) to `output`, and return that path.

    Reads the manifest, and the series of its records through the store. A file that was made
    from the same results by the same sources is left as it is: another invocation that was
    answered by them, at another time, has the same report.
    """
    return _built(manifest, store, output, drawing=_all_drawn)


def build_quickly(manifest: Manifest, store: Store, output: Path) -> Path:
    """As `build`, but with those figures only that were drawn before: drawing costs seconds."""
    return _built(manifest, store, output, drawing=_none_drawn)


def _all_drawn(view: Callable[[Draw], Page], folder: Path) -> None:
    """Draw what the view shows and the folder lacks."""
    from reports.figures import draw_missing

    shown: list[Chart | HeatMap] = []

    def collect(chart: Chart | HeatMap) -> str:
        shown.append(chart)
        return ""

    view(collect)
    draw_missing(shown, folder)


def _none_drawn(view: Callable[[Draw], Page], folder: Path) -> None:
    """Draw nothing."""


def _built(
    manifest: Manifest,
    store: Store,
    output: Path,
    drawing: Callable[[Callable[[Draw], Page], Path], None],
) -> Path:
    past = histories.histories(store, manifest.cases, {manifest.name: manifest}, note)
    stamp = _stamp(manifest, past, drawing.__name__)
    if _stamp_of(output) != stamp:
        from reports.figures import drawn_before
        from reports.page import page

        folder, series = store.root / "figures", functools.cache(store.series)
        drawing(lambda draw: page(manifest, series, draw, past, stamp), folder)
        view = page(manifest, series, functools.partial(drawn_before, folder=folder), past, stamp)
        write_output(output, printable(str(_template().render(page=view))).encode())
    return output


@functools.cache
def _template() -> Any:
    """The page's template: text is escaped, a misspelt name is an error.

    It is compiled anew, in a tenth of a second: bytecode kept in a store would be run from there.
    """
    import jinja2

    from reports import pieces, text

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    for name in (text.sci, text.brief, text.short, text.ratio, text.slug, text.known_columns):
        environment.filters[name.__name__] = name
    for piece in (pieces.glyph, pieces.tag, pieces.numbers):
        environment.globals[piece.__name__] = piece
    return environment.get_template("report.html.j2")


def _stamp(manifest: Manifest, past: Mapping[str, Sequence[Point]], drawing: str) -> str:
    """Digest of all a report shows but the time and the name of the invocation."""
    circumstances = dataclasses.replace(manifest.provenance, utc="")
    names = ("cases", "records", "findings", "baselines", "recorded")
    parts = [getattr(manifest, name) for name in names]
    before = [
        (case, point.name, point.closeness, point.cost, point.outcomes)
        for case, points in past.items()
        for point in points
    ]
    text = codec.render((circumstances, parts, before), sort_keys=True)
    return hashlib.sha256(f"{_sources()}{drawing}{text}".encode()).hexdigest()


def _stamp_of(output: Path) -> str:
    """The digest that a report names in its head; empty if there is none."""
    try:
        with output.open(encoding="utf-8") as file:
            head = file.read(HEAD)
    except (OSError, UnicodeDecodeError):
        return ""
    _, found, rest = head.partition('<meta name="vv-inputs" content="')
    return rest[:64] if found else ""


@functools.cache
def _sources() -> str:
    """Digest of the sources that decide how a report looks."""
    own = [p for p in HERE.rglob("*") if p.suffix in (".py", ".j2", ".css")]
    return closure.source_digest(closure.import_closure(own, (HERE.parent, TOOL)))
