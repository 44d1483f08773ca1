"""The declaration of a program and a question to it."""

from __future__ import annotations

from tests.support.adapters.live_asks import COARSE, flight
from vv.ask import Ask, Displacement, History, Velocity

DECLARED = """
command = "{command}"
[scheme.default]
method = "second-order"
terms = ["sphere", "drag", "gravity", "load"]
observables = ["displacement", "velocity"]
energies = ["kinetic"]
"""

ASK = Ask(flight(0.0), History(2e-3, 1e-3), (Displacement(0), Velocity(0)), COARSE)
