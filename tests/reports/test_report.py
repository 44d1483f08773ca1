"""Claims about the report: it says all there is, fetches nothing, and is not made twice."""

from __future__ import annotations

import dataclasses
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from reports import figures, html, tables
from reports.outcomes import OUTCOMES, WORST_FIRST, shown_outcome
from tests.support.fabricated import (
    STEPS,
    case,
    changed,
    entry,
    manifest_of_all,
    ran,
    requantified,
)
from tests.support.html_tags import Tags
from vv.ask import Status
from vv.records.accepted import AcceptanceSummary, BaselineSummary, Place
from vv.records.finding import Aspect, Bit, Finding
from vv.records.manifest import Manifest
from vv.records.outcomes import Outcome, Verdict
from vv.records.recorded import RecordedQuantity, RecordedResult
from vv.store.store import Store

HOSTILE = "</td><script>alert('x')</script><img src=http://bad.example/x onerror=run()>&$^_{"


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / ".vv")


@pytest.fixture
def manifest(store: Store) -> Manifest:
    return manifest_of_all(store)


@pytest.fixture
def sketched(monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures without content, for tests that do not look at them."""
    monkeypatch.setattr(figures, "draw", lambda chart, salt: "<svg></svg>")


PROFILES = 3  # figures over all variants: one for each error that somebody gets below


def built(manifest: Manifest, store: Store) -> str:
    output = store.root / "report.html"
    assert html.build(manifest, store, output) == output
    return output.read_text(encoding="utf-8")


@pytest.mark.usefixtures("sketched")
def test_every_outcome_of_every_record_is_in_its_cell_with_a_symbol(
    manifest: Manifest, store: Store
) -> None:
    cells = Tags(built(manifest, store)).cells
    seen = set()
    for made in manifest.records:
        outcome = shown_outcome(made)
        seen.add(outcome.key)
        assert f"{outcome.symbol} {outcome.word}" in cells[tables.anchor(made)]
    assert seen == set(OUTCOMES)


def test_every_status_and_verdict_has_an_outcome_told_apart_without_colour() -> None:
    words = {status.value for status in Status} - {"ran"} | {verdict.value for verdict in Verdict}
    assert words <= {outcome.value for outcome in OUTCOMES}
    assert set(OUTCOMES) == set(Outcome)
    assert len({known.symbol for known in WORST_FIRST}) == len(WORST_FIRST)
    assert len({known.word for known in WORST_FIRST}) == len(WORST_FIRST)


@pytest.mark.usefixtures("sketched")
def test_one_failing_rung_marks_its_cell(manifest: Manifest, store: Store) -> None:
    good = next(r for r in manifest.records if r.code == "dem" and r.rung.dt == 2e-3)
    bad = requantified(good, verdict="fail")
    records = tuple(bad if r is good else r for r in manifest.records)
    page = built(dataclasses.replace(manifest, records=records), store)
    cell = Tags(page).cells[tables.anchor(good)]
    assert "✗ fail 1" in cell
    assert "✓ pass 2" in cell


def test_nothing_is_fetched_and_every_link_leads_somewhere(
    manifest: Manifest, store: Store
) -> None:
    page = built(manifest, store)
    tags = Tags(page)
    ids = list(tags.all("id"))
    assert len(ids) == len(set(ids))
    assert not {tag for tag, _ in tags.tags} & {"script", "img", "link", "iframe", "object"}
    assert not list(tags.all("src"))
    for target in tags.all("href"):
        assert target == "https://doi.org/10.1/(x)" or target[1:] in ids, target
    assert re.findall(r"url\((?!#)|@import", page) == []
    assert set(re.findall(r"url\(#([^)]*)\)", page)) <= set(ids)


def test_a_figure_that_was_planted_in_the_store_is_not_shown(
    manifest: Manifest, store: Store, capsys: pytest.CaptureFixture[str]
) -> None:
    page = built(manifest, store)
    assert "not drawn yet" not in page  # so all that we draw are drawings
    kept = sorted((store.root / "figures").glob("*.svg"))
    assert kept
    for path in kept:
        path.write_text(path.read_text().replace("</svg>", "<script>alert(1)</script></svg>"))
    (store.root / "report.html").unlink()
    html.build_quickly(manifest, store, store.root / "report.html")
    tags = Tags((store.root / "report.html").read_text(encoding="utf-8"))
    assert not {tag for tag, _ in tags.tags} & {"script"}
    assert "no drawing of ours" in capsys.readouterr().err
    assert not list((store.root / "figures").glob("*.svg"))
    kept[0].write_text("<svg><script/></svg>")
    assert "not drawn yet" not in built(manifest, store)


def test_hostile_text_stays_text(manifest: Manifest, store: Store) -> None:
    (facts,) = manifest.cases.values()
    variants = {
        name: changed(
            said,
            summary=HOSTILE,
            formula=HOSTILE,
            quantities=[changed(one, unit=HOSTILE) for one in said.quantities],
        )
        for name, said in facts.variants.items()
    }
    source = changed(facts.source, note=HOSTILE)
    published = {"Fig. 4": HOSTILE}
    prose = changed(facts, title=HOSTILE, published=published, source=source, variants=variants)
    records = tuple(
        changed(
            requantified(one, note=HOSTILE),
            reason=HOSTILE,
            code_version=HOSTILE,
            model=one.model and changed(one.model, note=HOSTILE),
        )
        for one in manifest.records
    )
    hostile = dataclasses.replace(
        manifest,
        provenance=changed(manifest.provenance, command=HOSTILE),
        cases={"bounce": prose},
        records=records,
    )
    tags = Tags(built(hostile, store))
    assert not {tag for tag, _ in tags.tags} & {"script", "img"}
    assert not list(tags.all("onerror"))


@pytest.mark.usefixtures("sketched")
def test_the_same_results_are_not_rendered_again(manifest: Manifest, store: Store) -> None:
    built(manifest, store)
    output = store.root / "report.html"
    os.utime(output, ns=(1, 1))
    later = dataclasses.replace(manifest.provenance, utc="2026-01-01T00:00:00+00:00")
    built(dataclasses.replace(manifest, name="20260101", provenance=later), store)
    assert output.stat().st_mtime_ns == 1
    first, *others = manifest.records
    worse = (requantified(first, verdict="fail"), *others)
    built(dataclasses.replace(manifest, records=worse), store)
    assert output.stat().st_mtime_ns != 1


@pytest.mark.usefixtures("sketched")
def test_a_damaged_report_is_made_again(manifest: Manifest, store: Store) -> None:
    page = built(manifest, store)
    (store.root / "report.html").write_bytes(b"\xff\xfe not a report")
    assert built(manifest, store) == page


def test_figures_are_drawn_once(
    manifest: Manifest, store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    built(manifest, store)
    monkeypatch.setattr(figures, "draw", lambda chart, salt: pytest.fail("drawn again"))
    clean = dataclasses.replace(manifest.provenance, dirty=False)
    assert (
        built(dataclasses.replace(manifest, provenance=clean), store).count('role="img"')
        == 8 + PROFILES
    )


def test_same_results_give_the_same_bytes(manifest: Manifest, store: Store) -> None:
    first = built(manifest, store)
    shutil.rmtree(store.root / "figures")
    (store.root / "report.html").unlink()
    assert built(manifest, store) == first


def test_one_process_draws_as_many_do(
    manifest: Manifest, store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    by_many = built(manifest, store)
    shutil.rmtree(store.root / "figures")
    (store.root / "report.html").unlink()
    monkeypatch.setattr(figures, "FEW", by_many.count('role="img"') + 1)
    monkeypatch.setattr(figures, "ProcessPoolExecutor", lambda **_: pytest.fail("a second one"))
    assert built(manifest, store) == by_many


@pytest.mark.usefixtures("sketched")
def test_missing_series_leave_tables_and_ladders(manifest: Manifest, store: Store) -> None:
    shutil.rmtree(store.root / "records")
    page = built(manifest, store)
    assert "not in the store" in page
    assert "Error against step" in page
    assert "Relative error over time" not in page


@pytest.mark.usefixtures("sketched")
def test_a_variant_with_the_same_reference_is_drawn_only_in_trouble(
    manifest: Manifest, store: Store
) -> None:
    mirrored = [ran(store, "dem/default", "T1-mirrored", dt, "pass") for dt in STEPS]
    facts = case()
    variants = {**facts.variants, "T1-mirrored": facts.variants["T1"]}
    more = dataclasses.replace(
        manifest,
        cases={"bounce": dataclasses.replace(facts, variants=variants)},
        records=(*manifest.records, *mirrored),
    )
    page = built(more, store)
    assert 'href="#bounce--T1">T1</a>: the figures there serve' in page
    assert page.count('role="img"') == 8 + PROFILES
    trouble = (*manifest.records, requantified(mirrored[0], verdict="fail"), *mirrored[1:])
    assert (
        built(dataclasses.replace(more, records=trouble), store).count('role="img"')
        == 12 + PROFILES
    )


@pytest.mark.usefixtures("sketched")
def test_numbers_and_counts_have_tables_without_series(store: Store, manifest: Manifest) -> None:
    errors = {"max": 1e-5, "final": 1e-5}
    quantities = (
        entry("pass", errors, name="E", kind="scalar", value=2.0, reference=2.00002, norm=None),
        entry("no-reference", {}, name="hits", kind="count", unit="", value=31, norm=None),
    )
    records = tuple(dataclasses.replace(r, quantities=quantities) for r in manifest.records)
    assert "2.00002" in built(dataclasses.replace(manifest, records=records), store)


@pytest.mark.usefixtures("sketched")
def test_reasons_and_circumstances_are_told(manifest: Manifest, store: Store) -> None:
    page = built(manifest, store)
    told = ("refused it is", "drag is late", "vv run --all", "uncommitted", "grows with time")
    for words in (*told, "terms: gravity, drag", "● 9", "indicative", "one freedom"):
        assert words in page
    assert page.count("drag is late") == 3  # in the list, and over the rungs of both variants


@pytest.mark.usefixtures("sketched")
def test_what_was_accepted_moved_or_recorded_is_told(manifest: Manifest, store: Store) -> None:
    taken = AcceptanceSummary(
        commit="c0ffee" * 7,
        dirty=True,
        machine=Place("P9", "S9"),
        reason="looked <at>",
        utc="2025-01-01T00:00:00",
        versions={"numpy": "9.9"},
        results=3,
    )
    moved = Finding(Aspect.REGRESSION, "worse", "it moved", "bounce", "T1", bit=Bit.ACCURACY)
    absent = next(r for r in manifest.records if r.status is Status.NOT_INSTALLED)
    kept = RecordedResult(
        case=absent.case,
        variant=absent.variant,
        code=absent.code,
        scheme=absent.scheme,
        rung=absent.rung,
        knobs="",
        version="2.3",
        utc="2024-02-29T01:02:03",
        days=307,
        cpu=None,
        quantities={"y": RecordedQuantity({"max error": 4.2e-7})},
    )
    more = dataclasses.replace(
        manifest,
        baselines={"bounce": BaselineSummary(4, (taken,))},
        findings=(moved,),
        recorded=(kept,),
    )
    page = built(more, store)
    assert "3 of 4 results" in page
    assert "Reason: looked &lt;at&gt;" in page
    assert "P9, S9, numpy 9.9" in page
    assert "regression: worse<" in page
    assert "it moved" in page
    cell = Tags(page).cells[tables.anchor(absent)]
    assert "recorded 2024-02-29 with 2.3, 307 days ago: 4.2e-7" in cell
    assert "not installed" in cell
    assert "pass" not in cell


def test_importing_the_report_costs_no_plotting_library() -> None:
    code = "import reports.html, sys; assert not {'matplotlib', 'jinja2'} & set(sys.modules)"
    root = Path(html.__file__).parents[1]
    subprocess.run([sys.executable, "-c", code], check=True, cwd=root)


def test_what_an_error_costs_stands_with_each_timed_variant(
    manifest: Manifest, store: Store
) -> None:
    page = built(manifest, store)
    timed = {r.variant for r in manifest.records if r.cost.timed}
    assert timed
    assert page.count("What an error costs") == len(timed)
    assert "What accuracy costs" in page
