"""Claims about mutants in kernels that run as plain Python: only the side that is taken is run."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from bench.mutation.engine_mutants import PLAIN, lazy
from bench.mutation.switch_plain import lazily
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


def test_tests_of_the_copy_run_kernels_in_this_way() -> None:
    text = lazy((ROOT / PLAIN).read_bytes()).decode()
    assert "FunctionType(lazily(function), names" in text
    assert "import lazily\n" in text
