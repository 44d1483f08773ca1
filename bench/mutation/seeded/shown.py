"""Bugs in the numbers that reports, tables and answers show."""

from bench.mutation.seeded.bug import Bug

READING = "reports/variant/reading.py"
RANKING = "reports/variant/ranking.py"
TEXT = "reports/text.py"
CASE = "reports/pages/case.py"
CHARTS = "reports/drawing/charts.py"
COLLECT = "reports/drawing/collect.py"
COSTS = "vv/insight/accuracy_cost.py"
EFFORT = "vv/insight/effort.py"
HISTORY = "vv/insight/history.py"
COMPARE = "vv/insight/compare.py"
RUNGS = "vv/records/rungs.py"
RECORD = "vv/records/record.py"
PAGES, INSIGHT = "tests/reports", "tests/insight"

BUGS = (
    Bug("tolerance over error inverted", READING, "return one.tolerance / one.error if", "return one.error / one.tolerance if", tests=PAGES),
    Bug("the finest setting is the coarsest", RANKING, "finest = measured[-1] if", "finest = measured[0] if", tests=PAGES),
    Bug("a scheme is told by its best outcome", RANKING, "return self.outcomes[0][0]", "return self.outcomes[-1][0]", tests=PAGES),
    Bug("milliseconds that are microseconds", TEXT, '(1.0, 1e3, "ms")', '(1.0, 1e6, "ms")', tests=PAGES),
    Bug("compared with the source at any step", CASE, "if record.rung.dt in (dt, None)", "if record.rung.dt is not dt", tests=PAGES),
    Bug("profiles upside down", CHARTS, "levels = np.arange(1, len(ratios) + 1) / len(row)", "levels = 1 - np.arange(1, len(ratios) + 1) / len(row)", tests=PAGES),
    Bug("a curve of the coarsest setting", COLLECT, "kept = arrays(ran[-1].key)", "kept = arrays(ran[0].key)", tests=PAGES),
    Bug("the worst scheme ranked first", RANKING, "(row.error is None, row.error or 0.0, row.mark.label)", "(row.error is None, -(row.error or 0.0), row.mark.label)", tests=PAGES),
    Bug("the advice is the dearest setting", "reports/variant/advice.py", "in sorted(able, key=lambda row: row[:2]):", "in sorted(able, key=lambda row: row[:2])[::-1]:", tests=PAGES),
    Bug("the value of a number where the exact one is", "reports/settings_table.py", "text.brief(one.value), text.brief(one.reference)", "text.brief(one.value), text.brief(one.value)", tests=PAGES),
    Bug("the start told as the end", RECORD, '"final": _finite(value[-1])', '"final": _finite(value[0])', tests="tests/records"),
    Bug("the exact end is the code's own", RECORD, "end=_finite(reference[-1])", "end=_finite(value[-1])", tests="tests/records"),
    Bug("a cost interpolated from the wrong end", COSTS, "before[0] * (cpu / before[0]) ** share", "cpu * (before[0] / cpu) ** share", tests="tests/reports/test_readback.py"),
    Bug("a floor though the next stiffness gains", EFFORT, " or any(map(_gains, rows[at + 1 :]))", "", tests=INSIGHT),
    Bug("a missing error counts as accurate", COSTS, "(p.cpu, max(p.error, LEAST), p) for p in effort.points if p.cpu and p.error is not None", "(p.cpu, max(p.error or 0.0, LEAST), p) for p in effort.points if p.cpu", tests=INSIGHT),
    Bug("an error of which a part is missing", RUNGS, "finite and len(finite) == len(errors)", "finite", tests="tests/insight tests/records"),
    Bug("the model's part is the step's", RUNGS, "return Limit(h1, found, model, step,", "return Limit(h1, found, step, model,", tests="tests/insight tests/records"),
    Bug("the best of a commit as its worst", HISTORY, "[digest.closeness for _, digest in found], max)", "[digest.closeness for _, digest in found], min)", tests=INSIGHT),
    Bug("a comparison the wrong way round", COMPARE, '(x {b / a:.3g})', '(x {a / b:.3g})', tests=INSIGHT),
    Bug("the least drift as the largest", "vv/insight/stability_summary.py", "worst = max((one.errors", "worst = min((one.errors", tests=INSIGHT),
    Bug("answers agree within the error of the coarsest step", "vv/insight/agreement.py", "near = [(stiffest, min(coarser))]", "near = [(stiffest, max(coarser))]", tests=INSIGHT),
    Bug("of each code the dearest scheme", COSTS, 'first.setdefault(name.partition("/")[0], (name, point))', 'first[name.partition("/")[0]] = (name, point)', tests=INSIGHT),
    Bug("history backwards", HISTORY, "_points([*runs.values()][::-1])", "_points([*runs.values()])", tests=INSIGHT),
    Bug("computed over measured upside down", "reports/drawing/scatter.py", "number(SIZE - at(point.computed))", "number(at(point.computed))", tests="tests/reports/drawing/test_beside.py"),
    Bug("a map lost from the largest step on", "vv/insight/stability_summary.py", "{min(ratios):.3g} critical steps", "{max(ratios):.3g} critical steps", tests=INSIGHT),
    Bug("the quantity that is farthest from its bound", "vv/output/results_table.py", "worst = max(known, key=_closeness", "worst = min(known, key=_closeness", tests="tests/output"),
    Bug("exact and computed series exchanged", "vv/output/export.py", "for part in (\"value\", \"reference\")}\n", "for part in (\"reference\", \"value\")}\n    parts = dict(zip(parts, [*parts.values()][::-1], strict=True))\n", tests="tests/output"),
    Bug("right and wrong exchanged in a map of regions", "reports/drawing/regions.py", "value == exact) for at", "value != exact) for at", tests="tests/reports/drawing/test_beside.py"),
    Bug("a scatter of one freedom too many", "vv/insight/against_measurements.py", "logs.var(ddof=1)", "logs.var(ddof=0)", tests=INSIGHT),
    Bug("points within their bands are those without", "reports/pages/measured.py", "sum(point.within for point in one.held)", "sum(not point.within for point in one.held)", tests="tests/reports/drawing/test_beside.py"),
    Bug("what is recorded is told of the coarsest setting", "reports/variant/variant.py", "key=lambda result: fineness(result.rung))", "key=lambda result: fineness(result.rung), reverse=True)", tests="tests/reports/test_variant_part.py"),
    Bug("costs over those of the dearest", "reports/pages/overview.py", "best = min((cpu for cpu in known", "best = max((cpu for cpu in known", tests="tests/reports/test_readback.py"),
    Bug("a series of another run beside its error", "vv/store/store.py", "            check_series(arrays, quantities)\n", "", tests="tests/store/test_damage.py::test_a_series_that_is_not_that_of_its_figures_is_made_again"),
    Bug("an order fitted over all stiffnesses", "vv/output/results_table.py", "[r for r in done if r.rung.kn == finest.rung.kn]", "done", tests="tests/output/test_results_table.py"),
    Bug("CPU seconds that are those of the wall in JUnit", "vv/output/junit.py", '"cpu": record.cost.solve_cpu', '"cpu": record.cost.solve_wall', tests="tests/output/test_outputs.py"),
    Bug("the order before told as that after", COMPARE, "_order_changes(orders(one.records), orders(other.records))", "_order_changes(orders(other.records), orders(one.records))", tests="tests/insight/test_compare.py"),
    Bug("the best stiffness at the coarsest step", "reports/drawing/maps.py", "self.error[:, int(np.argmax(columns))]", "self.error[:, -1]", tests="tests/reports/drawing/test_map.py"),
    Bug("a rank's order fitted over all stiffnesses", RANKING, "own = [r for r in pile if r.rung.kn == pile[-1].rung.kn]", "own = pile", tests="tests/reports/variant/test_variant_decisions.py"),
    Bug("patterns sought over all stiffnesses", "vv/insight/diagnosis.py", "return [r for r in own if r.rung.kn == own[-1].rung.kn]", "return own", tests="tests/insight/test_diagnosis.py"),
    Bug("the last results are the oldest", "vv/output/explain.py", "for place, records in own.items()}\n        found = {**newest, **found}", "for place, records in own.items()}\n        found = {**found, **newest}", tests="tests/output/test_explained_agreement.py"),
    Bug("points of a picture in the order of settings", "vv/output/gallery/error_cost.py", "zip(*sorted(points), strict=True)", "zip(*points, strict=True)", tests="tests/output/gallery/test_error_cost.py"),
    Bug("what a tolerance adds for late events left out", "vv/output/wording.py", "    if one.late:\n", "    if False:\n", tests="tests/output/test_explained_agreement.py"),
    Bug("stored jobs of a dry run counted by scheme", "vv/output/listing.py", "kept = sum(len(own) for", "kept = sum(1 for", tests="tests/output/test_listing.py"),
    Bug("an exact phase curve of the fewest outputs", "reports/drawing/phases.py", "return max(whole, key", "return min(whole, key", tests="tests/reports/drawing/test_phases.py"),
    Bug("a duel that says of ours what it says of theirs", COSTS, "bool(other and other[2])", "bool(mine and mine[2])", tests="tests/insight/test_effort.py"),
    Bug("the nearest of theirs is the farthest", COSTS, "least = min((e.best for e in theirs", "least = max((e.best for e in theirs", tests="tests/insight/test_effort.py"),
    Bug("a profile in the order of the variants", COSTS, "return {name: sorted(row) for", "return {name: row for", tests="tests/insight/test_effort.py"),
    Bug("one of two uncertainties of a measurement", "vv/insight/against_measurements.py", "one.value, one.measurement.value, one.measurement.uncertainty,", "one.value, one.measurement.value, one.measurement.digitisation,", tests="tests/insight/test_against_measurements.py"),
    Bug("measurements beside the coarsest setting", "vv/insight/against_measurements.py", "sorted(manifest.records, key=by_fineness)", "sorted(manifest.records, key=by_fineness, reverse=True)", tests="tests/insight/test_against_measurements.py"),
    Bug("an answer's error without that of its softness", "vv/insight/agreement.py", "sum(abs(value - values[place]) for place in near)", "max((abs(value - values[place]) for place in near), default=0.0)", tests="tests/insight/test_agreement.py"),
    Bug("of two groups the less sure agrees", "vv/insight/agreement.py", "-sum(answer.error for", "sum(answer.error for", tests="tests/insight/test_agreement.py"),
    Bug("changes with the smallest first", COMPARE, "-change.size, change.where", "change.size, change.where", tests="tests/insight/test_compare.py"),
    Bug("a floor of the largest errors", EFFORT, "least = [min(row.errors)", "least = [max(row.errors)", tests="tests/insight/test_floors.py"),
    Bug("a floor that was paid for at the softest", EFFORT, 'Floor(min(least), f"{spent', 'Floor(least[0], f"{spent', tests="tests/insight/test_floors.py"),
    Bug("past figures of all variants under one place", "vv/insight/past_runs.py", "(record.variant, rung(record), name)", "(rung(record), name)", tests="tests/insight/test_past_runs.py"),
    Bug("a kept history beside the commits of others", HISTORY, "zip(own, runs[::-1], strict=True)", "zip(own, runs, strict=True)", tests="tests/insight/test_past_runs.py"),
    Bug("papers beside accepted answers of old", "vv/insight/rows_of_run.py", "return {**(known.results if known else {}), **{name_of(r): result_of(r, \"\") for r in ran}}", "return {**{name_of(r): result_of(r, \"\") for r in ran}, **(known.results if known else {})}", tests="tests/insight/test_rows_of_run.py"),
    Bug("the finest of papers has the shortest step", "vv/insight/papers.py", '(float(knobs.get("kn", 0.0)), -float(knobs.get("dt", 0.0)))', '(-float(knobs.get("dt", 0.0)), float(knobs.get("kn", 0.0)))', tests="tests/insight/test_papers.py"),
    Bug("papers beside any variant", "vv/insight/papers.py", "if variant != computed.variant or not", "if not", tests="tests/insight/test_papers.py"),
    Bug("errors that stay told backwards", "vv/insight/diagnosis.py", "first, last = points[0][1], points[-1][1]", "last, first = points[0][1], points[-1][1]", tests="tests/insight/test_diagnosis.py"),
    Bug("a factor at the coarsest step", "vv/insight/diagnosis.py", "for record in (rungs[-1], rungs[0])", "for record in (rungs[0], rungs[-1])", tests="tests/insight/test_diagnosis.py"),
    Bug("the largest stable step of the softest springs", "vv/insight/stability_summary.py", "record, one = pile[-1]", "record, one = pile[0]", tests="tests/insight/test_stability_summary.py"),
    Bug("start and set-up exchanged in the table", "vv/output/table.py", '"startup": r and r.cost.startup', '"startup": r and r.cost.setup', tests="tests/output/test_table.py"),
    Bug("the scale of a quantity as its tolerance", "vv/output/table.py", '"tolerance": q and q.tolerance', '"tolerance": q and q.scale', tests="tests/output/test_table.py"),
    Bug("answers of other codes beside the coarsest setting", "reports/variant/other_codes.py", "max(done, key=by_fineness)", "min(done, key=by_fineness)", tests="tests/reports/variant"),
    Bug("what lies outside is what passes", "reports/variant/other_codes.py", "one.verdict is Verdict.FAIL", "one.verdict is Verdict.PASS", tests="tests/reports/variant"),
    Bug("a map of regions of the coarsest setting", "reports/variant/region_figures.py", "measured[-1].quantities", "measured[0].quantities", tests="tests/reports/variant"),
    Bug("bands counted as uncertainties", "reports/variant/measurements.py", "sum(_within(p) for p in kept)", "sum(p.within for p in kept)", tests="tests/reports/variant"),
    Bug("the balance of the coarsest setting", RANKING, "balance=_balance(finest)", "balance=_balance(pile[0])", tests="tests/reports/pages/test_tables.py"),
    Bug("variants and reasons of refusals exchanged", "reports/pages/findings.py", "len(found[code][0]), len(found[code][1])", "len(found[code][1]), len(found[code][0])", tests="tests/reports/pages/test_gathered.py"),
    Bug("a broken law told by the numbers of the first", "reports/pages/troubles.py", "if found[0] == one.kind:", "if found:", tests="tests/reports/pages/test_page_decisions.py"),
    Bug("statements that differ shown as good", "reports/pages/papers.py", 'Assessment.DIFFERS: "bad"', 'Assessment.DIFFERS: "good"', tests="tests/reports/pages/test_page_decisions.py"),
    Bug("the source compared by the last quantity", CASE, "record.quantities[:1]", "record.quantities[-1:]", tests="tests/reports/pages/test_page_decisions.py"),
    Bug("two invocations told as each other", "vv/output/result_lines.py", '(("A", one), ("B", other))', '(("B", one), ("A", other))', tests="tests/output/test_result_lines.py"),
    Bug("a floor of the last error", RUNGS, "return Floor(min(errors), why)", "return Floor(errors[-1], why)", tests="tests/insight/test_floors.py"),
    Bug("errors of what is not judged by its error", RUNGS, "for one in record.quantities if one.judge is JudgeKind.EXACT", "for one in record.quantities", tests="tests/insight/test_floors.py"),
)  # fmt: skip
