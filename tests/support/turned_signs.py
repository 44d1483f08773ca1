"""Copies of modules with one sign changed, which tests must not accept as the solution."""

import ast
import inspect
from collections.abc import Callable
from types import ModuleType

import pytest


def signs(
    module: ModuleType, within: tuple[str, ...] = (), without: tuple[str, ...] = ()
) -> list[object]:
    """Parameters of a test: the index of each sign of a module, or of these functions of it, but
    for that of some expressions; the expression is the name.
    """
    tree = ast.parse(inspect.getsource(module))
    roots = [node for node in tree.body if not within or getattr(node, "name", "") in within]
    inside = {id(node) for root in roots for node in ast.walk(root)}
    found = [(i, ast.unparse(node), node) for i, node in enumerate(_signs(tree))]
    return [
        pytest.param(i, id=text)
        for i, text, node in found
        if id(node) in inside and text not in without
    ]


def turned(module: ModuleType, index: int | None) -> ModuleType:
    """The module from its source, with the sign of that index changed."""
    tree = ast.parse(inspect.getsource(module))
    node = None if index is None else _signs(tree)[index]
    if isinstance(node, ast.BinOp):
        node.op = ast.Sub() if isinstance(node.op, ast.Add) else ast.Add()
    elif isinstance(node, ast.UnaryOp):
        node.op = ast.UAdd()
    return _made(module, tree)


def using(module: ModuleType, *others: ModuleType) -> ModuleType:
    """The module from its source, with these modules in place of those of the same name."""
    made = _made(module, ast.parse(inspect.getsource(module)))
    for name, value in list(vars(made).items()):
        for other in others:
            if isinstance(value, ModuleType) and value.__name__ == other.__name__:
                setattr(made, name, other)
            elif getattr(value, "__module__", "") == other.__name__:
                setattr(made, name, getattr(other, name))
    return made


def _signs(tree: ast.Module) -> list[ast.AST]:
    return [node for node in ast.walk(tree) if _is_sign(node)]


def _is_sign(node: ast.AST) -> bool:
    if isinstance(node, ast.BinOp):
        return isinstance(node.op, ast.Add | ast.Sub)
    return isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub)


def _made(module: ModuleType, tree: ast.Module) -> ModuleType:
    made = ModuleType(module.__name__)
    exec(compile(tree, module.__name__, "exec"), vars(made))
    return made


def caught(agrees: Callable[[], bool]) -> bool:
    """Whether a changed sign is detected: by a disagreement, or by an error that it causes."""
    try:
        return not agrees()
    except (ArithmeticError, IndexError, RuntimeError, TypeError, ValueError, Warning):
        return True
