"""The law by which surfaces that touch act on each other: what it is asked, which a scene has.

A law is a named tuple in a file of this folder. It has fields `friction`, of which the second
number is mu, and which is None where nothing rubs, and `asked`: None, or any number where each step
asks what rubs and turns, and friction that is nil is there, too (`NO_FRICTION`). It has properties
`stiffness`, kn and ks [N/m] at most, and `columns`, how many numbers are kept of a contact from
step to step, and functions in its file: `pressed` and `rubbed`, which contacts of pairs, of walls,
and of pairs that are near each other all call, `damped` if it may be viscous, and `across` and
`stored` if the model of many spheres has it, too.
"""

from __future__ import annotations

from typing import Any

from vv.engines.dem.contact.hertz import elastic
from vv.engines.dem.contact.linear import Linear
from vv.engines.dem.contact.micro_slip import micro_slip
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.by_class import of_its_file
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple
from vv.scene import Scene, Term, Vector

Law = Any
NO_FRICTION = (0.0, 0.0)


def law_of(scene: Scene) -> Law:
    """The law of a scene's contacts."""
    law, rough = scene.contact, Term.FRICTION in scene.terms()
    if law.hertz is not None:
        in_part = rough and law.hertz.micro_slip
        return micro_slip(scene, law.hertz) if in_part else elastic(scene, law.hertz, rough)
    friction = (law.ks, law.mu) if rough else None
    return Linear(law.kn, friction, law.eta_n if law.eta_n > 0 else None)


def rubs(law: Law) -> bool:
    """Whether surfaces rub."""
    return law.friction is not None and law.friction[1] > 0.0


@inlined
def turning(turn: Vector | None, asked: int | None) -> bool:
    """Whether spheres turn, if there are torques of any; asked: that of the law."""
    if turn is None:
        return False
    if asked is None:
        return True
    return len(turn) > 0


@of_its_file
def pressed(law: Law, overlap: float, radius: float) -> tuple[float, float]:
    """The push along the normal [N] of an overlap [m], and what it holds [J].

    radius: 1/(1/r1 + 1/r2) of the two surfaces [m].
    """
    raise NotImplementedError


@of_its_file
def across(
    law: Law, touch: Touch, radius: float, mass: float, spring: Triple
) -> tuple[float, tuple[float, float]]:
    """The stiffness across the normal [N/m] in a step, and mu Fn [N] before the step and after it.

    radius as for `pressed`; mass: the reduced one [kg], of what can move; spring: the force across
    before the step [N].
    """
    raise NotImplementedError


@of_its_file
def stored(law: Law, overlap: float, radius: float, force: Triple) -> float:
    """What the spring across the normal holds [J] at a force [N]."""
    raise NotImplementedError


@of_its_file
def rubbed(
    law: Law, touch: Touch, radius: float, mass: float, kept: Vector, row: int, dt: float
) -> tuple[Triple, float, float]:
    """The force across the normal [N] after a step, what its spring holds [J], what friction took.

    radius as for `pressed`; mass: the reduced one [kg], of what can move; kept (k, columns): what
    is kept of contacts from step to step, of this one in a row, that force before the step first.
    It acts on the second of two surfaces, from the first to which the normal points.
    """
    raise NotImplementedError


@of_its_file
def damped(law: Law, before: float, overlap: float, radius: float, mass: float) -> float:
    """The coefficient [N s/m] of viscous contact at an overlap [m] > 0 at the end of a step.

    before: the overlap a step earlier, inf for none; radius and mass as above. In the first step
    of a contact the coefficient is that which gives its impulse to second order, whenever in that
    step the contact closed.
    """
    raise NotImplementedError
