"""Claims about rotations and inertia in kernels of `rigid`, against matrices by hand."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from vv.engines.rigid.general.turning import held_inverse, orthonormal, turn_by, turned_inertia

pytestmark = pytest.mark.usefixtures("in_python")


@pytest.mark.parametrize("size", [0.0, 1e-155, 5e-9, 1e-3, 1.0, 3.0])
def test_a_rotation_turns_by_its_vector(size: float) -> None:
    random = np.random.default_rng(1)
    angle = random.normal(size=3)
    angle *= size / np.linalg.norm(angle)
    start, out = random.normal(size=(3, 3)), np.empty((3, 3))
    turn_by(tuple(angle), start, out)
    assert out == pytest.approx(Rotation.from_rotvec(angle).as_matrix() @ start, abs=1e-14)
    change = np.cross(angle, start.T).T
    assert out - start == pytest.approx(change, abs=size**2 + 1e-15)


def test_rounding_of_a_rotation_is_removed_by_a_newton_step() -> None:
    random = np.random.default_rng(2)
    true = Rotation.from_rotvec([0.3, -0.2, 0.9]).as_matrix()
    off = true + 1e-5 * random.normal(size=(3, 3))
    found = off.copy()
    orthonormal(found)
    assert found == pytest.approx(0.5 * off @ (3.0 * np.eye(3) - off.T @ off), abs=1e-15)
    assert found.T @ found == pytest.approx(np.eye(3), abs=1e-8)


def test_inertia_is_turned_on_both_sides() -> None:
    inertia, rotation, out = np.diag([1.0, 2.0, 4.0]) + 0.1, np.arange(9.0).reshape(3, 3), np.eye(3)
    turned_inertia(inertia, rotation, out)
    assert out == pytest.approx(rotation @ inertia @ rotation.T)


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("free", range(4))
def test_the_inverse_inertia_is_that_in_the_free_directions(free: int, unit: float) -> None:
    random = np.random.default_rng(3)
    root = random.normal(size=(3, 3))
    inertia = unit * (root @ root.T + 0.5 * np.eye(3))
    rows = np.linalg.qr(random.normal(size=(3, 3)))[0][:free]
    out = np.full((3, 3), np.nan)
    held_inverse(inertia, rows.T @ rows, out)
    due = rows.T @ np.linalg.inv(rows @ inertia @ rows.T) @ rows if free else np.zeros((3, 3))
    assert out == pytest.approx(due, abs=1e-12 / unit)


@pytest.mark.parametrize("axis", range(3))
def test_a_plate_turns_about_a_free_axis_in_it_or_along_its_normal(axis: int) -> None:
    """A plate without thickness has about its normal the inertia of both axes in it."""
    for normal in range(3):
        inertia = np.roll([2.0, 3.0, 5.0], normal - 2)
        free, out = np.diag(np.eye(3)[axis]), np.full((3, 3), np.nan)
        held_inverse(np.diag(inertia), free, out)
        assert out == pytest.approx(free / inertia[axis])
