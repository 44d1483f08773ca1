"""Claims about the contents of pages: outcomes, papers, cards, the map, patterns, stability."""

from __future__ import annotations

import dataclasses
import re

import numpy as np

from reports import html
from reports.beside import Beside
from reports.outcomes import OUTCOMES, WORST_FIRST, shown_outcome
from reports.variant import reading
from tests.support.built_report import CASE, built, pages
from tests.support.fabricated import (
    STEPS,
    case,
    changed,
    entry,
    record,
)
from tests.support.fabricated import manifest as manifest_of
from tests.support.html_tags import Tags
from vv.ask import Status
from vv.case.published import Assessment, Paper
from vv.insight.papers import Answer, Row
from vv.records.finding import Aspect, Bit, Change, Finding
from vv.records.manifest import Manifest
from vv.records.outcomes import Outcome, Verdict
from vv.scene import Contact, Scene, Spheres, Wall
from vv.scene.picture.sketch import sketch
from vv.store.store import Store


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


PAPER = Paper("Doe (2001)", "Doe, A paper", "10.1/(x)", ())

SAID = Row(
    "Eq. 1", "the height", "2.0", "m", "2.1",
    (Answer("bounce:T1", "2.1", ("dem/default",)), Answer("gone:T9", "7", ("old/one",))),
    Assessment.MISPRINT, "the last place",
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


def test_a_card_shows_the_scene_that_it_is_of(manifest: Manifest, store: Store) -> None:
    (facts,) = manifest.cases.values()
    ball = sketch(Scene((Wall((0, 0, 0), (0, 0, 1)), one_sphere()), Contact(1e3)))  # type: ignore[arg-type]
    variants = {name: changed(said, sketch=ball) for name, said in facts.variants.items()}
    drawn = dataclasses.replace(manifest, cases={"bounce": changed(facts, variants=variants)})
    front = pages(drawn, store)["index.html"]
    assert '<div class="thumb"><svg class="scene"' in front


def test_reasons_and_circumstances_are_told(manifest: Manifest, store: Store) -> None:
    made = pages(manifest, store)
    for words in ("refused it is", "drag is late", "grows with time", "one freedom", "○"):
        assert words in made[CASE]
    for words in ("vv run --all", "with uncommitted changes", "gate: red"):
        assert words in made["index.html"]
    assert "refused it is" in made["code-fate.html"]  # the page of attention links to it
    assert 'href="code-fate.html#refused-fate"' in made["attention.html"]


def test_refusals_are_one_line_in_a_variant_and_blank_on_the_map(
    manifest: Manifest, store: Store
) -> None:
    made = pages(manifest, store)
    assert made[CASE].count("Not run by") == 1  # folded; the other variant has no such refusals
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


def test_a_card_says_first_what_is_wrong_and_then_what_changed(
    manifest: Manifest, store: Store
) -> None:
    said = "error 0.08, now 0.5; it may move by 0.1: rounding"
    worse = Finding(
        Aspect.REGRESSION, Change.WORSE.value, said, "bounce", "T1", "dem/default",
        bit=Bit.ACCURACY, size=1e9,
    )  # fmt: skip
    wrong = record("dem/published", "T2", 1e-3, quantities=[entry("fail", {"max": 0.1})])
    whole = dataclasses.replace(manifest_of(wrong), findings=(worse,))
    page = pages(whole, store)["attention.html"]
    wrong_at, moved_at = (
        page.index("Error of y 0.1, 100 times"),
        page.index("Worse than accepted: error"),
    )
    assert wrong_at < moved_at
    assert "now 0.5</p>" in page
    assert "It may move by 0.1: rounding.</p>" in page


def test_of_many_quantities_those_in_bounds_beyond_the_first_have_numbers_only(
    store: Store,
) -> None:
    names = [f"q{i}" for i in range(5)]
    facts = case()
    (height,) = facts.variants["T1"].quantities
    many = tuple(dataclasses.replace(height, name=name, symbol=name) for name in names)
    variant = dataclasses.replace(facts.variants["T1"], quantities=many)
    rungs = [
        record("a/a", "T1", dt, quantities=[
            entry("fail" if name == "q4" else "pass", {"max": dt / 4}, name=name) for name in names
        ])
        for dt in STEPS
    ]  # fmt: skip
    cases = {"bounce": dataclasses.replace(facts, variants={"T1": variant})}
    page = pages(manifest_of(*rungs, cases=cases), store)[CASE]
    titles = re.findall("<h3>(Error of .*)</h3>", page)
    assert [one for one in titles if "step" in one] == [
        f"Error of {name} against step" for name in ("q0", "q1", "q4")
    ]
    assert len({*titles}) == len(titles)  # titles of charts are unique
    assert 'data-draw="q2">q2</span>, <span data-draw="q3">q3</span>.</p>' in page


def test_how_a_code_models_a_variant_is_told_by_what_differs_from_one_above(store: Store) -> None:
    shared = "springs kn = 1e8 N/m; a sphere stands for the block; a long clause that both share"
    notes = {"T1": f"{shared}; started late", "T2": shared.replace("1e8", "1e9")}
    runs = [
        record(
            "a/a", name, 1e-3, quantities=[entry("pass", {"max": 1e-4})],
            model={"unknowns": 1, "terms": ["gravity"], "note": note},
        )
        for name, note in notes.items()
    ]  # fmt: skip
    page = pages(manifest_of(*runs), store)[CASE]
    assert "a/a</b>: springs kn = 1e8 N/m; a sphere stands" in page
    assert '<a href="#bounce--T1">T1</a>, but springs kn = 1e9 N/m; not: started late' in page
