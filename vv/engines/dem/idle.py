"""What of a scene has nothing to act on: no model needs it, and what a model leaves out is told."""

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
    """Terms of a scene that change nothing of what may be observed.

    They are the law of contacts where there is nothing to touch, and contacts along the normal
    where no sphere is free to move along any line or is carried: of these no reaction is reported.
    """
    terms, spheres = scene.terms(), scene.spheres
    found = frozenset() if terms & CONTACTS else OF_CONTACTS
    if not (spheres.free.any() or scene.locked_velocity.any()):
        turns = Term.FRICTION in terms and spheres.free_spin.any()
        found |= frozenset() if turns else OF_MOTION | RUBBED
    return terms & found


@functools.lru_cache(maxsize=32)  # asked for every rung of a scene
def why_left_out(scene: Scene, whole: bool) -> str | None:
    """Why a scene is refused whose model would leave out some of it; None if it has all.

    whole: whether the general model is asked for, which has all energies and reactions.
    """
    small = None if whole else line(scene) or pressed(scene)
    left = scene.terms() - (small or bulk(scene) or space(scene)).terms - idle(scene)
    if not left:
        return None
    named = ", ".join(sorted(term.value for term in left))
    return f"the model leaves out what it sees nothing to act on, or to be changed by: {named}"
