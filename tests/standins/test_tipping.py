"""Claims about blocks that begin to tip: they start with the forces of rigid contact."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from reference_solutions.blocks.first_motion import Mode, acceleration, mode
from tests.scenes.blocks.block_scenes import incline
from vv.ask import Ask, Displacement, History, Knobs
from vv.scene import Scene, rotated, rotation_about_z
from vv.standins.clump import Clump, clumps
from vv.standins.stand_in import spring_scene, without_rotations
from vv.standins.why_no_clump import why_no_clump

BOTH = (Mode.TOPPLES, Mode.SLIDES_AND_TOPPLES)


def clumped(scene: Scene) -> Clump:
    ask = Ask(scene, History(0.02, 0.01), (Displacement(1),), Knobs(1e-5, 1e10))
    assert why_no_clump(ask) is None
    (made,) = clumps(ask, spring_scene(without_rotations(ask)))
    return made


def slender(psi: float, phi: float, delta: float, angle: float) -> Scene:
    """A block with half a diagonal of 1 m on a slope psi, rotated about the vertical."""
    d = np.radians(delta)
    scene = incline(psi, phi, half=(np.sin(d), 0.5, np.cos(d)))
    return rotated(scene, rotation_about_z(angle))


@given(st.floats(5, 70), st.floats(5, 70), st.floats(6, 60), st.floats(0, 6.3))
def test_the_centre_starts_with_the_acceleration_of_its_mode(
    psi: float, phi: float, delta: float, angle: float
) -> None:
    law = {"psi": psi, "phi": phi, "delta": delta}
    assume(min(abs(psi - delta), abs(psi - phi), abs(phi - delta)) > 0.1)
    scene = slender(psi, phi, delta, angle)
    made, block = clumped(scene), scene.blocks[0]
    starts = scene.gravity + made.forces.sum(axis=0) / block.mass
    found = scene.axes @ starts / 9.81
    due = acceleration(mode(**law), **law)
    assert found == pytest.approx([due[0], 0.0, due[1]], abs=1e-9)
    assert (int(made.touching.sum()) == 2) is (mode(**law) in BOTH)


@given(st.floats(5, 70), st.floats(5, 70), st.floats(6, 60))
def test_forces_lie_in_the_cone_and_are_alike_on_the_edge(
    psi: float, phi: float, delta: float
) -> None:
    assume(psi > delta + 0.1 and mode(psi=psi, phi=phi, delta=delta) in BOTH)
    scene = slender(psi, phi, delta, 0.3)
    made, mu = clumped(scene), scene.contact.mu
    press, across = made.forces @ made.normal, np.linalg.norm(made.friction, axis=1)
    assert (across <= mu * press * (1 + 1e-9) + 1e-9).all()
    low, high = np.sort(press[made.touching])
    assert low == pytest.approx(high, rel=1e-9)
    # overlap of springs with a fourth of the stiffness each
    wall = scene.walls[0]
    overlap = made.radius - (made.corners - wall.point) @ wall.normal
    assert overlap * 1e10 / 4 == pytest.approx(press, rel=1e-4, abs=1e-5 * press.max())


def test_a_block_that_tips_as_it_slides_is_refused() -> None:
    scene = slender(40.0, 35.0, 10.0, 0.0)
    sliding = dataclasses.replace(scene.blocks[0], velocity=0.1 * scene.axes[0])
    moving = dataclasses.replace(scene, bodies=(*scene.walls, sliding))
    ask = Ask(moving, History(0.02, 0.01), (Displacement(1),), Knobs(1e-5, 1e10))
    assert "begins to tip as it slides" in (why_no_clump(ask) or "")
