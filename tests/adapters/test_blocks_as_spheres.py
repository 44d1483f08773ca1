"""Claims about blocks in codes of spheres: one sphere if it cannot turn, four at its corners."""

import pytest

from adapters.liggghts import ADAPTER as LIGGGHTS
from adapters.yade import ADAPTER as YADE
from cases.blocks.incline import CASE as INCLINE
from cases.blocks.responding_block import CASE as RESPONDING
from tests.support.adapters import liggghts_asks, yade_asks
from vv.ask import Ask, Knobs
from vv.case import Case
from vv.codes import Adapter

CODES = [
    (LIGGGHTS, liggghts_asks.PLAIN, liggghts_asks.CLUMP),
    (YADE, yade_asks.PLAIN, yade_asks.CLUMP),
]


def ask_of(case: Case, variant: str) -> Ask:
    study = case.declare(variant, case.defaults(variant)).study
    return study.ask(Knobs(dt=1e-4, kn=1e9))


@pytest.mark.parametrize("case", [INCLINE, RESPONDING], ids=lambda case: case.name)
@pytest.mark.parametrize(("code", "plain", "clump"), CODES, ids=["liggghts", "yade"])
def test_every_variant_with_a_block_is_run_as_a_sphere_if_it_cannot_turn(
    code: Adapter, plain: str, clump: str, case: Case
) -> None:
    for variant in case.variants:
        ask = ask_of(case, variant.name)
        assert ask.scene.terms() <= code.schemes[0].terms
        assert code.refuses(ask, clump) is None
        assert "4 spheres of 0.01" in code.describe(ask, clump).note
        if ask.scene.blocks[0].free_spin.any():
            assert "may turn; a sphere would roll" in (code.refuses(ask, plain) or "")
            continue
        assert code.refuses(ask, plain) is None
        model = code.describe(ask, plain)
        assert ask.scene.terms() <= model.terms
        assert "a sphere of its mass stands for a block" in model.note
        assert "kn = 1e+09, ks = 2.5e+10 N/m" in model.note


@pytest.mark.parametrize("case", [INCLINE, RESPONDING], ids=lambda case: case.name)
def test_yade_integrates_the_freedoms_of_the_block_alone(case: Case) -> None:
    asks = [ask_of(case, variant.name) for variant in case.variants]
    for ask in (ask for ask in asks if not ask.scene.blocks[0].free_spin.any()):
        assert YADE.describe(ask, yade_asks.PLAIN).unknowns == ask.scene.unknowns()
