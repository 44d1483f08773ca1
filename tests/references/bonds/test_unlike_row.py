"""Claims about unequal spheres on unequal bonds: modes and first order agree with Newton."""

from __future__ import annotations

import dataclasses
import functools
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from reference_solutions.bonds import unlike_row as closed
from reference_solutions.checks.bonds import unlike_row as stepped
from tests.support.turned_signs import caught, signs, turned

M, R = np.array([2.0, 5.0, 1.0, 3.0]), np.array([0.3, 0.22, 0.45, 0.1])
ROW = closed.Row(
    M, np.array([0.0, 0.5, 1.3, 1.7]), np.array([[1, 0], [1, 2], [3, 2]]), 1e4 * np.array([4, 1, 2])
)
KS, SPIN = 1e3 * np.array([10.0, 3.0, 20.0]), np.array([20.0, -5.0, 12.0, 30.0])
ASIDE = 1e-5 * np.array([[1.0, 0.0], [0.0, -1.0], [0.5, 0.7], [-1.0, 0.3]])
THROWN = np.array([0.1, -0.05, 0.03, 0.2])
T = np.linspace(0.0, 0.3, 5)
LENGTH = np.abs(np.diff(ROW.x[ROW.bonds])[:, 0])
LONGER = LENGTH * np.array([1.01, 0.99, 1.02])


@functools.cache  # used again for every sign
def stepped_by_newton(swings: bool) -> np.ndarray:
    """The same row in space, (k, 4, 3) [m], in lateral motion with spin or along its axis."""
    x, v, w, push = np.zeros((4, 4, 3))
    x[:, 0] = ROW.x
    if swings:
        v[:, 1:], w[:, 0] = ASIDE, SPIN
    else:
        v[:, 0], push[:, 0] = THROWN, 9.81 * M
    length = LENGTH if swings else LONGER
    given: dict[str, Any] = {"m": M, "r": R, "x": x, "v": v, "spin": w, "push": push}
    return stepped.motion(T, ROW.bonds, length=length, kn=ROW.kn, ks=KS, **given)


def across_agrees(one: ModuleType) -> bool:
    """Whether the lateral motion satisfies Newton's equations to first order."""
    found = one.across(T, one.Row(**vars(ROW)), r=R, ks=KS, spin=SPIN, v=ASIDE)
    due = stepped_by_newton(True)[:, :, 1:]
    return bool(np.abs(found - due).max() < 1e-9 * np.abs(due).max())


def along_agrees(one: ModuleType) -> bool:
    """Whether the motion along the row satisfies Newton's equations."""
    row = one.Row(**vars(ROW))
    found, _ = one.along(T, row, length=LONGER, v=THROWN, g=9.81, held=False)
    due = stepped_by_newton(False)[:, :, 0]
    return bool(np.abs(found - due).max() < 1e-10 * np.abs(due).max())


def test_a_row_that_spins_and_swings_aside_is_linear_in_what_swings() -> None:
    assert across_agrees(closed)


def test_a_row_swings_along_itself_in_its_modes() -> None:
    assert along_agrees(closed)


def held_agrees(one: ModuleType) -> bool:
    """Whether the momentum that a held row loses equals the impulse of the support."""
    row, many = one.Row(**vars(ROW)), np.linspace(0.0, 0.3, 3001)
    still = np.where(np.arange(4) > 0, THROWN, 0.0)
    u, reaction = one.along(many, row, length=LENGTH, v=still, g=9.81, held=True)
    slow = np.gradient(u, many, axis=0, edge_order=2) @ M
    due = (
        M @ still
        + 9.81 * M.sum() * many
        + np.append(0.0, np.cumsum(0.5 * np.diff(many) * (reaction[1:] + reaction[:-1])))
    )
    return bool(np.abs(slow - due).max() < 1e-3 * np.abs(slow).max() and not u[:, 0].any())


def slowed_agrees(one: ModuleType) -> bool:
    """Whether drag decelerates unequal spheres according to Newton's equations."""
    row, x, v = one.Row(**vars(ROW)), np.zeros((4, 3)), np.zeros((4, 3))
    x[:, 0], v[:, 0] = ROW.x, THROWN
    found = one.slowed(T, row, length=LONGER, v=THROWN, eta=15.0)
    due = stepped.motion(
        T, ROW.bonds, m=M, r=R, x=x, v=v, spin=np.zeros((4, 3)), push=np.zeros((4, 3)),
        length=LONGER, kn=ROW.kn, ks=KS, eta=15.0,
    )[:, :, 0]  # fmt: skip
    return bool(np.abs(found - due).max() < 1e-10 * np.abs(due).max())


DRAG, STEP = 150.0, 1e-3  # N s/m, s: of the leapfrog


@functools.cache
def leapt_by_hand(dt: float) -> np.ndarray:
    """Central differences (k, 4) [m] of the row with drag, of which rows are at the times T."""
    joined = np.zeros((3, 4))
    for bond, (i, j) in enumerate(ROW.bonds):
        joined[bond, [i, j]] = np.array([-1.0, 1.0]) * np.sign(ROW.x[j] - ROW.x[i])
    pulled = -joined.T @ (ROW.kn * (LENGTH - LONGER))
    now = np.zeros(4)
    before = -dt * THROWN + dt**2 / 2 * (pulled - DRAG * THROWN) / M
    every, kept = round(float(T[1]) / dt), [now]
    for step in range(1, 4 * every + 1):
        force = pulled - joined.T @ (ROW.kn * (joined @ now))
        after = dt**2 * force / M + 2 * now - (1 - DRAG * dt / (2 * M)) * before
        before, now = now, after / (1 + DRAG * dt / (2 * M))
        if step % every == 0:
            kept.append(now)
    return np.array(kept)


def leapt_agrees(one: ModuleType) -> bool:
    """Whether what is left of the error of a leapfrog is of fourth order in its step."""
    row, left, law = one.Row(**vars(ROW)), [], {"length": LONGER, "v": THROWN, "eta": DRAG}
    for dt in (STEP, STEP / 2):
        due = leapt_by_hand(dt)
        left.append(np.abs(one.leapt(T, row, dt=dt, **law) - due).max())
        missed = np.abs(closed.slowed(T, ROW, **law) - due).max()
    return bool(14 < left[0] / left[1] < 18 and left[1] < 0.01 * missed)


def starts_agree(one: ModuleType) -> bool:
    """Whether the accelerations at t = 0 are those with which both motions begin."""
    row, t, law = one.Row(**vars(ROW)), np.array([0.0, 1e-6]), {"length": LONGER, "v": THROWN}
    pulled = closed.along(t, ROW, g=9.81, held=False, **law)[0][1]
    slowed = closed.slowed(t, ROW, eta=20.0, **law)[1]
    given = one.accelerations(row, g=9.81, **law), one.accelerations(row, eta=20.0, **law)
    found = [2 * (u - THROWN * t[1]) / t[1] ** 2 for u in (pulled, slowed)]
    return all(np.allclose(*both, rtol=1e-3, atol=1e-2) for both in zip(found, given, strict=True))


def test_a_row_starts_with_the_accelerations_that_its_motions_have() -> None:
    assert starts_agree(closed)


def test_drag_slows_unlike_spheres_of_a_row() -> None:
    assert slowed_agrees(closed)


def test_a_leapfrog_with_drag_errs_as_its_modified_equation_says() -> None:
    assert leapt_agrees(closed)


def test_what_holds_a_row_takes_its_momentum() -> None:
    assert held_agrees(closed)


@pytest.mark.parametrize("sign", signs(closed))
def test_any_wrong_sign_in_the_formulas_is_caught(sign: int) -> None:
    other = turned(closed, sign)
    assert caught(
        lambda: (
            along_agrees(other)
            and across_agrees(other)
            and held_agrees(other)
            and slowed_agrees(other)
            and starts_agree(other)
            and leapt_agrees(other)
        )
    )


def test_a_mass_that_is_not_positive_is_refused() -> None:
    with pytest.raises(ValueError, match="m = -1"):
        dataclasses.replace(ROW, m=np.array([1.0, 1.0, -1.0, 1.0]))


def test_the_fastest_oscillation_of_a_pair_is_that_of_its_reduced_mass() -> None:
    pair = closed.Row(np.array([2.0, 3.0]), np.array([0.0, 1.0]), np.array([[1, 0]]), np.ones(1))
    assert closed.highest_frequency(pair) == pytest.approx((1 / 2 + 1 / 3) ** 0.5, rel=1e-14)
