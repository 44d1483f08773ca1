"""Claims about dda/augmented-lagrangian in narrow grooves, which magnify what springs leave."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from tests.engines.dda.test_augmented_lagrangian import wedge
from tests.scenes.blocks.dda_scenes import closes, moved, run
from tests.scenes.metamorphic import in_units
from vv.ask import Ask, Displacement, Knobs, Method
from vv.case import Exact, Series
from vv.engines.dda import BORNE, DEFAULT, prepare, refuses
from vv.engines.dda.general.energy import FAILED
from vv.plan.project import find
from vv.scene import Vector, rotated, with_bodies_reversed

WEDGE = find().load_case("wedge")
UPRIGHT = np.eye(3)
UNITS = ((2.0**-10, 2.0**5, 2.0**9), (1e3, 1e3, 1e3), (0.3048, 60.0, 0.4536))


def slid(ask: Ask) -> Vector:
    way: Vector = moved(run(ask, BORNE)) @ ask.scene.axes[0]
    return way


def error_over_bound(
    xi: float, dip: float, held: float, knobs: Knobs, frame: Vector = UPRIGHT,
    axes: Vector | None = None,
) -> float:  # fmt: skip
    """The largest error, over what the case allows a scheme of this class.

    axes (3, 3): the scene's axes; the groove's if none are given.
    """
    given = {**WEDGE.defaults("xi-1"), "xi": xi, "dip": dip, "held": held}
    trial = WEDGE.declare("xi-1", given)
    (s,) = trial.quantities
    assert isinstance(s, Series)
    assert isinstance(s.judge, Exact)
    assert s.reference is not None
    assert s.still is not None
    ask = trial.study.ask(knobs)
    scene = rotated(ask.scene, frame)
    along = scene.axes[0]
    chosen = scene if axes is None else dataclasses.replace(scene, axes=axes)
    program = prepare(dataclasses.replace(ask, scene=chosen), BORNE)
    done = program.run(program.solve())
    closes(done)
    assert program.arguments[2][-1, FAILED] == 0  # no step is kept unconverged
    assert len(done.times) == 51, done.reason
    due = s.reference(done.times)
    scale = s.still if held > 1.0 else float(np.abs(due).max())
    off = float(np.abs(moved(done) @ along - due).max()) / scale
    return off / s.judge.tolerance(Method.SECOND_ORDER).value


@pytest.mark.shows(
    "In steps of 1 ms `dda/augmented-lagrangian` is within its bound at 1e-8 rad",
)
@pytest.mark.parametrize("held", [0.1, 0.5, 0.95, 1.1, 1.3])
@pytest.mark.parametrize("dip", [15.0, 23.0, 30.0, 40.0])
@pytest.mark.parametrize("xi", [1e-7, 1e-8])
def test_a_wedge_is_pressed_in_grooves_that_are_narrower_still(
    xi: float, dip: float, held: float
) -> None:
    """Springs that are stiff beside its inertia across a groove let it fall along the sides."""
    assert error_over_bound(xi, dip, held, Knobs(1e-3, 1e9)) <= 1.0


@pytest.mark.parametrize("held", [0.97, 0.99, 0.995, 1.001, 1.01])
@pytest.mark.parametrize("dt", [1e-2, 5e-3, 1e-3])
@pytest.mark.parametrize("xi", [0.1, 1e-3, 1e-4, 1e-5, 1e-6])
def test_what_friction_all_but_holds_gets_the_force_that_is_left(
    xi: float, dt: float, held: float
) -> None:
    """Rounding of gaps, and normal forces that were not found, were many times that force."""
    assert error_over_bound(xi, 30.0, held, Knobs(dt, 1e9)) <= 1.0


@pytest.mark.parametrize("held", [0.5, 0.95, 1.1])
@pytest.mark.parametrize("xi", [1e-2, 1e-5, 1e-7])
def test_answers_depend_on_neither_units_nor_the_order_of_sides(xi: float, held: float) -> None:
    """No length, time or mass is a limit; units other than powers of two round numbers anew."""
    ask = wedge(xi, 30.0, held, Knobs(1e-3, 1e9))
    path, fall = slid(ask), 0.5 * 9.81  # m in a second
    for units in UNITS:
        assert np.abs(slid(in_units(ask, units)) / units[0] - path).max() <= 1e-12 * fall
    turned = dataclasses.replace(
        ask, scene=with_bodies_reversed(ask.scene), observables=(Displacement(0),)
    )
    assert np.abs(slid(turned) - path).max() <= 1e-12 * fall


@pytest.mark.shows(
    "So it is in grooves that are oblique to the frame, down to 1e-7 rad",
)
@pytest.mark.parametrize("held", [0.5, 0.97, 1.1])
@pytest.mark.parametrize("xi", [1e-3, 1e-5, 1e-6, 1e-7])
def test_in_grooves_that_are_oblique_to_the_frame_all_laws_are_kept(xi: float, held: float) -> None:
    """In eight frames normals and gaps are rounded otherwise, and magnified by 1/sin(xi/2)."""
    chance = np.random.default_rng(1)
    for _ in range(8):
        assert error_over_bound(xi, 30.0, held, Knobs(1e-3, 1e9), drawn(chance)) <= 1.0


@pytest.mark.shows(
    "whatever the scene's axes are, since the unknowns of blocks that move freely are along the "
    "groove",
)
@pytest.mark.parametrize("seed", range(60))
def test_grooves_along_no_axis_of_the_scene_are_solved_along_themselves(seed: int) -> None:
    """In axes of the scene slip was rounded in each unknown, which failed 29 of 42 such wedges."""
    chance = np.random.default_rng(seed)
    xi, dip, held = 10 ** chance.uniform(-7, -1), chance.uniform(10, 45), chance.uniform(0.1, 1.3)
    knobs, frame, axes = Knobs(1e-3, 1e9), drawn(chance), drawn(chance)
    assert error_over_bound(xi, dip, held, knobs, frame, axes) <= 1.0


def drawn(chance: np.random.Generator) -> Vector:
    """Directions at right angles (3, 3), drawn at random."""
    frame, _ = np.linalg.qr(chance.normal(size=(3, 3)))
    return np.asarray(frame * np.linalg.det(frame))


@pytest.mark.shows(
    "sides that enclose less than 1e-9 rad are refused",
)
def test_sides_that_multipliers_would_take_for_parallel_are_refused() -> None:
    narrow, wide = (wedge(xi, 30.0, 0.5, Knobs(1e-3, 1e9)) for xi in (5e-10, 2e-9))
    assert "walls 0 and 1 enclose 5e-10 rad" in (refuses(narrow, BORNE) or "")
    assert refuses(wide, BORNE) is None
    assert refuses(narrow, DEFAULT) is None
