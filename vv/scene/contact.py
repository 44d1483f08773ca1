"""The contact law between bodies: springs or elastic moduli, Coulomb friction, viscosity."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vv.scene.hertz import Hertz


@dataclass(frozen=True)
class Contact:
    """Linear contact without tension: kn, ks [N/m], Coulomb coefficient mu, eta_n [N s/m].

    kn = inf is rigid contact without elasticity. Then ks has no effect, and a penalty scheme uses
    the stiffness of its knob kn instead.

    Fn = kn U for an overlap U > 0; the shear spring ks is charged by the tangential motion and
    capped at mu Fn (Li et al. 2018, Eqs. 4-8). ks = 0 or mu = 0 means no shear force.

    With eta_n > 0, Fn = max(0, kn U + eta_n U'): the force never pulls and ends before the overlap
    does (Schwager and Poeschel 2007). Coulomb's limit is mu times this whole force, dashpot
    included, so that friction ends with it; the shear spring has no dashpot of its own.

    With `hertz` elastic spheres touch by that law in place of springs: kn, ks, eta_n are then 0.

    Raises ValueError for a kn that is not positive, for other values that are negative or not
    finite, for eta_n > 0 together with rigid contact, and for springs beside `hertz`.
    """

    kn: float
    ks: float = 0.0
    mu: float = 0.0
    eta_n: float = 0.0
    hertz: Hertz | None = None

    def __post_init__(self) -> None:
        if self.hertz is not None and (self.kn, self.ks, self.eta_n) != (0.0, 0.0, 0.0):
            raise ValueError(
                f"Contact.kn, ks, eta_n = {self.kn!r}, {self.ks!r}, {self.eta_n!r}; they must be 0 "
                "beside Contact.hertz, which takes their place"
            )
        if self.hertz is None and not self.kn > 0:
            raise ValueError(f"Contact.kn = {self.kn!r} N/m; a stiffness must be positive")
        for name, unit in (("ks", " N/m"), ("mu", ""), ("eta_n", " N s/m")):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise ValueError(f"Contact.{name} = {value!r}{unit}; it must be zero or more")
        if self.eta_n > 0 and self.rigid:
            raise ValueError(
                f"Contact.eta_n = {self.eta_n!r} N s/m with kn = {self.kn!r} N/m; viscous contact "
                "has a finite kn"
            )

    @property
    def rigid(self) -> bool:
        """Whether the contact has no elasticity; a penalty scheme then needs its knob kn."""
        return not np.isfinite(self.kn)

    @property
    def viscous(self) -> bool:
        """Whether the contact is viscous along its normal."""
        return self.eta_n > 0 or (self.hertz is not None and self.hertz.damping > 0)

    @property
    def carries_shear(self) -> bool:
        """Whether the contact can transmit a shear force."""
        stiff = self.ks if self.hertz is None else self.hertz.shear_modulus
        return self.mu > 0 and (stiff > 0 or self.rigid)
