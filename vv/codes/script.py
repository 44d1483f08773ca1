"""Writes an ask as a Python script that runs alone: the native input of the in-house codes."""

from __future__ import annotations

import dataclasses
import enum
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from vv.ask import Ask
from vv.base.digest import digest

WIDTH = 88  # columns, beyond which a call or a list is broken into lines

SCRIPT = '''"""Solves one scene with {module} and prints time and observables, in SI units.

It runs alone, with the Python in which vv is installed: .venv/bin/python FILE
"""

import sys

import numpy as np

import {module}
{imports}

ask = {ask}

run = {module}.{function}(ask)
if run.status is not Status.RAN:
    sys.exit(f"{{run.status.value}}: {{run.reason}}")
print("# t", *ask.observables, *ask.energies, sep=", ")
columns = [run.times, *(run.values[observable] for observable in ask.observables)]
columns += [run.energies[form] for form in ask.energies]
np.savetxt(sys.stdout, np.column_stack(columns), fmt="%.17g")
'''


def python_script(ask: Ask, engine_module: str, function: str) -> str:
    """The text of a script that puts `ask` to `engine_module.function(ask) -> Run`.

    The script prints a header, then a row per time: t, then three components per observable and
    one number per form of energy.
    It rebuilds the ask bit for bit; data equal to a default is left out. Needs vv and numpy.
    """
    used = {(_public(kind), kind.__name__) for kind in _kinds(ask)} | {("vv.ask", "Status")}
    modules = sorted({module for module, _ in used})
    imports = "\n".join(
        f"from {module} import {', '.join(sorted(n for m, n in used if m == module))}"
        for module in modules
    )
    return SCRIPT.format(module=engine_module, function=function, imports=imports, ask=source(ask))


def _public(kind: type) -> str:
    """The package that people import a class of a scene or an ask from, such as `vv.scene`."""
    return ".".join(kind.__module__.split(".")[:2])


def source(value: Any, indent: int = 0) -> str:
    """A Python expression that evaluates to `value`: frozen data, arrays, tuples and scalars."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        inner = [f"{name}={source(part, indent + 4)}" for name, part in _stated(value)]
        return _bracketed(f"{type(value).__name__}(", inner, ")", indent)
    if isinstance(value, np.ndarray):
        rows = [repr(row).replace("inf", "np.inf") for row in value.tolist()]
        return "np.array(" + _bracketed("[", rows, "]", indent) + ")"
    if isinstance(value, tuple):
        parts = [source(part, indent + 4) for part in value]
        closing = ",)" if len(parts) == 1 else ")"
        return _bracketed("(", parts, closing, indent)
    if isinstance(value, enum.Enum):
        return f"{type(value).__name__}.{value.name}"
    if isinstance(value, float) and not math.isfinite(value):
        return f'float("{value}")'
    return repr(value)


def _bracketed(opening: str, parts: list[str], closing: str, indent: int) -> str:
    """The parts on one line if they fit, else one to a line."""
    line = opening + ", ".join(parts) + closing
    if indent + len(line) <= WIDTH and "\n" not in line:
        return line
    margin = " " * (indent + 4)
    body = "".join(f"\n{margin}{part}," for part in parts)
    return f"{opening}{body}\n{' ' * indent}{closing[-1]}"


def _stated(value: Any) -> Iterator[tuple[str, Any]]:
    """The fields that must be written: those that differ from their defaults."""
    for field in dataclasses.fields(value):
        default: Any = field.default
        if field.default_factory is not dataclasses.MISSING:
            default = field.default_factory()
        if default is not dataclasses.MISSING:
            plain = dataclasses.replace(value, **{field.name: default})
            if digest(plain) == digest(value):
                continue
        yield field.name, getattr(value, field.name)


def _kinds(value: Any) -> Iterator[type]:
    """The classes that the expression for `value` uses."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        yield type(value)
        for _, part in _stated(value):
            yield from _kinds(part)
    elif isinstance(value, tuple):
        for part in value:
            yield from _kinds(part)
    elif isinstance(value, enum.Enum):
        yield type(value)
