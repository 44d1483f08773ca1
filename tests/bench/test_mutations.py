"""The bench of mutants reaches every kernel there is, and seeded bugs still fit the sources."""

from __future__ import annotations

import ast
import inspect
import shutil
import subprocess
from pathlib import Path

import pytest

from bench.mutation.mutants import COMPILED, ROOT, kernels, mechanical, parsed
from bench.mutation.schemata import KERNEL
from bench.mutation.seeded_bugs import KINDS, changed
from vv.engines.kernels import compiled as compiling

PLAIN = {  # nothing to turn: they only call others
    "vv/engines/kernels/triples.py", "vv/engines/dem/space/forces.py",
    "vv/engines/dem/bulk/steps.py", "vv/engines/dem/bulk/threads.py",
    "vv/engines/dem/bonds/threads.py",
}  # fmt: skip


def test_every_file_that_compiles_a_kernel_has_mutants_in_a_code_that_it_is_part_of() -> None:
    found = kernels()
    compiled = {
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "vv").rglob("*.py")
        if COMPILED.search(path.read_text())
    }
    assert compiled <= set(found)
    assert {mutant.file for mutant in mechanical(1)} >= compiled - PLAIN
    assert {codes[0] for codes in found.values()} == {"dem", "exact", "rigid", "dda"}
    assert found["vv/engines/kernels/drive.py"] == ("dem", "rigid", "dda")


def test_a_mutant_differs_from_its_file_and_is_still_a_program() -> None:
    for mutant in mechanical(1):
        assert ast.unparse(ast.parse(mutant.text())) != ast.unparse(parsed(mutant.file)), (
            mutant.what
        )


def test_choices_in_kernels_of_every_kind_are_made_as_in_kernels() -> None:
    """Elsewhere a whole number could become another kind of number, and would not compile."""
    made = {"function": "Kernel", "return": "Kernel"}
    kinds = inspect.getmembers(compiling, inspect.isfunction)
    assert {name for name, one in kinds if one.__annotations__ == made} == set(KERNEL)


def check_syntax(text: str, suffix: str) -> None:
    """Raise an error where a text is no program; one of a page is parsed where node is there."""
    if suffix == ".py":
        ast.parse(text)
    elif node := shutil.which("node"):
        subprocess.run([node, "--check", "-"], input=text, text=True, check=True)


@pytest.mark.parametrize("kind", KINDS)
def test_every_seeded_bug_is_found_in_its_file_and_leaves_a_program(kind: str) -> None:
    assert len(KINDS[kind]) >= 16
    for bug in KINDS[kind]:
        text = changed(bug)
        check_syntax(text, Path(bug.file).suffix)
        assert text != (ROOT / bug.file).read_text(), bug.what
        assert bug.code or bug.tests, bug.what
        for one in bug.tests.split():
            file, _, test = one.partition("::")
            assert (ROOT / file).exists(), bug.what
            assert not test or f"\ndef {test}(" in (ROOT / file).read_text(), bug.what


def test_no_two_seeded_bugs_have_one_name() -> None:
    names = [bug.what for bugs in KINDS.values() for bug in bugs]
    assert len(names) == len(set(names)) >= 100
