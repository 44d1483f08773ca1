"""The question put to a code (Ask) and its answer (Run).

May import: base, scene.
"""

from vv.ask.ask import Ask
from vv.ask.goals import NO_STIFFNESS, Bracket, History, Knobs, SearchVariable
from vv.ask.observables import (
    Displacement,
    Impulse,
    Observable,
    Reaction,
    Strain,
    Velocity,
)
from vv.ask.run import Cost, Ledger, Model, Run
from vv.ask.status import Method, Status

__all__ = [
    "NO_STIFFNESS",
    "Ask",
    "Bracket",
    "Cost",
    "Displacement",
    "History",
    "Impulse",
    "Knobs",
    "Ledger",
    "Method",
    "Model",
    "Observable",
    "Reaction",
    "Run",
    "SearchVariable",
    "Status",
    "Strain",
    "Velocity",
]
