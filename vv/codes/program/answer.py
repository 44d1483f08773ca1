"""Makes a Run from the files that a program wrote, series.csv and result.json."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from vv.ask import Ask, Model, Run, Status
from vv.codes.program.bad_answer import BadAnswerError
from vv.codes.program.question import columns, energy_column
from vv.codes.program.result import RESULT, Result, read_result
from vv.codes.program.series import SERIES, read_series


def read(folder: Path, ask: Ask, model: Model) -> tuple[Run, float | None]:
    """The answer that a program left in its folder, and the CPU seconds of its steps if it says so.

    model: what the declaration promises, which result.json may correct.
    """
    try:
        result = read_result(folder / RESULT)
        if result.status is not Status.RAN:
            reason = result.reason or f"{RESULT} gives no reason"
            return Run(result.status, reason), None
        series = read_series(folder / SERIES, ask)
    except BadAnswerError as error:
        return Run(Status.ERROR, str(error)), None
    steps = 0 if ask.knobs.dt is None else ask.goal.steps(ask.knobs.dt)
    run = Run(
        Status.RAN,
        result.reason,
        times=ask.goal.times(ask.knobs.dt),
        values={w: np.stack([series[c] for c in columns(w)], axis=1) for w in ask.observables},
        steps=steps if result.steps is None else result.steps,
        model=_corrected(model, result),
        ledger=result.energies,
        energies={form: series[energy_column(form)] for form in ask.energies},
    )
    return run, result.solve_cpu


def _corrected(model: Model, result: Result) -> Model:
    return Model(
        model.unknowns if result.unknowns is None else result.unknowns,
        model.terms if result.terms is None else result.terms,
        "; ".join(filter(None, (model.note, result.note))),
    )
