"""What a case declares at random parameters, and measures of runs made up by formula, as digests.

`python -m tests.cases.declarations [CASE ...]` writes the record anew that
`tests/cases/test_declarations.py` compares with. The gate judges the variants of one level at their
default parameters, and pages show what is declared at these. The record covers the rest: bounds,
refusals and scenes at other parameters, and how quantities are measured at levels above quick.
"""

from __future__ import annotations

import hashlib
import json
import sys
import warnings
import zlib
from collections.abc import Iterable, Iterator

import numpy as np

from tests import ROOT
from vv.ask import Ask, Displacement, Ledger, Run, Status
from vv.case import Case, Level, Parameters, Quantity, Series, Trial, Variant
from vv.output.gallery.declared_numbers import numbers
from vv.plan.project import find

RECORD = ROOT / "tests" / "cases" / "declarations.json"
DRAWS, FAR = 3, 2.0  # sets of parameters a variant, each multiplied by 1/FAR to FAR
SIZES = (1e-3, 0.03, 1.0)  # of motions in made-up runs, over that of the scene
VAST = 2000  # bodies, above which a scene takes too long to declare in a test
LARGE = "large"
Row = dict[str, str]  # what it is -> digest or numbers


def declared(case: Case, variant: Variant) -> Row | str:
    """The row of a variant: a digest for each set of parameters, numbers for each quantity."""
    trial = case.declare(variant.name, case.defaults(variant.name))
    if sum(map(len, trial.study.scene.bodies)) > VAST:
        return LARGE
    others = [*draws(case, variant.name)]
    with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
        drawn = {f"draw {i}": at(case, variant, one) for i, one in enumerate(others)}
        return {**drawn, **dict(measured(trial)), **measured_at(case, variant, others)}


def draws(case: Case, variant: str) -> Iterator[Parameters]:
    """Sets of parameters for a variant, to three digits, always the same."""
    chance = np.random.default_rng(zlib.crc32(f"{case.name}:{variant}".encode()))
    usual = case.defaults(variant)
    for _ in range(DRAWS if usual else 0):
        factors = FAR ** chance.uniform(-1, 1, len(usual))
        yield {k: float(f"{v * f:.3g}") for (k, v), f in zip(usual.items(), factors, strict=True)}


def at(case: Case, variant: Variant, parameters: Parameters) -> str:
    """The digest of all numbers at these parameters, or that they are refused."""
    try:
        lines = numbers(case, variant, parameters)
    except (ValueError, ArithmeticError) as error:
        return "refused" if isinstance(error, ValueError) else "no number"
    return hashlib.sha256(json.dumps(lines).encode()).hexdigest()[:8]


def measured_at(case: Case, variant: Variant, others: Iterable[Parameters]) -> Row:
    """What each quantity measures of a made-up run at the first parameters that are accepted."""
    for parameters in others:
        try:
            trial = case.declare(variant.name, parameters)
            return {f"drawn, {name}": text for name, text in measured(trial, SIZES[1:2])}
        except (ValueError, ArithmeticError):
            continue
    return {}


def measured(trial: Trial, sizes: Iterable[float] = SIZES) -> Iterator[tuple[str, str]]:
    """What each quantity measures of made-up runs."""
    ask = trial.study.ask(trial.study.rungs[Level.QUICK][0])
    for part in sizes:
        run = made_up(ask, part)
        for one in trial.quantities:
            yield f"{one.name}, {part:g}", _seen(one, run)


def made_up(ask: Ask, part: float) -> Run:
    """A run by formula: bodies swing, sink and turn back by this part of the scene's size."""
    times = ask.goal.times(ask.knobs.dt)
    spheres, blocks = ask.scene.spheres.position, [b.centroid() for b in ask.scene.blocks]
    size = part * max(1e-3, *np.abs([*spheres.ravel(), *np.ravel(blocks)]))
    turns = 2 * np.pi * times / times[-1]
    values = {}
    for i, what in enumerate(ask.observables):
        phase, large = 0.3 * i, size if isinstance(what, Displacement) else size / times[-1]
        wave = [np.sin((1 + k) * turns + phase) - np.sin(phase) - 0.2 * turns for k in range(3)]
        values[what] = large * np.column_stack(wave)
    energies = {form: size * (2 + np.sin(turns + i)) for i, form in enumerate(ask.energies)}
    steps = max(1, ask.goal.steps(ask.knobs.dt or 1e-3))
    ledger = Ledger({"kinetic": 2.0, "normal elastic": 1.0}, 1e-3, 3.0)
    span = ask.search.span if ask.search else 2.0
    tried = (ask.knobs.dt or 1.0) * np.linspace(1.0, span, 9)
    grown = np.where(np.arange(9) < 6, 0.5, 2.0) * (ask.search.bound if ask.search else 1.0)
    return Run(
        Status.RAN, times=times, values=values, steps=steps, ledger=ledger, energies=energies,
        tried=np.column_stack([tried, grown]),
    )  # fmt: skip


def _seen(quantity: Quantity, run: Run) -> str:
    """The numbers that a quantity takes from a run, or that it takes none."""
    try:
        found = quantity.observe(run)
    except (ValueError, ArithmeticError, IndexError, KeyError) as error:
        return type(error).__name__
    values = np.atleast_1d(np.asarray(found, float))
    shown = [*values[:: max(1, len(values) // 4)]] if isinstance(quantity, Series) else [*values]
    return ", ".join(f"{value:.5g}" for value in shown)


def written(rows: dict[str, Row | str]) -> str:
    """The record as text, a line for each variant."""
    lines = (f"{json.dumps(name)}: {json.dumps(row)}" for name, row in sorted(rows.items()))
    return "{\n" + ",\n".join(lines) + "\n}\n"


def main() -> None:
    """Write the record anew, for all cases or for those named."""
    project = find(ROOT)
    rows = json.loads(RECORD.read_text()) if RECORD.is_file() and sys.argv[1:] else {}
    for name in sys.argv[1:] or project.case_names():
        case = project.load_case(name)
        rows |= {f"{name}:{one.name}": declared(case, one) for one in case.variants}
    RECORD.write_text(written(rows))


if __name__ == "__main__":
    main()
