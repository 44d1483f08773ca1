"""What accuracy costs: from records to the cost of an error, the front, and who is fastest.

Errors count from every rung, costs only from timed ones, which are of one session.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from vv.ask import Status
from vv.finding import label
from vv.gate import status_of
from vv.metrics import Convergence, Order, convergence, observed_order

Record = Mapping[str, Any]
TARGETS = (1e-2, 1e-3, 1e-4, 1e-6)  # relative errors that users ask for
STALLED = 1.5  # refinements that improve by less, twice in a row, have met a floor
PATIENCE = 60.0  # CPU seconds after which a code has had its chance
LEAST = 1e-17  # stands for an error of zero on a logarithmic scale


@dataclass(frozen=True)
class Point:
    """A rung: its knobs, its largest judged error, its CPU seconds (None: not timed).

    error None: it gave none that is finite. spread: of its repeats, relative.
    """

    dt: float | None
    kn: float | None
    error: float | None
    cpu: float | None
    spread: float


@dataclass(frozen=True)
class Floor:
    """The error a scheme does not get below, and how that was seen."""

    error: float
    why: str


@dataclass(frozen=True)
class Reach:
    """What an error costs a scheme. cpu None: it was not reached. bound: it costs that at most.

    point: the cheapest timed rung that is as accurate.
    """

    cpu: float | None
    bound: bool = False
    point: Point | None = None


@dataclass(frozen=True)
class Effort:
    """A scheme on a variant; points by stiffness and step, coarsest first."""

    case: str
    variant: str
    label: str
    external: bool
    points: tuple[Point, ...]
    orders: tuple[tuple[float | None, Order], ...]
    limits: tuple[tuple[float | None, Convergence], ...]
    floor: Floor | None

    @property
    def stepping(self) -> bool:
        """Whether it advances by time steps."""
        return any(point.dt is not None for point in self.points)

    @property
    def best(self) -> float | None:
        """Its smallest error."""
        return min((p.error for p in self.points if p.error is not None), default=None)


def efforts(manifest: Mapping[str, Any]) -> list[Effort]:
    """Every scheme that ran on a variant of which something was timed, in the order of records."""
    piles: dict[tuple[str, str, str], list[Record]] = {}
    for record in manifest["records"]:
        if status_of(record) not in (Status.REFUSED, Status.NOT_INSTALLED):
            key = (record["case"], record["variant"], label(record))
            piles.setdefault(key, []).append(record)
    found = [_effort(key, pile, manifest["codes"]) for key, pile in piles.items()]
    timed = {(e.case, e.variant) for e in found if any(p.cpu is not None for p in e.points)}
    return [effort for effort in found if (effort.case, effort.variant) in timed]


def _effort(key: tuple[str, str, str], pile: Sequence[Record], codes: Mapping[str, Any]) -> Effort:
    pile = sorted(pile, key=lambda r: (r["rung"]["kn"] or 0.0, -(r["rung"]["dt"] or 0.0)))
    points = tuple(_point(record) for record in pile)
    orders, limits = [], []
    for kn in dict.fromkeys(point.kn for point in points):
        row = [p for p in points if p.kn == kn and p.dt and p.error]
        order = observed_order([p.dt or 0.0 for p in row], [p.error or 0.0 for p in row])
        orders += [(kn, order)] if order else []
        limit = _limit([record for record in pile if record["rung"]["kn"] == kn])
        limits += [(kn, limit)] if limit else []
    external = bool(codes[pile[0]["code"]]["files"])
    return Effort(*key, external, points, tuple(orders), tuple(limits), _floor(points))


def _point(record: Record) -> Point:
    cost = record["cost"]
    timed = cost["kind"] == "timed" and cost["solve_cpu"] > 0
    return Point(
        record["rung"]["dt"],
        record["rung"]["kn"],
        _error(record),
        cost["solve_cpu"] if timed else None,
        cost["spread"],
    )


def _error(record: Record) -> float | None:
    """The largest error that is judged; None where one of them is missing."""
    judged = [e for e in record["quantities"] if e["judge"] == "exact"]
    errors = [entry["errors"].get(entry["norm"] or "max") for entry in judged]
    return max(errors) if errors and None not in errors else None


def _limit(pile: Sequence[Record]) -> Convergence | None:
    """What the final values of the three finest steps say by themselves, of the first quantity."""
    ran = [r for r in pile if r["rung"]["dt"] and r["quantities"]][-3:]
    finals = [r["quantities"][0]["figures"].get("final") for r in reversed(ran)]
    if len(finals) < 3 or None in finals:
        return None
    steps = tuple(r["rung"]["dt"] for r in reversed(ran))
    return convergence(steps, tuple(finals))


def _floor(points: Sequence[Point]) -> Floor | None:
    """The floor of a scheme, if each of its knobs was refined twice for next to nothing."""
    rows: dict[float | None, list[float]] = {}
    for point in points:
        if point.error is not None:
            rows.setdefault(point.kn, []).append(point.error)
    if not rows:
        return None
    best = min(min(row) for row in rows.values())
    spent = max((point.cpu or 0.0 for point in points), default=0.0)
    if spent >= PATIENCE:
        return Floor(best, f"{spent:.0f} s were spent")
    stiffest = list(rows.values())[-1]
    if _stalled(stiffest) and (len(rows) == 1 or _stalled([row[-1] for row in rows.values()])):
        return Floor(best, f"two refinements of each knob improved less than {STALLED:g} times")
    return None


def _stalled(errors: Sequence[float]) -> bool:
    pairs = list(itertools.pairwise(errors))[-2:]
    return len(pairs) == 2 and all(before < STALLED * after for before, after in pairs)


def reach(effort: Effort, target: float) -> Reach:
    """What an error costs: interpolated between rungs on logarithmic scales."""
    timed = [
        (p.cpu, max(p.error, LEAST), p) for p in effort.points if p.cpu and p.error is not None
    ]
    before: tuple[float, float] | None = None
    for cpu, error, point in sorted(timed, key=lambda row: (row[0], row[1])):
        if error <= target:
            if before is None:
                return Reach(cpu, True, point)
            share = math.log(before[1] / target) / math.log(before[1] / error)
            return Reach(before[0] * (cpu / before[0]) ** share, False, point)
        if before is None or error < before[1]:
            before = cpu, error
    return Reach(None)


def front(every: Iterable[Effort]) -> list[tuple[str, Point]]:
    """(label, point) of the timed rungs that none beats in both error and cost, cheapest first."""
    timed = [
        (p.cpu, p.error, effort.label, p)
        for effort in every
        for p in effort.points
        if p.cpu is not None and p.error is not None
    ]
    kept: list[tuple[str, Point]] = []
    least = math.inf
    for _, error, name, point in sorted(timed, key=lambda row: row[:3]):
        if error < least:
            kept.append((name, point))
            least = error
    return kept


@dataclass(frozen=True)
class Duel:
    """The best of our own engines against the best external code at an error, on a variant.

    ratio: our cost over theirs; None where one of them does not get there; loose: theirs may be
    cheaper, as their coarsest timed rung is more accurate already. ours, theirs: labels, '' for
    nobody; least: the smallest error of the external codes, if they do not get there.
    """

    case: str
    variant: str
    target: float
    stepping: bool
    ours: str
    theirs: str
    ratio: float | None
    loose: bool
    least: float | None


def duels(every: Sequence[Effort], targets: Sequence[float]) -> list[Duel]:
    """One for each variant and error, over all our engines and over those that step in time."""
    variants = dict.fromkeys((e.case, e.variant) for e in every if e.external)
    found = []
    for case, variant in variants:
        here = [e for e in every if (e.case, e.variant) == (case, variant)]
        theirs = [e for e in here if e.external]
        for target in targets:
            for stepping in (False, True):
                ours = [e for e in here if not e.external and (e.stepping or not stepping)]
                found.append(_duel(case, variant, target, stepping, ours, theirs))
    return found


def _duel(
    case: str,
    variant: str,
    target: float,
    stepping: bool,
    ours: Sequence[Effort],
    theirs: Sequence[Effort],
) -> Duel:
    mine, other = _cheapest(ours, target), _cheapest(theirs, target)
    ratio = mine[0] / other[0] if mine and other else None
    least = min((e.best for e in theirs if e.best is not None), default=None)
    return Duel(
        case, variant, target, stepping, mine[1] if mine else "", other[1] if other else "",
        ratio, bool(other and other[2]), None if other else least,
    )  # fmt: skip


def _cheapest(every: Sequence[Effort], target: float) -> tuple[float, str, bool] | None:
    found = [(reach(effort, target), effort.label) for effort in every]
    return min(((r.cpu, name, r.bound) for r, name in found if r.cpu is not None), default=None)


def profile(every: Sequence[Effort], target: float) -> dict[str, list[float]]:
    """Label -> how many times the cheapest each variant cost it, sorted; inf where it failed.

    The share of entries up to a factor is the performance profile of Dolan and More (2002).
    Variants that nobody solves to the target are left out.
    """
    names = dict.fromkeys(e.label for e in every)
    ratios: dict[str, list[float]] = {name: [] for name in names}
    for place in dict.fromkeys((e.case, e.variant) for e in every):
        here = {e.label: reach(e, target).cpu for e in every if (e.case, e.variant) == place}
        best = min((cpu for cpu in here.values() if cpu is not None), default=None)
        if best is not None:
            for name in names:
                cpu = here.get(name)
                ratios[name].append(math.inf if cpu is None else cpu / best)
    return {name: sorted(row) for name, row in ratios.items()}
