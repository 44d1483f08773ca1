"""All of ask.json, by hand: a scene in which no two numbers of one kind are alike."""

from __future__ import annotations

import json

import numpy as np

from vv.ask import Ask, Displacement, History, Knobs, Reaction, Velocity
from vv.codes.program import question
from vv.scene import (
    Block,
    Bonds,
    Contact,
    Elastic,
    Fluid,
    Form,
    Harmonic,
    Pulse,
    Scene,
    Spheres,
    Wall,
    box_geometry,
)

YES, NO = True, False
AXES = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]
SLANTED = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
EYE = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


def sphere(number: int, free: list[bool], free_spin: list[bool]) -> Spheres:
    """One whose numbers are its own: radius 0.1 n, mass n, and vectors that count on from 10 n."""
    vectors = np.arange(10.0 * number, 10.0 * number + 12.0).reshape(4, 1, 3)
    position, velocity, spin, load = vectors
    return Spheres(position, velocity, np.array([0.1 * number]), np.array([1.0 * number]),
                   np.array([free]), np.array([0.5 * number]), spin, np.array([free_spin]),
                   load)  # fmt: skip


def block() -> Block:
    vertices, faces = box_geometry(np.array([4.0, 5.0, 6.0]), np.array([0.5, 1.0, 1.5]), np.eye(3))
    return Block(
        "slab", vertices, faces, 8.0, np.diag([1.0, 2.0, 3.0]), np.array([0.1, 0.2, 0.3]),
        np.array([YES, NO, NO]), np.array([NO, YES, YES]), np.array([0.4, 0.5, 0.6]),
        np.array([0.7, 0.8, 0.9]), Elastic(5e9, 0.25),
    )  # fmt: skip


def scene() -> Scene:
    moved = Harmonic(np.array([0.01, 0.02, 0.03]), np.array([1.0, 2.0, 3.0]),
                     np.array([0.4, 0.5, 0.6]), np.array(SLANTED))  # fmt: skip
    shaken = Harmonic(np.array([1.1, 1.2, 1.3]), np.array([4.0, 5.0, 6.0]))
    bonds = Bonds(np.array([[1, 2], [4, 2]]), np.array([0.3, 7.0]), np.array([2e5, 3e5]),
                  np.array([1e5, 4e4]), np.array([50.0, np.inf]),
                  np.array([60.0, np.inf]))  # fmt: skip
    bodies = (
        Wall(np.array([0.0, 0.0, -9.0]), np.array([0.0, 0.0, 1.0]), moved),
        sphere(1, [YES, NO, NO], [NO, NO, YES]),
        sphere(2, [YES, YES, NO], [NO, YES, NO]),
        block(),
        sphere(3, [NO, YES, YES], [YES, NO, NO]),
    )
    return Scene(
        bodies, Contact(2e5, 1e5, 0.3, 7.0), 0.8, np.array([0.0, 1.0, -9.0]), np.array(AXES),
        Pulse(shaken, 0.35), bonds, Fluid(1000.0, 2e-3),
    )  # fmt: skip


def asked() -> dict[str, object]:
    """The question as a program reads it, of steps of 0.25 s to 1 s with every second put out."""
    ask = Ask(
        scene(), History(1.0, 0.5), (Velocity(4), Displacement(1), Reaction(2)), Knobs(0.25, 1e9),
        energies=(Form.KINETIC, Form.DRAG),
    )  # fmt: skip
    found: dict[str, object] = json.loads(question.text(ask, "fine", ("kn", "dt")))
    return found


def test_a_question_says_what_is_to_be_solved_and_put_out() -> None:
    found = asked()
    del found["scene"], found["terms"]
    assert found == {
        "format": "vv ask 1",
        "scheme": "fine",
        "knobs": {"dt": 0.25, "kn": 1e9},
        "duration": 1.0,
        "interval": 0.5,
        "steps": 4,
        "stride": 2,
        "times": [0.0, 0.5, 1.0],
        "observables": [
            {"kind": "velocity", "body": 4,
             "columns": ["velocity_4_x", "velocity_4_y", "velocity_4_z"]},
            {"kind": "displacement", "body": 1,
             "columns": ["displacement_1_x", "displacement_1_y", "displacement_1_z"]},
            {"kind": "reaction", "body": 2,
             "columns": ["reaction_2_x", "reaction_2_y", "reaction_2_z"]},
        ],
        "energies": [
            {"form": "kinetic", "column": "energy_kinetic"},
            {"form": "drag", "column": "energy_drag"},
        ],
        "columns": [
            "t", "velocity_4_x", "velocity_4_y", "velocity_4_z", "displacement_1_x",
            "displacement_1_y", "displacement_1_z", "reaction_2_x", "reaction_2_y", "reaction_2_z",
            "energy_kinetic", "energy_drag",
        ],
    }  # fmt: skip


def test_each_number_of_a_scene_stands_under_its_name() -> None:
    found = asked()["scene"]
    assert isinstance(found, dict)
    vertices = found["blocks"][0].pop("vertices")
    assert sorted(vertices) == [[x, y, z] for x in (3.5, 4.5) for y in (4.0, 6.0)
                                for z in (4.5, 7.5)]  # fmt: skip
    assert found["blocks"][0].pop("faces") == [list(face) for face in block().faces]
    assert found == {
        "contact": {"kn": 2e5, "ks": 1e5, "mu": 0.3, "eta_n": 7.0},
        "drag": 0.8,
        "gravity": [0.0, 1.0, -9.0],
        "axes": AXES,
        "shaking": {"amplitude": [1.1, 1.2, 1.3], "frequency": [4.0, 5.0, 6.0],
                    "phase": [0.0, 0.0, 0.0], "axes": EYE, "until": 0.35},
        "spheres": {
            "body": [1, 2, 4],
            "position": [[10.0, 11.0, 12.0], [20.0, 21.0, 22.0], [30.0, 31.0, 32.0]],
            "velocity": [[13.0, 14.0, 15.0], [23.0, 24.0, 25.0], [33.0, 34.0, 35.0]],
            "spin": [[16.0, 17.0, 18.0], [26.0, 27.0, 28.0], [36.0, 37.0, 38.0]],
            "load": [[19.0, 20.0, 21.0], [29.0, 30.0, 31.0], [39.0, 40.0, 41.0]],
            "radius": [0.1, 0.2, 0.1 * 3],
            "mass": [1.0, 2.0, 3.0],
            "inertia": [0.5, 1.0, 1.5],
            "free": [[1, 0, 0], [1, 1, 0], [0, 1, 1]],
            "free_spin": [[0, 0, 1], [0, 1, 0], [1, 0, 0]],
        },
        "walls": [{
            "body": 0, "point": [0.0, 0.0, -9.0], "normal": [0.0, 0.0, 1.0],
            "motion": {"amplitude": [0.01, 0.02, 0.03], "frequency": [1.0, 2.0, 3.0],
                       "phase": [0.4, 0.5, 0.6], "axes": SLANTED},
        }],
        "blocks": [{
            "body": 3, "name": "slab", "centroid": [4.0, 5.0, 6.0], "mass": 8.0,
            "inertia": [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]],
            "velocity": [0.1, 0.2, 0.3], "spin": [0.4, 0.5, 0.6], "load": [0.7, 0.8, 0.9],
            "free": [1, 0, 0], "free_spin": [0, 1, 1],
            "elastic": {"young": 5e9, "poisson": 0.25, "relaxed": False},
        }],
        "bonds": {"pairs": [[1, 2], [4, 2]], "length": [0.3, 7.0], "kn": [2e5, 3e5],
                  "ks": [1e5, 4e4], "tension": [50.0, None], "shear": [60.0, None]},
        "fluid": {"density": 1000.0, "viscosity": 2e-3},
    }  # fmt: skip
