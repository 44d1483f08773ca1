"""Claims about works of contacts with multipliers, and about slips that are alike, by hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from vv.engines.dda.general.augmented.multipliers import add_multiplier_energies
from vv.engines.dda.general.augmented.reversal import slip_alike
from vv.engines.dda.general.energy import BASE, CREATED, DEEPEST, EXCESS, FRICTION, NUMERICAL, PEAK
from vv.engines.dda.general.setting import Law
from vv.engines.dda.law import OPEN, SLIDE, STICK
from vv.engines.dda.limits import ALONG

pytestmark = pytest.mark.usefixtures("in_python")
UP, RIGHT = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
KN, KS, MU = 900.0, 40.0, 0.5


@pytest.mark.parametrize("used", [STICK, SLIDE, OPEN])
@pytest.mark.parametrize("wall", [-1, 0, 1])
@pytest.mark.parametrize("way", [0.3, -0.3])
def test_all_work_of_a_contact_but_that_of_friction_is_lost(
    used: int, wall: int, way: float
) -> None:
    """It presses by 7 N, opens by 0.02 m and slips by `way` against a rub of 3 N."""
    random = np.random.default_rng(1)
    field, moved = random.normal(size=(1, 2, 3)), random.normal(size=(2, 3))
    spring, rub = np.array([[0.05, 0.01, 0.0]]), np.array([[3.0, 0.4, 0.0]])
    relative = np.array([[way, 0.0, 0.02]])
    touch: Any = SimpleNamespace(
        key=[5], normal=UP[None], push=np.array([7.0]), spring=spring, wall=np.array([wall]),
        columns=np.array([2]), column=np.array([[2, 0]]), field=field, gap=np.array([-0.06]),
        force=np.zeros((1, 3)),
    )  # fmt: skip
    ledger, worst, pull = np.arange(13.0), np.zeros(10), np.full(4, 9.0)
    work: Any = SimpleNamespace(ledger=ledger, worst=worst, pull=pull, moved=moved, u=np.zeros(4))
    shut = np.array([[0.0, 0.0, -0.02]])  # its wall sinks, its block stays
    trial: Any = SimpleNamespace(used=np.array([used]), rub=rub, relative=relative, shut=shut)
    add_multiplier_energies(work, touch, trial, Law(KN, KS, MU, 1.0))
    rubs = {STICK: -KS * spring[0], SLIDE: -rub[0], OPEN: 0.0 * UP}[used]
    force, work = rubs + 7.0 * UP, float(rubs @ (way * RIGHT))
    due = np.arange(13.0)
    due[NUMERICAL] -= 7.0 * 0.02 + (work if used == STICK else max(work, 0.0))
    due[CREATED] += 7.0 * 0.02 + (max(work, 0.0) if used == SLIDE else 0.0)
    due[FRICTION] -= min(work, 0.0) if used == SLIDE else 0.0
    due[BASE] += force @ moved[wall] if wall >= 0 else 0.0
    assert ledger == pytest.approx(due)
    assert touch.force[0] == pytest.approx(force)
    assert pull == pytest.approx([field[0, 1] @ force, 0.0, field[0, 0] @ force, 0.0])
    assert touch.gap == pytest.approx([-0.04])
    assert worst[[EXCESS, PEAK, DEEPEST]] == pytest.approx(
        [max(np.linalg.norm(rubs) - MU * 7.0, 0.0), 7.0, 0.04]
    )


@pytest.mark.parametrize(("change", "alike"), [
    ({}, True), ({"state": STICK}, False), ({"state": STICK, "used": OPEN}, True),
    ({"used": STICK}, True), ({"turned": 0.98 * ALONG}, True), ({"turned": 1.02 * ALONG}, False),
    ({"way": 0.98e-3}, True), ({"way": 1.02e-3}, False), ({"aside": -1.02e-3}, False),
    ({"lifts": 0.5}, True), ({"held": 0.98 * ALONG}, True), ({"held": -1.02 * ALONG}, False),
    ({"held": 1.02 * ALONG, "used": OPEN}, True),
])  # fmt: skip
def test_contacts_slip_alike_that_slid_along_a_line_and_go_as_far_along_it(
    change: dict[str, float], alike: bool
) -> None:
    """The first of two does so; the second differs: in its state, direction, way or friction."""
    told = {"state": SLIDE, "used": SLIDE, "turned": 0.0, "way": 0.0, "aside": 0.0, "lifts": 0.0}
    told |= {"held": 0.0, **change}
    touch: Any = SimpleNamespace(normal=np.array([UP, UP]), push=np.array([7.0, 7.0]))
    rub = MU * 7.0 * np.array([0.3 * RIGHT, [0.3, told["held"], 0.0]])
    direction = np.array([RIGHT, np.array([1.0, told["turned"], 0.0])])
    relative = np.array([0.2 * RIGHT, [0.2 + told["way"], told["aside"], told["lifts"]]])
    states, used = (np.array([SLIDE, told[name]], int) for name in ("state", "used"))
    before: Any = SimpleNamespace(state=states, direction=direction)
    trial: Any = SimpleNamespace(used=used, relative=relative, rub=rub)
    along: Any = tuple(RIGHT)
    found = slip_alike(touch, before, trial, along, 0.2, 1e-3, MU)
    assert found is alike
