"""Claims about kernels of `rigid` that look for landings, with truths by hand."""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np
import pytest

from tests.engines.rigid.test_momentum import pile
from tests.scenes.blocks.block_scenes import DOWN, FLOOR, HELD, box
from vv.engines.rigid.general.landing import (
    earliest_landing,
    gain_of_closing,
    impact_acted,
    speed_of_closing,
    time_to_closing,
)
from vv.engines.rigid.general.model import Space
from vv.engines.rigid.general.setting import least_impact_speed
from vv.engines.rigid.limits import CLOSELY, GENTLY, LOOSELY, SLOWLY, SMALL, TOUCHING
from vv.engines.rigid.slip import first_root
from vv.engines.rigid.solver.assembly import Joints
from vv.scene import Contact, Scene, Vector

PULL, SLACK, DT = 10.0, 1e-9, 1e-3  # m/s2, m, s
FALLS = 1e-2 * PULL * DT**2  # m: a gap that counts, far less than falls shut in a step


class Open(NamedTuple):
    """The gaps of contacts, and their rates, at the start of a step."""

    gap: Vector
    slack: float
    opens: Vector
    known: Any


class Tried(NamedTuple):
    """Of a trial only what is known of gaps, impulses and motions."""

    joints: Joints
    gaps: Open
    p: Vector
    v: Vector
    w: Vector


class Limits(NamedTuple):
    """Of a scene only what tells an impact from a soft landing."""

    pull: float
    slack: float
    tolerance: float


def tried(gap: Any, opens: Any, push: Any, v: Any = 0.0) -> Tried:
    """Two contacts on a cube that moves up at v after the trial; the others are pressed before."""
    joints, *_ = pile(1, 0.5)
    gaps = Open(np.ones(4), 0.0, np.zeros(4), np.arange(4) >= 2)
    gaps.gap[:2], gaps.opens[:2] = gap, opens
    p, rates = np.zeros((4, 3)), np.zeros((2, 3))
    p[:2, 2], rates[0, 2] = push, v
    return Tried(joints, gaps, p, rates, np.zeros((2, 3)))


def _first_root(a: float, b: float, c: float) -> float:
    return first_root(a, b, c)


@pytest.mark.parametrize(
    ("a", "b", "c", "root"),
    [
        (2.0, -1.0, -1.0, 1.0),
        (3.0, -4.0, 1.0, 1.0),
        (2.0, 1.0, -1.0, 2.0),
        (0.0, 3.0, -1.5, 2.0),
        (0.0, -3.0, 1.0, 0.0),
        (2.0, -1.0, 1.0, np.inf),
        (2.0, 1.0, 1.0, np.inf),
        (2.0, -4.0, 0.0, 0.5),
    ],
)
def test_a_parabola_falls_below_zero_at_its_first_root(
    a: float, b: float, c: float, root: float
) -> None:
    kernel: Any = numba.njit(_first_root)
    assert kernel(a, b, c) == pytest.approx(root)


def _closing(trial: Any, span: float) -> float:
    return time_to_closing(trial, span)


@pytest.mark.parametrize(
    ("gap", "opens", "v", "after"),
    [
        ([1.0, 9.0], -1.0, -2.0, 1.25**0.5 - 1.0),  # 1/4 - 2 t - t^2 = 0
        ([9.0, 1.0], -1.0, -2.0, 1.25**0.5 - 1.0),
        ([1.0, 9.0], 3.0, 1.0, (1.0 + 17.0**0.5) / 4.0),  # 2 + t - 2 t^2 = 0
        ([0.25, 9.0], -1.0, -3.0, -0.25),  # it is -3/4, and has closed at 3 m/s
        ([0.1, 9.0], -4.0, 1.0, np.inf),  # it has closed and opens again
    ],
)
def test_a_gap_closes_where_the_parabola_through_a_trial_says(
    gap: list[float], opens: float, v: float, after: float
) -> None:
    """Its rate changes evenly over the 0.5 s of the trial, and goes on so."""
    kernel: Any = numba.njit(_closing)
    assert kernel(tried(gap, opens, 0.0, v), 0.5) == pytest.approx(after)


def _earliest(limits: Any, trial: Any) -> float:
    fast = least_impact_speed(limits, DT)
    return earliest_landing(limits, trial, DT, fast)


earliest: Any = numba.njit(_earliest)


@pytest.mark.parametrize("gap", [FALLS, 0.3])
@pytest.mark.parametrize("opens", [0.0, -2.0])
def test_no_block_lands_before_free_fall_takes_it_there(gap: float, opens: float) -> None:
    """gap - slack + opens t - pull t^2/2 = 0, of the contact that is the first."""
    trial = tried([gap, 2.0 * gap], opens, 1.0)
    roots = np.roots([-0.5 * PULL, opens, gap - SLACK])
    due = next(r for r in roots if r > 0)
    assert earliest(Limits(PULL, SLACK, 0.0), trial) == pytest.approx(due)


@pytest.mark.parametrize(
    ("gap", "opens", "push"),
    [
        (0.3, -1.0, 0.0),  # nothing presses it
        (0.3, -1.0, -1.0),
        (0.9 * CLOSELY * PULL * DT**2 + SLACK, -0.9 * SLOWLY * PULL * DT, 1.0),  # softly
    ],
)
def test_what_does_not_act_or_closes_softly_is_no_landing(
    gap: float, opens: float, push: float
) -> None:
    assert earliest(Limits(PULL, SLACK, 0.0), tried(gap, opens, push)) == np.inf


@pytest.mark.parametrize("opens", [-1.1 * SLOWLY * PULL * DT, 1.1 * SLOWLY * PULL * DT])
def test_a_closed_contact_that_moves_fast_lands(opens: float) -> None:
    found = earliest(Limits(PULL, SLACK, 0.0), tried(0.0, opens, 1.0))
    assert found == pytest.approx(max(0.0, 2.0 * opens / PULL))


def _closes(limits: Any, trial: Any) -> float:
    return speed_of_closing(limits, trial)


def _gained(limits: Any, trial: Any, free: Any) -> float:
    return gain_of_closing(limits, trial, free)


@pytest.mark.parametrize(("push", "times", "gain"), [
    ([1.0, 0.0], [-1.1, -7.0], 4.1), ([0.0, 1.0], [-5.0, -1.5], 4.5),
    ([1.0, 1.0], [-4.0, -2.0], 7.0), ([1.0, 1.0], [-0.9, 3.0], 0.0),
    ([0.0, -1.0], [-7.0, -7.0], 0.0),
])  # fmt: skip
def test_a_contact_that_begins_to_act_gains_what_its_velocity_changes_without_it(
    push: list[float], times: list[float], gain: float
) -> None:
    """At most, in units of the least velocity that counts; without contact it is 3 at the end."""
    closes: Any = numba.njit(_closes)
    gained: Any = numba.njit(_gained)
    limits, unit = Limits(PULL, SLACK, 1e-9), 1e-9 * GENTLY
    trial = tried(0.0, np.array(times) * unit, push, 9.0 * unit)
    free = tried(0.0, 0.0, 0.0, 3.0 * unit)
    counts = [-k for k, p in zip(times, push, strict=True) if p > 0.0 and k < -1.0]
    assert closes(limits, trial) == pytest.approx(max(counts, default=0.0) * unit)
    assert gained(limits, trial, free) == pytest.approx(gain * unit)


def _acted(limits: Any, trial: Any) -> bool:
    return impact_acted(limits, trial, DT)


@pytest.mark.parametrize(("times", "acts"), [(0.98, False), (1.02, True)])
@pytest.mark.parametrize("tolerance", [0.0, 1e-3])
def test_an_impact_acts_if_it_stops_half_the_least_speed(
    times: float, tolerance: float, acts: bool
) -> None:
    """An impulse changes the velocity of a contact by itself times `across`."""
    least = max(SLOWLY * PULL * DT, GENTLY * tolerance)
    trial = tried(0.0, 0.0, [0.0, 1.0])
    trial.p[:] *= 0.5 * times * least / trial.joints.across[1]
    kernel: Any = numba.njit(_acted)
    assert kernel(Limits(PULL, SLACK, tolerance), trial) is acts


@pytest.mark.parametrize(("blocks", "part"), [(2, TOUCHING), (SMALL + 1, LOOSELY)])
def test_a_gap_counts_as_closed_by_a_part_of_the_smallest_block(blocks: int, part: float) -> None:
    half = 0.1 + 0.1 * np.arange(blocks)
    bodies = [box(str(k), [3.0 * k, 0.0, h], [h] * 3, free_spin=HELD) for k, h in enumerate(half)]
    space = Space(Scene((FLOOR, *bodies), Contact(np.inf), gravity=DOWN))
    setting = space.arguments(DT)[0]
    assert setting.slack == pytest.approx(part * setting.shapes.size.min())
    assert setting.shapes.size[1] == pytest.approx(2.0 * setting.shapes.size[0])
