"""Claims about the report's pages: they say all there is, fetch nothing, and are made once."""

from __future__ import annotations

import dataclasses
import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

from reports import html
from reports.beside import Beside
from reports.outcomes import OUTCOMES, WORST_FIRST, shown_outcome
from reports.variant import reading
from tests.support.built_report import CASE, built, pages
from tests.support.fabricated import (
    HEAD,
    STEPS,
    TAIL,
    case,
    changed,
    cost,
    entry,
    native,
    ran,
    record,
    requantified,
    with_external,
)
from tests.support.fabricated import manifest as manifest_of
from tests.support.html_tags import Tags
from vv.ask import Status
from vv.case.published import Paper, Standing
from vv.insight.papers import Answer, Row
from vv.records.accepted import AcceptanceSummary, BaselineSummary, Place
from vv.records.finding import Aspect, Bit, Finding
from vv.records.manifest import Manifest
from vv.records.outcomes import Outcome, Verdict
from vv.records.recorded import RecordedQuantity, RecordedResult
from vv.scene import Contact, Scene, Spheres, Wall
from vv.scene.sketch import sketch
from vv.store.store import Store

HOSTILE = (
    "</td></script><script>alert('x')</script><img src=http://bad.example/x onerror=run()>&$^_{"
)


def one_sphere() -> Spheres:
    place, free = np.zeros((1, 3)), np.ones((1, 3), bool)
    return Spheres(place + 1.0, place, np.ones(1), np.ones(1), free)


def test_every_outcome_of_what_ran_is_in_its_row_with_a_symbol(
    manifest: Manifest, store: Store
) -> None:
    page = built(manifest, store)
    rows, seen = Tags(page).rows, set()
    for made in manifest.records:
        outcome = shown_outcome(made)
        seen.add(outcome.key)
        where = rows.get(reading.anchor(made), page)
        assert f"{outcome.symbol} {outcome.word}" in re.sub(r"<[^>]*>", "", where)
    assert seen == set(OUTCOMES)


def test_every_status_and_verdict_has_an_outcome_told_apart_without_colour() -> None:
    words = {status.value for status in Status} - {"ran"} | {verdict.value for verdict in Verdict}
    assert words <= {outcome.value for outcome in OUTCOMES}
    assert set(OUTCOMES) == set(Outcome)
    assert len({known.symbol for known in WORST_FIRST}) == len(WORST_FIRST)
    assert len({known.word for known in WORST_FIRST}) == len(WORST_FIRST)


def test_red_is_explained_by_the_setting_that_fails_and_not_by_the_finest(
    manifest: Manifest, store: Store
) -> None:
    good = next(r for r in manifest.records if r.label == "dem/default" and r.rung.dt == 4e-3)
    leaked = {"terms": {}, "unaccounted": 0.0, "peak": 9.0, "bound": None}
    audits = {"energy created [J]": [1390.0, 2e-10]}
    bad = changed(good, ledger={**leaked, "audits": audits})
    records = tuple(bad if r is good else r for r in manifest.records)
    page = built(dataclasses.replace(manifest, records=records), store)
    row = Tags(page).rows[reading.anchor(good)]
    assert "≠ not conserved 1" in row
    assert "✓ pass 2" in row
    said = "at dt = 0.004 s: Energy not conserved: created 1.39e3 J, allowed 2.00e-10 J"
    assert f"dem/default</b> {said} " in page
    assert "vv run bounce:T1 --codes dem/default --rung dt=0.004" in page


def test_a_larger_error_that_is_green_is_explained_by_its_class(store: Store) -> None:
    rough = record(
        "a/rough", "T1", 1e-3, method="penalty", quantities=[entry("pass", {"max": 2.1e-4})]
    )
    late = entry("xfail", {"max": 1.1e-4}, tolerance=1e-5, note="drag is late")
    sharp = record("b/sharp", "T1", 1e-3, quantities=[late])
    text = built(manifest_of(rough, sharp), store)
    assert "a/rough (penalty) has 2.1e-4 of 1.0e-3 and passes" in text
    assert "b/sharp (second order) has 1.1e-4 of 1.0e-5 and is &#39;known disagreement&#39;" in text


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


PAPER = Paper("Doe (2001)", "Doe, A paper", "10.1/(x)", ())
SAID = Row(
    "Eq. 1", "the height", "2.0", "m", "2.1",
    (Answer("bounce:T1", "2.1", ("dem/default",)), Answer("gone:T9", "7", ("old/one",))),
    Standing.MISPRINT, "the last place",
)  # fmt: skip


def test_the_page_of_the_papers_has_each_statement_and_leads_to_its_variant(
    manifest: Manifest, store: Store
) -> None:
    folder = store.root / "report"
    html.build(manifest, store, folder, Beside([(PAPER, [SAID])]))
    page, front = ((folder / name).read_text() for name in ("papers.html", "index.html"))
    said = re.sub(r"\s+", " ", re.sub(r"<[^>]*>", " ", page))
    assert "Eq. 1 the height 2.0 m 2.1 m misprint the last place" in said
    assert '<a href="case-bounce.html#bounce--T1">bounce:T1</a>' in page
    assert "gone:T9" in page
    assert "old/one" in page
    assert 'href="papers.html"' in front
    assert "1 misprint" in front
    html.build(manifest, store, folder)
    assert not (folder / "papers.html").exists()
    assert "papers.html" not in (folder / CASE).read_text() + (folder / "index.html").read_text()


def test_the_input_of_a_code_stands_with_the_variant_and_what_all_begin_with_once(
    manifest: Manifest, store: Store
) -> None:
    folder = store.root / "report"
    html.build(with_external(manifest, "other"), store, folder, Beside(native=native))
    page, code = ((folder / name).read_text() for name in (CASE, "code-other.html"))
    found = re.findall(r'<pre data-head="other">\n(.*?)</pre>', page, re.DOTALL)
    assert found == [f'variant = "T1"\n{TAIL.replace("<", "&lt;")}']
    base = "input--bounce-T1-other"
    found = re.findall(rf'<pre data-head="other" data-base="{base}">\n(.*?)</pre>', page, re.DOTALL)
    assert found == ['@@ -1 +1 @@\n-variant = "T1"\n+variant = "T2"\n']
    assert f'<div class="input" id="{base}">' in page
    assert f'<pre id="head-other">\n{HEAD.replace("&", "&amp;").replace("<", "&lt;")}</pre>' in code
    assert json.dumps(HEAD) in (folder / "inputs.js").read_text()
    assert "vv export bounce:T1 --code other/default --rung" in page


def test_who_has_no_script_reads_a_ranking_by_cost_too(store: Store) -> None:
    runs = [
        record(label, "T1", 1e-3, cost=cost(cpu=cpu), quantities=[entry("pass", {"max": error})])
        for label, cpu, error in (("a/slow", 4e-3, 1e-8), ("b/quick", 1e-3, 1e-4))
    ]
    page = built(manifest_of(*runs), store)
    ranking = re.search(r'<ol class="small cheapest">(.*?)</ol>', page, re.DOTALL)
    assert ranking is not None
    rows = [re.sub(r"<[^>]*>", "", row) for row in ranking[1].split("</li>")]
    assert rows[0].strip().startswith("b/quick 1 ms ○; error 1.0e-4")
    assert rows[1].strip().startswith("a/slow 4 ms ○, 4 times the cheapest; error 1.0e-8")


def test_a_card_shows_the_scene_that_it_is_of(manifest: Manifest, store: Store) -> None:
    (facts,) = manifest.cases.values()
    ball = sketch(Scene((Wall((0, 0, 0), (0, 0, 1)), one_sphere()), Contact(1e3)))  # type: ignore[arg-type]
    variants = {name: changed(said, sketch=ball) for name, said in facts.variants.items()}
    drawn = dataclasses.replace(manifest, cases={"bounce": changed(facts, variants=variants)})
    front = pages(drawn, store)["index.html"]
    assert '<div class="thumb"><svg class="scene"' in front


def hostile(manifest: Manifest) -> Manifest:
    """The manifest with a hostile text wherever a text is."""
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
    assert '#bounce--T1">T1</a>: the figures there serve' in page
    drawn = page.count('role="img"')
    trouble = (*manifest.records, requantified(mirrored[0], verdict="fail"), *mirrored[1:])
    assert built(dataclasses.replace(more, records=trouble), store).count('role="img"') == drawn + 4


def test_numbers_and_counts_have_tables_without_series(store: Store, manifest: Manifest) -> None:
    errors = {"max": 1e-5, "final": 1e-5}
    quantities = (
        entry("pass", errors, name="E", kind="scalar", value=2.0, reference=2.00002, norm=None),
        entry("no-reference", {}, name="hits", kind="count", unit="", value=31, norm=None),
    )
    records = tuple(dataclasses.replace(r, quantities=quantities) for r in manifest.records)
    assert "2.00002" in built(dataclasses.replace(manifest, records=records), store)


def test_reasons_and_circumstances_are_told(manifest: Manifest, store: Store) -> None:
    made = pages(manifest, store)
    for words in ("refused it is", "drag is late", "grows with time", "one freedom", "○"):
        assert words in made[CASE]
    for words in ("vv run --all", "with uncommitted changes", "gate: red"):
        assert words in made["index.html"]
    assert "refused it is" in made["attention.html"]


def test_costs_of_whole_processes_are_marked_and_explained(
    manifest: Manifest, store: Store
) -> None:
    assert "◻" not in pages(manifest, store)[CASE]
    whole = [changed(r, cost=changed(r.cost, whole=True)) for r in manifest.records]
    made = pages(dataclasses.replace(manifest, records=tuple(whole)), store)[CASE]
    for words in (" ◻", "the program does not say what its steps cost", "costs of whole processes"):
        assert words in made


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
    assert "recorded 2024-02-29 with 2.3, 307 days ago: error 4.2e-7" in page


def test_importing_the_report_costs_no_templates() -> None:
    code = "import reports.html, sys; assert not {'matplotlib', 'jinja2'} & set(sys.modules)"
    root = Path(html.__file__).parents[1]
    subprocess.run([sys.executable, "-c", code], check=True, cwd=root)


def test_what_an_error_costs_stands_with_each_timed_variant(
    manifest: Manifest, store: Store
) -> None:
    made = pages(manifest, store)
    timed = {r.variant for r in manifest.records if r.cost.timed}
    assert timed
    assert made[CASE].count("What an error costs") == len(timed)
    assert "What accuracy costs" in made["index.html"]


def test_refusals_are_one_line_in_a_variant_and_blank_on_the_map(
    manifest: Manifest, store: Store
) -> None:
    made = pages(manifest, store)
    assert made[CASE].count("Not run by") == 1  # folded; the other variant was asked of no such
    (row,) = re.findall(
        r'<tr><th scope="row"><a href="case-bounce.html#bounce">.*?</tr>', made["index.html"]
    )
    cells = re.findall(r"<td.*?</td>", row)
    labels = sorted({record.label for record in manifest.records})
    assert cells[labels.index("fate/a")] == "<td></td>"
    assert "≠" in cells[labels.index("fate/j")]


def test_the_verdict_is_that_of_the_gate(manifest: Manifest, store: Store) -> None:
    from vv.gate.judgement import judgement
    from vv.output.markdown import headline

    assert f"gate: {headline(judgement(manifest))}" in pages(manifest, store)["index.html"]


def test_an_empty_run_and_one_of_failures_only_have_pages(store: Store) -> None:
    assert "Nothing was run" in pages(manifest_of(), store)["index.html"]
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


def test_stability_stands_on_the_page_of_attention(manifest: Manifest, store: Store) -> None:
    quantity = entry(
        "pass", {"max": 0.0}, name="step", kind="scalar", value=0.9996, reference=1.0,
        note="at dt = 0.2 s: it blew up",
    )  # fmt: skip
    sought = record("dem/default", "T1", 0.1, study="search", quantities=[quantity])
    found = (sought, changed(sought, code="exact"))
    more = dataclasses.replace(manifest, records=(*manifest.records, *found))
    text = pages(more, store)["attention.html"]
    assert text.count("0.9996, as due; at dt = 0.2 s: it blew up") == 1  # shared by both


def test_the_pattern_of_a_failure_is_named_where_its_author_looks(store: Store) -> None:
    stuck = [
        record("a/a", "T1", dt, quantities=[entry("fail", {"max": 0.013})], ledger=None)
        for dt in STEPS
    ]
    made = pages(manifest_of(*stuck), store)
    for page in (CASE, "code-a.html", "index.html", "attention.html"):
        assert "it does not converge: error 0.013 to 0.013 as dt shrinks" in made[page]


def test_who_agrees_with_whom_is_told_where_three_codes_speak(store: Store) -> None:
    def speak(*values: tuple[str, float]) -> str:
        runs = [
            requantified(ran(store, label, "T1", dt, "pass"), figures={"final": end + dt})
            for label, end in values
            for dt in STEPS
        ]
        return built(manifest_of(*runs), store)

    two = ("dem/default", 1.0), ("other/default", 1.0)
    assert "agree within their errors" not in speak(*two)
    page = speak(*two, ("third/default", 1.0), ("odd/default", 7.0))
    assert "dem/default, other/default, third/default agree within their errors" in page
    assert "the odd one is odd/default, 7.001" in page
