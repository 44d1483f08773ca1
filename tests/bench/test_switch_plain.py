"""Claims about mutants in kernels that run as plain Python: only the side that is taken is run."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from bench.mutation.in_copy.switch_plain import lazily, plainly
from bench.mutation.schemata import AS_PYTHON, as_in_copy
from tests import ROOT

SOURCE = """
def same(function):
    return function


@same
def part(a: Unknown, b: Unknown) -> Unknown:
    return _either(1, a * b, _either(2, a, a / b)) + _either(3, 1, 1 / 0)
"""


def of_copy(path: Path, on: int) -> Any:
    """The function of the source, with a mutant that is on."""
    path.write_text(SOURCE.replace("\n", "\nfrom __future__ import annotations\n", 1))
    names: dict[str, Any] = {"_on": lambda number: number == on}
    exec(compile(path.read_text(), str(path), "exec"), names)
    part = names["part"]
    part.__code__ = lazily(part)
    return part


def test_what_would_divide_by_zero_is_run_where_it_is_chosen_alone(tmp_path: Path) -> None:
    assert of_copy(tmp_path / "kernels.py", on=0)(3.0, 0.0) == 1.0
    assert of_copy(tmp_path / "kernels.py", on=1)(3.0, 0.0) == 4.0
    with pytest.raises(ZeroDivisionError):
        of_copy(tmp_path / "kernels.py", on=3)(3.0, 2.0)


def test_a_function_without_choices_is_run_as_it_is() -> None:
    assert plainly(of_copy).__code__ is of_copy.__code__


@pytest.mark.parametrize(
    ("name", "way"),
    [
        ("tests/support/plain.py", "FunctionType(lazily(function), names"),
        ("tests/engines/conftest.py", "return plainly(kernel.__wrapped__)(*arguments)"),
    ],
)
def test_tests_of_the_copy_run_kernels_in_this_way(name: str, way: str) -> None:
    text = as_in_copy(name, (ROOT / name).read_bytes()).decode()
    assert way in text
    assert text.count("import lazily, plainly\n") == 1
    assert len(AS_PYTHON) == 2


def test_other_files_are_copied_as_they_are() -> None:
    assert as_in_copy("tests/conftest.py", b"kernel.__wrapped__(*arguments)") == (
        b"kernel.__wrapped__(*arguments)"
    )
