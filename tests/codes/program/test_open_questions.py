"""What a question leaves open: no step, contact that is rigid, walls at rest, bonds that last."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

import numpy as np

from tests.codes.program.test_question import NO, YES, block, sphere
from vv.ask import Ask, Displacement, History, Knobs
from vv.codes.program import question
from vv.scene import Bonds, Contact, Form, Harmonic, Hertz, Scene, Wall

UP, BACK = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])


def told(ask: Ask, *knobs: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(question.text(ask, "default", knobs))
    return found


def floor() -> Scene:
    """A sphere on a floor and beside a wall, with a bond that never breaks to another one."""
    endless = np.array([np.inf])
    bonds = Bonds(np.array([[1, 3]]), np.ones(1), np.array([2e5]), np.zeros(1), endless, endless)
    shaken = Harmonic(np.array([1.1, 0.0, 0.0]), np.array([4.0, 0.0, 0.0]))
    bodies = (Wall(-9.0 * UP, UP), sphere(1, [YES] * 3, [NO] * 3), Wall(-8.0 * BACK, BACK),
              sphere(2, [YES] * 3, [NO] * 3))  # fmt: skip
    return Scene(bodies, Contact(np.inf, mu=0.5), bonds=bonds, shaking=shaken)


def test_without_a_step_times_are_the_intervals_and_steps_are_nobody_s() -> None:
    found = told(Ask(floor(), History(1.0, 0.25), (Displacement(1),), Knobs(None)), "dt")
    assert (found["knobs"], found["steps"], found["stride"]) == ({"dt": None}, None, None)
    assert found["times"] == [0.0, 0.25, 0.5, 0.75, 1.0]


def test_times_are_those_of_whole_steps() -> None:
    found = told(Ask(floor(), History(1.0, 0.4), (Displacement(1),), Knobs(0.25)), "dt")
    assert (found["steps"], found["stride"], found["times"]) == (4, 2, [0.0, 0.5, 1.0])


def test_a_scheme_is_given_its_own_knobs_alone() -> None:
    ask = Ask(floor(), History(1.0, 0.25), (Displacement(1),), Knobs(0.25, 1e9, 0.5))
    assert told(ask, "dd", "dt")["knobs"] == {"dd": 0.5, "dt": 0.25}


def test_what_has_no_end_is_null_and_what_a_scene_lacks_is_null_or_left_out() -> None:
    found = told(Ask(floor(), History(1.0, 0.25), (Displacement(1),)))["scene"]
    assert found["contact"] == {"kn": None, "ks": 0.0, "mu": 0.5, "eta_n": 0.0}
    assert found["bonds"] == {"pairs": [[1, 3]], "length": [1.0], "kn": [2e5], "ks": [0.0],
                              "tension": [None], "shear": [None]}  # fmt: skip
    assert "until" not in found["shaking"]
    assert "fluid" not in found
    assert found["blocks"] == []


def test_each_wall_is_its_own() -> None:
    found = told(Ask(floor(), History(1.0, 0.25), (Displacement(1),)))["scene"]["walls"]
    assert found == [
        {"body": 0, "point": [0.0, 0.0, -9.0], "normal": [0.0, 0.0, 1.0], "motion": None},
        {"body": 2, "point": [0.0, -8.0, 0.0], "normal": [0.0, 1.0, 0.0], "motion": None},
    ]


def test_a_rigid_block_in_a_scene_at_rest_has_no_law_no_shaking_and_no_bonds() -> None:
    rigid = Scene((dataclasses.replace(block(), elastic=None),), Contact(1e6))
    found = told(Ask(rigid, History(1.0, 0.25), ()))
    assert found["scene"]["blocks"][0]["elastic"] is None
    assert (found["scene"]["shaking"], found["scene"]["bonds"]) == (None, None)


def test_elastic_spheres_have_friction_beside_their_law_and_no_springs() -> None:
    law = Contact(0.0, mu=0.25, hertz=Hertz(7e9, 6e9, 0.125, micro_slip=False))
    one = Scene((sphere(1, [YES] * 3, [NO] * 3),), law)
    assert told(Ask(one, History(1.0, 0.25), ()))["scene"]["contact"] == {
        "kn": 0.0, "ks": 0.0, "mu": 0.25, "eta_n": 0.0,
        "hertz": {"modulus": 7e9, "shear_modulus": 6e9, "damping": 0.125, "micro_slip": False},
    }  # fmt: skip


def test_forms_and_terms_of_two_words_have_a_hyphen_and_columns_an_underscore() -> None:
    found = told(Ask(floor(), History(1.0, 0.25), (), energies=(Form.BROKEN_SHEAR,)))
    assert found["energies"] == [{"form": "broken-shear", "column": "energy_broken_shear"}]
    assert found["columns"] == ["t", "energy_broken_shear"]
    assert "rigid-contact" in found["terms"]
