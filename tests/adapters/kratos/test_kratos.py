"""Claims about Kratos: what it is given and refuses, and what it answers where it is installed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from adapters.kratos import ADAPTER
from adapters.kratos.plan import plan
from tests.support.installed import only_with
from tests.support.live_asks import COARSE, TRIALS, error, ran
from vv.ask import Knobs
from vv.codes import unsupported

UNDRAGGED = [name for name in TRIALS if name[:2] in ("T1", "T3")]


def test_drag_is_a_term_that_it_lacks() -> None:
    (scheme,) = ADAPTER.schemes
    lacking = {name for name in TRIALS if unsupported(scheme, TRIALS[name].study.scene.terms())}
    assert lacking == set(TRIALS) - set(UNDRAGGED)


def test_a_load_stands_for_an_oblique_lock_and_cancels_the_contact_at_the_start() -> None:
    ask = TRIALS["T3-rotated"].study.ask(COARSE)
    assert ADAPTER.refuses(ask, "default") is None
    (sphere,) = plan(ask)["spheres"]
    assert sphere["free"] == [True, True, False]
    assert np.linalg.norm(sphere["start"]) < 1e-12 * np.linalg.norm(sphere["force"])


def test_the_face_of_a_wall_lies_in_it_and_looks_out_of_it() -> None:
    ask = TRIALS["T3-rotated"].study.ask(COARSE)
    (wall,), (corners,) = ask.scene.walls, plan(ask)["walls"]
    a, b, c, d = np.array(corners)
    half = np.linalg.norm(b - a) / 2
    assert np.cross(b - a, c - b) @ wall.normal == pytest.approx(4 * half**2)
    assert np.abs(([a, b, c, d] - wall.point) @ wall.normal).max() < 1e-12 * half
    assert half > 100 * ask.scene.spheres.radius.max()


def test_without_friction_shear_springs_carry_nothing() -> None:
    given = plan(TRIALS["T1"].study.ask(COARSE))
    assert given["mu"] == 0.0
    assert given["ks"] > 0


@only_with(ADAPTER)
def test_single_contacts_are_of_second_order(tmp_path: Path) -> None:
    steps = (1e-3, 5e-4)
    asks = [TRIALS[name].study.ask(Knobs(dt=dt)) for name in UNDRAGGED for dt in steps]
    runs = iter(ran(ADAPTER, asks, "default", tmp_path))
    for name in UNDRAGGED:
        coarse, fine = (error(next(runs), name) for _ in steps)
        assert coarse < 1e-4, name
        assert fine < coarse / 2.5, name
