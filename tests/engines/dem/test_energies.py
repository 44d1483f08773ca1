"""Claims about energies over time: which schemes give them, what they return and refuse."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from adapters.dem import SCHEMES
from tests.scenes.spheres.bonded_scenes import elements, unit
from vv.ask import Ask, Displacement, History, Knobs, Model, Run, Status
from vv.codes import unreported
from vv.engines import dem
from vv.records.checking import checked
from vv.scene import Form
from vv.store.store import Store

BASE = np.array([[1, 1, 1], [1, 1, 0], [1, 1, 0], [1, 1, 0]], bool)
PULL = np.array([[0.0, 0.0, 0.1]] + [[0.0, 0.0, 0.0]] * 3)  # N
SCENE = unit(elements(free=BASE, load=PULL), eta=6.0)
GOAL = History(2e-6, 1e-7)
ASK = Ask(SCENE, GOAL, (Displacement(1),), Knobs(dt=1e-8), energies=tuple(Form))
PLAIN = dataclasses.replace(ASK, energies=())


def solved() -> Run:
    run = dem.solve_default(ASK)
    assert run.status is Status.RAN, run.reason
    return run


def test_all_forms_together_do_not_change_and_end_as_the_ledger_says() -> None:
    run = solved()
    assert run.ledger is not None
    total = np.sum([run.energies[form] for form in Form], axis=0)
    assert np.ptp(total) <= 1e-6 * run.ledger.peak
    assert {form.value: series[-1] for form, series in run.energies.items()} == {
        form.value: run.ledger.terms.get(form.value, 0.0) for form in Form
    }
    work = -run.energies[Form.LOAD]
    assert run.energies[Form.DRAG][-1] == pytest.approx(work[-1] / 2, rel=0.05)


def test_only_what_is_asked_is_told() -> None:
    some = dataclasses.replace(ASK, energies=(Form.DRAG,))
    assert list(dem.solve_default(some).energies) == [Form.DRAG]
    assert not dem.solve_default(PLAIN).energies
    assert len({ask.digest() for ask in (ASK, some, PLAIN)}) == 3
    assert ASK.at(2e-8).energies == ASK.energies


def test_a_scheme_that_does_not_tell_a_form_is_refused_by_its_name() -> None:
    silent = dataclasses.replace(SCHEMES[0], energies=frozenset(Form) - {Form.DRAG})
    assert unreported(SCHEMES[0], ASK) is None
    assert unreported(silent, ASK) == "energy over time (drag dissipation)"
    assert unreported(silent, PLAIN) is None


def test_energies_that_are_missing_or_not_finite_are_no_run() -> None:
    run = dataclasses.replace(solved(), model=Model(1, SCENE.terms()))
    assert checked(run, ASK).status is Status.RAN
    for wrong, status, said in (
        ({}, Status.ERROR, "'kinetic' was asked in shape (21,) and not reported"),
        ({**run.energies, Form.DRAG: np.zeros(3)}, Status.ERROR, "reported with shape (3,)"),
        (
            {**run.energies, Form.LOAD: np.where(run.times > 1.05e-6, np.nan, 0.0)},
            Status.DIVERGED,
            "'load potential' is not finite from t = 1.1e-06 s",
        ),
    ):
        found = checked(dataclasses.replace(run, energies=wrong), ASK)
        assert found.status is status
        assert said in found.reason


@pytest.mark.parametrize("ask", [ASK, PLAIN])
def test_the_store_gives_them_back(tmp_path: Path, ask: Ask) -> None:
    run = dem.solve_default(ask)
    store = Store(tmp_path)
    store.keep_run("abc", run)
    back = store.run("abc")
    assert back is not None
    assert set(back.energies) == set(run.energies)
    assert all(np.array_equal(back.energies[form], run.energies[form]) for form in run.energies)
