"""Claims about an oblique impact on a spring, a dashpot and friction: two routes agree."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference_solutions.contact import oblique_dashpot
from reference_solutions.contact.oblique_dashpot import Impact
from tests.scenes.event_located import event_located
from tests.scenes.spheres.oblique_impact import oblique
from tests.support.turned_signs import caught, signs, turned

THERE_AND_BACK = Impact(2.0, 1e4, 3e4, 0.3, 0.05, 0.3, 0.1)  # sticks, slips, sticks, slips back
T = np.linspace(0.0, 0.05, 6)


def agree(impact: Impact, motion: object = oblique_dashpot.motion) -> bool:
    """Whether the path agrees with event location; only the route under test has closed forms."""
    found = np.stack(motion(T, impact), axis=1)  # type: ignore[operator]
    due = event_located(oblique(impact), T, 1e-3)[:, 0]
    return bool(np.abs(found - due).max() < 1e-11 * np.abs(due).max())


@given(
    st.floats(0.05, 0.9), st.floats(0.02, 3.0), st.floats(0.1, 1.0), st.floats(1e3, 4e4),
)  # fmt: skip
@settings(max_examples=4)
def test_the_two_routes_agree(z: float, along: float, mu: float, ks: float) -> None:
    assert agree(Impact(2.0, 1e4, ks, mu, z, 0.3, along))


@pytest.mark.parametrize("sign", signs(oblique_dashpot))
def test_any_wrong_sign_is_caught(sign: int) -> None:
    wrong = turned(oblique_dashpot, sign)
    assert caught(lambda: agree(wrong.Impact(*THERE_AND_BACK), wrong.motion))


def test_what_catches_wrong_signs_lets_unchanged_copies_pass() -> None:
    same = turned(oblique_dashpot, None)
    assert agree(same.Impact(*THERE_AND_BACK), same.motion)
