"""Runs the tests that cannot judge the copy with all mutants, on one mutant at a time.

Branches between mutants change what the compiler makes of a kernel. Tests that look at its machine
code, or count sweeps that the last bits decide, are therefore red in that copy. They are run on a
plain copy, in which one file at a time is mutated.
"""

import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path

from bench.mutation.forked_tests import passes, rewrite, with_tests
from bench.mutation.mutants import ROOT, Mutant
from bench.mutation.schemata import copied


def seeing(tests: Sequence[str], chosen: Iterable[Mutant]) -> dict[str, str]:
    """Mutant -> the test that detects it; '' if none does."""
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder).resolve()
        copied(project, with_tests())
        sound = [one for one in tests if passes(project, one)]
        red = ", ".join(one for one in tests if one not in sound)
        print(f"red in a plain copy too, and not run at all: {red or 'none'}", flush=True)
        return {one.what: _seeing(project, sound, one) for one in chosen}


def _seeing(project: Path, tests: Iterable[str], mutant: Mutant) -> str:
    place = project / mutant.file
    try:
        rewrite(place, mutant.text())
        return next((one for one in tests if not passes(project, one)), "")
    finally:
        rewrite(place, (ROOT / mutant.file).read_text())
