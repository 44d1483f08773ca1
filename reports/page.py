"""Arranges for the template what an invocation left: from a manifest and the stored series."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping, Sequence

from reports import collect, costs, gallery, steadiness, tables
from reports.collect import Arrays, History
from reports.costs import Costs
from reports.findings import findings
from reports.gallery import Draw, Figure
from reports.marks import Mark, marks
from reports.outcomes import WORST_FIRST, counted, shown_outcome
from reports.tables import Group
from reports.text import slug
from reports.views import Case, Page, Recorded, Scheme, Variant
from vv.case import Norm
from vv.insight.accuracy_cost import FACTORS
from vv.insight.history import Point
from vv.records import codec
from vv.records.case_facts import CaseFacts, QuantityFacts, VariantFacts
from vv.records.finding import worst_first
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.reading import by_fineness, fineness
from vv.records.recorded import RecordedResult


def page(
    manifest: Manifest,
    arrays: Arrays,
    draw: Draw,
    past: Mapping[str, Sequence[Point]],
    digest: str,
) -> Page:
    """The view of a manifest.

    arrays: record key -> its series. draw: chart -> SVG. past: case -> its points over commits.
    """
    records = manifest.records
    looks = marks(record.label for record in records)
    dear, profiles = costs.costs(manifest, looks, draw)
    return Page(
        digest=digest,
        name=manifest.name,
        provenance=manifest.provenance,
        marks=looks,
        versions={r.code: r.code_version for r in records if r.code_version},
        counts=counted(records),
        cases=[
            _case(name, manifest, looks, arrays, draw, past[name], dear) for name in manifest.cases
        ],
        since=worst_first(manifest.findings),
        trouble=findings(records, looks, ("bad", "odd")),
        known=findings(records, looks, ("known",)),
        idle=findings(records, looks, ("idle",)),
        legend=WORST_FIRST[::-1],
        norms={name: norm.value for norm, name in tables.NORM_NAMES.items()},
        profiles=profiles,
        stability=steadiness.sections(manifest, looks),
        factors=FACTORS,
    )


def _case(
    name: str,
    manifest: Manifest,
    looks: Mapping[str, Mark],
    arrays: Arrays,
    draw: Draw,
    past: Sequence[Point],
    dear: Mapping[tuple[str, str], Costs],
) -> Case:
    facts = manifest.cases[name]
    records = [r for r in manifest.records if r.case == name]
    recorded = [r for r in manifest.recorded if r.case == name]
    variants: list[Variant] = []
    distinct: dict[str, list[History]] = {}
    for variant, stated in facts.variants.items():
        own = [r for r in records if r.variant == variant]
        first = stated.quantities[0].name if stated.quantities else ""
        curves = collect.histories(own, first, looks, arrays)
        like = next((v for v, other in distinct.items() if collect.same_curve(other, curves)), "")
        if not like:
            distinct[variant] = curves
        if any(shown_outcome(record).troubling for record in own):
            like = ""  # whoever looks for what went wrong needs its own picture
        made = [] if like else _figures(stated, own, looks, arrays, draw)
        kept = _recorded([r for r in recorded if r.variant == variant], stated)
        view = _variant(name, variant, facts, own, kept, looks, made, like, bool(curves))
        variants.append(dataclasses.replace(view, costs=dear.get((name, variant))))
    dt = _stated_step(facts)
    beside = {v: _pointwise([r for r in records if r.variant == v], dt) for v in distinct}
    return Case(
        name=name,
        anchor=slug(name),
        facts=facts,
        quantities=_quantities(facts),
        variants=variants,
        beside=beside,
        beside_dt=dt,
        baseline=manifest.baselines.get(name),
        past=past,
    )


def _recorded(results: Sequence[RecordedResult], stated: VariantFacts) -> dict[str, Recorded]:
    """Scheme -> its recorded result at the finest rung, by the first quantity."""
    found = {}
    first = stated.quantities[0].name if stated.quantities else ""
    for one in sorted(results, key=lambda result: fineness(result.rung)):
        kept = one.quantities.get(first)
        error = kept.figures.get("max error") if kept else None
        found[one.label] = Recorded(one.version, one.utc.partition("T")[0], one.days, error)
    return found


def _figures(
    stated: VariantFacts,
    records: Sequence[Record],
    looks: Mapping[str, Mark],
    arrays: Arrays,
    draw: Draw,
) -> list[Figure]:
    made = []
    critical = dict(stated.critical)
    for quantity in stated.quantities:
        name = quantity.name
        measured = [one for r in records if (one := r.quantity(name))]
        norm = next((one.norm for one in measured if one.norm), Norm.MAX)
        curves = collect.histories(records, name, looks, arrays)
        steps = collect.ladders(records, name, looks)
        made += gallery.figures(curves, steps, quantity, norm, draw, critical) if measured else []
    return made


def _variant(
    case: str,
    name: str,
    facts: CaseFacts,
    records: Sequence[Record],
    recorded: Mapping[str, Recorded],
    looks: Mapping[str, Mark],
    made: Sequence[Figure],
    like: str,
    has_series: bool,
) -> Variant:
    groups = tables.groups(records, looks)
    by_label = {
        scheme: [r for r in records if r.label == scheme]
        for scheme in sorted({record.label for record in records})
    }
    usual = {parameter.name: parameter.value for parameter in facts.parameters}
    given = records[0].parameters if records else {}
    return Variant(
        name=name,
        anchor=slug(case, name),
        facts=facts.variants[name],
        settings={key: value for key, value in given.items() if value != usual.get(key)},
        modified=any(record.modified for record in records),
        cells={scheme: tables.cell(own) for scheme, own in by_label.items()},
        recorded=recorded,
        schemes=[_scheme(looks[scheme], own, groups) for scheme, own in by_label.items()],
        groups=groups,
        absent=tables.absent(records, looks),
        figures=made,
        like=like,
        has_series=has_series,
        costs=None,
    )


def _scheme(mark: Mark, records: Sequence[Record], groups: Sequence[Group]) -> Scheme:
    ordered = sorted(records, key=by_fineness)
    finest = next((r for r in reversed(ordered) if r.model), ordered[-1])
    reasons = dict.fromkeys(r.reason for r in records if r.reason and not r.quantities)
    return Scheme(
        mark=mark,
        cell=tables.cell(records),
        version=finest.code_version,
        method=codec.word(finest.method).replace("-", " "),
        model=finest.model,
        orders=[g for g in groups if g.mark is mark and g.order],
        ledger=finest.ledger,
        reason="; ".join(reasons),
    )


def _quantities(facts: CaseFacts) -> list[tuple[QuantityFacts, Sequence[str]]]:
    """(quantity, variants it belongs to), each distinct quantity once."""
    found: list[tuple[QuantityFacts, list[str]]] = []
    for variant, stated in facts.variants.items():
        for quantity in stated.quantities:
            variants = next((names for known, names in found if known == quantity), None)
            if variants is None:
                found.append((quantity, [variant]))
            else:
                variants.append(variant)
    return [*found]


def _stated_step(facts: CaseFacts) -> float | None:
    """The step that the tolerances are stated for: there codes are compared with the source."""
    for quantity, _ in _quantities(facts):
        for tolerance in (quantity.tolerances or {}).values():
            if tolerance.dt is not None:
                return tolerance.dt
    return None


def _pointwise(records: Iterable[Record], dt: float | None) -> dict[str, float | None]:
    """Scheme -> largest pointwise relative error at that step, or at the only rung it has."""
    return {
        record.label: one.errors.get(Norm.POINTWISE)
        for record in records
        if record.rung.dt in (dt, None)
        for one in record.quantities[:1]
    }
