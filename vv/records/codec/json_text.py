"""Converts plain data and records to JSON text, and JSON text to plain data."""

from __future__ import annotations

import json
from typing import Any, NoReturn

from vv.records.codec.damaged import MISSING, DamagedError
from vv.records.codec.writing import to_data


def parse(text: str) -> Any:
    """Parse JSON to plain data; raises ValueError if it is invalid or a number is not finite.

    For data that is not a record; records are read with `read`.
    """
    try:
        return json.loads(text, parse_constant=_not_finite)
    except RecursionError:
        raise DamagedError(MISSING, "must not be nested so deeply", "JSON") from None


def render(value: object, **style: Any) -> str:
    """Records, or a container of records, as JSON text; style: as for `json.dumps`."""
    return dump(to_data(value), **style)


def dump(data: object, **style: Any) -> str:
    """Plain data as JSON text; style: as for `json.dumps`."""
    return json.dumps(data, allow_nan=False, **style)


def _not_finite(constant: str) -> NoReturn:
    raise DamagedError(constant, "a number must be finite", "JSON")
