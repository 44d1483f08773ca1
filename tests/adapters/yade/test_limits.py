"""Claims about what the YADE adapter models and refuses, and how it finds YADE or its absence."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import pytest

from adapters.yade import ADAPTER
from cases.contact.single_contact import CASE
from tests.support.adapters.small_asks import UP, ball, ball_ask, case_ask
from tests.support.adapters.yade_asks import HALF_STEP, PLAIN
from vv.ask import Displacement, Reaction, Status
from vv.scene import Spheres, Term, Wall, rotated, rotation_about_z


def test_every_variant_is_run() -> None:
    for variant in CASE.variants:
        ask = case_ask(variant.name)
        assert ask.scene.terms() <= ADAPTER.schemes[0].terms
        assert ADAPTER.refuses(ask, PLAIN) is None
        assert (ADAPTER.refuses(ask, HALF_STEP) is None) == (ask.scene.eta > 0)


def test_drag_is_all_that_half_step_masses_are_about() -> None:
    terms = ADAPTER.schemes[1].terms
    assert {Term.SHAKING, Term.BASE_MOTION} <= terms
    assert not {Term.BLOCK, Term.RIGID_CONTACT} & terms


def refusal(*bodies: Spheres | Wall, **more: Any) -> str:
    return ADAPTER.refuses(ball_ask(*bodies, **more), PLAIN) or ""


def test_what_yade_would_get_wrong_is_refused_with_the_reason() -> None:
    carried = ball(velocity=[[1, 0, 0]], free=[[False, True, True]])
    turned = rotated(ball_ask(carried).scene, rotation_about_z(0.3))
    reason = ADAPTER.refuses(dataclasses.replace(ball_ask(carried), scene=turned), PLAIN)
    assert "locks are oblique" in (reason or "")
    assert "locked freedom" in refusal(ball(spin=[[1, 0, 0]]))
    assert "behind wall 0" in refusal(UP, ball(position=[[0, -0.01, 0]]), body=1)
    partly = ball(free_spin=[[True, False, False]])
    turned = rotated(ball_ask(partly).scene, rotation_about_z(0.3))
    reason = ADAPTER.refuses(dataclasses.replace(ball_ask(partly), scene=turned), PLAIN)
    assert "turned frame" in (reason or "")
    assert "body 0 is not a sphere" in refusal(UP, ball(position=[[0, 1, 0]]))


def test_a_model_states_its_unknowns_and_how_locks_are_kept() -> None:
    straight = ADAPTER.describe(case_ask("T3"), PLAIN)
    oblique = ADAPTER.describe(case_ask("T3-rotated"), PLAIN)
    assert (straight.unknowns, oblique.unknowns) == (1, 2)
    assert "a dead load along the normal instead of a locked axis" in oblique.note
    assert oblique.terms - straight.terms == {Term.OBLIQUE_LOCK, Term.LOAD}


def test_where_yade_is_absent_it_is_said_how_to_get_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VV_YADE", str(tmp_path))
    found = ADAPTER.found()
    assert not found.installed
    assert "apt-get install yade" in found.how_to_install
    runs = list(ADAPTER.run([case_ask("T1")] * 2, PLAIN, tmp_path, 0.0))
    assert [run.status for run in runs] == [Status.NOT_INSTALLED] * 2


def test_the_version_is_read_from_the_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "py" / "yade"
    package.mkdir(parents=True)
    (package / "wrapper.so").touch()
    (package / "config.py").write_text("prefix='/usr'\nversion='1.2b'\n")
    monkeypatch.setenv("VV_YADE", str(package.parent))
    monkeypatch.setattr("adapters.yade.installed.PYTHON", package / "config.py")
    assert ADAPTER.found().version == "1.2b"
    assert package / "wrapper.so" in ADAPTER.found().files


@pytest.mark.parametrize("oblique", [True, False])
@pytest.mark.parametrize("observed", [Reaction(1), Displacement(1)])
def test_only_the_reaction_of_an_oblique_lock_is_not_known(oblique: bool, observed: Any) -> None:
    ask = dataclasses.replace(case_ask("T3-rotated" if oblique else "T3"), observables=(observed,))
    unknown = "the reaction of oblique locks" in (ADAPTER.refuses(ask, PLAIN) or "")
    assert unknown is (oblique and isinstance(observed, Reaction))
