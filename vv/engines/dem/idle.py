"""The terms of a scene that have no effect, and the refusal of scenes whose model omits others."""

from __future__ import annotations

import functools

from vv.engines.dem.bulk.model import bulk
from vv.engines.dem.line.model import line
from vv.engines.dem.pressed.model import pressed
from vv.engines.dem.space.model import space
from vv.scene import Scene, Term

CONTACTS = frozenset({Term.SPHERE_CONTACT, Term.WALL_CONTACT})
VISCOUS = frozenset({Term.CONTACT_VISCOSITY, Term.HERTZ_VISCOSITY})
RUBBED = frozenset({Term.FRICTION, Term.MICRO_SLIP})
OF_CONTACTS = VISCOUS | RUBBED
OF_MOTION = VISCOUS | CONTACTS


def idle(scene: Scene) -> frozenset[Term]:
    """The terms of a scene that change none of its observables.

    They are the contact law where there are no contacts, and the normal contact where no sphere can
    move in any direction or has a steady velocity: reactions there are not observable.
    """
    terms, spheres = scene.terms(), scene.spheres
    found = frozenset() if terms & CONTACTS else OF_CONTACTS
    if not (spheres.free.any() or scene.locked_velocity.any()):
        turns = Term.FRICTION in terms and spheres.free_spin.any()
        found |= frozenset() if turns else OF_MOTION | RUBBED
    return terms & found


@functools.lru_cache(maxsize=32)  # asked for every setting of a scene
def why_left_out(scene: Scene, whole: bool) -> str | None:
    """Why the scene is refused if its model would omit some of its terms; None if it has all.

    whole: whether the general model is needed, which has all energies and reactions.
    """
    small = None if whole else line(scene) or pressed(scene)
    left = scene.terms() - (small or bulk(scene) or space(scene)).terms - idle(scene)
    if not left:
        return None
    named = ", ".join(sorted(term.value for term in left))
    return f"the model would omit terms that have nothing to act on, or no effect: {named}"
