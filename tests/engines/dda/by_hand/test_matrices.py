"""Claims about matrices in kernels of `dda`, and about equations in a profile, against numpy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.algebra.linear import back, eliminate, factorise, forward, substitute
from vv.engines.dda.general.algebra.matrices import (
    congruent,
    fill_exponential,
    moment_product,
    times_vector,
)
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")


def test_products_of_matrices_are_those_of_numpy() -> None:
    one, two, root = np.random.default_rng(1).normal(size=(3, 3, 3))
    second = root @ root.T
    a = np.array([0.3, -2.0, 5.0])
    assert times_vector(one, tuple(a)) == pytest.approx(one @ a)
    assert moment_product(second, one, two) == pytest.approx(np.trace(one @ second @ two.T))
    out = np.empty((3, 3))
    congruent(out, one, second)
    assert out == pytest.approx(one @ second @ one.T)
    congruent(second, one, second)
    assert second == pytest.approx(out)


@pytest.mark.parametrize("terms", [1, 2, 4, 30])
def test_an_exponential_is_the_sum_of_so_many_terms(terms: int) -> None:
    slope, whole = np.random.default_rng(2).normal(size=(3, 3)), np.empty((3, 3))
    fill_exponential(whole, slope, terms)
    due, power = np.eye(3), np.eye(3)
    for k in range(1, terms + 1):
        power = power @ slope / k
        due = due + power
    assert whole == pytest.approx(due)
    if terms == 30:
        assert whole == pytest.approx(expm(slope))


FIRST = np.array([0, 0, 1, 0, 3, 2, 5])


def in_profile(seed: int, first: Index) -> Vector:
    """A matrix that differs from zero only from the first column of a row on, and in its image."""
    n = len(first)
    full = np.random.default_rng(seed).normal(size=(n, n)) + 6.0 * np.eye(n)
    there = np.array([[first[max(i, j)] <= min(i, j) for j in range(n)] for i in range(n)])
    return np.where(there, full, 0.0)


@pytest.mark.parametrize("first", [FIRST, np.zeros(5, int), np.arange(4)])
def test_a_symmetric_system_in_a_profile_is_solved(first: Index) -> None:
    full = in_profile(3, first)
    full = full + full.T
    matrix, x = np.tril(full), np.random.default_rng(4).normal(size=len(first))
    factorise(matrix, first)
    lower = np.tril(matrix, -1) + np.eye(len(first))
    assert lower @ np.diag(np.diag(matrix)) @ lower.T == pytest.approx(full)
    found = np.full(len(first), np.nan)
    substitute(matrix, first, full @ x, found)
    assert found == pytest.approx(x)
    forward(matrix, first, lower @ x, found)
    assert found == pytest.approx(x)


@pytest.mark.parametrize("first", [FIRST, np.zeros(5, int), np.arange(4)])
def test_a_system_of_symmetric_profile_is_solved(first: Index) -> None:
    full = in_profile(5, first)
    matrix, x = full.copy(), np.random.default_rng(6).normal(size=len(first))
    eliminate(matrix, first)
    lower = np.tril(matrix, -1) + np.eye(len(first))
    assert lower @ np.triu(matrix) == pytest.approx(full)
    found = np.full(len(first), np.nan)
    back(matrix, first, full @ x, found)
    assert found == pytest.approx(x)
