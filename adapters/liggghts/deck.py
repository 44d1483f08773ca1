"""Writes a setup as a LIGGGHTS deck: one text, which needs no other file to run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from adapters.liggghts.outputs import count_commands, output_commands
from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import Setup
from adapters.liggghts.terms.table import translated
from vv.standins.clump import words

DOMAIN = """\
units           si
atom_style      {style}
atom_modify     map array sort 0 0
boundary        f f f
newton          off
communicate     single vel yes"""


def deck(setup: Setup, history: str) -> str:
    """A deck that solves an ask and writes the file `history`: a row per output after t = 0.

    A row holds the step, the number of spheres that are inside the box and before all walls, and
    three numbers for each of `setup.watched`: the displacement [m] or the velocity [m/s].
    """
    observed = [
        "",
        "modify_timing   on",
        *count_commands(setup),
        *output_commands(setup, history),
    ]
    return _text([*_prepared(setup), *observed, _run(setup), "unfix history"])


def silent_deck(setup: Setup, around: Sequence[str] = ()) -> str:
    """The same solve without any output, for timing; around: commands before and after the run."""
    return _text([*_prepared(setup), *around, _run(setup), *around])


def notes(setup: Setup) -> list[str]:
    """How the scene is represented, one statement each."""
    sections, stand_in = translated(setup), setup.springs.notes
    if setup.clumps:
        stand_in = words(setup.clumps, "a rigid body"), *stand_in[1:]
    return [*stand_in, sections.law.note, *sections.motion_notes, *sections.notes]


def _text(lines: Iterable[str]) -> str:
    return "\n".join(lines) + "\n"


def _run(setup: Setup) -> str:
    return f"run             {setup.ask.goal.steps(setup.ask.dt)}"


def _prepared(setup: Setup) -> Iterator[str]:
    """The commands up to the first step."""
    sections: Deck = translated(setup)
    yield DOMAIN.format(style=sections.style)
    yield from sections.box
    yield from sections.neighbours
    yield ""
    yield from (*sections.created, *sections.sized)
    yield ""
    yield from sections.law.commands()
    yield from sections.walls
    yield f"timestep        {setup.ask.dt!r}"
    yield "thermo_style    custom step atoms"
    yield "thermo          0"
    if sections.charging:
        yield ""
        yield from sections.charging
    yield ""
    yield from (*sections.moves, *sections.integrated, *sections.forces, *sections.last)
