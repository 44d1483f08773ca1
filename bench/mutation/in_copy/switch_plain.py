"""Compiles kernels that run as plain Python in the copy, where it is vv/switch_plain.py.

Compiled kernels compute both sides of a choice between mutants; in Python the side that is not
taken could raise, for example where it divides by zero.
"""

import __future__

import ast
import functools
from pathlib import Path
from types import CodeType, FunctionType


class Chosen(ast.NodeTransformer):
    """Turns choices of which both sides are computed into those of which one is."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """`_either(number, old, new)` becomes `new if _on(number) else old`."""
        self.generic_visit(node)
        if not (isinstance(node.func, ast.Name) and node.func.id == "_either"):
            return node
        number, old, new = node.args
        return ast.IfExp(ast.Call(ast.Name("_on", ast.Load()), [number], []), new, old)


@functools.cache
def plainly(function: FunctionType) -> FunctionType:
    """The function, with choices of which only one side is computed."""
    names, defaults = function.__globals__, function.__defaults__
    return FunctionType(lazily(function), names, function.__name__, defaults, function.__closure__)


def lazily(function: FunctionType) -> CodeType:
    """The code of a function, with choices of which only one side is computed."""
    given = function.__code__
    node = _definition(given)
    if not any(isinstance(one, ast.Name) and one.id == "_either" for one in ast.walk(node)):
        return given
    node.decorator_list = []
    module = ast.fix_missing_locations(ast.Module([Chosen().visit(node)], []))
    names = dict(function.__globals__)
    flags = __future__.annotations.compiler_flag
    exec(compile(module, given.co_filename, "exec", flags, dont_inherit=True), names)
    made: FunctionType = names[given.co_name]
    return made.__code__


def _definition(given: CodeType) -> ast.FunctionDef:
    """The definition that a code was compiled from."""
    tree = ast.parse(Path(given.co_filename).read_text())
    found = (
        one for one in ast.walk(tree)
        if isinstance(one, ast.FunctionDef) and one.name == given.co_name
        and given.co_firstlineno in (one.lineno, *(d.lineno for d in one.decorator_list))
    )  # fmt: skip
    return next(found)
