"""Claims about what the LIGGGHTS adapter models and refuses, and how it finds LIGGGHTS or not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from adapters.liggghts import ADAPTER
from cases.contact.single_contact import CASE
from tests.scenes.blocks.sliding_blocks import Frame, incline
from tests.support.adapters.liggghts_asks import HALF_STEP, PLAIN, ball, ball_ask
from tests.support.adapters.small_asks import FREE, UP, block_ask, case_ask
from vv.ask import Status
from vv.scene import Harmonic, Term

UNIT = np.array([1.0, 0.0, 0.0])

REFUSED = {
    "body 1 is not a sphere": ball_ask(ball(), UP, body=1),
    "dt is not set": ball_ask(ball(), dt=None),
    "longer than the 0.1 s": ball_ask(ball(), dt=0.2),
    "velocity or spin in a locked freedom": ball_ask(ball(spin=[[0, 0, 1]])),
    "no sphere is free": ball_ask(ball(free=~FREE)),
    "rotate about some axes only": ball_ask(ball(free_spin=[[True, False, False]])),
    "is not 2/5 m r2": ball_ask(ball(free_spin=FREE, inertia=[1.0])),
    "raise the inertia": ball_ask(ball(free_spin=FREE), eta=1.0),
    "lies behind wall 0": ball_ask(UP, ball(position=[[0, -0.01, 0]]), body=1),
    "these settings give no kn": block_ask(incline(Frame(20.0), 30.0), None),
    "has 29 groups": ball_ask(
        *(ball(position=[[i, 0, 0]], mass=[1.0 + i]) for i in range(32)),
        shaking=Harmonic(UNIT, UNIT),
    ),
}


@pytest.mark.parametrize("reason", REFUSED)
def test_what_liggghts_cannot_hold_is_refused(reason: str) -> None:
    assert reason in (ADAPTER.refuses(REFUSED[reason], HALF_STEP) or "not refused")


def test_every_variant_is_run_and_says_all_its_terms() -> None:
    for variant in CASE.variants:
        ask = case_ask(variant.name)
        for scheme in ADAPTER.schemes[: 2 if ask.scene.eta else 1]:
            assert ADAPTER.refuses(ask, scheme.name) is None
            assert ask.scene.terms() <= ADAPTER.describe(ask, scheme.name).terms <= scheme.terms
    assert "there is no drag" in (ADAPTER.refuses(case_ask("T3"), HALF_STEP) or "not refused")
    turned = ADAPTER.describe(case_ask("T4-rotated"), HALF_STEP)
    assert turned.unknowns == 3  # LIGGGHTS integrates locked translations too
    assert Term.OBLIQUE_LOCK in turned.terms
    for words in (
        "a dead load along the normal instead of a locked axis",
        "a mesh wall",
        "eta dt/2",
    ):
        assert words in turned.note


def test_an_absent_liggghts_is_said_to_be_absent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VV_LIGGGHTS", str(tmp_path / "nowhere"))
    assert not ADAPTER.found().installed
    (run,) = ADAPTER.run([case_ask("T1")], PLAIN, tmp_path, 0.0)
    assert run.status is Status.NOT_INSTALLED
    assert "apt-get install liggghts" in run.reason


def test_an_executable_of_one_s_own_is_found_with_its_library(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program, library = tmp_path / "bin/lmp", tmp_path / "lib/libliggghts.so.3.7.1"
    for file in (program, library):
        file.parent.mkdir()
        file.touch(0o755)
    monkeypatch.setenv("VV_LIGGGHTS", str(program))
    found = ADAPTER.found()
    assert (found.installed, found.version, found.path) == (True, "3.7.1", str(program))
    assert found.files == (program.resolve(), library.resolve())
