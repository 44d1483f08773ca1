"""Linear contact: a spring along the normal, and one across it up to Coulomb's limit."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.dem.contact.friction import sheared, slid
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple, dot


class Linear(NamedTuple):
    """kn [N/m]; friction: ks [N/m] and mu, or None (Li 2018, Eqs. 4-8)."""

    kn: float
    friction: tuple[float, float] | None

    @property
    def stiffness(self) -> tuple[float, float]:
        """kn and ks [N/m]."""
        return self.kn, 0.0 if self.friction is None else self.friction[0]


@inlined
def pressed(law: Linear, overlap: float, radius: float) -> tuple[float, float]:
    """kn U, and kn U^2/2."""
    return law.kn * overlap, 0.5 * law.kn * overlap * overlap


@inlined
def rubbed(
    law: Linear, touch: Touch, radius: float, spring: Triple, dt: float
) -> tuple[Triple, float, float]:
    """The spring charged by the slide, up to mu kn U."""
    (ks, mu), overlap = law.friction, touch.overlap  # type: ignore[misc]  # asked where it rubs
    slide, change = slid(touch, dt)
    caps = mu * law.kn * (overlap + touch.opened), mu * law.kn * overlap
    force, taken = sheared(spring, touch, slide, change, ks, caps)
    return force, 0.5 * dot(force, force) / ks, taken
