"""Claims about a step of `dda` in time: inertia, velocities, loss of energy, unknowns of blocks."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.engines.blocks.test_any_blocks import turned
from tests.scenes.blocks.block_scenes import box
from vv.engines.dda.general.energy import KINETIC, NORMAL, SHEAR, STRAIN, store_energies
from vv.engines.dda.general.inertia import inertia_terms, part_to_stop, update_velocities
from vv.engines.dda.general.rows import diverged, fill_forces
from vv.engines.dda.general.setting import Part
from vv.engines.dda.general.unknowns import hooke, initial_rates, unknowns_of
from vv.engines.dda.law import SLIDE, STICK
from vv.engines.dda.stepping import HALF_LEAP, IMPLICIT, generalised_alpha
from vv.engines.kernels.drive import drives
from vv.scene import Elastic, Harmonic, Vector

pytestmark = pytest.mark.usefixtures("in_python")
STEP = 0.03  # s
RULES = {
    "dda": IMPLICIT,
    "half": HALF_LEAP,
    "0.5": generalised_alpha(0.5),
    "0": generalised_alpha(0.0),
}


def masses(q: int) -> tuple[Vector, Any]:
    """Two blocks of two and of q - 2 unknowns: their mass matrix (q, 12), and where they begin."""
    random = np.random.default_rng(1)
    matrix, start = np.full((q, 12), np.nan), np.array([0, 2, q])
    for first, last in ((0, 2), (2, q)):
        root = random.normal(size=(last - first, last - first))
        matrix[first:last, : last - first] = root @ root.T + np.eye(last - first)
    return matrix, SimpleNamespace(start=start, mass=np.ones(2))


def full(matrix: Vector, bodies: Any) -> Vector:
    """The whole matrix (q, q)."""
    found = np.zeros((len(matrix), len(matrix)))
    for first, last in zip(bodies.start, bodies.start[1:], strict=False):
        found[first:last, first:last] = matrix[first:last, : last - first]
    return found


@pytest.mark.parametrize("name", RULES)
def test_a_step_has_the_accelerations_of_its_rule_and_loses_what_these_say(name: str) -> None:
    """Displacements, velocities and accelerations satisfy the equations of `Stepping`."""
    rule: Any = tuple(RULES[name])
    alpha_m, alpha_f, beta, gamma = rule
    v0, a0, d = np.random.default_rng(2).normal(size=(3, 5)) * [[1.0], [9.0], [0.05]]
    matrix, bodies = masses(5)
    a1 = ((d / STEP - v0) / STEP - (0.5 - beta) * a0) / beta
    v1 = v0 + STEP * ((1.0 - gamma) * a0 + gamma * a1)
    predictor = np.empty(5)
    weight = inertia_terms(predictor, v0, a0, rule, STEP)
    u = (1.0 - alpha_f) * d
    mean = (1.0 - alpha_m) * a1 + alpha_m * a0
    assert weight / STEP * (u / STEP - predictor) == pytest.approx(mean)
    velocity, rate, whole = v0.copy(), a0.copy(), full(matrix, bodies)
    lost = update_velocities(velocity, rate, d, matrix, bodies, rule, STEP)
    assert velocity == pytest.approx(v1)
    assert rate == pytest.approx(a1)
    work = mean @ whole @ d - 0.5 * (v1 @ whole @ v1 - v0 @ whole @ v0)
    assert lost == pytest.approx(work, abs=1e-12)
    assert abs(lost) <= 1e-15 or name != "dda"


def test_hookes_law_is_that_of_unit_strains_with_other_stresses_zero() -> None:
    E, nu = 7e9, 0.2
    law = Elastic(E, nu)
    assert hooke(law, ((0, 0),)) == pytest.approx(np.array([[E]]))
    plane = E / (1 - nu**2) * np.array([[1, nu], [nu, 1]])
    assert hooke(law, ((0, 0), (2, 2))) == pytest.approx(plane)
    shear = E / (2 * (1 + nu))
    found = hooke(law, ((0, 0), (0, 2), (2, 2)))
    assert found[1] == pytest.approx([0.0, shear, 0.0])
    every = tuple((i, j) for i in range(3) for j in range(i, 3))
    whole = hooke(law, every)
    lame = E * nu / ((1 + nu) * (1 - 2 * nu))
    assert whole[0] == pytest.approx([lame + 2 * shear, 0, 0, lame, 0, lame])
    assert np.diag(whole)[[1, 2, 4]] == pytest.approx([shear] * 3)


def test_the_fields_of_a_block_are_its_free_motions_and_strains() -> None:
    axes = turned(np.random.default_rng(3))
    free, spins = np.array([True, False, True]), np.array([False, True, True])
    block = box("b", [1, 2, 3], [0.1, 0.2, 0.3], axes, free=free, free_spin=spins,
                elastic=Elastic(5e6, 0.3), velocity=axes[0] - 2.0 * axes[2],
                spin=3.0 * axes[1] + 4.0 * axes[2])  # fmt: skip
    line, slope, stiffness = unknowns_of(block, axes)
    arm = np.array([0.3, -0.5, 0.7])
    moved = line + slope @ arm
    e = axes @ arm
    due = [axes[0], axes[2], np.cross(axes[1], arm), np.cross(axes[2], arm), e[0] * axes[0],
           0.5 * (e[2] * axes[0] + e[0] * axes[2]), e[2] * axes[2]]  # fmt: skip
    assert moved == pytest.approx(np.array(due))
    assert not stiffness[:4].any()
    assert not stiffness[:, :4].any()
    volume = 8.0 * 0.1 * 0.2 * 0.3
    assert stiffness[4:, 4:] == pytest.approx(volume * hooke(block.elastic, block.strains))  # type: ignore[arg-type]
    assert initial_rates(block, axes) == pytest.approx([1.0, -2.0, 3.0, 4.0, 0.0, 0.0, 0.0])


def test_energies_are_of_motion_springs_and_strains() -> None:
    matrix, bodies = masses(5)
    v, strain = np.random.default_rng(4).normal(size=(2, 5))
    gap, spring = np.array([-2e-3, 1e-3, -1e-3]), np.random.default_rng(5).normal(size=(3, 3))
    touch: Any = SimpleNamespace(key=np.arange(3), gap=gap, spring=spring)
    motion: Any = SimpleNamespace(velocity=v, strain=strain)
    ledger = np.full(13, 7.0)
    store_energies(ledger, touch, bodies, motion, matrix, 4e6, 3.0, 2.0 * matrix)
    whole = full(matrix, bodies)
    assert ledger[KINETIC] == pytest.approx(0.5 * v @ whole @ v)
    assert ledger[STRAIN] == pytest.approx(strain @ whole @ strain)
    assert ledger[NORMAL] == pytest.approx(0.5 * 4e6 * 5e-6)
    assert ledger[SHEAR] == pytest.approx(1.5 * (spring**2).sum())
    assert (ledger[4:] == 7.0).all()


@pytest.mark.parametrize("term", [KINETIC, NORMAL, SHEAR, STRAIN])
def test_a_run_has_diverged_whose_energy_is_too_large_or_not_finite(term: int) -> None:
    ledger = np.zeros(13)
    ledger[4:] = 1e9
    ledger[term] = 2.0
    assert not diverged(ledger, 2.0)
    assert diverged(ledger, 1.9)
    for value in (np.inf, np.nan):
        ledger[term] = value
        assert diverged(ledger, np.inf)


def test_forces_on_blocks_are_those_of_contacts_and_shaking() -> None:
    """Contact 0 is with a wall, contact 1 between both blocks."""
    touch: Any = SimpleNamespace(
        key=np.arange(2), first=np.array([2, 0]), second=np.array([1, 1]), wall=np.array([0, -1]),
        force=np.array([[1.0, 2.0, 3.0], [-5.0, 7.0, 11.0]]),
    )  # fmt: skip
    bodies: Any = SimpleNamespace(mass=np.array([2.0, 3.0]))
    pressed, given = np.full((2, 3), 9.0), np.ones((2, 3))
    fill_forces(pressed, given, touch, bodies, (0.1, 0.2, 0.3), 0.5)
    due = np.array([[5.2, -6.6, -10.4], [-3.7, 9.6, 14.9]])
    assert pressed == pytest.approx(due)
    assert given == pytest.approx(1.0 + 0.5 * due)


@pytest.mark.parametrize("time", [0.1, -0.1])
def test_a_part_of_a_step_ends_where_the_first_slide_stops(time: float) -> None:
    """Of four contacts, of which the last sticks; walls are at rest before t = 0."""
    base, starts = drives((None, Harmonic(np.array([0.02, 0, 0]), np.array([1.0, 0, 0]))))
    part = 0.02
    wall = 0.02 * 2 * np.pi * np.cos(2 * np.pi * time) if time > 0 else 0.0
    speeds = np.array([0.5, 0.5 - wall, 0.5, 0.5])
    ends = np.array([0.9, 0.6, 1.7, 0.3])
    slips = part * speeds * (1.0 - 0.5 / ends)
    direction = np.tile([1.0, 0.0, 0.0], (4, 1))
    right, left, none = [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [9.0, 9.0, 9.0]
    touch: Any = SimpleNamespace(
        columns=np.array([1, 1, 2, 1]), column=np.array([[0, 0], [0, 0], [1, 2], [0, 0]]),
        field=np.array([[right, none], [right, none], [right, left], [right, none]]),
        wall=np.array([0, 1, -1, 0]),
    )  # fmt: skip
    motion: Any = SimpleNamespace(velocity=np.array([0.5, 0.8, 0.3]))
    state = np.array([SLIDE, SLIDE, SLIDE, STICK])
    relative = slips[:, None] * direction + [0.0, 0.3, 0.0]
    before: Any = SimpleNamespace(state=state, direction=direction)
    setting: Any = SimpleNamespace(base=base, starts=starts)
    given: Any = (relative, setting, motion, Part(time, part, IMPLICIT, 2.0))
    assert part_to_stop(touch, before, *given) == pytest.approx(0.6)
    before.state = np.full(4, STICK)
    assert part_to_stop(touch, before, *given) == 1.0
