"""Kratos' DEM application as a code of the framework: spheres on linear springs or by Hertz."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from adapters.kratos.plan import plan, refusal
from vv.ask import Ask, Displacement, Method, Run, Status, Velocity
from vv.codes import Scheme
from vv.codes.driver_adapter import DriverAdapter
from vv.codes.own_python import Driver, PythonEnvironment
from vv.scene import Term, why_load_is_no_lock, with_loads_for_locks

DEFAULT = Scheme(
    "default",
    "velocity Verlet for translations, direct integration of rotations; linear springs of given "
    "stiffness or contacts by Hertz, and Coulomb friction",
    Method.LEAPFROG,
    frozenset(
        {
            Term.SPHERE,
            Term.SPHERE_CONTACT,
            Term.WALL_CONTACT,
            Term.FRICTION,
            Term.HERTZ,
            Term.GRAVITY,
            Term.LOAD,
            Term.ROTATION,
            Term.OBLIQUE_LOCK,
        }
    ),
    observables=frozenset({Displacement, Velocity}),
    pace=(2.5e-5, 1.5e-6),
)
HOME = PythonEnvironment("kratos", ("kratosdemapplication", "kratosmultiphysics"))
DRIVER = Driver(HOME, Path(__file__).with_name("driver.py"))
NOTES = (
    "law DEM_D_Linear_Custom_Constants, its stiffnesses as properties of the contacts, or "
    "DEM_D_Hertz_viscous_Coulomb, by a material whose contacts have these moduli",
    "masses and inertias as given, weights and loads as one external force on each sphere",
    "the force at t = 0 given for the first half step",
    "each wall a rigid face of four corners, far larger than the scene",
)


def _drift(ask: Ask, run: Run) -> str | None:
    """Report a sphere that moved along a locked direction, where a dead load replaces the lock."""
    if Term.OBLIQUE_LOCK not in ask.scene.terms() or run.status is not Status.RAN:
        return None
    for seen, moved in run.values.items():
        sphere = ask.scene.sphere_index(seen.body)
        if isinstance(seen, Displacement) and (
            how := why_load_is_no_lock(ask.scene, sphere, moved)
        ):
            return f"body {seen.body} {how}"
    return None


ADAPTER = DriverAdapter(
    DEFAULT,
    DRIVER,
    NOTES,
    refusal=refusal,
    plan=plan,
    frame=lambda ask: np.eye(3),
    integrated=with_loads_for_locks,
    fault=_drift,
)
