"""Claims about the exact engine on rigid contact: its energy balance, unknowns and cost."""

from __future__ import annotations

from pathlib import Path

import pytest

from adapters.exact import ADAPTER
from tests.scenes.blocks.exact_slides import BOX, ran, slid
from tests.scenes.blocks.sliding_blocks import Frame, incline, random_scene, responding
from vv.ask import Ask, History, Velocity
from vv.scene import Scene


def test_the_energy_is_accounted_for_to_rounding_and_within_its_bound() -> None:
    scenes = [random_scene(seed)[0] for seed in range(10)]
    scenes += [incline(Frame(20), 22.0, 20.0), responding(0.2, 20.0, 0.6)]
    share: dict[str, float] = {}
    for number, scene in enumerate(scenes):
        ledger = ran(scene, 3.0).ledger
        assert ledger is not None
        assert ledger.bound is not None
        size = sum(map(abs, ledger.terms.values()))
        assert ledger.unaccounted <= ledger.bound <= 1e-11 * max(size, ledger.peak), number
        for name, term in ledger.terms.items():
            share[name] = max(share.get(name, 0.0), abs(term) / size)
    assert min(share.values()) > 0.05, share  # no term is always small


def test_a_base_pays_for_friction_and_speed() -> None:
    run = ran(responding(0.5, 1.0, 0.1), 5.0)
    ledger = run.ledger
    assert ledger is not None
    mass = responding(0.5, 1.0, 0.1).blocks[0].mass
    assert ledger.terms["kinetic"] == pytest.approx(mass * run.values[Velocity(1)][-1, 0] ** 2 / 2)
    paid = -ledger.terms["work left to the wall"]
    spent = ledger.terms["kinetic"] + ledger.terms["friction dissipation"]
    assert paid == pytest.approx(spent, rel=1e-13)
    assert spent > 0


def test_the_model_has_one_unknown() -> None:
    scene = responding(0.2, 2.0, 0.6)
    run = ran(scene, 5.0)
    assert run.model is not None
    assert (run.model.unknowns, run.model.terms) == (1, scene.terms())
    assert "out of 3 freedoms; 1 rigid contact with constant normal; 1 sine" in run.model.note
    assert slid(scene, 5.0).series.ndim == 2


@pytest.mark.parametrize("scene", [incline(Frame(20), 22.0, 5.0), responding(0.2, 2.0, 0.6)])
def test_a_solve_takes_some_milliseconds(scene: Scene, tmp_path: Path) -> None:
    (run,) = ADAPTER.run([Ask(scene, History(5.0, 0.01), (BOX,))], "default", tmp_path, 0.05)
    assert 0 < run.cost.solve_cpu < 25e-3
    assert run.cost.setup < 25e-3
