"""Claims, without LIGGGHTS, about what stands for a block: a sphere or a rigid body of spheres."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from adapters.liggghts import ADAPTER
from tests.scenes.blocks.sliding_blocks import Frame, incline
from tests.support.adapters.liggghts_asks import CLUMP, PLAIN, deck_of, words
from tests.support.adapters.small_asks import DT, block_ask, case_ask
from vv.ask import Knobs
from vv.standins.stand_in import spring_scene


def test_a_charge_is_a_step_before_time_starts_that_ends_where_the_sphere_begins() -> None:
    ask = block_ask(incline(Frame(28.0, turn=0.4), 15.0, v0=0.2))
    text, springs = deck_of(ask, PLAIN), spring_scene(ask)
    assert springs.charged is not None
    (created,) = words(text, "create_atoms")
    *_, slid = words(text[: text.index("fix slid")], "set", "atom")
    way = DT * np.array(slid[2::2], float)
    start = np.array(created[2:5], float)
    assert start + way == pytest.approx(springs.scene.spheres.position[0], abs=1e-15)
    assert -springs.scene.contact.ks * way == pytest.approx(springs.charged[0], rel=1e-12)
    after = text[text.index("unfix slid") :]
    (speeds,) = words(after, "set", "atom")
    assert np.array(speeds[2::2], float) == pytest.approx(0.2 * Frame(28.0, turn=0.4).dip)
    assert after.index("reset_timestep") < after.index(" nve") < after.index("run  ")
    assert "slid" not in deck_of(case_ask("T3"), PLAIN)


def test_a_rigid_body_has_the_sphere_s_springs_and_the_rotations_of_the_block() -> None:
    scene = incline(Frame(28.0), 15.0, A=2.0)
    turning = dataclasses.replace(scene.blocks[0], free_spin=np.array([False, True, False]))
    ask = block_ask(dataclasses.replace(scene, bodies=(*scene.walls, turning)))
    text, alone = deck_of(ask, CLUMP), deck_of(block_ask(scene), PLAIN)
    for name in ("kn", "kt"):
        springs = [float(words(deck, "fix", name)[0][-1]) for deck in (text, alone)]
        assert springs[0] * 4 == springs[1]
    masses = [float(line[4]) for line in words(text, "set", "atom") if line[1] == "diameter"]
    assert len(masses) == 1 + 4 + 8
    assert sum(masses) == pytest.approx(scene.blocks[0].mass, rel=1e-15)
    fixes = [line[0] for line in words(text, "fix")]
    assert fixes.index("body") > max(fixes.index("weight"), fixes.index("shake0"))
    (freedoms,) = (" ".join(line) for line in words(text, "fix", "body"))
    assert freedoms == "all rigid single force 1 on on on torque 1 off on off"
    assert not [line for line in words(text, "fix") if line[2] in ("nve", "nve/sphere")]


def test_numpy_scalars_are_written_as_numbers() -> None:
    knobs = Knobs(np.float64(DT), np.float64(1e9))
    ask = dataclasses.replace(block_ask(incline(Frame(28.0), 15.0, A=2.0)), knobs=knobs)
    for scheme in (PLAIN, CLUMP):
        assert "float64" not in ADAPTER.native(ask, scheme)
