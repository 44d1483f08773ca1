"""Finds the native input of a code for a record, and stores it, since that takes long."""

from __future__ import annotations

import functools
from collections.abc import Callable

from vv.base.digest import digest
from vv.base.errors import UsageError
from vv.case import Case, Trial
from vv.codes.adapter import Adapter
from vv.plan.planning import declare_trial
from vv.plan.project import Project
from vv.records.job_record import Record
from vv.store.store import Store


def native_inputs(project: Project) -> Callable[[Record], str]:
    """A function that returns the input of a record's code in that code's own language."""
    case, adapter = functools.cache(project.load_case), functools.cache(project.load_adapter)
    native = functools.partial(_native, case, adapter, {})
    return functools.partial(_kept, Store(project.data()), native)


def _kept(store: Store, native: Callable[[Record], str], record: Record) -> str:
    """The stored input of a code for a record; it depends only on data that the key covers."""
    key = digest("native input", record.key)
    known = store.facts(str, key) if record.key else native(record)
    if known is None:
        known = native(record)
        store.keep_facts(key, known)
    return known


def _native(
    load_case: Callable[[str], Case],
    load_adapter: Callable[[str], Adapter],
    trials: dict[tuple[str, str], Trial],
    record: Record,
) -> str:
    """The input of a code for a record; empty if the case or the code has changed since."""
    case, variant = record.case, record.variant
    try:
        if (case, variant) not in trials:
            declared = declare_trial(load_case(case), variant, record.parameters)
            trials[case, variant] = declared
        ask = trials[case, variant].study.ask(record.rung)
        return load_adapter(record.code).native(ask, record.scheme)
    except (LookupError, ValueError, UsageError):  # including ProjectError
        return ""
