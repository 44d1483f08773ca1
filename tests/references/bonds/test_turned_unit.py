"""Claims about a unit in large rotation: its limit is the sine, and invariants are constant."""

import numpy as np
import pytest

from cases.bonds.parts._unit import CORNERS, EDGES, ROUND
from reference_solutions.bonds import turned_unit

M, KN, KS, D = 1.87e-6, 4.68e7, 8.07e6, 1e-3
TIMES = np.linspace(0.0, 2e-6, 41)
RATE = 2 * np.sqrt(KS / M)


def path(strain: float) -> tuple[np.ndarray, np.ndarray]:
    """Displacements of a unit that starts to rotate at this amplitude, and their linear limit."""
    thrown = D * strain * ROUND
    moved = turned_unit.path(D * CORNERS, EDGES, RATE * thrown, m=M, kn=KN, ks=KS)(TIMES)
    return moved, np.sin(RATE * TIMES)[:, None, None] * thrown


@pytest.mark.parametrize("strain", [1e-4, 1e-3])
def test_it_strays_from_the_sine_by_its_square(strain: float) -> None:
    moved, sine = path(strain)
    turned = np.abs(moved[:, 1:, :2] - sine[:, 1:, :2]).max() / np.abs(sine).max()
    assert turned < strain
    assert np.abs(moved[:, 1, 1] - sine[:, 1, 1]).max() / np.abs(sine).max() < 3 * strain**2


def test_its_middle_stays_and_it_turns_about_its_axis_alike() -> None:
    moved, _ = path(1e-2)
    assert np.abs(moved.mean(axis=1)).max() < 1e-10 * np.abs(moved).max()
    outwards = np.linalg.norm((D * CORNERS + moved)[:, 1:, :2], axis=2)
    assert np.ptp(outwards, axis=1).max() < 1e-10 * D
    assert np.ptp(outwards[:, 0]) > 1e-6 * D  # the rotation stretches the unit
