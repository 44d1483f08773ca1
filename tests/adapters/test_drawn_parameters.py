"""Claims that YADE and LIGGGHTS are green at parameters that were drawn by chance."""

from __future__ import annotations

from pathlib import Path

import pytest

from bench.chance.holdouts import Draw, judged
from tests.support.installed import require
from vv.plan.project import find

PROJECT = find(Path(__file__))
STICKS = (
    "rho=2.81e3", "r1=0.126", "r2=0.0679", "kn=6.41e6", "ks=5e6", "mu=0.384", "gap=8.66e-5",
    "v_n=0.0389", "v_t=0.0218", "w1=0.214", "w2=-0.254",
)  # fmt: skip


@pytest.mark.parametrize(
    ("code", "variant", "settings"),
    [
        ("yade", "held", ("r1=0.0588", "mu=0.295", "gap=0.000112")),
        ("yade", "held", ("kn=4.02e10",)),
        ("yade", "again", ("rho=1.11e3", "ks=2.36e6", "v_n=0.0146")),
        ("yade", "pair", STICKS),
        ("liggghts", "pair", STICKS),
        ("liggghts", "again", ("mu=0.417", "gap=0.00012", "w1=0.532")),
    ],
)
def test_a_shear_spring_that_a_whole_step_loads_has_no_order_where_contacts_close_by_chance(
    code: str,
    variant: str,
    settings: tuple[str, ...],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    monkeypatch.setenv("VV_DATA", str(tmp_path))
    require(PROJECT.load_adapter(code))
    assert judged(PROJECT, Draw("bounce", variant, settings), code) == ("green", [])
