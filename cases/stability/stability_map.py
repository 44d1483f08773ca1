"""Maps over contact stiffness and step of where codes are right, wrong or diverge."""

from __future__ import annotations

import dataclasses
import math

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks.incline import CASE as INCLINE
from cases.blocks.responding_block import CASE as RESPONDING_BLOCK
from cases.bonds.tetrahedral_unit import CASE as UNIT
from vv.ask import History
from vv.case import Case, Check, Grid, Level, Parameters, Series, Shown, Source, Trial, Variant
from vv.scene import Scene


def _declare(variant: str, p: Parameters) -> Trial:
    trial = _source_trial(variant, {})
    moved = trial.quantities[0]
    assert isinstance(moved, Series)
    study = _unit_grid(trial) if variant == "unit" else _block_grid(trial)
    return Trial(study, (dataclasses.replace(moved, judge=EXPLORED),))


def _source_trial(variant: str, changed: Parameters) -> Trial:
    """The trial of the case behind a variant, with some of its parameters changed."""
    case, name, own = BEHIND[variant]
    return case.declare(name, {**case.defaults(name), **own, **changed})


def _block_grid(trial: Trial) -> Grid:
    """A block on springs kn; its critical step is that of the normal spring, 2 sqrt(m/kn)."""
    scene = trial.study.scene
    (block,) = scene.blocks

    def critical(kn: float | None) -> float:
        return 2 * math.sqrt(block.mass / (kn or math.inf))

    goal = History(SECONDS, SECONDS / SAMPLES)
    return Grid(
        scene, goal, trial.study.observables, STEPS, critical, STIFFNESSES, cpu_limit=PATIENCE
    )


def _unit_grid(trial: Trial) -> Grid:
    """The unit on its bonds; its critical step is 2/w of its breathing, the fastest mode.

    Its mass grows with its stiffness, so that its frequency stays and the answer is the same.
    """
    scene = trial.study.scene
    assert scene.bonds is not None
    kn, mass = float(scene.bonds.kn[0]), float(scene.spheres.mass[0])
    step = math.sqrt(mass / kn)

    def own(other: float) -> Scene:
        return _source_trial("unit", {"kn": other, "m": mass * other / kn}).study.scene

    goal = History(PERIODS * math.pi * step, PERIODS * math.pi * step / SAMPLES)
    return Grid(
        scene, goal, trial.study.observables, ALL_STEPS, lambda _: step, STIFFNESSES,
        scene_with_kn=own, cpu_limit=PATIENCE,
    )  # fmt: skip


BEHIND = {
    "incline": (INCLINE, "newmark-30", {"f": 2.0}),
    "responding-block": (RESPONDING_BLOCK, "1d", {}),
    "unit": (UNIT, "breathing", {"gamma": 0.0}),  # breathing does not stretch shear springs
}
SECONDS, PERIODS, SAMPLES = 0.5, 20, 200  # s: one cycle of shaking; oscillations; outputs
PATIENCE = 30.0  # s: the finest step at 1e12 N/m runs 5e6 times, at some microseconds each
FEW, MANY = (2.0, 0.1), (10.0, 2.0, 0.9, 0.19, 0.1, 1e-2, 1e-3)
STEPS = {Level.QUICK: FEW, Level.DEFAULT: FEW, Level.PAPER: MANY}
ALL_STEPS = {
    Level.QUICK: FEW,
    Level.DEFAULT: (10.0, 2.0, 1.01, 0.99, 0.1, 1e-2),
    Level.PAPER: (10.0, 2.0, 1.01, 0.99, 0.1, 1e-2, 1e-3),
}
STIFFNESSES = {
    Level.QUICK: (1e6, 1e9),
    Level.DEFAULT: (1e6, 1e9, 1e12),
    Level.PAPER: tuple(10.0**n for n in range(4, 13)),
}
EXPLORED = Shown(
    "a map: on soft springs a block sinks and lags, stiff ones need small steps, and each code "
    "diverges beyond some step; shear springs that are 25 times as stiff as normal ones lower the "
    "limit to a fifth. The unit oscillates at the same rate at any stiffness: a row that differs "
    "from the others shows an absolute threshold in a code"
)
CASE = Case(
    name="stability-map",
    title="Maps over stiffness and step",
    source=Source(
        *YAGODA_BIRAN_2016,
        "The scenes are those of the cases with these names, and of the tetrahedral unit of Liu et "
        "al. (2017), over one cycle of shaking at 2 Hz and over 20 oscillations. Stiffness runs "
        "from 1e4 to 1e12 N/m, the step from 1e-3 to 10 times 2 sqrt(m/kn), or 2/w of the unit; a "
        "step longer than the run is refused. The bonds of the unit have no shear springs, and its "
        "mass grows with its stiffness. A point that would take a code more than 30 s at its "
        "stated speed is left out and marked.",
    ),
    parameters=(),
    variants=(
        Variant(
            "incline",
            "the incline, phi = 30, shaken at 2 Hz",
            INCLINE.variant("newmark-30").formula,
        ),
        Variant(
            "responding-block",
            "the block on a base that shakes at 2 Hz",
            RESPONDING_BLOCK.variant("1d").formula,
        ),
        Variant("unit", "four bonded elements that breathe", UNIT.variant("breathing").formula),
    ),
    declare=_declare,
    # chaotic motion diverges by its last bits
    enforced=frozenset(Check) - {Check.REGRESSION},
)
