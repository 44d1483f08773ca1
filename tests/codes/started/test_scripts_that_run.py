"""Claims about a script that is written for an in-house code: it prints what the engine answers."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests import ROOT
from tests.support.adapters.live_asks import flight
from vv.ask import Ask, Displacement, History, Knobs, Status, Velocity
from vv.codes import python_script, source
from vv.engines import dem
from vv.scene import Form, Harmonic


def test_it_prints_times_observables_and_energies_in_their_order_with_all_digits(
    tmp_path: Path,
) -> None:
    ask = Ask(flight(0.3), History(0.3, 0.1), (Velocity(0), Displacement(0)), Knobs(0.05),
              energies=(Form.DRAG, Form.KINETIC))  # fmt: skip
    script = tmp_path / "native.py"
    script.write_text(python_script(ask, "vv.engines.dem", "solve_default"))
    done = subprocess.run(
        [sys.executable, str(script)], env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    head, _, rows = done.stdout.partition("\n")
    assert head == f"# t, {Velocity(0)}, {Displacement(0)}, {Form.DRAG}, {Form.KINETIC}"
    run = dem.solve_default(ask)
    assert run.status is Status.RAN
    due = [run.times, run.values[Velocity(0)], run.values[Displacement(0)],
           run.energies[Form.DRAG], run.energies[Form.KINETIC]]  # fmt: skip
    assert np.array_equal(np.loadtxt(io.StringIO(rows)), np.column_stack(due))
    assert len({float(part) for part in np.column_stack(due)[-1]}) == 9, "no two are alike"


@pytest.mark.parametrize(
    "value", [(1.5,), ("x" * 100,), (1.5, 2.5), (), float("inf"), -float("inf"), Form.BROKEN_SHEAR]
)
def test_a_value_is_written_so_that_it_is_read_back(value: object) -> None:
    assert eval(source(value), {"Form": Form}) == value


def test_an_array_with_what_is_infinite_is_read_back() -> None:
    array = np.array([[np.inf, 1.0], [-np.inf, 1.0 / 3.0]])
    assert np.array_equal(eval(source(array), {"np": np}), array)


def test_what_differs_from_a_default_in_the_last_bit_is_written() -> None:
    """Also where Python calls both the same: -0.0 == 0.0, and 1 == 1.0."""
    one = Harmonic(np.ones(3), np.ones(3), np.array([-0.0, 0.0, 0.0]))
    again = eval(source(one), {"Harmonic": Harmonic, "np": np})
    assert np.signbit(again.phase).tolist() == [True, False, False]
