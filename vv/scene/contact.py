"""The law of contact between bodies: stiffnesses, friction, and viscosity along the normal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Contact:
    """Linear contact without tension: kn, ks [N/m], Coulomb coefficient mu, eta_n [N s/m].

    kn = inf is rigid contact: no elasticity, for which ks says nothing and the knob kn of a
    penalty scheme stands in.

    Fn = kn U for an overlap U > 0; the shear spring ks is charged by the tangential motion and
    capped at mu Fn (Li et al. 2018, Eqs. 4-8). ks = 0 or mu = 0 means no shear force.

    With eta_n, Fn = max(0, kn U + eta_n U'): it ends where it would pull, before the overlap does
    (Schwager and Poeschel 2007). What caps friction then is not stated, and raises ValueError.
    """

    kn: float
    ks: float = 0.0
    mu: float = 0.0
    eta_n: float = 0.0

    def __post_init__(self) -> None:
        if not self.kn > 0:
            raise ValueError(f"Contact.kn = {self.kn!r} N/m; a stiffness must be positive")
        for name, unit in (("ks", " N/m"), ("mu", ""), ("eta_n", " N s/m")):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise ValueError(f"Contact.{name} = {value!r}{unit}; it must be zero or more")
        if self.eta_n > 0 and (self.mu > 0 or self.rigid):
            raise ValueError(
                f"Contact.eta_n = {self.eta_n!r} N s/m with kn = {self.kn!r} N/m, mu = "
                f"{self.mu!r}; viscous contact has a finite kn and no friction"
            )

    @property
    def rigid(self) -> bool:
        """Whether it has no elasticity: a penalty scheme must be told a stiffness."""
        return not np.isfinite(self.kn)

    @property
    def rubs(self) -> bool:
        """Whether it can carry shear."""
        return self.mu > 0 and (self.ks > 0 or self.rigid)
