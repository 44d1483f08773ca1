"""Claims about the map of stable steps: the parameters that change with the stiffness."""

from __future__ import annotations

import pytest

from cases.stability.stability_map import CASE
from vv.case import Grid


@pytest.mark.parametrize("kn", [1e5, 1e9, 1e12])
def test_a_unit_on_stiffer_bonds_is_as_much_heavier_and_swings_as_fast(kn: float) -> None:
    study = CASE.declare("unit", CASE.defaults("unit")).study
    assert isinstance(study, Grid)
    assert study.scene_with_kn is not None
    own, other = study.scene, study.scene_with_kn(kn)
    assert own.bonds is not None
    assert other.bonds is not None
    assert other.bonds.kn == pytest.approx(kn)
    stiffer, heavier = kn / own.bonds.kn[0], other.spheres.mass / own.spheres.mass
    assert heavier / stiffer == pytest.approx(1.0)
