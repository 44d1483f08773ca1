"""The columns of the energy table that the kernel fills."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from vv.scene import Form, Vector

FORMS = tuple(Form)  # the columns, in their order
WIDTHS = (7, 9, 12)  # widths of tables: up to gravity and loads, up to shaking and walls, and whole


def column(form: Form) -> int:
    """The column of a form of energy."""
    return FORMS.index(form)


def width(booked: Iterable[Form]) -> int:
    """The width of a table that has columns for these forms of energy."""
    last = max(map(column, booked), default=0)
    return next(width for width in WIDTHS if last < width)


def signed(energy: Vector) -> Vector:
    """The forms of energy [J] of a kernel's table: work done on the scene becomes negative."""
    signs = np.array([1.0] * 5 + [-1.0] * 5 + [1.0] * 2)
    return np.asarray(energy * signs[: energy.shape[1]] + 0.0)
