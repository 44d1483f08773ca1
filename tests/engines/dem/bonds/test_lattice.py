"""Claims about the layout of bonds in the explicit DEM: no answer depends on it."""

from __future__ import annotations

import dataclasses
import os
import subprocess
import sys

import numpy as np
import pytest

from bench.speed.lattice_threads import program
from tests.scenes.spheres.bonded_scenes import CORNERS, KN, KS, M, elements, tied, unit
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import dem
from vv.engines.dem.bonds import blocks
from vv.engines.dem.terms.bonds import Bonds
from vv.scene import Contact, Scene, Spheres, Vector

SIZE = 580  # elements; their 2902 bonds make two chunks
SEEN = tuple(Displacement(i) for i in range(4))


def moved(scene: Scene) -> Vector:
    ask = Ask(scene, History(2e-6, 2e-6), SEEN, Knobs(1e-8))
    return np.array([dem.solve_default(ask).values[what][-1] for what in SEEN])


def test_bonds_of_unlike_strengths_pull_like_those_of_one() -> None:
    """Bonds of one strength share four numbers; bonds of several strengths have their own."""
    velocity = np.random.default_rng(1).normal(size=(4, 3))
    told = []
    for most in (1e5, 2e5):
        strength = np.array([1e5] * 5 + [most])
        bonds = tied(tension=strength, shear=strength)
        told.append(moved(unit(elements(velocity=velocity), bonds, contact=Contact(KN, KS, 0.3))))
    assert np.abs(told[0] - told[1]).max() <= 1e-14 * np.abs(told[0]).max()


def test_unlike_springs_are_each_bonds_own() -> None:
    """A spring that is stiffer by a tenth exerts forces larger by a tenth on its two ends."""
    stiffer = np.full(6, KN)
    stiffer[0] *= 1.1
    scenes = [unit(bonds=tied(kn=k, length=0.999 * 1e-3, ks=0.0)) for k in (KN, stiffer)]
    u = [moved(dataclasses.replace(s, bodies=(heavy(s),))) for s in scenes]
    n = (CORNERS[0] - CORNERS[1]) / 1e-3
    assert (u[1] - u[0])[:2] @ n == pytest.approx(
        0.1 * KN * 1e-6 / (1e6 * M) * 2e-12 * np.array([-1, 1]), rel=1e-6
    )
    assert np.abs((u[1] - u[0])[2:]).max() < 1e-5 * np.abs(u[1] - u[0]).max()  # by way of the two


def heavy(scene: Scene) -> Spheres:
    return dataclasses.replace(scene.spheres, mass=np.full(4, 1e6 * M))


def test_chunks_add_up_to_the_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    paths = []
    for chunks in (1, 8):
        monkeypatch.setattr(blocks, "CHUNKS", chunks)
        one = program(SIZE, 20)
        assert one.solve() == 2
        paths.append(one.arguments[0])
    bonds = one.system.state.term(Bonds)  # type: ignore[union-attr]
    assert len(bonds.arrays.blocks.window) == 2
    assert 0.0 < np.abs(paths[0] - paths[1]).max() <= 1e-13 * np.abs(paths[0]).max()


def test_two_threads_give_the_bits_of_one() -> None:
    """It runs in a process of its own, since this one has one thread. Bonds break meanwhile.

    It is slow without cached kernels: the kernel for threads is compiled for this test only.
    """
    script = (
        "from bench.speed.lattice_threads import program\n"
        f"one, two = program({SIZE}, 60), program({SIZE}, 60, threads=2)\n"
        "assert one.solve() == two.solve() == 2\n"
        "assert one.arguments[1][-1, 10] > 0.0, 'no bond breaks'\n"
        "assert all(a.tobytes() == b.tobytes() for a, b in zip(one.arguments[:2], two.arguments))\n"
    )
    env = {**os.environ, "NUMBA_NUM_THREADS": "2"}
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_more_threads_than_there_may_be_are_refused() -> None:
    with pytest.raises(ValueError, match="number of threads"):
        program(SIZE, 20, threads=10_000).solve()
