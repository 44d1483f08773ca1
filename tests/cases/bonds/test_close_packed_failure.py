"""Claims about the case of a block that is pressed to failure: where a slope is taken."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from cases.bonds.close_packed_failure import CASE, _Pressed
from reference_solutions.bonds import tetrahedral_unit
from reference_solutions.bonds.lattice_material import Element

USUAL = CASE.defaults("82")
SLIDES = abs(
    tetrahedral_unit.sliding_failure(
        Element(*(USUAL[name] for name in ("kn", "ks", "xb", "fs0", "mu_p"))), USUAL["d"]
    ).strain
)  # the strain at which inclined bonds slide


def pressed(last: float) -> _Pressed:
    """A block whose last level bond opens at this strain."""
    history: Any = SimpleNamespace(strain=[0.5 * last, last])
    unused: Any = None
    return _Pressed(USUAL, unused, lambda: (history,), [])


@pytest.mark.parametrize(
    ("last", "low", "high"), [(0.4, 0.44, 0.8), (0.6, 0.66, 0.9), (0.73, 0.803, 0.9)]
)
def test_the_slope_is_taken_after_the_last_opening_and_before_bonds_slide(
    last: float, low: float, high: float
) -> None:
    """From a tenth beyond it to twice it, or to nine tenths of the strain at which bonds slide."""
    assert pressed(last * SLIDES).window() == pytest.approx((low * SLIDES, high * SLIDES))


def test_where_bonds_slide_soon_after_the_last_opening_no_slope_is_taken() -> None:
    with pytest.raises(ValueError, match="bonds slide soon after the last one opens"):
        pressed(0.74 * SLIDES).window()
