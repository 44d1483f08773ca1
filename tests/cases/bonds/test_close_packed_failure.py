"""Claims about the case of a block that is pressed to failure: where a slope is taken."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from cases.bonds.close_packed_failure import CASE, UNSEEN
from cases.bonds.parts._pressed_block import PULLED, Pressed
from reference_solutions.bonds import lattice_failure, tetrahedral_unit
from reference_solutions.bonds.close_packed_lattice import SIZES, lattice
from reference_solutions.bonds.lattice_material import Element
from vv.case import Shown

USUAL = CASE.defaults("82")
SLIDES = abs(
    tetrahedral_unit.sliding_failure(
        Element(*(USUAL[name] for name in ("kn", "ks", "xb", "fs0", "mu_p"))), USUAL["d"]
    ).strain
)  # the strain at which inclined bonds slide


def pressed(last: float) -> Pressed:
    """A block whose last level bond opens at this strain."""
    history: Any = SimpleNamespace(strain=[0.5 * last, last])
    unused: Any = None
    return Pressed(USUAL, unused, lambda: (history,), [])


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


@pytest.mark.parametrize(("ks", "unequal"), [(0.1, True), (0.5, False), (1.01, False)])
@pytest.mark.parametrize("variant", ["82", "82-counted"])
def test_what_takes_equal_loads_is_not_judged_where_inclined_bonds_may_be_pulled_open(
    variant: str, ks: float, unequal: bool
) -> None:
    """At a tenth of the shear stiffness two of them open, and the slope is 1 % below its value."""
    name = {"82": "E after", "82-counted": "all opened"}[variant]
    trial = CASE.declare(variant, {**USUAL, "ks": ks * USUAL["ks"]})
    (judge,) = (one.judge for one in trial.quantities if one.name == name)
    assert (isinstance(judge, Shown) and judge.reason == PULLED) == unequal


@pytest.mark.parametrize("ks", [0.068, 0.1, 0.3])
def test_the_first_opening_is_bounded_by_the_strain_between_outputs_over_its_own(ks: float) -> None:
    """On weak shear springs it is less than the 0.6 of Eq. 8 that it is at the usual ones."""
    trial = CASE.declare("82", {**USUAL, "ks": ks * USUAL["ks"]})
    (judge,) = (one.judge for one in trial.quantities if one.name == "A3")
    (bound,) = {one.value for one in judge.tolerances.values()}  # type: ignore[union-attr]
    history = lattice_failure.pressed(
        lattice(*SIZES[82], USUAL["d"]), USUAL["kn"], ks * USUAL["ks"], USUAL["xb"]
    )
    apart = trial.study.goal.interval * abs(USUAL["rate"])
    assert apart / history.strain[0] < bound < apart / history.strain[0] + 0.01


@pytest.mark.parametrize(("kn", "seen"), [(0.254, False), (0.362, True), (1.01, True)])
def test_the_first_opening_is_not_judged_where_it_hardly_lowers_the_pressure(
    kn: float, seen: bool
) -> None:
    """On normal springs of a quarter it lowers it by 1.5e-3; what is observed is 9 % above."""
    trial = CASE.declare("82", {**USUAL, "kn": kn * USUAL["kn"]})
    (judge,) = (one.judge for one in trial.quantities if one.name == "A3")
    assert (judge == Shown(UNSEEN)) != seen
