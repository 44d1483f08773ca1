"""The interface of contact laws, and the choice of the law of a scene.

A law is a named tuple in a file of this folder. Its field `friction` is None without friction;
otherwise its second number is mu. Its field `at_run_time` is None if the compiler decides whether
there are friction and rotation; it is a number if every step decides this at run time, and a scene
without friction then has `NO_FRICTION`. Its property `stiffness` is the largest kn and ks [N/m],
and its property `columns` says how many numbers a contact stores from step to step.

Its file has the functions `normal_force` and `friction_force`, which contacts of all kinds call,
`damping_at` if the law may be viscous, and `shear_stiffness` and `shear_energy` if the model of
many spheres supports it.
"""

from __future__ import annotations

from typing import Any

from vv.engines.dem.contact.hertz import elastic_law
from vv.engines.dem.contact.linear import Linear
from vv.engines.dem.contact.micro_slip import micro_slip_law
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.by_class import of_its_file
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple
from vv.scene import Scene, Term, Vector

Law = Any
NO_FRICTION = (0.0, 0.0)


def law_of(scene: Scene) -> Law:
    """The contact law of a scene."""
    law, rough = scene.contact, Term.FRICTION in scene.terms()
    if law.hertz is not None:
        in_part = rough and law.hertz.micro_slip
        return micro_slip_law(scene, law.hertz) if in_part else elastic_law(scene, law.hertz, rough)
    friction = (law.ks, law.mu) if rough else None
    return Linear(law.kn, friction, law.eta_n if law.eta_n > 0 else None)


def has_friction(law: Law) -> bool:
    """Whether the law has friction."""
    return law.friction is not None and law.friction[1] > 0.0


@inlined
def spheres_rotate(turn: Vector | None, at_run_time: int | None) -> bool:
    """Whether spheres rotate; if `at_run_time` is a number, the rows of `turn` decide this."""
    if turn is None:
        return False
    if at_run_time is None:
        return True
    return len(turn) > 0


@of_its_file
def normal_force(law: Law, overlap: float, radius: float) -> tuple[float, float]:
    """The elastic normal force [N] at an overlap [m], and the energy [J] stored in it.

    radius: 1/(1/r1 + 1/r2) of the two surfaces [m].
    """
    raise NotImplementedError


@of_its_file
def shear_stiffness(
    law: Law, touch: Touch, radius: float, mass: float, spring: Triple
) -> tuple[float, tuple[float, float]]:
    """The tangential stiffness [N/m] in a step, and the limits mu Fn [N] before and after the step.

    radius as for `normal_force`; mass: the reduced mass [kg] of the bodies that can move; spring:
    the tangential force [N] before the step.
    """
    raise NotImplementedError


@of_its_file
def shear_energy(law: Law, overlap: float, radius: float, force: Triple) -> float:
    """The energy [J] stored in the tangential spring at a force [N]."""
    raise NotImplementedError


@of_its_file
def friction_force(
    law: Law, touch: Touch, radius: float, mass: float, kept: Vector, row: int, dt: float
) -> tuple[Triple, float, float]:
    """The tangential force [N] after a step, the energy [J] of its spring, and that dissipated.

    radius and mass as for `shear_stiffness`; kept (k, columns): the numbers stored per contact,
    this one's in the given row, the tangential force before the step first. The force acts on the
    second body; the normal points from the first to the second.
    """
    raise NotImplementedError


@of_its_file
def damping_at(law: Law, before: float, overlap: float, radius: float, mass: float) -> float:
    """The coefficient [N s/m] of a viscous contact whose overlap [m] at the end of the step is > 0.

    before: the overlap one step earlier, inf if there was none; radius and mass as for
    `shear_stiffness`. In the step in which the contact closes, the coefficient is corrected so that
    its impulse is of second order, wherever in the step it closes.
    """
    raise NotImplementedError
