"""Claims about native input of the in-house codes: it is the ask, bit for bit, and it runs."""

from __future__ import annotations

import dataclasses
import subprocess
import sys
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests import ROOT
from tests.scenes.blocks.block_scenes import box
from tests.scenes.small_scenes import small_scene
from vv.ask import Ask, Displacement, History, Knobs, Status, Strain, Velocity
from vv.base.digest import digest
from vv.codes import python_script, source
from vv.scene import Block, Contact, Elastic, Form, Harmonic, Scene, Spheres, Wall

NAMES = {
    kind.__name__: kind
    for kind in (
        Ask,
        Block,
        Contact,
        Displacement,
        Elastic,
        Form,
        Harmonic,
        History,
        Knobs,
        Scene,
        Spheres,
        Strain,
        Velocity,
    )
} | {"Wall": Wall, "np": np}


def rebuilt(ask: Ask) -> object:
    return eval(source(ask), NAMES)


@given(st.integers(0, 10**6), st.sampled_from([None, 1e-4]))
def test_the_text_is_the_ask_bit_for_bit(seed: int, dt: float | None) -> None:
    seen = (Displacement(1), Velocity(1))
    forms = (Form.KINETIC, Form.BROKEN_SHEAR)
    ask = Ask(small_scene(seed), History(0.4, 1e-3), seen, Knobs(dt=dt), energies=forms)
    assert digest(rebuilt(ask)) == digest(ask)


def test_rigid_contact_and_moving_walls_are_written_too() -> None:
    motion = Harmonic(np.array([0.1, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    wall = Wall(np.zeros(3), np.array([0.0, 1.0, 0.0]), motion)
    scene = Scene((wall, small_scene(1).spheres), Contact(np.inf, mu=0.5), shaking=motion)
    ask = Ask(scene, History(0.4, 1e-3), ())
    assert digest(rebuilt(ask)) == digest(ask)


def test_blocks_that_strain_are_written_with_their_law() -> None:
    law = Elastic(1e9, 0.2)
    scene = Scene((dataclasses.replace(box("a", np.zeros(3), np.ones(3)), elastic=law),),
                  Contact(np.inf))  # fmt: skip
    ask = Ask(scene, History(0.4, 1e-3), (Strain(0),))
    assert digest(rebuilt(ask)) == digest(ask)
    assert f"elastic=Elastic(young={law.young!r}, poisson=0.2)" in source(ask)
    assert "from vv.scene import Block, Contact, Elastic, Scene" in python_script(
        ask, "vv.engines.dda", "solve"
    )


def test_what_a_default_gives_back_is_left_out() -> None:
    scene = small_scene(0)
    text = source(Ask(scene, History(0.4, 1e-3), ()))
    assert "inertia" not in text
    assert "spin" not in text
    assert "knobs" not in text


def test_the_script_stops_with_the_reason_when_the_engine_refuses(tmp_path: Path) -> None:
    ask = Ask(small_scene(0), History(0.4, 1e-3), (Displacement(0),))  # body 0 is a wall
    script = tmp_path / "native.py"
    script.write_text(python_script(ask, "vv.engines.exact", "solve"))
    root = str(ROOT)
    done = subprocess.run(
        [sys.executable, str(script)], env={"PYTHONPATH": root},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 1
    assert done.stderr.startswith(f"{Status.REFUSED.value}: body 0 is not a sphere")


def test_what_is_too_long_for_a_line_is_indented_by_its_depth() -> None:
    first, second = 50 * "a", 50 * "b"
    indented = f"(\n    (\n        {first!r},\n        {second!r},\n    ),\n)"
    assert source(((first, second),)) == indented
    wide = Wall(np.full(3, 1.0 / 3.0), np.array([0.0, 0.6, 0.8]), Harmonic(*np.full((2, 3), 1 / 3)))
    inner = ", ".join(3 * [repr(1 / 3)])
    assert source(wide).splitlines() == [
        "Wall(",
        f"    point=np.array([{inner}]),",
        "    normal=np.array([0.0, 0.6, 0.8]),",
        "    motion=Harmonic(",
        f"        amplitude=np.array([{inner}]),",
        f"        frequency=np.array([{inner}]),",
        "    ),",
        ")",
    ]
