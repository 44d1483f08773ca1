"""Checks that stored series belong to a record: its figures must follow from them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from vv.records.outcomes import QuantityKind
from vv.records.quantity import MeasuredQuantity
from vv.records.record import error_in
from vv.scene import Vector

NUMBERS = "fiu"  # kinds of arrays
SUMMED = 1e-9  # relative: another machine may sum in another order, which changes about 1e-16 n

Said = tuple[
    str, float | None, float, float
]  # name, value in the record, value from the series, scale


def check_series(arrays: Mapping[str, Any], quantities: Iterable[MeasuredQuantity]) -> None:
    """Raise ValueError unless these quantities were measured from these series."""
    own = [one for one in quantities if one.kind is QuantityKind.SERIES]
    due = {"t"} if own else set[str]()
    for one in own:
        due |= {f"{one.name}.{part}" for part in _parts(one)}
    if arrays.keys() != due:
        raise ValueError(f"it holds {_listed(arrays)} instead of {_listed(due)}")
    for name, values in arrays.items():
        if (
            values.dtype.kind not in NUMBERS
            or values.shape != (len(arrays["t"]),)
            or not len(values)
        ):
            raise ValueError(f"{name} is not a series with a number at each time")
    for one in own:
        _check(one, *(arrays[f"{one.name}.{part}"] for part in _parts(one)))


def _parts(one: MeasuredQuantity) -> tuple[str, ...]:
    """The stored parts of a series; one with a final reference or an error has a reference."""
    compared = one.end is not None or bool(one.errors)
    return ("value", "reference") if compared else ("value",)


def _listed(names: Iterable[str]) -> str:
    return ", ".join(sorted(names)) or "nothing"


def _check(one: MeasuredQuantity, value: Vector, reference: Vector | None = None) -> None:
    """Raise ValueError if a figure of the record does not follow from the series."""
    with np.errstate(all="ignore"):
        for what, said, seen, size in _figures(one, value, reference):
            known = math.nan if said is None else said
            both_unknown = said is None and not math.isfinite(seen)
            if not both_unknown and not abs(known - seen) <= SUMMED * size:
                raise ValueError(f"{what} of {one.name} is {seen:g}, its record says {said}")


def _figures(one: MeasuredQuantity, value: Vector, reference: Vector | None) -> Iterator[Said]:
    """The figures of a series that the record states."""
    size = _largest(value)
    own = {"final": float(value[-1]), "mean": float(value.mean())}
    for name, said in one.figures.items():
        yield name, said, own.get(name, math.nan), size
    if reference is None:
        return
    yield "the end", one.end, float(reference[-1]), _largest(reference)
    for norm, said in one.errors.items():
        seen = error_in(norm, value, reference, one.scale or math.nan)
        yield f"the {norm.value} error", said, seen, seen


def _largest(values: Vector) -> float:
    """The largest absolute value among the finite ones."""
    return float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
