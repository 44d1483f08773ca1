"""Reads the few figures of past runs that a history needs, and stores them."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from vv.base import closure
from vv.base.digest import digest
from vv.gate.judgement import counted
from vv.records.job_record import Record
from vv.records.manifest import Machine, Manifest, Provenance
from vv.records.outcomes import Outcome
from vv.records.reading import rung
from vv.store.store import Store

Figures = Mapping[str, Mapping[str, float]]  # scheme -> quantity at a setting -> figure
Head = tuple[tuple[str, ...], Provenance]  # the cases and the provenance of a past run
Read = Callable[[str], tuple[Record, ...]]  # case -> its records
Part = TypeVar("Part")
NOWHERE = Provenance("", "", False, "", Machine("", None, "", ""), {}, 1)  # of damaged runs


@dataclass(frozen=True, slots=True)
class Digest:
    """The figures of a case in a past run, from records with the case's own parameters.

    closeness: error over tolerance; cost: a timed solve in calibration kernels; outcomes: scheme ->
    numbers of outcomes; empty if there are no such records.
    """

    closeness: Figures
    cost: Figures
    outcomes: Mapping[str, Mapping[Outcome, int]]


@dataclass(frozen=True)
class PastRuns:
    """Reads past runs in parts; damaged ones are skipped with one notice.

    The figures of a case are computed once for all runs with the same records of it.
    """

    store: Store
    at_hand: Mapping[str, Manifest]
    passed_over: Callable[[str], None]
    heads: dict[str, Head] = field(default_factory=dict)
    held: dict[str, Mapping[str, str]] = field(default_factory=dict)
    opened: dict[str, Read | None] = field(default_factory=dict)

    def head(self, name: str) -> Head:
        """The cases and the provenance of a past run; no cases if it is damaged."""
        if name not in self.heads:
            head = self._of(name, lambda: self.store.manifests.head(name))
            self.heads[name] = head or ((), NOWHERE)
        return self.heads[name]

    def digest(self, name: str, case: str) -> Digest:
        """The figures of a case in a past run; they are stored when first computed."""
        stored = self._held(name).get(case, "")
        key = digest(stored, _sources())
        known = self.store.facts(Digest, key) if stored else None
        if known is None:
            read = self._records(name, case)
            known = digest_of(read or ())
            if read is not None and stored:
                self.store.keep_facts(key, known)
        return known

    def key_of(self, names: Sequence[str], case: str) -> str:
        """The digest of the records of a case in these runs; empty if one is not stored."""
        held = [self._held(name).get(case, "") for name in names]
        return digest("history", held, _sources()) if held and all(held) else ""

    def _held(self, name: str) -> Mapping[str, str]:
        """Case -> digest of its records in a run; empty if the run is not stored."""
        if name not in self.held:
            key = digest("held", name)
            known = self.store.facts(dict[str, str], key)
            if known is None:
                known = self.store.manifests.digests_of(name)
                if known:
                    self.store.keep_facts(key, known)
            self.held[name] = known
        return self.held[name]

    def _records(self, name: str, case: str) -> Sequence[Record] | None:
        """The records of a case in a past run; None if they are damaged."""
        if name in self.at_hand:
            return [r for r in self.at_hand[name].records if r.case == case]
        if name not in self.opened:  # the cases of a run are requested one after the other
            self.opened.clear()
            self.opened[name] = self._of(name, lambda: self.store.manifests.reader(name))
        read = self.opened[name]
        return self._of(name, lambda: read(case)) if read else None

    def _of(self, name: str, read: Callable[[], Part]) -> Part | None:
        try:
            return read()
        except OSError as error:
            self.passed_over(f"past run {name}: {error.strerror}; skipped")
            return None


def digest_of(records: Iterable[Record]) -> Digest:
    """The figures of the records of a case in one run."""
    own = [record for record in records if not record.modified]
    return Digest(_measured(own, _closeness), _measured(own, _relative), _by_scheme(own))


@functools.cache
def _sources() -> str:
    """The digest of the sources that affect figures, here and in `vv.insight.history`."""
    here = Path(__file__)
    own = [here, here.with_name("history.py")]
    return closure.source_digest(closure.import_closure(own, (here.parents[2],)))


def _measured(
    records: Iterable[Record], measure: Callable[[Record], Mapping[str, float]]
) -> dict[str, dict[str, float]]:
    """Scheme -> place -> figure."""
    found: dict[str, dict[str, float]] = {}
    for record in records:
        for name, value in measure(record).items():
            place = "\n".join((record.variant, rung(record), name))
            found.setdefault(record.label, {})[place] = value
    return found


def _closeness(record: Record) -> dict[str, float]:
    pairs = {one.name: (one.error, one.tolerance) for one in record.quantities}
    return {name: error / bound for name, (error, bound) in pairs.items() if error and bound}


def _relative(record: Record) -> dict[str, float]:
    relative = record.cost.relative
    return {"cost": math.sqrt(relative[0] * relative[1])} if relative else {}


def _by_scheme(records: Sequence[Record]) -> dict[str, Mapping[Outcome, int]]:
    found: dict[str, list[Record]] = {}
    for record in records:
        found.setdefault(record.label, []).append(record)
    return {scheme: counted(own) for scheme, own in found.items()}
