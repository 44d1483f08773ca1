"""Claims about which blocks PyBullet can be given, and along what they are driven."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import adapters.pybullet
from adapters.pybullet.shapes import _edges, own_axes, why_no_shapes
from vv.scene import box_geometry

TURN = np.array([[0.8, 0.6, 0.0], [-0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])


def block(free: tuple[bool, ...], **more: Any) -> Any:
    spins = np.ones(3, bool)
    return SimpleNamespace(name="b", free=np.array(free), free_spin=spins, **more)


def test_what_any_block_is_free_along_is_driven(monkeypatch: pytest.MonkeyPatch) -> None:
    blocks = [{"free": [True, False, False]}, {"free": [False, False, True]}]
    monkeypatch.setattr(adapters.pybullet, "boxed", lambda ask: {"blocks": blocks})
    monkeypatch.setattr(adapters.pybullet, "own_axes", lambda one: {"half": 1})
    monkeypatch.setattr(adapters.pybullet, "in_units_of_blocks", lambda plan: plan)
    made: Any = adapters.pybullet._plan(None)  # type: ignore[arg-type]
    assert made["driven"] == [True, False, True]
    assert [one["half"] for one in made["blocks"]] == [1, 1]


def test_free_blocks_are_locked_alike() -> None:
    one, other, fixed = (True, True, False), (True, False, True), (False, False, False)
    for kinds, fits in (((one, one, fixed), True), ((one, one, other), False), ((fixed,), True)):
        scene: Any = SimpleNamespace(blocks=[block(kind) for kind in kinds])
        assert (why_no_shapes(scene) is None) is fits


@pytest.mark.parametrize(("product", "fits"), [(1e-7, True), (1e-5, False)])
def test_a_lock_is_about_an_axis_of_inertia_to_a_billionth(product: float, fits: bool) -> None:
    inertia = np.diag([1e3, 2e3, 3e3])
    inertia[0, 1] = inertia[1, 0] = product
    one = block((True, True, True), inertia=inertia)
    one.free_spin = np.array([False, True, False])
    scene: Any = SimpleNamespace(blocks=[one], axes=np.eye(3))
    assert (why_no_shapes(scene) is None) is fits
    one.free_spin = np.ones(3, bool)
    assert why_no_shapes(scene) is None


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(("off", "is_box"), [(1e-10, True), (1e-8, False)])
def test_a_box_is_one_to_a_billionth_whatever_its_size(
    size: float, off: float, is_box: bool
) -> None:
    vertices, _ = box_geometry(np.zeros(3), size * np.array([0.5, 0.3, 0.2]), TURN)
    vertices = vertices * np.array([[1 + off], *[[1.0]] * 7])
    assert (_edges(vertices) is not None) is is_box
    assert _edges(vertices[:7]) is None


@pytest.mark.parametrize("size", [1e-3, 1e3])
def test_inertia_is_diagonal_to_a_billionth_whatever_its_size(size: float) -> None:
    half = np.array([0.5, 0.3, 0.2])
    vertices, _ = box_geometry(np.zeros(3), half, np.eye(3))
    for off, kept in ((1e-10, True), (1e-8, False)):
        inertia = size * np.diag([1.0, 2.0, 3.0])
        inertia[0, 1] = inertia[1, 0] = off * 3.0 * size
        made = own_axes({"inertia": inertia, "vertices": vertices, "free_spin": [True] * 3})
        assert sorted(made["half"]) == (pytest.approx([0.2, 0.3, 0.5]) if kept else [])
        assert sorted(made["moments"]) == pytest.approx([size, 2 * size, 3 * size])
