"""Claims about Kratos' spheres that leave a lock for which a dead load stands."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import adapters.kratos
from vv.ask import Displacement, Status, Velocity
from vv.scene import Term


@pytest.mark.parametrize(
    ("terms", "status", "seen", "said"),
    [
        ({Term.OBLIQUE_LOCK}, Status.RAN, Displacement(3), "body 3 leaves 1"),
        ({Term.OBLIQUE_LOCK}, Status.RAN, Velocity(3), None),
        ({Term.OBLIQUE_LOCK}, Status.DIVERGED, Displacement(3), None),
        ({Term.LOAD}, Status.RAN, Displacement(3), None),
    ],
)
def test_only_a_displacement_of_a_run_with_oblique_locks_is_an_error(
    monkeypatch: pytest.MonkeyPatch, terms: set[Term], status: Status, seen: Any, said: str | None
) -> None:
    monkeypatch.setattr(
        adapters.kratos, "why_load_is_no_lock", lambda scene, sphere, moved: f"leaves {sphere}"
    )
    scene = SimpleNamespace(terms=lambda: terms, sphere_index=lambda body: body - 2)
    ask: Any = SimpleNamespace(scene=scene)
    run: Any = SimpleNamespace(status=status, values={seen: np.ones((2, 3))})
    assert adapters.kratos._drift(ask, run) == said
