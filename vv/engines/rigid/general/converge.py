"""Solves the contacts of a step by the solver for few blocks or that for many."""

from __future__ import annotations

from vv.engines.kernels.arrays import numbers
from vv.engines.kernels.compiled import called
from vv.engines.rigid.general.few import Limits, solve_few
from vv.engines.rigid.general.many import solve_many_at
from vv.engines.rigid.general.setting import Setting
from vv.engines.rigid.limits import SMALL
from vv.engines.rigid.solver.problem import Problem


@called
def converged(
    setting: Setting, problem: Problem, fewest: int, tolerance: float
) -> tuple[int, float]:
    """Solve contacts as `solve_few`, whether blocks are few or many."""
    limits = Limits(len(setting.mass), setting.tolerance, setting.most, setting.finest)
    if limits.blocks <= SMALL:
        return solve_few(limits, problem, fewest, tolerance)
    left = numbers(1)
    sweeps = solve_many_at(setting.solver, left, limits, problem, fewest, tolerance)
    return sweeps, left[0]
