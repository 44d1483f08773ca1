"""The sections of a deck, to which each term of a scene adds its commands."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

SPRINGS = "pair gran, hooke/stiffness: kn is the contact's stiffness, nothing is damped"


@dataclass(frozen=True)
class Law:
    """The contact law of a deck.

    style: LIGGGHTS' contact model; tangential: that of its shear spring; damping: its switches;
    properties: values for a pair of types, by name, where kn and kt are the springs themselves
    [N/m]; material: values for a type, by name; bonds: commands that replace all of this; note: the
    description.
    """

    properties: Mapping[str, float]
    style: str = "hooke/stiffness"
    tangential: str = "off"
    damping: str = "tangential_damping off"
    material: Mapping[str, float] = field(default_factory=dict)
    bonds: tuple[str, ...] = ()
    note: str = SPRINGS

    @property
    def model(self) -> str:
        """The contact model, in the syntax of commands for pairs and walls."""
        return f"model {self.style} tangential {self.tangential}"

    def commands(self) -> Iterator[str]:
        """The commands that set the law for all pairs of spheres."""
        yield from self.bonds
        if self.bonds:
            return
        if self.material:
            yield "hard_particles  yes"
        for name, value in self.material.items():
            yield f"fix {name} all property/global {name} peratomtype {float(value)!r}"
        for name, value in self.properties.items():
            yield f"fix {name} all property/global {name} peratomtypepair 1 {float(value)!r}"
        yield f"pair_style      gran {self.model} {self.damping}"
        yield "pair_coeff      * *"


@dataclass(frozen=True)
class Deck:
    """The sections of a deck, in the order that LIGGGHTS requires.

    style: of atoms; box: creates the box; neighbours: how they are searched; created: creates the
    atoms; sized: their masses, radii and velocities; law and walls: contact; charging: sets shear
    springs before t = 0; moves: of walls; integrated: time integration; forces: on atoms; last:
    what must act after, or cancel, all other forces. notes: how terms are represented, one
    statement each; motion_notes: how atoms are moved.
    """

    box: tuple[str, ...]
    neighbours: tuple[str, ...]
    created: tuple[str, ...]
    sized: tuple[str, ...]
    law: Law
    integrated: tuple[str, ...]
    last: tuple[str, ...]
    motion_notes: tuple[str, ...]
    notes: tuple[str, ...]
    style: str = "granular"
    walls: tuple[str, ...] = field(default=())
    charging: tuple[str, ...] = field(default=())
    moves: tuple[str, ...] = field(default=())
    forces: tuple[str, ...] = field(default=())

    def with_more(self, **sections: Iterable[str]) -> Deck:
        """The deck with lines added to these sections."""
        longer = {name: (*getattr(self, name), *lines) for name, lines in sections.items()}
        return replace(self, **longer)  # type: ignore[arg-type]  # sections of lines only
