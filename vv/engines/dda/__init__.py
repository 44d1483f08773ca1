"""DDA: blocks on penalty springs, solved implicitly with open-close iterations.

May import: base, scene, ask, standins, engines.kernels, engines.blocks.
"""

from vv.ask import Ask, Run
from vv.engines.dda.formulation import BORNE, DAMPED, DEFAULT, LAGGED, PUBLISHED, Formulation
from vv.engines.dda.refusals import refuses
from vv.engines.dda.solve import PreparedBlocks, prepare, solve

__all__ = [
    "BORNE",
    "DAMPED",
    "DEFAULT",
    "LAGGED",
    "PUBLISHED",
    "Formulation",
    "PreparedBlocks",
    "prepare",
    "refuses",
    "solve",
    "solve_augmented_lagrangian",
    "solve_default",
    "solve_generalised_alpha",
    "solve_lagged",
    "solve_published",
]


def solve_default(ask: Ask) -> Run:
    """Solve an ask with friction iterated to convergence; cost is left empty."""
    return solve(ask, DEFAULT)


def solve_published(ask: Ask) -> Run:
    """Solve an ask by the published formulation with its known errors; cost is left empty."""
    return solve(ask, PUBLISHED)


def solve_lagged(ask: Ask) -> Run:
    """Solve an ask with friction from the previous iteration (lagged); cost is left empty."""
    return solve(ask, LAGGED)


def solve_generalised_alpha(ask: Ask) -> Run:
    """Solve an ask with generalised-alpha time integration; cost is left empty."""
    return solve(ask, DAMPED)


def solve_augmented_lagrangian(ask: Ask) -> Run:
    """Solve an ask with gaps closed exactly by multipliers; cost is left empty."""
    return solve(ask, BORNE)
