"""The springs of DDA at each contact point."""

from __future__ import annotations

from dataclasses import dataclass

from vv.ask import NO_STIFFNESS
from vv.engines.dda.formulation import Formulation
from vv.scene import Scene


@dataclass(frozen=True)
class Springs:
    """kn, ks [N/m] of each point of contact and mu; ks and mu None without friction."""

    kn: float
    ks: float | None
    mu: float | None


def springs(scene: Scene, kn: float | None, formulation: Formulation) -> Springs:
    """The springs of the scene or, if its contact is rigid, those of the knob kn [N/m]."""
    law = scene.contact
    if law.rigid and kn is None:
        raise ValueError(NO_STIFFNESS)
    normal = float(kn) if law.rigid and kn is not None else law.kn
    shear = formulation.shear * normal if law.rigid else law.ks
    rough = law.mu > 0 and shear > 0
    return Springs(normal, shear if rough else None, law.mu if rough else None)
