"""Claims about what is counted for the table of Liu et al. (2017)."""

import numpy as np

from cases.bonds.parts._quartzite_lattice import BLOCK, at_faces


def test_elements_at_faces_are_all_that_lack_a_neighbour_within() -> None:
    """An element within has twelve neighbours at one diameter; all others lie at a face."""
    apart = np.linalg.norm(BLOCK.position[:, None] - BLOCK.position, axis=2)
    near = (np.abs(apart / np.sort(apart.ravel())[len(apart)] - 1.0) < 1e-9).sum(axis=1)
    inner, outer = np.flatnonzero(near == 12), np.flatnonzero(near < 12)
    assert len(inner) > 1
    assert at_faces(inner) == 0.0
    assert at_faces(outer) == len(outer)
