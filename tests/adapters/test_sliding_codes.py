"""Claims that external codes slide blocks as rigid contact does, on springs and on driven walls."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping

import numpy as np
import pytest

import adapters.liggghts
import adapters.yade
from tests.scenes.blocks.driven_blocks import off
from tests.scenes.blocks.known_slides import (
    ASKS,
    BLOCK,
    BOUNCED,
    CLUMPED,
    COARSE,
    FADING,
    LADDER,
    ODD,
    SAME,
    SCENES,
    loaded,
)
from tests.support.installed import require
from vv.ask import Run, Status
from vv.codes import Adapter
from vv.engines import dem
from vv.scene import Term

CODES: dict[str, Adapter] = {"yade": adapters.yade.ADAPTER, "liggghts": adapters.liggghts.ADAPTER}
SCHEMES = [(code, s.name) for code in CODES for s in CODES[code].schemes if Term.BLOCK in s.terms]
Answers = Callable[[str], Mapping[str, Run]]


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> Answers:
    """The runs of a code by the scenes' names, all from one call of its adapter."""

    @functools.cache
    def run(code: str) -> Mapping[str, Run]:
        require(CODES[code])
        spheres = {**ASKS, **{f"{name}, soft": CLUMPED[name] for name in SAME}}
        runs: dict[str, Run] = {}
        fading = [(f"{name}, {ask.knobs.dt}", ask) for name in FADING for ask in FADING[name][:-1]]
        spheres |= dict(fading)
        schemes = {"default": spheres, "clump": CLUMPED}
        if code == "yade":
            schemes["polyhedra"] = COARSE
            spheres |= {f"{name}, coarse": ask for name, ask in COARSE.items()}
        for scheme, own in schemes.items():
            asks = {**own, **ODD}
            answered = CODES[code].run(
                list(asks.values()), scheme, tmp_path_factory.mktemp(scheme), 0.0
            )
            of = "" if scheme == "default" else f"{scheme}: "
            runs |= {f"{of}{name}": run for name, run in zip(asks, answered, strict=True)}
        assert [(run.status, run.reason) for run in runs.values()] == [(Status.RAN, "")] * len(runs)
        return runs

    return run


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("code", CODES)
def test_a_sphere_on_charged_springs_slides_as_the_block_does(
    code: str, name: str, answers: Answers
) -> None:
    assert SCENES[name].error(answers(code)[name]) < SCENES[name].within


@pytest.mark.parametrize("code", CODES)
def test_a_block_that_holds_stands_still(code: str, answers: Answers) -> None:
    assert np.abs(answers(code)["held"].values[BLOCK]).max() < 1e-12


@pytest.mark.parametrize("name", ["newmark", "uphill too", "dragged", "loaded, soft"])
@pytest.mark.parametrize("code", CODES)
def test_all_leapfrogs_of_one_direction_are_one(code: str, name: str, answers: Answers) -> None:
    ours = dem.solve_default(ASKS[name] if name in ASKS else loaded()).values[BLOCK]
    assert off(answers(code)[name].values[BLOCK], ours) < 1e-9


@pytest.mark.parametrize("code", CODES)
def test_shaken_spheres_bounce_off_a_swinging_wall_as_in_the_engine(
    code: str, answers: Answers
) -> None:
    ours = dem.solve_default(BOUNCED)
    for seen in BOUNCED.observables:
        assert off(answers(code)["bounced"].values[seen], ours.values[seen]) < 3e-4  # events


@pytest.mark.parametrize("name", SAME)
@pytest.mark.parametrize("code", CODES)
def test_a_clump_that_cannot_turn_slides_as_the_sphere(
    code: str, name: str, answers: Answers
) -> None:
    one, two = (answers(code)[key].values[BLOCK] for key in (f"{name}, soft", f"clump: {name}"))
    assert off(two, one) < 1e-8


@pytest.mark.parametrize("code", CODES)
def test_a_clump_that_may_turn_rocks_on_its_springs_and_stays_on_the_slope(
    code: str, answers: Answers
) -> None:
    run, known = answers(code)["clump: loose"], SCENES["newmark"]
    assert known.error(run) < 1e-4
    assert np.abs(run.values[BLOCK] @ known.scene.axes[1]).max() < 1e-10
    assert 1e-8 < np.abs(run.values[BLOCK] @ known.scene.axes[2]).max() < 1e-6
    assert run.model == CODES[code].describe(CLUMPED["loose"], "clump")
    assert run.model is not None
    assert run.model.unknowns == 6


@pytest.mark.parametrize("name", COARSE)
def test_a_polyhedron_slides_as_the_sphere(name: str, answers: Answers) -> None:
    runs = answers("yade")
    one, two = runs[f"{name}, coarse"], runs[f"polyhedra: {name}"]
    assert off(two.values[BLOCK], one.values[BLOCK]) < 1e-8
    assert two.model == CODES["yade"].describe(COARSE[name], "polyhedra")


@pytest.mark.parametrize(("name", "order"), [("dragged", 2), ("lifted", 1)])
@pytest.mark.parametrize("code", CODES)
def test_both_codes_lose_an_order_where_slip_turns(
    code: str, name: str, order: int, answers: Answers
) -> None:
    fine = dem.solve_default(FADING[name][-1]).values[BLOCK]
    errors = [off(answers(code)[f"{name}, {dt}"].values[BLOCK], fine) for dt in LADDER]
    assert np.polyfit(np.log(LADDER), np.log(errors), 1)[0] == pytest.approx(order, abs=0.4)


@pytest.mark.parametrize("name", ODD)
@pytest.mark.parametrize(("code", "scheme"), SCHEMES)
def test_odd_starts_are_as_in_the_engine(
    code: str, scheme: str, name: str, answers: Answers
) -> None:
    run = answers(code)[name if scheme == "default" else f"{scheme}: {name}"]
    ours = dem.solve_default(ODD[name])
    assert off(run.values[BLOCK], ours.values[BLOCK]) < 1e-11
