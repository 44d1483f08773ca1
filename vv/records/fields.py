"""Marks fields of records that JSON omits at their default, or writes without their own name."""

from __future__ import annotations

import dataclasses
from typing import Any

OMITTED, SPREAD = "omitted", "spread"  # keys in the metadata of such fields


def optional(default: Any) -> Any:
    """A field that JSON omits if it has its default, which must be empty or None."""
    return dataclasses.field(default=default, metadata={OMITTED: True})


def spread() -> Any:
    """A field whose entries are written beside the other fields, under their own names."""
    return dataclasses.field(default_factory=dict, metadata={SPREAD: True})
