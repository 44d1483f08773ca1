"""Explicit DEM: spheres and walls with linear contacts, by compiled leapfrogs."""

from vv.ask import Ask, Run
from vv.dem.leapfrog import CENTRED, LAGGED, Leapfrog
from vv.dem.safe import safe_step
from vv.dem.solve import Program, prepare, refuses, solve, unstable
from vv.dem.stability import critical_step

__all__ = [
    "CENTRED",
    "LAGGED",
    "Leapfrog",
    "Program",
    "critical_step",
    "prepare",
    "refuses",
    "safe_step",
    "solve_default",
    "solve_published",
    "unstable",
]


def solve_default(ask: Ask) -> Run:
    """Solve an ask by the leapfrog of second order in every term; cost is left empty."""
    return solve(ask, CENTRED)


def solve_published(ask: Ask) -> Run:
    """Solve an ask by the leapfrog of Li et al. (2018), Eqs. 4-12; cost is left empty."""
    return solve(ask, LAGGED)
