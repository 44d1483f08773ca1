"""Claims about the part of a page on a variant: ranking, reasons, costs, inputs, records."""

from __future__ import annotations

import dataclasses
import json
import re

from reports import html
from reports.beside import Beside
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
from vv.ask import Knobs, Status
from vv.records.accepted import AcceptanceSummary, BaselineSummary, Place
from vv.records.finding import Aspect, Bit, Finding
from vv.records.manifest import Manifest
from vv.records.recorded import RecordedQuantity, RecordedResult
from vv.store.store import Store


def words(page: str) -> str:
    """A page without the marks that keep lines from breaking within numbers."""
    return re.sub('<span class="n">|</span>', "", page)


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
    assert f"dem/default</b> {said} " in words(page)
    assert "vv run bounce:T1 --codes dem/default --rung dt=0.004" in page


def test_a_larger_error_that_is_green_is_explained_by_its_class(store: Store) -> None:
    rough = record(
        "a/rough", "T1", 1e-3, method="penalty", quantities=[entry("pass", {"max": 2.1e-4})]
    )
    late = entry("xfail", {"max": 1.1e-4}, tolerance=1e-5, note="drag is late")
    sharp = record("b/sharp", "T1", 1e-3, quantities=[late])
    text = words(built(manifest_of(rough, sharp), store))
    assert "a/rough (penalty) has 2.1e-4 of 1.0e-3 and passes" in text
    assert "b/sharp (second order) has 1.1e-4 of 1.0e-5 and is &#39;known disagreement&#39;" in text


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
    assert '#bounce--T1">T1</a>; the figures there apply' in page
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


def test_costs_of_whole_processes_are_marked_and_explained(
    manifest: Manifest, store: Store
) -> None:
    assert "◻" not in pages(manifest, store)[CASE]
    whole = [changed(r, cost=changed(r.cost, whole=True)) for r in manifest.records]
    made = pages(dataclasses.replace(manifest, records=tuple(whole)), store)[CASE]
    for words in (
        " ◻",
        "the program does not report the cost of its steps",
        "costs of whole processes",
    ):
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


def part(page: str, variant: str) -> str:
    """The part of a page on a variant."""
    return page.partition(f'<h2 id="{variant}">')[2].partition("<h2 ")[0]


def test_what_is_recorded_stands_with_its_own_variant(manifest: Manifest, store: Store) -> None:
    absent = next(r for r in manifest.records if r.status is Status.NOT_INSTALLED)
    kept = [
        RecordedResult("bounce", name, absent.code, absent.scheme, absent.rung, "", "2.3",
                       f"2024-02-2{k}T01:02:03", 307, None, {})
        for k, name in enumerate(("T1", "T2"))
    ]  # fmt: skip
    page = built(dataclasses.replace(manifest, recorded=tuple(kept)), store)
    for k, name in enumerate(("T1", "T2")):
        assert re.findall(r"recorded 2024-02-2(\d)", part(page, f"bounce--{name}")) == [str(k)]


def test_what_is_recorded_of_a_scheme_is_told_of_its_finest_setting(
    manifest: Manifest, store: Store
) -> None:
    absent = next(r for r in manifest.records if r.status is Status.NOT_INSTALLED)
    errors = {2e-3: 4.2e-3, 5e-4: 4.2e-5, 1e-3: 4.2e-4}
    kept = [
        RecordedResult("bounce", "T1", absent.code, absent.scheme, Knobs(dt), "", "2.3",
                       "2024-02-29T01:02:03", 307, None,
                       {"y": RecordedQuantity({"max error": error})})
        for dt, error in errors.items()
    ]  # fmt: skip
    page = built(dataclasses.replace(manifest, recorded=tuple(kept)), store)
    assert re.findall(r"307 days ago: error ([^.]*[.]\d+e-\d)", page) == ["4.2e-5"]


def test_the_parameters_of_a_variant_that_are_not_those_of_the_table_are_told(
    store: Store,
) -> None:
    usual = record("a/a", "T1", 1e-3, parameters={"m": 1.0})
    other = record("a/a", "T2", 1e-3, parameters={"m": 2.5})
    page = built(manifest_of(usual, other), store)
    assert "Defaults of its own" not in part(page, "bounce--T1")
    assert "Defaults of its own: <code>m</code> = 2.5." in words(part(page, "bounce--T2"))
    wide = changed(other, modified=True, changed=["m"], parameters={"m": 2.5, "g": 3.0})
    page = built(manifest_of(usual, wide), store)
    assert "<b>Modified parameters:</b> m = 2.5." in words(part(page, "bounce--T2"))
    assert '<code class="cmd">vv run bounce:T2 --set m=2.5</code>' in page
    assert '<code class="cmd">vv run bounce:T1</code>' in page
    assert "Modified" not in part(page, "bounce--T1")


def test_what_an_error_costs_stands_with_each_timed_variant(
    manifest: Manifest, store: Store
) -> None:
    made = pages(manifest, store)
    timed = {r.variant for r in manifest.records if r.cost.timed}
    assert timed
    assert made[CASE].count("Cost of an error:") == len(timed)
    assert "What accuracy costs" in made["index.html"]


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
    assert "odd/default differs, 7.001" in page
