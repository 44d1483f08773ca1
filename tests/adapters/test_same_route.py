"""What is timed is what was judged: the same kernel, chosen from the scene and nothing else."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from vv.ask import Ask, Status
from vv.case import Case, Level
from vv.codes import Adapter, known_beforehand
from vv.plan.planning import project_knobs
from vv.plan.project import find
from vv.scene import Block, Scene, Spheres, Wall

PROJECT = find(Path(__file__))
IN_HOUSE = [a for a in map(PROJECT.load_adapter, PROJECT.adapter_names()) if not a.found().files]
TIMED = [
    (case, variant.name)
    for case in map(PROJECT.load_case, PROJECT.case_names())
    for variant in case.variants
    if case.declare(variant.name, case.defaults(variant.name)).study.timed
]


@pytest.mark.parametrize("adapter", IN_HOUSE, ids=lambda adapter: adapter.name)
@pytest.mark.parametrize(("case", "variant"), TIMED, ids=lambda x: getattr(x, "name", x))
def test_a_timed_solve_gives_the_bits_of_the_judged_one(
    adapter: Adapter, case: Case, variant: str, tmp_path: Path
) -> None:
    study = case.declare(variant, case.defaults(variant)).study
    for scheme in adapter.schemes:
        ask = study.ask(project_knobs(study.rungs[Level.QUICK][0], scheme))
        if known_beforehand(adapter, scheme, ask, adapter.found()) is not None:
            continue
        (judged,) = adapter.run([ask], scheme.name, tmp_path, 0.0)
        (timed,) = adapter.run([ask], scheme.name, tmp_path, 1e-3)
        assert judged.status is timed.status is Status.RAN
        assert judged.model == timed.model
        for observable, values in judged.values.items():
            assert np.array_equal(values, timed.values[observable])


@pytest.mark.parametrize("adapter", IN_HOUSE, ids=lambda adapter: adapter.name)
@pytest.mark.parametrize(("case", "variant"), TIMED, ids=lambda x: getattr(x, "name", x))
def test_a_scene_that_is_no_case_takes_the_same_route(
    adapter: Adapter, case: Case, variant: str
) -> None:
    """A hundredth more mass, and nobody can tell the case from the scene: the model is the same."""
    study = case.declare(variant, case.defaults(variant)).study
    for scheme in adapter.schemes:
        ask = study.ask(project_knobs(study.rungs[Level.QUICK][0], scheme))
        if known_beforehand(adapter, scheme, ask, adapter.found()) is not None:
            continue
        other = dataclasses.replace(ask, scene=heavier(ask.scene))
        known, unknown = (adapter.describe(a, scheme.name) for a in (ask, other))
        assert (known.unknowns, known.terms) == (unknown.unknowns, unknown.terms)


def heavier(scene: Scene) -> Scene:
    return dataclasses.replace(scene, bodies=tuple(map(_heavier, scene.bodies)))


def _heavier(group: Spheres | Wall | Block) -> Spheres | Wall | Block:
    if isinstance(group, Spheres):
        return dataclasses.replace(group, mass=1.01 * group.mass)
    if isinstance(group, Block):
        return dataclasses.replace(group, mass=1.01 * group.mass)
    return group


def test_no_ask_knows_the_case_it_comes_from() -> None:
    assert {field.name for field in dataclasses.fields(Ask)} == {
        "scene",
        "goal",
        "observables",
        "knobs",
        "search",
        "energies",
    }
