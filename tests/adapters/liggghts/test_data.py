"""Claims about many spheres in LIGGGHTS, which it reads from a file that its deck writes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from adapters.liggghts import ADAPTER, data
from adapters.liggghts.space import space
from tests.support.installed import only_with
from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.scene import Contact, Scene, Spheres, Wall

COUNT, DT = 27, 1e-4


def ask() -> Ask:
    """Unlike spheres that fly at a wall and at each other, and turn."""
    random = np.random.default_rng(2)
    grid = np.stack(np.meshgrid(*[np.arange(3.0)] * 3, indexing="ij"), 3).reshape(-1, 3)
    spheres = Spheres(
        2.1 * grid + 1.1, random.normal(size=(COUNT, 3)), random.uniform(0.9, 1.0, COUNT),
        random.uniform(1.0, 2.0, COUNT), np.ones((COUNT, 3), bool),
        spin=random.normal(size=(COUNT, 3)), free_spin=np.ones((COUNT, 3), bool),
    )  # fmt: skip
    scene = Scene((spheres, Wall(np.zeros(3), np.eye(3)[2])), Contact(1e4, 5e3, 0.5))
    seen = tuple(map(Displacement, range(COUNT)))
    return Ask(scene, History(0.2, 0.2), seen, Knobs(DT))


def solved(scratch: Path) -> Run:
    scratch.mkdir()
    (run,) = ADAPTER.run([ask()], "default", scratch, 0.0)
    assert run.status is Status.RAN, run.reason
    return run


@only_with(ADAPTER)
def test_spheres_of_a_file_move_as_those_created_one_by_one(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """To rounding: masses are made of densities. The box ends behind the wall then."""
    one = solved(tmp_path / "one")
    monkeypatch.setattr(data, "MANY", COUNT)
    monkeypatch.setattr("adapters.liggghts.words.FEW", 5)
    before = space(ask().scene, 0.2)
    monkeypatch.setattr("adapters.liggghts.space.CROWD", COUNT)
    after = space(ask().scene, 0.2)
    assert before.low[2] < -10.0
    assert after.low == pytest.approx([*before.low[:2], -10.0 * ask().scene.spheres.radius.max()])
    assert after.high == pytest.approx(before.high)
    deck = ADAPTER.native(ask(), "default")
    assert "read_data" in deck
    assert "create_atoms" not in deck
    assert f"id <> 1 {COUNT}" in deck
    other = solved(tmp_path / "other")
    for what, path in one.values.items():
        assert np.abs(other.values[what] - path).max() <= 1e-10 * np.abs(path).max()
