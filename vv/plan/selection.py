"""Finds the cases and variants, or the codes and schemes, that patterns select."""

from __future__ import annotations

import fnmatch
import itertools
from collections.abc import Iterable, Mapping, Sequence

from vv.base.errors import UsageError
from vv.base.hints import name_hint
from vv.case import Case
from vv.codes.adapter import Adapter, Scheme
from vv.plan.project import Project

LONGEST = (
    200  # the most characters of a pattern: names are short, and thousands of stars take minutes
)


def select(project: Project, selection: Sequence[str]) -> list[tuple[Case, str]]:
    """(case, variant name) pairs for patterns FAMILY, CASE or CASE:VARIANT, in file order."""
    wanted: dict[str, set[str]] = {}
    for pattern in selection:
        for name, variants in _matching_variants(project, pattern).items():
            wanted.setdefault(name, set()).update(variants)
    return [
        (case, variant.name)
        for case in project.load_cases(n for n in project.case_names() if n in wanted)
        for variant in case.variants
        if variant.name in wanted[case.name]
    ]


def _matching_variants(project: Project, pattern: str) -> dict[str, list[str]]:
    """Case -> its variants that match a pattern; raises UsageError if nothing matches."""
    _check_length(pattern)
    case_pattern, _, variant_pattern = pattern.partition(":")
    families = project.families()
    hits = [n for n, f in families.items() if fnmatch.filter((n, f), case_pattern)]
    if not hits:
        raise UsageError(f"no case or family '{case_pattern}'{_hint(project, case_pattern)}")
    known = {case.name: [v.name for v in case.variants] for case in project.load_cases(hits)}
    found = {name: fnmatch.filter(own, variant_pattern or "*") for name, own in known.items()}
    if not any(found.values()):
        names = itertools.chain.from_iterable(known.values())
        hint = name_hint(variant_pattern, names)
        raise UsageError(f"{case_pattern} has no variant '{variant_pattern}'{hint}")
    return found


def _check_length(pattern: str) -> None:
    """Raise UsageError for a pattern that is no name of anything."""
    if len(pattern) > LONGEST:
        what = f"a pattern of {len(pattern)} characters, '{pattern[:20]}...'"
        raise UsageError(f"{what}; at most {LONGEST} are read")


def _hint(project: Project, name: str) -> str:
    """A suggestion for a name that is neither a case nor a family."""
    families = project.families()
    for case in project.load_cases(list(families)):
        if name in {variant.name for variant in case.variants}:
            return f"; it is a variant: say {case.name}:{name}"
    return name_hint(name, {*families, *families.values()})


def named_adapters(project: Project, patterns: Iterable[str]) -> dict[str, Adapter]:
    """Adapters that match patterns CODE or CODE/SCHEME; all of them if a pattern matches none."""
    names, patterns = project.adapter_names(), tuple(patterns)
    for pattern in patterns:
        _check_length(pattern)
    hits = [fnmatch.filter(names, pattern.partition("/")[0]) for pattern in patterns]
    wanted = {name for hit in hits for name in hit} if hits and all(hits) else set(names)
    return {name: project.load_adapter(name) for name in names if name in wanted}


def choose_schemes(
    adapters: Mapping[str, Adapter], patterns: Iterable[str]
) -> list[tuple[Adapter, Scheme]]:
    """Pairs of adapter and scheme that match CODE or CODE/SCHEME; CODE means all its schemes.

    Raises UsageError for a pattern that matches nothing.
    """
    labels = {f"{a.name}/{s.name}": (a, s) for a in adapters.values() for s in a.schemes}
    chosen: dict[str, tuple[Adapter, Scheme]] = {}
    for pattern in patterns:
        full = pattern if "/" in pattern else f"{pattern}/*"
        hits = [label for label in labels if fnmatch.fnmatchcase(label, full)]
        if not hits:
            known = [*labels, *adapters]
            raise UsageError(f"no code '{pattern}'{name_hint(pattern, known)}")
        chosen.update((label, labels[label]) for label in hits)
    return [pair for label, pair in labels.items() if label in chosen]
