"""All of result.json, by hand: no two numbers are alike, so that none can stand for another."""

import json
from pathlib import Path

from vv.ask import Ledger, Status
from vv.codes.program.result import Result, read_result
from vv.scene import Term


def read(folder: Path, **entries: object) -> Result:
    file = folder / "result.json"
    file.write_text(json.dumps(entries))
    return read_result(file)


def test_each_entry_of_a_result_stands_for_itself(tmp_path: Path) -> None:
    energies = {"forms": {"kinetic": 1.0, "drag": 2.0, "numerical": 3.0, "heat of mine": 4.0},
                "unaccounted": 5.0, "peak": 6.0, "bound": 7.0}  # fmt: skip
    found = read(
        tmp_path, status="diverged", reason="it grew", solve_cpu=8.5, steps=9, unknowns=10,
        terms=["gravity", "drag"], note="explicit", energies=energies,
    )  # fmt: skip
    forms = {"kinetic": 1.0, "drag dissipation": 2.0, "numerical dissipation": 3.0,
             "heat of mine": 4.0}  # fmt: skip
    assert found == Result(
        status=Status.DIVERGED,
        reason="it grew",
        solve_cpu=8.5,
        steps=9,
        unknowns=10,
        terms=frozenset({Term.GRAVITY, Term.DRAG}),
        note="explicit",
        energies=Ledger(forms, unaccounted=5.0, peak=6.0, bound=7.0),
    )


def test_what_a_result_leaves_out_is_unknown_and_it_ran(tmp_path: Path) -> None:
    assert read(tmp_path) == read_result(tmp_path / "none") == Result(Status.RAN)
    unbound = read(tmp_path, energies={"forms": {}, "unaccounted": 5.0, "peak": 6.0})
    assert unbound.energies == Ledger({}, unaccounted=5.0, peak=6.0, bound=None)
