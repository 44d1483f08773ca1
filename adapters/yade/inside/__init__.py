"""The program that runs inside YADE: one script, combined from the files in this folder."""

import ast
import functools
from pathlib import Path

PARTS = ("session", "bodies", "bonds", "engines", "stepping", "driver")  # in order of dependence
EMPTY = "ASK: dict[str, Any] | None = None\n"


def script(ask: str | None = None) -> str:
    """The text of the program, which needs no other file; ask: filled in, as its place there says.

    Imports between files of this folder are removed; the imported file stands earlier in the
    script.
    """
    return _whole() if ask is None else _whole().replace(EMPTY, ask)


@functools.cache
def _whole() -> str:
    """All parts as one text, cached since a report asks for it hundreds of times."""
    texts = [_alone((Path(__file__).parent / f"{part}.py").read_text()) for part in PARTS]
    return "\n\n".join(texts)


def _alone(text: str) -> str:
    """A part without its imports from other parts."""
    lines = text.splitlines(keepends=True)
    for node in ast.parse(text).body:
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith(__name__):
            last = node.end_lineno or node.lineno
            lines[node.lineno - 1 : last] = [""] * (last - node.lineno + 1)
    return "".join(lines)
