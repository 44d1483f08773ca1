"""What is known of an ask before it is run: which asks a scheme and a code refuse, and why."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from tests.scene.test_scene import PARTLY, TURNED, Z, balls, block, scene
from vv.ask import Ask, Displacement, History, Knobs, Method, SearchVariable, Status, Velocity
from vv.codes import Adapter, Found, Scheme
from vv.codes.adapter import (
    behind_wall,
    known_beforehand,
    no_drag,
    no_sphere,
    no_steps,
    turned_spin_lock,
    unreported,
)
from vv.scene import Form, Scene, Term, Wall

ASK = Ask(scene(), History(1.0, 0.1), (Displacement(0),), Knobs(0.1))
SCHEME = Scheme("default", "", Method.SECOND_ORDER, frozenset({Term.SPHERE}))
HERE, AWAY = Found(True), Found(False, how_to_install="make it")


def asked(**changes: Any) -> Ask:
    return dataclasses.replace(ASK, **changes)


def searched(variable: SearchVariable) -> Any:
    return SimpleNamespace(variable=variable)


@pytest.mark.parametrize(
    ("scheme", "ask", "found", "why"),
    [
        ({}, ASK, HERE, None),
        ({}, ASK, AWAY, "make it"),
        ({"terms": frozenset()}, ASK, AWAY, "code/default does not support: spheres"),
        ({"terms": frozenset(), "why_not": {Term.SPHERE: "it has none"}}, ASK, HERE,
         "code/default does not support: spheres (it has none)"),
        ({"observables": frozenset({Velocity})}, ASK, HERE,
         "code/default does not report: Displacement"),
        ({}, asked(knobs=Knobs(0.1, dd=0.9)), HERE,
         "its steps keep all velocity, not dd = 0.9"),
        ({"knobs": ("dt", "dd")}, asked(knobs=Knobs(0.1, dd=0.9)), HERE, None),
        ({}, asked(knobs=Knobs(3.0)), HERE, "dt = 3 s is longer than the 1 s to be run"),
    ],
)  # fmt: skip
def test_refusals_come_before_what_is_not_installed(
    scheme: dict[str, Any], ask: Ask, found: Found, why: str | None
) -> None:
    code = cast(Adapter, SimpleNamespace(name="code", refuses=lambda ask, scheme: None))
    run = known_beforehand(code, dataclasses.replace(SCHEME, **scheme), ask, found)
    assert (run and run.reason) == why
    if run:
        assert run.status is (Status.NOT_INSTALLED if why == "make it" else Status.REFUSED)


def test_a_code_s_own_refusal_is_told() -> None:
    code = cast(Adapter, SimpleNamespace(name="code", refuses=lambda ask, scheme: f"no {scheme}"))
    run = known_beforehand(code, SCHEME, ASK, AWAY)
    assert run is not None
    assert (run.status, run.reason) == (Status.REFUSED, "no default")


@pytest.mark.parametrize(
    ("dt", "variable", "words"),
    [
        (0.1, None, None),
        (1.0, None, None),
        (3.0, None, "longer than"),
        (None, None, None),
        (None, SearchVariable.STEP, "it has no time step"),
        (0.1, SearchVariable.STEP, None),
        (None, next(one for one in SearchVariable if one is not SearchVariable.STEP), None),
    ],
)
def test_steps_fit_unless_one_is_too_long_or_one_is_searched_and_there_is_none(
    dt: float | None, variable: SearchVariable | None, words: str | None
) -> None:
    ask: Any = SimpleNamespace(
        knobs=Knobs(dt), search=variable and searched(variable), goal=ASK.goal
    )
    why = no_steps(ask)
    assert (why is None) is (words is None)
    assert words is None or words in (why or "")


@pytest.mark.parametrize(
    ("seen", "energies", "why"),
    [
        ((Displacement(0), Velocity(0)), (), None),
        ((), (Form.KINETIC,), None),
        ((), (Form.KINETIC, Form.GRAVITY, Form.LOAD),
         "energy over time (gravity potential; load potential)"),
    ],
)  # fmt: skip
def test_what_a_scheme_does_not_report_is_named(
    seen: Any, energies: tuple[Form, ...], why: str | None
) -> None:
    scheme = dataclasses.replace(SCHEME, energies=frozenset({Form.KINETIC}))
    ask: Any = SimpleNamespace(observables=seen, energies=energies)
    assert unreported(scheme, ask) == why


def test_only_scenes_with_drag_are_for_a_scheme_that_differs_in_it() -> None:
    assert no_drag(scene(eta=0.1)) is None
    assert "there is no drag" in (no_drag(scene()) or "")


def test_a_body_that_is_no_sphere_is_named() -> None:
    one = scene(balls(), block())
    assert no_sphere(asked(scene=one), one) is None
    assert "body 1 is not a sphere" in (
        no_sphere(asked(scene=one, observables=(Displacement(1),)), one) or ""
    )


@pytest.mark.parametrize(("height", "behind"), [(7.1, False), (7.0, True), (6.9, True)])
def test_a_centre_behind_a_wall_is_refused(height: float, behind: bool) -> None:
    two = dataclasses.replace(balls(2), position=np.array([9.0 * Z, height * Z]))
    why = behind_wall(scene(Wall(-3.0 * Z, Z), Wall(7.0 * Z, Z), two))
    assert (why is not None) is behind
    assert why is None or why.startswith("the centre of sphere 1 lies behind wall 1")


FREE, ABOUT_Z = np.ones(3, bool), np.array([False, False, True])


@pytest.mark.parametrize(
    ("one", "refused"),
    [
        (scene(balls(free_spin=PARTLY)), False),
        (scene(balls(free_spin=PARTLY), axes=TURNED), True),
        (scene(balls(free_spin=FREE), axes=TURNED), False),
        (scene(balls(free_spin=~FREE), axes=TURNED), False),
        (scene(balls(free_spin=FREE), balls(free_spin=PARTLY), axes=TURNED), True),
        (scene(block(free_spin=PARTLY), axes=TURNED), True),
        (scene(block(free_spin=ABOUT_Z), axes=TURNED), False),  # z is the frame's
        (scene(block(free_spin=PARTLY)), False),
        (scene(block(free_spin=ABOUT_Z), block(free_spin=PARTLY), axes=TURNED), True),
    ],
)
def test_rotation_locked_about_axes_of_a_turned_frame_is_refused(one: Scene, refused: bool) -> None:
    why = turned_spin_lock(one, "it locks its own")
    assert (why is not None) is refused
    assert why is None or why.endswith("it locks its own")
