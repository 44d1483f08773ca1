"""The columns of the table of energies that the kernel fills."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from vv.scene import Form, Vector

FORMS = tuple(Form)  # the columns, in their order
WIDTHS = (7, 9, 12)  # of tables: with gravity and loads, with shaking and walls, with all


def column(form: Form) -> int:
    """Where a form of energy is booked."""
    return FORMS.index(form)


def width(booked: Iterable[Form]) -> int:
    """How many columns there are where these forms are booked."""
    last = max(map(column, booked), default=0)
    return next(width for width in WIDTHS if last < width)


def signed(energy: Vector) -> Vector:
    """The forms of energy [J] of a table as the kernel wrote it: work done on a scene is less."""
    signs = np.array([1.0] * 5 + [-1.0] * 5 + [1.0] * 2)
    return np.asarray(energy * signs[: energy.shape[1]] + 0.0)
