"""Explicit DEM: spheres and walls with linear contacts, by compiled leapfrogs.

May import: base, scene, ask, standins, engines.kernels.
"""

from vv.ask import Ask, Run
from vv.engines.dem.critical_step import critical_step
from vv.engines.dem.leapfrog import CENTRED, LAGGED, Leapfrog
from vv.engines.dem.refusals import refuses, unstable
from vv.engines.dem.safe_step import safe_step
from vv.engines.dem.solve import PreparedSpheres, prepare, solve

__all__ = [
    "CENTRED",
    "LAGGED",
    "Leapfrog",
    "PreparedSpheres",
    "critical_step",
    "prepare",
    "refuses",
    "safe_step",
    "solve_default",
    "solve_published",
    "unstable",
]


def solve_default(ask: Ask) -> Run:
    """Solve an ask by the leapfrog that is of second order in all terms; cost is left empty."""
    return solve(ask, CENTRED)


def solve_published(ask: Ask) -> Run:
    """Solve an ask by the leapfrog of Li et al. (2018), Eqs. 4-12; cost is left empty."""
    return solve(ask, LAGGED)
