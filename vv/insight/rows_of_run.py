"""Compares statements of papers with an invocation; the rows are stored until either changes."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from pathlib import Path

from vv.ask import Status
from vv.base import closure
from vv.base.digest import digest
from vv.case.published import Paper
from vv.gate.baseline import name_of, result_of
from vv.insight import papers as insight
from vv.insight.papers import Row
from vv.plan.project import Project
from vv.plan.published import files
from vv.records.accepted import AcceptedResult
from vv.records.manifest import Manifest
from vv.store.store import Store


def rows_of_run(
    papers: Sequence[Paper], project: Project, manifest: Manifest
) -> tuple[tuple[Row, ...], ...]:
    """The rows of each paper, computed again if records, baselines or sources have changed."""
    results = functools.cache(functools.partial(_results, project, manifest))
    store = Store(project.data())
    records = store.manifests.digests_of(manifest.name)
    sources = _sources(project) if records else ""
    found = []
    for paper in papers:
        key = _key_of_rows(paper, project, sources, records) if records else ""
        rows = store.facts(tuple[Row, ...], key) if key else None
        if rows is None or len(rows) != len(paper.statements):
            rows = insight.rows(paper, results)
            if key:
                store.keep_facts(key, rows)
        found.append(rows)
    return tuple(found)


def _sources(project: Project) -> str:
    """The digest of the sources that list the papers and make the rows."""
    of = [*files(project), Path(insight.__file__)]
    return closure.source_digest(closure.import_closure(of, project.roots))


def _key_of_rows(paper: Paper, project: Project, sources: str, records: Mapping[str, str]) -> str:
    """The digest of everything that the rows depend on; records: case -> digest of them."""
    cases = sorted({it.case for one in paper.statements for it in one.computed})
    folders = [root / "cases" / "baselines" for root in project.roots]
    accepted = [folder / f"{case}.json" for folder in folders for case in cases]
    return digest(
        "rows of a paper",
        paper.name,
        sources,
        closure.source_digest([path for path in accepted if path.is_file()]),
        [records.get(case, "") for case in cases],
    )


def _results(project: Project, manifest: Manifest, case: str) -> Mapping[str, AcceptedResult]:
    """The accepted results of a case, and those of the invocation."""
    from vv.gate.all_checks import baseline_of

    known = baseline_of(project, case)
    own = (r for r in manifest.records if r.case == case)
    ran = (r for r in own if r.status is Status.RAN and not r.modified)
    return {**(known.results if known else {}), **{name_of(r): result_of(r, "") for r in ran}}
