"""Combines terms: makes one function for each hook, which calls all terms that have the hook.

A term is a file of `vv/engines/dem/terms/`; its hooks are functions in that file. numba knows the
classes of the terms when it compiles a kernel, so hooks that a scene lacks cost nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from numba.extending import overload

from vv.engines.kernels.by_class import hook_of
from vv.engines.kernels.compiled import HIDDEN, LENT, ROUNDING
from vv.engines.kernels.compiler.parts import PartCompiler

Hook = TypeVar("Hook", bound=Callable[..., object])
OPTIONS: Any = {"forceinline": True, "pipeline_class": PartCompiler, **LENT, **HIDDEN, **ROUNDING}


def call(parts: list[int], rest: str) -> list[str]:
    """Source lines that call the hook of all terms in order."""
    return [*(f"hook_{k}(terms[{k}], {rest})" for k in parts), "return None"]


def first(parts: list[int], rest: str) -> list[str]:
    """Source lines that return the first term that has the hook, without calling it, or None."""
    return [f"return terms[{k}]" for k in parts[:1]] or ["return None"]


def chain(parts: list[int], rest: str) -> list[str]:
    """Source lines that pass the first argument through the hook of all terms in order."""
    changed = rest.split(", ", maxsplit=1)[0]
    return [*(f"{changed} = hook_{k}(terms[{k}], {rest})" for k in parts), f"return {changed}"]


def total(count: int) -> Callable[[list[int], str], list[str]]:
    """Source lines that add up the `count` numbers that each term returns, in order."""
    names = [f"sum_{c}" for c in range(count)]

    def lines(parts: list[int], rest: str) -> list[str]:
        written = []
        for k in parts:
            written.append(f"one = hook_{k}(terms[{k}], {rest})")
            before = [""] * count if k == parts[0] else [f"{name} + " for name in names]
            written += [f"{names[c]} = {before[c]}one[{c}]" for c in range(count)]
        return [*written, f"return {', '.join(names if parts else ['0.0'] * count)},"]

    return lines


def added(parts: list[int], rest: str) -> list[str]:
    """Source lines that add what each term returns to the pair in the first argument, in order."""
    held, _, others = rest.partition(", ")
    written = []
    for k in parts:
        written.append(f"one = hook_{k}(terms[{k}], {others})")
        written.append(f"{held} = {held}[0] + one[0], {held}[1] + one[1]")
    return [*written, f"return {held}"]


def composed(combine: Callable[[list[int], str], list[str]]) -> Callable[[Hook], Hook]:
    """Turns a function that only names arguments into one that calls this hook of all terms.

    The first argument is the tuple of terms.
    """

    def register(hook: Hook) -> Hook:
        code = hook.__code__
        rest = ", ".join(code.co_varnames[1 : code.co_argcount])

        @overload(hook, jit_options=OPTIONS, strict=False)
        def typed(terms: Any, *_: Any) -> Any:
            found = {k: function for k, kind in enumerate(terms)
                     if (function := hook_of(kind, hook.__name__)) is not None}  # fmt: skip
            lines = combine([*found], rest)
            source = f"def {hook.__name__}(terms, {rest}):\n " + "\n ".join(lines)
            names: dict[str, Any] = {f"hook_{k}": function for k, function in found.items()}
            exec(source, names)
            return names[hook.__name__]

        return hook

    return register
