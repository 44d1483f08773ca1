"""Claims that a parameter without effect is declared inert, also where it is nil by default."""

from __future__ import annotations

import numpy as np
import pytest

from vv.case import Case
from vv.output.gallery.declared_numbers import Lines, numbers
from vv.plan.project import find
from vv.plan.selection import select

OTHER = (1e-3, 1.0)  # values of a parameter that is nil by default; a case may refuse either
NIL = [
    (case, variant, name)
    for case, variant in select(find(), ["*"])
    for name, value in case.defaults(variant).items()
    if value == 0.0 and name not in case.variant(variant).inert
]


def declared(case: Case, variant: str, name: str, value: float) -> Lines | None:
    """All that is declared with this value, but for the value itself; None if it is refused."""
    try:
        with np.errstate(all="ignore"):
            own = {**case.defaults(variant), name: value}
            lines = numbers(case, case.variant(variant), own)
    except (ValueError, ArithmeticError):
        return None
    return {what: said for what, said in lines.items() if what != f"parameter {name}"}


@pytest.mark.parametrize(
    ("case", "variant", "name"), NIL, ids=[f"{c.name}:{v} {name}" for c, v, name in NIL]
)
def test_a_parameter_that_is_nil_by_default_has_an_effect_or_is_declared_inert(
    case: Case, variant: str, name: str
) -> None:
    usual = declared(case, variant, name, 0.0)
    others = [declared(case, variant, name, value) for value in OTHER]
    assert any(other is None or other != usual for other in others)
