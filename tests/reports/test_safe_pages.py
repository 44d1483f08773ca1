"""Claims about pages of any content: hostile, empty, single, and without the network."""

from __future__ import annotations

import dataclasses
import re
import subprocess
import sys
from pathlib import Path

from reports import html
from reports.beside import Beside
from tests.support.built_report import CASE, pages
from tests.support.fabricated import (
    STEPS,
    case,
    changed,
    record,
    requantified,
    with_external,
)
from tests.support.fabricated import manifest as manifest_of
from tests.support.html_tags import Tags
from vv.records.manifest import Manifest
from vv.store.store import Store

HOSTILE = (
    "</td></script><script>alert('x')</script><img src=http://bad.example/x onerror=run()>&$^_{"
)


def test_nothing_is_fetched_and_every_link_leads_somewhere(
    manifest: Manifest, store: Store
) -> None:
    made = pages(manifest, store)
    read = {name: Tags(page) for name, page in made.items() if name.endswith(".html")}
    assert {"index.html", "attention.html", "code-fate.html", CASE} <= read.keys()
    ids = {name: list(tags.all("id")) for name, tags in read.items()}
    for name, tags in read.items():
        assert len(ids[name]) == len(set(ids[name])), name
        assert not {tag for tag, _ in tags.tags} & {"img", "iframe", "object"}
        assert set(tags.all("src")) == {"report.js"}
        for target in tags.all("href"):
            page, _, anchor = target.partition("#")
            if target != "https://doi.org/10.1/(x)":
                assert not page or page in made, target
                assert not anchor or anchor in ids[page or name], target
        assert re.findall(r"url\((?!#)|@import|://(?!doi\.org/10\.1/)", made[name]) == []
    assert re.findall(r"url\(|@import|https?:", made["report.css"]) == []
    assert re.findall(r"fetch\(|XMLHttp|https?:", made["report.js"]) == ["http:"]  # names SVG


def hostile(manifest: Manifest) -> Manifest:
    """The manifest with a hostile text in place of every text."""
    (facts,) = manifest.cases.values()
    variants = {
        name + HOSTILE: changed(
            said,
            summary=HOSTILE,
            formula=HOSTILE,
            quantities=[changed(one, unit=HOSTILE, symbol=HOSTILE) for one in said.quantities],
        )
        for name, said in facts.variants.items()
    }
    source = changed(facts.source, note=HOSTILE)
    published = {"Fig. 4": HOSTILE}
    prose = changed(facts, title=HOSTILE, published=published, source=source, variants=variants)
    records = tuple(
        changed(
            requantified(one, note=HOSTILE),
            variant=one.variant + HOSTILE,
            scheme=one.scheme + HOSTILE,
            reason=HOSTILE,
            code_version=HOSTILE,
            model=one.model and changed(one.model, note=HOSTILE),
        )
        for one in manifest.records
    )
    return dataclasses.replace(
        manifest,
        provenance=changed(manifest.provenance, command=HOSTILE),
        cases={"bounce": prose},
        records=records,
    )


def test_hostile_text_stays_text(manifest: Manifest, store: Store) -> None:
    folder = store.root / "report"
    given = with_external(hostile(manifest), "other")
    html.build(given, store, folder, Beside(native=lambda record: HOSTILE))
    made = {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}
    single = html.build_single(hostile(manifest), store, ["bounce"], store.root / "one.html")
    for name, page in [*made.items(), ("one.html", single.read_text(encoding="utf-8"))]:
        if name.endswith(".html"):
            tags = Tags(page)
            assert not {tag for tag, _ in tags.tags} & {"img"}, name
            assert not list(tags.all("onerror")), name
            assert "<script>alert" not in page, name
    assert not [name for name in made if "/" in name or "<" in name]


def test_importing_the_report_costs_no_templates() -> None:
    code = "import reports.html, sys; assert not {'matplotlib', 'jinja2'} & set(sys.modules)"
    root = Path(html.__file__).parents[1]
    subprocess.run([sys.executable, "-c", code], check=True, cwd=root)


def test_an_empty_run_and_one_of_failures_only_have_pages(store: Store) -> None:
    empty = pages(manifest_of(), store)["index.html"]
    assert "Nothing was run" in empty
    assert not any(f'id="{name}"' in empty for name in ("which", "map"))  # they would be empty
    failed = [record("a/b", "T1", dt, status="error", reason="boom") for dt in STEPS]
    made = pages(manifest_of(*failed), store)
    assert "boom" in made["attention.html"]
    assert "boom" in made[CASE]


def test_one_file_holds_a_selection_and_needs_nothing_else(
    manifest: Manifest, store: Store
) -> None:
    two = dataclasses.replace(manifest, cases={**manifest.cases, "other": case()})
    output = store.root / "one.html"
    text = html.build_single(two, store, ["bounce"], output).read_text(encoding="utf-8")
    tags = Tags(text)
    ids = list(tags.all("id"))
    assert len(ids) == len(set(ids))
    assert not list(tags.all("src"))
    targets = [target for target in tags.all("href") if not target.startswith("https://doi.org")]
    assert all(target.startswith("#") and target[1:] in ids for target in targets)
    assert "other" not in {ids_part.partition("--")[0] for ids_part in ids}
