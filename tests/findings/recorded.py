"""Figures of codes that are not installed, from their recorded results in `cases/recorded`."""

from __future__ import annotations

import functools
from collections.abc import Mapping

from tests.findings.figures import PROJECT, Posed, Read, posed
from vv.ask import Knobs
from vv.case import Level
from vv.gate.all_checks import recorded_of
from vv.gate.baseline import named
from vv.plan.planning import project_knobs
from vv.records import codec
from vv.records.reading import in_words
from vv.records.recorded import RecordedFile, RecordedQuantity


def recorded(name: str, scheme: str, at: Knobs | Level | None, what: Read) -> float | None:
    """The figure of a recorded run; None if none of these parameters and this setting has it."""
    one = _quantities(posed(name, scheme, at)).get(what.quantity)
    return one.figures.get(what.name) if one else None


def _quantities(one: Posed) -> Mapping[str, RecordedQuantity]:
    """What is recorded of an ask, by quantity; nothing of other parameters or another setting."""
    kept = _kept(one.adapter.name, one.case)
    if kept is None or kept.parameters.get(one.variant) != one.given:
        return {}
    label = f"{one.adapter.name}/{one.scheme.name}"
    setting = in_words(project_knobs(one.ask.knobs, one.scheme))
    run = kept.results.get(named(one.variant, label, setting))
    return run.quantities if run else {}


@functools.cache
def _kept(code: str, case: str) -> RecordedFile | None:
    """The recorded results of a code on a case."""
    path = recorded_of(PROJECT) / code / f"{case}.json"
    if not path.is_file():
        return None
    return codec.read(RecordedFile, codec.parse(path.read_text(encoding="utf-8")), "recorded")
