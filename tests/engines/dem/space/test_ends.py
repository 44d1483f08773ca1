"""Claims about where a run of the general model ends: by what was put in, and by speed alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.dem.test_space import FAR, MASS, RADIUS
from vv.engines.dem.limits import BLOW_UP, GAIN
from vv.engines.dem.space.ledger import FORMS, WIDTHS, column, signed, width
from vv.engines.dem.space.model import space
from vv.engines.dem.terms.drag import Drag
from vv.scene import Contact, Form, Scene, Spheres, Vector

DT, KN, KS = 1e-3, 1e4, 6e3
TINY = 1e-100  # what is not zero shares a kernel with other tests
PLACE = np.array([[0.0, 0.0, 0.0], [1.597, 0.0, 0.0]])
APART = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]])


def driven(
    eta: float,
    place: Vector = APART,
    load: float = TINY,
    gravity: float = TINY,
    mu: float = 0.3,
) -> tuple[int, Vector, Vector, Scene]:
    """Two spheres on which a drag acts that may push: the rows filled, path, energies, scene."""
    free = np.ones((2, 3), bool)
    spheres = Spheres(
        place, np.array([[0.03, 0.01, 0.0], [0.0, -0.02, 0.03]]), RADIUS[:2], MASS[:2], free,
        spin=np.array([[0.0, 0.02, 0.01], [0.05, 0.0, 0.0]]), free_spin=free,
        load=np.array([[load, 0.0, 0.0], [0.0, 0.0, load]]),
    )  # fmt: skip
    down = np.array([TINY, gravity, TINY])
    scene = Scene((spheres, FAR), Contact(KN, KS, mu), TINY, down)
    model, rows = space(scene), 900
    terms = tuple(
        one._replace(eta=eta) if isinstance(one, Drag) else one for one in model.state.terms
    )
    state, outputs = model.state._replace(terms=terms), model.outputs(rows, (0, 1))
    run: Any = model.kernel()
    row = run(*outputs, 1, DT, *state, 1.0, 0.0)
    return row, np.asarray(outputs[0]), np.asarray(outputs[1]), scene


def moving(scene: Scene) -> float:
    """The energy of motion and spin at the start."""
    s = scene.spheres
    return 0.5 * float(s.mass @ (s.velocity**2).sum(axis=1) + s.inertia @ (s.spin**2).sum(axis=1))


@pytest.mark.parametrize(
    ("place", "load", "gravity"),
    [
        (APART, TINY, TINY),
        (PLACE, TINY, TINY),
        (APART, 0.03, TINY),
        (APART, -0.03, TINY),
        (APART, TINY, 0.02),
    ],
)
def test_a_run_ends_where_it_holds_four_times_what_was_put_in(
    place: Vector, load: float, gravity: float
) -> None:
    """Motion, spin and springs at the start, and the most work that loads and gravity have done."""
    row, path, energy, scene = driven(-0.004 * MASS[1] / DT, place, load, gravity)
    deep = RADIUS[0] + RADIUS[1] - place[1, 0]
    start = moving(scene) + 0.5 * KN * max(deep, 0.0) ** 2
    u = path[: row + 1, :, :3]
    work = load * (u[:, 0, 0] + u[:, 1, 2]) + gravity * u[:, :, 1] @ MASS[:2]
    limit = GAIN * (start + np.maximum(np.maximum.accumulate(work), 0.0))
    held = energy[: row + 1, :3].sum(axis=1)
    assert 50 < row < 899
    assert (held[:-1] <= limit[:-1]).all()
    assert held[-1] > limit[-1]


def test_springs_hold_energy_as_motion_does() -> None:
    """The pair swings on both springs of its contact, which friction does not let slip."""
    row, _, energy, scene = driven(-0.05 * MASS[1] / DT, PLACE, mu=1e3)
    limit = GAIN * (moving(scene) + 0.5 * KN * (1.6 - 1.597) ** 2)
    held = energy[: row + 1, :3].sum(axis=1)
    assert (held[:-1] <= limit).all()
    assert held[-1] > limit


def test_a_run_ends_where_its_speed_alone_holds_a_million_times_that() -> None:
    """Velocities turn about in each step and grow, those of the lighter sphere faster."""
    row, _, energy, scene = driven(2.02 * MASS[1] / DT)
    s = scene.spheres
    growth = 1.0 - 2.02 * MASS[1] / s.mass
    put_in = moving(scene)
    square = (s.velocity**2).sum(axis=1)
    spins = 0.5 * float(s.inertia @ (s.spin**2).sum(axis=1))

    def fast(n: int) -> float:
        return spins + 0.5 * float((s.mass * square) @ growth ** (2 * n + 2))

    assert 10 < row < 899
    assert energy[row, :3].sum() < put_in
    assert fast(row - 1) <= BLOW_UP * put_in < fast(row)


def test_work_done_on_a_scene_is_told_as_what_it_holds_less() -> None:
    energy = np.arange(1.0, 25.0).reshape(2, 12)
    due = energy.copy()
    due[:, 5:10] *= -1.0
    for wide in WIDTHS:
        assert (signed(energy[:, :wide]) == due[:, :wide]).all()
    assert str(signed(np.zeros((1, 12)))[0, 6]) == "0.0"


def test_a_table_is_as_wide_as_its_last_form_needs() -> None:
    assert [column(form) for form in Form] == list(range(12)) == [*range(len(FORMS))]
    assert width(()) == 7
    widths = [width((Form.KINETIC, form)) for form in Form]
    assert widths == [7] * 7 + [9] * 2 + [12] * 3
