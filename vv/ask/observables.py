"""What a code can be asked to report of a body over time."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Displacement:
    """Observable: the displacement of a body's centre since t = 0, (3,) per time [m]."""

    body: int


@dataclass(frozen=True)
class Velocity:
    """Observable: the velocity of a body's centre, (3,) per time [m/s]."""

    body: int


@dataclass(frozen=True)
class Reaction:
    """Observable: the force of the locks on a body's translations, (3,) per time [N]."""

    body: int


@dataclass(frozen=True)
class Impulse:
    """Observable: the integral of that force since t = 0, (3,) per time [N s], with impacts."""

    body: int


@dataclass(frozen=True)
class Strain:
    """Observable: the normal strains of a block along the scene's axes, (3,) per time.

    Strains and stresses rotate with the block, unless a scheme says otherwise.
    """

    body: int


Observable = Displacement | Velocity | Reaction | Impulse | Strain
