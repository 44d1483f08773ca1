"""Runs of one ball, and ledgers, of which tests change a part."""

import dataclasses
from typing import Any

import numpy as np

from vv.ask import (
    Ask,
    Cost,
    Displacement,
    History,
    Knobs,
    Ledger,
    Method,
    Model,
    Run,
    Status,
)
from vv.case import Exact, Tolerance
from vv.scene import Contact, Form, Scene, Spheres, Vector  # fmt: skip

WAY = Displacement(0)

BALL = Spheres(
    position=np.zeros((1, 3)),
    velocity=np.zeros((1, 3)),
    radius=np.ones(1),
    mass=np.ones(1),
    free=np.ones((1, 3), bool),
)

SCENE = Scene((BALL,), Contact(1e4), gravity=np.array([0.0, 0.0, -9.81]))

ASK = Ask(SCENE, History(1.0, 0.25), (WAY,), Knobs(0.25), energies=(Form.KINETIC,))

TIMES: Vector = np.array([0.0, 0.25, 0.5, 0.75, 1.0])

WHOLE = np.ones((5, 3))

SECOND = Method.SECOND_ORDER

EXACTLY = Exact({SECOND: Tolerance(1e-2, "why")})

POINT = Model(1, SCENE.terms(), "a point")


def run(**changes: Any) -> Run:
    whole = Run(
        Status.RAN, "", TIMES, {WAY: WHOLE}, Cost(solve_cpu=1e-3), 4, POINT, None,
        {Form.KINETIC: np.ones(5)},
    )  # fmt: skip
    return dataclasses.replace(whole, **changes)


def ledger(**changes: Any) -> Ledger:
    return dataclasses.replace(LEDGER, **changes)


LEDGER = Ledger({"kinetic energy": 1.0}, 0.0, 1.0, 1e-9, {"Coulomb": (0.0, 1.0)})
