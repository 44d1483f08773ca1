"""Claims about what is booked where Newton's iteration does not converge, by hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from vv.engines.dda.general.newton import assume_present_states
from vv.engines.dda.law import OPEN, SLIDE, STICK

pytestmark = pytest.mark.usefixtures("in_python")


@pytest.mark.parametrize("state", [OPEN, STICK, SLIDE])
def test_a_trial_that_is_kept_moves_as_its_unknowns_and_rubs_as_its_states(state: int) -> None:
    """What an increment assumed that was halved is replaced; the wall moves by (1, 2, 3) mm."""
    along = np.array([0.6, 0.8, 0.0])
    touch: Any = SimpleNamespace(
        state=np.array([state]), push=np.array([7.0]), direction=along[None],
        columns=np.array([2]), column=np.array([[1, 0]]), field=np.eye(3)[None, :2],
    )  # fmt: skip
    trial: Any = SimpleNamespace(
        used=np.array([STICK + 5]), rub=np.full((1, 3), 9.0), relative=np.full((1, 3), 9.0),
        shut=np.array([[1e-3, 2e-3, 3e-3]]),
    )  # fmt: skip
    assume_present_states(trial, touch, np.array([0.5, 0.25]), 0.3)
    assert trial.used[0] == state
    assert trial.relative[0] == pytest.approx([0.25 - 1e-3, 0.5 - 2e-3, -3e-3])
    assert trial.rub[0] == pytest.approx(0.3 * 7.0 * along if state == SLIDE else np.zeros(3))
