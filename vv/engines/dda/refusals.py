"""The reasons why DDA cannot solve an ask."""

from __future__ import annotations

import itertools

import numpy as np

from vv.ask import NO_STIFFNESS, Ask
from vv.engines.blocks.checks import moves_where_locked, overlaps, undetermined
from vv.engines.dda.formulation import DEFAULT, Formulation
from vv.engines.dda.limits import UNLIKE
from vv.scene import Scene

PARALLEL = 4 * float(np.finfo(float).eps)  # sine between opposite normals that are rounded
YIELDING = 1e-9  # relative to friction: a larger load by less than this moves a block negligibly


def refuses(ask: Ask, formulation: Formulation = DEFAULT) -> str | None:
    """Why a formulation cannot solve the ask as it stands; None if it can."""
    dt, goal, scene = ask.knobs.dt, ask.goal, ask.scene
    rigid = not np.isfinite(scene.contact.kn)
    if dt is None:
        return "Knobs.dt is None; DDA needs a step"
    if goal.steps(dt) == 0:
        return f"dt = {dt!r} s leaves no step in History.duration = {goal.duration!r} s"
    if not scene.blocks:
        return "the scene holds no block"
    if len(scene.spheres):
        return "the scene holds spheres; DDA knows blocks and walls"
    if rigid and ask.knobs.kn is None:
        return NO_STIFFNESS
    checks = (moves_where_locked, undetermined, _locked_strains)
    found = next((reason for check in checks if (reason := check(scene))), None)
    found = found or (overlaps(scene) if rigid else None)
    found = found or (_why_no_multipliers(scene) if formulation.multipliers else None)
    return found or (
        _slides_before_start(scene, formulation.settling) if formulation.settling else None
    )


def settles(scene: Scene) -> bool:
    """Whether gravity may act before t = 0: all blocks are at rest, and something is to shake."""
    waits = scene.shaking is not None or any(wall.motion for wall in scene.walls)
    return waits and not any(block.velocity.any() or block.spin.any() for block in scene.blocks)


def _slides_before_start(scene: Scene, settling: float) -> str | None:
    """Why a block on one wall would slide in `settling` [s] of gravity before t = 0; else None."""
    if not settles(scene) or len(scene.blocks) != 1 or len(scene.walls) != 1:
        return None
    (block,), (wall,) = scene.blocks, scene.walls
    pull = block.mass * scene.gravity + block.load
    press = -float(pull @ wall.normal)
    along = (scene.axes @ (pull + press * wall.normal)) * block.free
    holds = scene.contact.mu * max(press, 0.0)
    if np.linalg.norm(along) <= holds * (1 + YIELDING):
        return None
    return (
        f"gravity pulls block '{block.name}' with {np.linalg.norm(along):.6g} N, and friction "
        f"holds {holds:.6g} N: it would slide for the {settling:g} s of gravity alone before t = 0"
    )


def _why_no_multipliers(scene: Scene) -> str | None:
    """Why multipliers are refused: for contact on springs, or several blocks that can rotate.

    Or for a groove that they do not find, see `least_share`.
    """
    if not scene.contact.rigid:
        return "multipliers keep gaps at zero, but the scene has contact on springs"
    for (i, one), (j, two) in itertools.combinations(enumerate(scene.walls), 2):
        opening = float(np.linalg.norm(np.cross(one.normal, two.normal)))
        if one.normal @ two.normal < 0.0 and PARALLEL < opening < UNLIKE:
            return (
                f"walls {i} and {j} enclose {opening:.6g} rad; multipliers take sides that enclose "
                f"less than {UNLIKE:g} rad for parallel, and a wedge would fall between them"
            )
    turning = [block.name for block in scene.blocks if block.free_spin.any()]
    if len(turning) < 2:
        return None
    return (
        f"blocks '{turning[0]}' and '{turning[1]}' can rotate: with several such blocks, "
        "multipliers at redundant points with friction do not always converge"
    )


def _locked_strains(scene: Scene) -> str | None:
    """Why a block is refused that may rotate, and is free in one direction of that plane only."""
    for block in scene.blocks:
        for axis in np.flatnonzero(block.free_spin):
            across = np.delete(block.free, axis)
            if block.elastic and across.any() and not across.all():
                return (
                    f"block '{block.name}' deforms and can rotate about axis {axis}, but is free "
                    "in only one direction normal to it: its strains would rotate into locked "
                    "ones"
                )
    return None
